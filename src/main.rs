//! The program `photon-mapping`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(photon_mapping::cli::run(std::env::args_os()))
}
