//! How many threads run where the system limits the address space, as `ulimit -v` does.

/// What `grade` needs for two lists of 5,000,000 records in a class of 42, in bytes, besides its
/// threads and for each of these: one ran in 563 MB, and six in 973 MB but not in 870 MB. Five once
/// ran out of 973 MB on a busy machine, so each has half as much again. The C library reserves
/// 64 MB for what each allocates.
const BASE: u64 = 560_000_000;
const OF_THREAD: u64 = 120_000_000;

/// Has no more threads than the address space holds: memory that runs out ends the whole program.
pub fn keep_within_memory() {
    let Some(limit) = limit() else { return };
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|threads| threads.parse().ok());
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = within(limit, asked.filter(|asked| *asked > 0).unwrap_or_else(cores));
    // Only once, before the first use: so it cannot fail but by the system's refusal, with which
    // the first use ends as well.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(threads).build_global();
}

fn within(limit: u64, wanted: usize) -> usize {
    let most = limit.saturating_sub(BASE) / OF_THREAD;
    wanted.min(usize::try_from(most).unwrap_or(usize::MAX)).max(1)
}

/// The address space in bytes, if it has a limit.
#[cfg(unix)]
fn limit() -> Option<u64> {
    rustix::process::getrlimit(rustix::process::Resource::As).current
}

#[cfg(not(unix))]
fn limit() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::within;

    #[test]
    fn address_space_bounds_threads() {
        assert_eq!(within(950_000 * 1024, 16), 3);
        assert_eq!(within(950_000 * 1024, 2), 2);
        assert_eq!(within(100_000_000, 16), 1);
        assert_eq!(within(1 << 40, 16), 16);
    }
}
