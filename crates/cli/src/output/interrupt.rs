//! What happens when a signal ends the program.

/// On Ctrl-C and its like, removes the files being written and ends with the exit code that shells
/// expect: 128 and the number of the signal.
#[cfg(unix)]
pub fn remove_unfinished_files_on_interrupt() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let signals = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| !is_ignored(*signal));
    // Without the handler an interrupt would leave a temporary file behind, nothing worse: no
    // reason to give up.
    let Ok(mut signals) = Signals::new(signals) else { return };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            let _held = super::unfinished::remove_own();
            std::process::exit(128 + signal);
        }
    });
}

/// Whether whoever started the program asked that it not end on `signal`, as `nohup` does.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// The next run removes what is left.
#[cfg(not(unix))]
pub fn remove_unfinished_files_on_interrupt() {}
