//! A course's own scores.
#![no_main]

use grading::policy::Policy;
use grading::verdict::Verdict;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    if let Ok(policy) = serde_json::from_slice::<Policy>(data)
        && policy.odd_score().is_none()
    {
        let score = policy.score(Verdict::Incorrect, Some("no-offset"), true);
        assert!((0.0..=policy.best()).contains(&score));
    }
});
