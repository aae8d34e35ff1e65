//! What walls programs off from the network and from other processes.

use std::process::{Command, Stdio};
use std::sync::OnceLock;

/// Bubblewrap: no network, processes of its own, and a file system that is read-only.
pub(crate) const BUBBLEWRAP: &[&str] = &[
    "bwrap",
    "--ro-bind",
    "/",
    "/",
    "--dev",
    "/dev",
    "--proc",
    "/proc",
    "--unshare-all",
    "--die-with-parent",
];
/// Programs of util-linux: no network, and processes of its own that end with the checker. Signals
/// do not end the first process, so that is a shell.
pub(crate) const UNSHARE: &[&str] = &[
    "unshare",
    "--user",
    "--map-current-user",
    "--keep-caps",
    "setpriv",
    "--pdeathsig=KILL",
    "unshare",
    "--net",
    "--ipc",
    "--pid",
    "--fork",
    "--kill-child",
    "setpriv",
    "--ambient-caps=-all",
    "--inh-caps=-all",
    "sh",
    "-c",
    "exec 4>&2 2>/dev/null; (exec \"$@\" 2>&4 4>&-); exit $?",
    "sh",
];

/// What walls programs off, where it is there and allowed to work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wall {
    /// Bubblewrap.
    Bubblewrap,
    /// `unshare`: for submissions, not for compilers.
    Unshare,
    /// Nothing.
    None,
}

/// The best wall of this system.
pub fn wall() -> Wall {
    static WALL: OnceLock<Wall> = OnceLock::new();
    let works = |command: &[&str]| {
        Command::new(command[0])
            .args(&command[1..])
            .arg("true")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success())
    };
    *WALL.get_or_init(|| match () {
        () if works(BUBBLEWRAP) => Wall::Bubblewrap,
        () if works(UNSHARE) => Wall::Unshare,
        () => Wall::None,
    })
}
