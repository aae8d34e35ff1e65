//! The stand-in for the framework and the harness, written to a folder, and the compiler for them.

use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use tempfile::TempDir;

use crate::error::CheckError;
use crate::foreign::system_folders;
use crate::kept::{kept, make_whole, remove_unused, users_folder};

/// The framework's standard.
pub(crate) const STANDARD: &str = "-std=gnu++11";
/// What nearly all files read first, and takes most of the time: the standard headers, and glm.
pub(crate) const COMMON: &str = "standin/common/common.h";
/// What other files read first: nothing.
pub(crate) const NOTHING: &str = "harness/first.hpp";
/// The sources of the harness. The first is compiled anew for submissions that replace a header of
/// the framework.
pub(crate) const HARNESS: [&str; 2] = ["harness/harness.cpp", "harness/rest.cpp"];
/// For as many submissions, a precompiled header takes less time than it saves.
const MANY: usize = 3;
/// How the names of our folders begin.
pub(crate) const PREFIX: &str = "photon-mapping-check-";
/// A younger folder may not be locked yet.
const YOUNG: Duration = Duration::from_secs(60);

macro_rules! assets {
    ($($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../assets/", $path)))),*]
    };
}

/// The C++ files, by their paths under the kit's folder.
pub(crate) const ASSETS: &[(&str, &str)] = assets![
    "harness/around.cpp",
    "harness/first.hpp",
    "harness/guard.cpp",
    "harness/harness.cpp",
    "harness/plan.cpp",
    "harness/plan.hpp",
    "harness/random.cpp",
    "harness/recorder.cpp",
    "harness/recorder.hpp",
    "harness/rest.cpp",
    "harness/scene.cpp",
    // Those that people plug into the framework themselves, by links to `interop/cpp`.
    "standin/photon_dump.hpp",
    "standin/reference_rand.hpp",
    "standin/common/common.h",
    "standin/common/core.h",
    "standin/common/Intersection/IntersectionState.h",
    "standin/common/Rendering/Material/Material.h",
    "standin/common/Rendering/Renderer.h",
    "standin/common/Rendering/Renderer/Backward/BackwardRenderer.h",
    "standin/common/Rendering/Renderer/Photon/Photon.h",
    "standin/common/Rendering/Renderer/Photon/PhotonMappingRenderer.h",
    "standin/common/Sampling/ColorSampler.h",
    "standin/common/Scene/Camera/Camera.h",
    "standin/common/Scene/Camera/Perspective/PerspectiveCamera.h",
    "standin/common/Scene/Geometry/Mesh/MeshObject.h",
    "standin/common/Scene/Geometry/Primitives/Primitive.h",
    "standin/common/Scene/Geometry/Primitives/PrimitiveBase.h",
    "standin/common/Scene/Geometry/Ray/Ray.h",
    "standin/common/Scene/Lights/Light.h",
    "standin/common/Scene/Lights/Point/PointLight.h",
    "standin/common/Scene/Scene.h",
    "standin/common/Scene/SceneObject.h",
    "standin/kdtree++/kdtree.hpp",
];

/// The kit, and a folder for submissions, which goes with it.
#[derive(Debug)]
pub struct Kit {
    folder: TempDir,
    /// Where the kit is: the user's folder for it, else `folder`.
    home: PathBuf,
    /// Both folders, locked as long as this process lives.
    _locks: [File; 2],
    /// The compiler.
    pub(crate) compiler: PathBuf,
    /// Where glm is, if not where the compiler looks anyway.
    pub(crate) glm: Option<PathBuf>,
    /// Where the compiler looks for headers.
    pub(crate) system: Vec<PathBuf>,
    /// Whether the compiler is clang, which assembles by itself.
    pub(crate) is_clang: bool,
    /// Held while the sources of the harness are compiled.
    harness: [Mutex<()>; 2],
}

impl Kit {
    /// Looks for a compiler, `$CXX`, `c++`, `g++`, `clang++`, and for the kit that an earlier run
    /// kept for it. Else writes one.
    ///
    /// # Errors
    /// When there is none, or the kit cannot be written.
    pub fn new(glm: Option<&Path>) -> Result<Self, CheckError> {
        Self::kept_in(users_folder().as_deref(), glm)
    }

    pub(crate) fn kept_in(parent: Option<&Path>, glm: Option<&Path>) -> Result<Self, CheckError> {
        let (compiler, version) = find_compiler().ok_or(CheckError::NoCompiler)?;
        let temporary = std::env::temp_dir();
        remove_unused(&temporary, YOUNG);
        let folder = tempfile::Builder::new()
            .prefix(PREFIX)
            .tempdir_in(temporary)
            .map_err(CheckError::io("a folder for temporary files"))?;
        let lock = File::open(folder.path()).and_then(|lock| Ok((lock.lock()?, lock)));
        let (_, lock) = lock.map_err(CheckError::io("a folder for temporary files"))?;
        let glm = glm.map(|glm| fs::canonicalize(glm).unwrap_or_else(|_| glm.to_owned()));
        let system = system_folders(&compiler);
        // Another glm has other times.
        let times = glm.iter().chain(&system).filter_map(|folder| {
            fs::metadata(folder.join("glm/glm.hpp")).and_then(|about| about.modified()).ok()
        });
        let times: Vec<_> = times.collect();
        let key = (&compiler, &version, &glm, &system, times);
        let (home, lock_of_home) = match parent.and_then(|parent| kept(parent, key)) {
            Some(kept) => kept,
            None => {
                write_assets(folder.path())?;
                let again = lock.try_clone().map_err(CheckError::io("a file that is open"))?;
                (folder.path().to_owned(), again)
            }
        };
        let is_clang = version.contains("clang");
        let (harness, _locks) = (Default::default(), [lock, lock_of_home]);
        Ok(Self { folder, home, _locks, compiler, glm, system, is_clang, harness })
    }

    /// The folder with the kit.
    pub(crate) fn path(&self) -> &Path {
        &self.home
    }

    /// The folder with the submissions.
    pub(crate) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Precompiles [`COMMON`] if so many `submissions` follow that it saves time, or this user
    /// checks again and again.
    pub fn prepare_for(&self, submissions: usize) {
        let header = self.path().join(COMMON);
        let precompiled = header.with_extension("h.gch");
        let is_wanted = submissions >= MANY || self.object(0).exists();
        // Clang has another format.
        if self.is_clang || !is_wanted || precompiled.exists() {
            return;
        }
        let command = self.command(STANDARD);
        let mut process = Command::new(&command[0]);
        process.args(&command[1..]);
        process.args(self.glm.iter().flat_map(|glm| ["-I".as_ref(), glm.as_os_str()]));
        process.args(["-x", "c++-header"]).arg(header).stdin(Stdio::null());
        // What fails here fails again where it is told.
        let _ = make_whole(&precompiled, |path| {
            Ok(process.arg("-o").arg(path).output()?.status.success())
        });
    }

    /// The compiler with the options that all files share.
    pub(crate) fn command(&self, standard: &str) -> Vec<OsString> {
        let mut command = vec![self.compiler.clone().into()];
        // -O1 takes the least time to compile and run together.
        let options = [standard, "-O1", "-w", "-fdiagnostics-color=never"];
        let defines = ["-DGLM_FORCE_CTOR_INIT", "-DGLM_ENABLE_EXPERIMENTAL"];
        command.extend(options.into_iter().chain(defines).map(OsString::from));
        command
    }

    /// Where an object file of the harness is kept, for submissions that replace no header of it.
    pub(crate) fn object(&self, of_harness: usize) -> PathBuf {
        self.path().join(HARNESS[of_harness]).with_extension("o")
    }

    /// An object file of the harness. The first submission compiles it with `compile`, which gives
    /// the path of the object, or what is wrong.
    pub(crate) fn harness<E>(
        &self,
        of_harness: usize,
        compile: impl FnOnce() -> Result<Result<PathBuf, E>, CheckError>,
    ) -> Result<Result<PathBuf, E>, CheckError> {
        // Others wait: they need the same object.
        let _lock = self.harness[of_harness].lock().unwrap_or_else(PoisonError::into_inner);
        let kept = self.object(of_harness);
        if kept.exists() {
            return Ok(Ok(kept));
        }
        let object = match compile()? {
            Ok(object) => object,
            Err(error) => return Ok(Err(error)),
        };
        let is_kept = make_whole(&kept, |path| fs::copy(&object, path).map(|_| true)).is_ok();
        Ok(Ok(if is_kept { kept } else { object }))
    }

    /// A new empty folder for one submission.
    ///
    /// # Errors
    /// When it cannot be made.
    pub(crate) fn work_folder(&self) -> Result<TempDir, CheckError> {
        tempfile::Builder::new()
            .prefix("submission-")
            .tempdir_in(self.folder())
            .map_err(CheckError::io("a folder for temporary files"))
    }
}

/// Writes the kit to `folder`.
pub(crate) fn write_assets(folder: &Path) -> Result<(), CheckError> {
    ASSETS.iter().try_for_each(|(path, content)| write(&folder.join(path), content.as_bytes()))
}

/// Writes a file, with the folders above it.
pub(crate) fn write(path: &Path, content: &[u8]) -> Result<(), CheckError> {
    let shown = path.display().to_string();
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(CheckError::io(shown.clone()))?;
    }
    fs::write(path, content).map_err(CheckError::io(shown))
}

/// The compiler, and what it says of its version.
fn find_compiler() -> Option<(PathBuf, String)> {
    let of_user = std::env::var_os("CXX").filter(|name| !name.is_empty());
    let usual = ["c++", "g++", "clang++"].map(OsString::from);
    of_user.into_iter().chain(usual).find_map(|name| {
        let output = Command::new(&name).arg("--version").stdin(Stdio::null()).output().ok()?;
        let version = String::from_utf8_lossy(&output.stdout).into_owned();
        output.status.success().then(|| (PathBuf::from(name), version))
    })
}
