//! An example at the end of each verb's help.

use clap::{Command, CommandFactory};

use super::Cli;
use super::color::option;

/// Verbs, and how they are used most.
const EXAMPLES: [(&str, &str); 9] = [
    ("render", "photon-mapping render --seed 7 --photons 200000 --out run7/"),
    ("compare", "photon-mapping compare --seed 148 --photons 1000000 submission.csv"),
    ("explain", "photon-mapping explain 73"),
    ("explore", "photon-mapping explore --photon 73 --out page/"),
    ("grade", "photon-mapping grade class/ --format html --out pages/"),
    ("expect", "photon-mapping expect --quick"),
    ("merge", "photon-mapping merge part1/photons.ply part2/photons.ply --out photons.ply"),
    ("report", "photon-mapping report --quick --out report/"),
    ("kit", "photon-mapping kit gradescope --out kit/"),
];

/// The command line, with an example for each verb, and what holds for the outputs of all.
pub fn command() -> Command {
    let command = EXAMPLES.iter().fold(Cli::command().arg(option()), |command, (verb, example)| {
        command.mut_subcommand(verb, |verb| {
            let before = verb.get_after_help().map(|help| format!("{help}\n\n"));
            verb.after_help(format!("{}Example: {example}", before.unwrap_or_default()))
        })
    });
    command.mut_subcommands(|verb| {
        verb.mut_args(|arg| match arg.get_id() == "out" {
            true => {
                let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
                arg.help(format!("{help}; '-' is refused"))
            }
            false => arg,
        })
    })
}
