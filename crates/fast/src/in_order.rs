//! Pieces of work for all threads, whose results are consumed in order.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard};

/// How many pieces may be worked on, or wait, while the pieces before them are consumed.
const MOST_AHEAD: usize = 64;

/// Does `work` on `pieces` with all threads of the current rayon pool and hands the results to
/// `consume`, one at a time and in order. Memory does not grow with the number of pieces.
///
/// No thread waits while there is something to do: each consumes the next result, if it is there,
/// or else works on the next piece. A parallel iterator would divide the pieces beforehand, and a
/// thread that is held up would hold up the others. `consume` must not use the pool itself.
///
/// # Errors
/// The first error of `consume`, which ends the work.
pub fn in_order<P: Send, T: Send, E: Send>(
    pieces: impl Iterator<Item = P> + Send,
    work: impl Fn(P) -> T + Sync,
    consume: impl FnMut(T) -> Result<(), E> + Send,
) -> Result<(), E> {
    let shared = Shared {
        progress: Mutex::new(Progress {
            pieces,
            consume: Some(consume),
            ahead: VecDeque::new(),
            consumed: 0,
            end: None,
        }),
        changed: Condvar::new(),
    };
    rayon::scope(|scope| {
        for _ in 1..rayon::current_num_threads() {
            scope.spawn(|_| shared.work_on(&work));
        }
        shared.work_on(&work);
    });
    shared.lock().end.take().expect("no thread leaves before the end")
}

struct Shared<I, C, T, E> {
    progress: Mutex<Progress<I, C, T, E>>,
    changed: Condvar,
}

struct Progress<I, C, T, E> {
    /// Those that nobody has begun.
    pieces: I,
    /// Not here while a thread is consuming.
    consume: Option<C>,
    /// The results that are still to be consumed; none where a thread is at work.
    ahead: VecDeque<Option<T>>,
    consumed: usize,
    end: Option<Result<(), E>>,
}

impl<I, C, T, E> Shared<I, C, T, E> {
    fn lock(&self) -> MutexGuard<'_, Progress<I, C, T, E>> {
        self.progress.lock().expect("no thread panics while it holds the lock")
    }

    fn work_on<P>(&self, work: impl Fn(P) -> T)
    where
        I: Iterator<Item = P>,
        C: FnMut(T) -> Result<(), E>,
    {
        let _release = ReleaseOnPanic(self);
        let mut progress = self.lock();
        while progress.end.is_none() {
            if let Some((mut consume, result)) = progress.next_to_consume() {
                drop(progress);
                let consumed = consume(result);
                progress = self.lock();
                progress.consume = Some(consume);
                if consumed.is_err() {
                    progress.end = Some(consumed);
                }
            } else if let Some((place, piece)) = progress.next_to_work_on() {
                drop(progress);
                let result = work(piece);
                progress = self.lock();
                let place = place - progress.consumed;
                progress.ahead[place] = Some(result);
            } else if progress.ahead.is_empty() && progress.consume.is_some() {
                progress.end = Some(Ok(()));
            } else {
                progress = self.changed.wait(progress).expect("no thread panics with the lock");
                continue;
            }
            self.changed.notify_all();
        }
    }
}

impl<P, I: Iterator<Item = P>, C, T, E> Progress<I, C, T, E> {
    fn next_to_consume(&mut self) -> Option<(C, T)> {
        self.ahead.front()?.as_ref()?;
        let consume = self.consume.take()?;
        self.consumed += 1;
        Some((consume, self.ahead.pop_front()??))
    }

    /// The next piece and its place among all.
    fn next_to_work_on(&mut self) -> Option<(usize, P)> {
        let piece = (self.ahead.len() < MOST_AHEAD).then(|| self.pieces.next())??;
        self.ahead.push_back(None);
        Some((self.consumed + self.ahead.len() - 1, piece))
    }
}

/// Lets the other threads go when this one panics; they would wait for its result for ever.
struct ReleaseOnPanic<'a, I, C, T, E>(&'a Shared<I, C, T, E>);

impl<I, C, T, E> Drop for ReleaseOnPanic<'_, I, C, T, E> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.lock().end = Some(Ok(()));
            self.0.changed.notify_all();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Work that takes longer for some pieces than for others, with `threads` threads.
    fn run(
        threads: usize,
        pieces: u64,
        consume: impl FnMut(u64) -> Result<(), u64> + Send,
    ) -> Result<(), u64> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let work = |piece: u64| {
            if piece.is_multiple_of(7) {
                std::thread::sleep(std::time::Duration::from_micros(300));
            }
            10 * piece
        };
        pool.install(|| in_order(0..pieces, work, consume))
    }

    #[test]
    fn results_come_once_and_in_order() {
        for threads in [1, 2, 7] {
            for pieces in [0, 1, 2, 500] {
                let mut results = Vec::new();
                let end = run(threads, pieces, |result| {
                    results.push(result);
                    Ok(())
                });
                assert_eq!(end, Ok(()));
                let expected: Vec<u64> = (0..pieces).map(|piece| 10 * piece).collect();
                assert_eq!(results, expected, "{threads} threads");
            }
        }
    }

    #[test]
    fn the_first_error_ends_it() {
        for threads in [1, 2, 7] {
            let mut results = Vec::new();
            let end = run(threads, 500, |result| {
                results.push(result);
                if result == 90 { Err(result) } else { Ok(()) }
            });
            assert_eq!(end, Err(90));
            assert_eq!(results.len(), 10, "{threads} threads");
        }
    }

    #[test]
    fn a_slow_consumer_holds_up_the_work() {
        let begun = std::sync::atomic::AtomicUsize::new(0);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(4).build().expect("threads");
        let work = |piece: usize| {
            begun.fetch_add(1, std::sync::atomic::Ordering::SeqCst);
            piece
        };
        let mut most_ahead = 0;
        let end = pool.install(|| {
            in_order(0..1000, work, |piece| {
                std::thread::sleep(std::time::Duration::from_micros(50));
                let begun = begun.load(std::sync::atomic::Ordering::SeqCst);
                most_ahead = most_ahead.max(begun - piece);
                Ok::<(), ()>(())
            })
        });
        assert_eq!(end, Ok(()));
        assert!(most_ahead <= MOST_AHEAD + 1, "{most_ahead}");
    }

    #[test]
    fn a_panic_is_passed_on() {
        let work = |piece: u64| assert_ne!(piece, 20, "on purpose");
        let end = std::panic::catch_unwind(|| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
            pool.install(|| in_order(0..100, work, |()| Ok::<(), ()>(())))
        });
        assert!(end.is_err());
    }
}
