//! The autograder for Gradescope: what an instructor zips and uploads.

use std::fs;

use super::super::error::CliError;
use super::KitFile;

/// The files of the kit. The grader is this program.
///
/// # Errors
/// When this program does not run on Gradescope, or cannot be read.
pub fn files() -> Result<Vec<KitFile>, CliError> {
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        let message = "kit gradescope: expected the program built for Linux on x86-64, which \
                       Gradescope runs; make the kit there";
        return Err(CliError::Argument(message.to_owned()));
    }
    let unreadable = |source| CliError::unreadable("photon-mapping".as_ref(), source);
    let program = std::env::current_exe().map_err(unreadable)?;
    let program = fs::read(&program).map_err(|source| CliError::unreadable(&program, source))?;
    Ok(vec![
        KitFile::new("README.md", include_str!("../../assets/gradescope/README.md")),
        KitFile::new("policy.json", include_str!("../../assets/gradescope/policy.json")),
        KitFile::executable("setup.sh", include_str!("../../assets/gradescope/setup.sh")),
        KitFile::executable(
            "run_autograder",
            include_str!("../../assets/gradescope/run_autograder"),
        ),
        KitFile::executable("photon-mapping", program),
    ])
}

/// What to know about this program before it is uploaded.
pub fn advice() -> &'static str {
    if cfg!(target_feature = "crt-static") {
        ""
    } else {
        "note: this program is linked to this system's C library and may not start on an older \
         one; README.md of the project says how to build a static one\n"
    }
}
