//! `photon-mapping kit`: folders for a course, ready to use.

mod gradescope;
mod lock;
mod student;

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, Subcommand};

use super::error::{CliError, print};
use super::output;

/// The options of `kit`.
#[derive(Debug, Args)]
pub struct KitArgs {
    #[command(subcommand)]
    kit: KitCommand,
}

#[derive(Debug, Subcommand)]
enum KitCommand {
    /// A Rust project for students: the reference with the handout's five sections left to write
    #[command(after_help = "\
Example: photon-mapping kit student --out starter/
Then, in starter/: cargo test names sections to write, cargo run --release draws the picture.")]
    Student(OutArgs),
    /// An autograder for Gradescope: zip the folder's files and upload them
    #[command(after_help = "Example: photon-mapping kit gradescope --out kit/")]
    Gradescope(OutArgs),
}

#[derive(Debug, Args)]
struct OutArgs {
    /// The folder to write; it must be new or empty
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// A file of a kit.
struct KitFile {
    /// Its place in the kit, with slashes.
    path: String,
    content: Vec<u8>,
    is_executable: bool,
}

impl KitFile {
    fn new(path: &str, content: impl Into<Vec<u8>>) -> Self {
        Self { path: path.to_owned(), content: content.into(), is_executable: false }
    }

    fn executable(path: &str, content: impl Into<Vec<u8>>) -> Self {
        Self { is_executable: true, ..Self::new(path, content) }
    }
}

/// Writes the kit, and prints its folder.
///
/// # Errors
/// When the folder has files already or cannot be written.
pub fn run(arguments: &KitArgs) -> Result<u8, CliError> {
    let (out, files, advice) = match &arguments.kit {
        KitCommand::Student(to) => (&to.out, student::files(), ""),
        KitCommand::Gradescope(to) => (&to.out, gradescope::files()?, gradescope::advice()),
    };
    write(out, &files)?;
    let count = files.len();
    print(&format!("{}: {count} files; start with README.md\n{advice}", out.display()))?;
    Ok(0)
}

fn write(out: &Path, files: &[KitFile]) -> Result<(), CliError> {
    let unwritable = |path: &Path| {
        let path = path.to_owned();
        move |source| CliError::Unwritable { path, source }
    };
    fs::create_dir_all(output::folder(out)?).map_err(unwritable(out))?;
    if fs::read_dir(out).map_err(unwritable(out))?.next().is_some() {
        let message = format!("--out {}: expected a new or empty folder", out.display());
        return Err(CliError::Argument(format!("{message}, found files in it")));
    }
    for KitFile { path, content, is_executable } in files {
        let path = out.join(path);
        output::write(&path, content)?;
        if *is_executable {
            make_executable(&path).map_err(unwritable(&path))?;
        }
    }
    Ok(())
}

#[cfg(unix)]
fn make_executable(path: &Path) -> std::io::Result<()> {
    fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(0o755))
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> std::io::Result<()> {
    Ok(())
}
