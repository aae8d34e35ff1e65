//! The stand-in for the framework and the harness, written to a folder, and the compiler for them.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, PoisonError};

use tempfile::TempDir;

use crate::error::CheckError;

macro_rules! assets {
    ($($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../assets/", $path)))),*]
    };
}

/// The C++ files, by their paths under the kit's folder.
const ASSETS: &[(&str, &str)] = assets![
    "harness/all.cpp",
    "harness/guard.cpp",
    "harness/harness.cpp",
    "harness/random.cpp",
    "harness/recorder.cpp",
    "harness/recorder.hpp",
    "harness/scene.cpp",
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
    /// The compiler.
    pub compiler: PathBuf,
    /// Where glm is, if not where the compiler looks anyway.
    pub glm: Option<PathBuf>,
    /// The harness, compiled for submissions without headers of their own.
    harness: Mutex<Option<PathBuf>>,
}

impl Kit {
    /// Writes the kit and looks for a compiler: `$CXX`, `c++`, `g++`, `clang++`.
    ///
    /// # Errors
    /// When there is none, or the kit cannot be written.
    pub fn new(glm: Option<&Path>) -> Result<Self, CheckError> {
        let compiler = find_compiler().ok_or(CheckError::NoCompiler)?;
        let folder = tempfile::Builder::new()
            .prefix("photon-mapping-check-")
            .tempdir()
            .map_err(CheckError::io("a folder for temporary files"))?;
        for (path, content) in ASSETS {
            write(&folder.path().join(path), content.as_bytes())?;
        }
        let glm = glm.map(|glm| fs::canonicalize(glm).unwrap_or_else(|_| glm.to_owned()));
        Ok(Self { folder, compiler, glm, harness: Mutex::new(None) })
    }

    /// The folder with the kit.
    pub fn path(&self) -> &Path {
        self.folder.path()
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

/// Writes a file, with the folders above it.
pub(crate) fn write(path: &Path, content: &[u8]) -> Result<(), CheckError> {
    let shown = path.display().to_string();
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(CheckError::io(shown.clone()))?;
    }
    fs::write(path, content).map_err(CheckError::io(shown))
}

fn find_compiler() -> Option<PathBuf> {
    let of_user = std::env::var_os("CXX").filter(|name| !name.is_empty());
    let usual = ["c++", "g++", "clang++"].map(OsString::from);
    of_user.into_iter().chain(usual).find_map(|name| {
        let works = Command::new(&name)
            .arg("--version")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success());
        works.then(|| PathBuf::from(name))
    })
}
