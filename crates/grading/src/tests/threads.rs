//! What pictures are held against is made once, whoever asks for it at the same time.

use std::sync::mpsc::channel;
use std::time::Duration;

use photon_mapping::assignment8::{MAX_PHOTON_BOUNCES, create_scene};
use rayon::prelude::*;

use crate::judge_list::Expectations;
use crate::places::Places;
use crate::signature::Signatures;

#[test]
fn many_threads_may_need_the_same_at_once() {
    let (done, is_done) = channel();
    std::thread::spawn(move || {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(32).build().unwrap();
        // By chance, one of two such rounds would never end.
        for _ in 0..4 {
            let places = Places::new(&create_scene());
            let signatures = Signatures::of_limit(&places, MAX_PHOTON_BOUNCES);
            let expectations = Expectations::new(places, signatures);
            // Who has nothing to do helps who waits for the same.
            pool.install(|| {
                (0..256).into_par_iter().for_each(|at| match at % 8 {
                    0 => drop(expectations.pictures().shifted()),
                    4 => drop(expectations.paths()),
                    _ => std::thread::sleep(Duration::from_millis(1)),
                });
            });
        }
        done.send(()).unwrap();
    });
    is_done.recv_timeout(Duration::from_secs(60)).expect("no thread waits for itself");
}
