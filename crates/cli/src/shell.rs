//! What a shell asks of the program: completions, manual pages, and `-q` before the verb.

use std::ffi::OsString;

use clap::Args;
use clap_complete::Shell;
use clap_mangen::Man;

use super::error::{CliError, print};
use super::examples::command;

/// The options of `completions`.
#[derive(Debug, Args)]
#[command(after_help = "\
Example, for bash: photon-mapping completions bash >> ~/.bash_completion")]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// The options of `man`.
#[derive(Debug, Args)]
#[command(after_help = "Example: photon-mapping man grade | man -l -")]
pub struct ManArgs {
    /// The verb
    verb: Option<String>,
}

/// Prints the completions.
///
/// # Errors
/// When standard output cannot be written.
pub fn completions(arguments: &CompletionsArgs) -> Result<u8, CliError> {
    let mut text = Vec::new();
    clap_complete::generate(arguments.shell, &mut command(), "photon-mapping", &mut text);
    print(&String::from_utf8_lossy(&text))?;
    Ok(0)
}

/// Prints a manual page.
///
/// # Errors
/// When there is no such verb, or standard output cannot be written.
pub fn man(arguments: &ManArgs) -> Result<u8, CliError> {
    let mut program = command();
    program.build();
    let page_of = match &arguments.verb {
        None => program,
        Some(verb) => program.find_subcommand(verb).cloned().ok_or_else(|| {
            let verbs: Vec<&str> = program.get_subcommands().map(|verb| verb.get_name()).collect();
            let message = format!("man: expected one of {}, found '{verb}'", verbs.join(", "));
            CliError::Argument(message)
        })?,
    };
    let mut page = Vec::new();
    Man::new(page_of).render(&mut page).expect("memory takes everything");
    print(&String::from_utf8_lossy(&page))?;
    Ok(0)
}

/// `words` of a command line, with a `-q` before the verb moved behind it, where the verb reads it.
pub fn quiet_after_verb(mut words: Vec<OsString>) -> Vec<OsString> {
    let is_quiet = words.get(1).is_some_and(|word| word == "-q" || word == "--quiet");
    let verb = words.get(2).and_then(|word| word.to_str());
    if is_quiet && verb.is_some_and(|verb| command().find_subcommand(verb).is_some()) {
        words.swap(1, 2);
    }
    words
}
