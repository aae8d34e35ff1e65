//! The stand-in for the framework and the harness, written to a folder, and the compiler for them.

use std::ffi::OsString;
use std::fs::{self, File};
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use tempfile::TempDir;

use crate::error::CheckError;
use crate::foreign::system_folders;

/// The framework's standard.
pub(crate) const STANDARD: &str = "-std=gnu++11";
/// The headers that the two files include first.
pub(crate) const FIRST_HEADERS: [&str; 2] = [
    "standin/common/Rendering/Renderer/Photon/PhotonMappingRenderer.h",
    "standin/common/Scene/Lights/Point/PointLight.h",
];
/// For as many submissions, precompiled headers take less time than they save.
const MANY: usize = 6;
/// How the names of our temporary folders begin.
const PREFIX: &str = "photon-mapping-check-";
/// A younger folder may not be locked yet.
const YOUNG: Duration = Duration::from_secs(60);

macro_rules! assets {
    ($($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../assets/", $path)))),*]
    };
}

/// The C++ files, by their paths under the kit's folder.
const ASSETS: &[(&str, &str)] = assets![
    "harness/all.cpp",
    "harness/around.cpp",
    "harness/guard.cpp",
    "harness/harness.cpp",
    "harness/random.cpp",
    "harness/recorder.cpp",
    "harness/recorder.hpp",
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

/// The kit in a folder of its own, which goes with it.
#[derive(Debug)]
pub struct Kit {
    folder: TempDir,
    /// The folder, locked as long as this process lives.
    _lock: File,
    /// The compiler.
    pub compiler: PathBuf,
    /// Where glm is, if not where the compiler looks anyway.
    pub glm: Option<PathBuf>,
    /// Where the compiler looks for headers.
    pub(crate) system: Vec<PathBuf>,
    /// Whether the compiler is clang, which assembles by itself.
    pub(crate) is_clang: bool,
    /// The harness, compiled for submissions without headers of their own.
    harness: Mutex<Option<PathBuf>>,
}

impl Kit {
    /// Writes the kit and looks for a compiler: `$CXX`, `c++`, `g++`, `clang++`.
    ///
    /// # Errors
    /// When there is none, or the kit cannot be written.
    pub fn new(glm: Option<&Path>) -> Result<Self, CheckError> {
        let (compiler, version) = find_compiler().ok_or(CheckError::NoCompiler)?;
        let parent = std::env::temp_dir();
        remove_abandoned(&parent);
        let folder = tempfile::Builder::new()
            .prefix(PREFIX)
            .tempdir_in(parent)
            .map_err(CheckError::io("a folder for temporary files"))?;
        let lock = File::open(folder.path()).and_then(|lock| Ok((lock.lock()?, lock)));
        let (_, lock) = lock.map_err(CheckError::io("a folder for temporary files"))?;
        for (path, content) in ASSETS {
            write(&folder.path().join(path), content.as_bytes())?;
        }
        let glm = glm.map(|glm| fs::canonicalize(glm).unwrap_or_else(|_| glm.to_owned()));
        let system = system_folders(&compiler);
        let is_clang = version.contains("clang");
        let harness = Mutex::new(None);
        Ok(Self { folder, _lock: lock, compiler, glm, system, is_clang, harness })
    }

    /// The folder with the kit.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Precompiles headers if so many `submissions` follow that it saves time. GCC takes what is
    /// precompiled only where that changes nothing: for the first header that a file includes.
    pub fn prepare_for(&self, submissions: usize) {
        // Clang would have to be told in every call, and would then take it in any case.
        if submissions < MANY || self.is_clang {
            return;
        }
        let precompile = |header: &str| {
            let header = self.path().join(header);
            let command = self.command(STANDARD);
            let mut process = Command::new(&command[0]);
            process.args(&command[1..]).arg("-I").arg(self.path().join("standin"));
            process.args(self.glm.iter().flat_map(|glm| ["-I".as_ref(), glm.as_os_str()]));
            process.args(["-x", "c++-header"]).arg(header).stdin(Stdio::null());
            // What fails here fails again where it is told.
            let _ = process.output();
        };
        std::thread::scope(|scope| {
            for header in FIRST_HEADERS {
                scope.spawn(move || precompile(header));
            }
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

    /// The object file of the harness for submissions without headers of their own. The first one
    /// compiles it with `compile`, which gives the path of the object, or what is wrong.
    pub(crate) fn harness<E>(
        &self,
        compile: impl FnOnce() -> Result<Result<PathBuf, E>, CheckError>,
    ) -> Result<Result<PathBuf, E>, CheckError> {
        // Others wait: they need the same object.
        let mut harness = self.harness.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(path) = &*harness {
            return Ok(Ok(path.clone()));
        }
        let object = match compile()? {
            Ok(object) => object,
            Err(error) => return Ok(Err(error)),
        };
        let kept = self.path().join("harness.o");
        fs::copy(object, &kept).map_err(CheckError::io("harness.o"))?;
        *harness = Some(kept.clone());
        Ok(Ok(kept))
    }

    /// A new empty folder for one submission.
    ///
    /// # Errors
    /// When it cannot be made.
    pub fn work_folder(&self) -> Result<TempDir, CheckError> {
        tempfile::Builder::new()
            .prefix("submission-")
            .tempdir_in(self.path())
            .map_err(CheckError::io("a folder for temporary files"))
    }
}

/// Removes the folders in `parent` that killed processes of this user left: nobody locks them.
fn remove_abandoned(parent: &Path) {
    let user = rustix::process::geteuid().as_raw();
    for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
        let is_ours = entry.file_name().to_string_lossy().starts_with(PREFIX)
            && fs::symlink_metadata(entry.path()).is_ok_and(|about| {
                let age = about.modified().ok().and_then(|modified| modified.elapsed().ok());
                about.is_dir() && about.uid() == user && age.is_some_and(|age| age > YOUNG)
            });
        if is_ours && File::open(entry.path()).is_ok_and(|folder| folder.try_lock().is_ok()) {
            // What cannot be removed now is tried again by the next run.
            let _ = fs::remove_dir_all(entry.path());
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_folders_that_a_killed_process_left_are_removed() {
        let parent = tempfile::tempdir().expect("a folder");
        let at = |name: &str| parent.path().join(name);
        let outside = tempfile::tempdir().expect("a folder");
        for name in [&format!("{PREFIX}old"), &format!("{PREFIX}locked"), "other"] {
            write(&at(name).join("submission-1/a.o"), b"").expect("can be written");
        }
        std::os::unix::fs::symlink(outside.path(), at("photon-mapping-check-link"))
            .expect("a link");
        let now = std::time::SystemTime::now();
        for entry in fs::read_dir(parent.path()).expect("a folder").flatten() {
            let folder = File::open(entry.path()).expect("a folder");
            folder.set_modified(now - 2 * YOUNG).expect("can be set");
        }
        write(&at("photon-mapping-check-young").join("plan.txt"), b"").expect("can be written");
        let lock = File::open(at("photon-mapping-check-locked")).expect("a folder");
        lock.lock().expect("can be locked");
        remove_abandoned(parent.path());
        let left = fs::read_dir(parent.path()).expect("a folder").flatten();
        let mut left: Vec<_> = left.map(|entry| entry.file_name()).collect();
        left.sort();
        let names = ["check-link", "check-locked", "check-young"];
        let names = names.map(|name| format!("photon-mapping-{name}"));
        assert_eq!(left[1..], names.map(OsString::from));
        assert!(left[0] == "other" && outside.path().is_dir());
        // Closing is not enough: a compiler that another test starts may hold a copy for a moment.
        lock.unlock().expect("can be unlocked");
        remove_abandoned(parent.path());
        assert!(!at("photon-mapping-check-locked").exists());
    }
}
