//! Traces the reference run and holds its hash against the golden one: the check that another
//! processor gives the same bits. Exits with 1 when it does not.

use std::process::ExitCode;

use photon_mapping::assignment8::{PHOTON_COUNT, SEED};
use photon_mapping::photon_list::{ListHash, trace};

fn main() -> ExitCode {
    let snapshot = include_str!("../golden/handout-1000000-sha256.snap");
    let golden = snapshot.lines().last().expect("the snapshot has a line for the hash");
    let mut hash = ListHash::default();
    hash.update(&trace(SEED, PHOTON_COUNT));
    println!("{}: golden {golden}, traced {}", std::env::consts::ARCH, hash.hex());
    if hash.hex() == golden { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
