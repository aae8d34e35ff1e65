//! A whole judgment of whatever is handed in.
#![no_main]

use std::sync::OnceLock;

use classroom::class::grade_one;
use classroom::intake::{Folders, collect};
use grading::judge_list::Expectations;
use grading::places::Places;
use grading::signature::Signatures;
use grading::submission::{Settings, grade};
use photon_mapping::assignment8;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    static EXPECTATIONS: OnceLock<Expectations> = OnceLock::new();
    let expectations = EXPECTATIONS.get_or_init(|| {
        let places = Places::new(&assignment8::create_scene());
        Expectations::new(places, Signatures::of_assignment8())
    });
    photon_mapping_fuzz::with_file("handed-in", data, |path| {
        let settings = Settings { emitted: Some(20_000), ..Settings::default() };
        for one in collect(&[path.to_owned()], Folders::Clear).handed_in {
            let graded = grade_one(&one, &settings, |submission| {
                Some(grade(submission, &settings, expectations))
            });
            let grade = graded.expect("there is a grade").grade;
            let mut found = grade.findings.iter().map(|finding| &finding.found);
            // Not where a cell with these words is quoted.
            let failed = found.any(|found| found.starts_with("the grader itself failed"));
            assert!(!failed && (0.0..=4.0).contains(&grade.score), "{grade:?}");
        }
    });
});
