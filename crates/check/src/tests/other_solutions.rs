//! Solutions in the styles of twelve students, in folders as they are handed in: each section of
//! each gets the right answer. The files are whole, with the framework's given functions, because
//! that is what `check` has to read.

use std::time::Duration;

use super::{handed_in, kit, statuses, two_at_a_time};
use crate::checking::{CheckSettings, check};
use crate::find::CppSubmission;

/// Folder, what is in it, and for emission, storage, scattering, sampling and transformation `+`
/// where it is right and `x` where it is wrong.
const SOLUTIONS: [(&str, &str, &str); 12] = [
    ("ava", "a loop in place of the recursion", "+++++"),
    ("ben", "a header of its own, <random>, double", "+++++"),
    ("chloe", "lambdas, a function pointer to rand, only `position` is set", "+++++"),
    ("dev", "a helper header, a rotation in place of t and b, a resource fork", "+++++"),
    ("emma", "the loop of the emission never ends", "x++++"),
    ("farid", "direct photons are stored; lines end in CR LF", "+x+++"),
    ("grace", "P_r forgets blue, which this scene does not show", "++x++"),
    ("hugo", "z = sqrt(1 - r)", "+++x+"),
    ("ines", "the matrix is transposed", "++++x"),
    ("jack", "remainingBounces is handed on as it is, which this scene does not show", "+x+++"),
    ("kim", "no rejection, and r = u1", "x++x+"),
    ("leo", "the roulette is turned around, and t is parallel to b on upright faces", "++x+x"),
];

#[test]
fn every_section_of_other_solutions_gets_its_answer() {
    let Some(kit) = kit() else { return };
    let folder = handed_in().join("other_solutions");
    two_at_a_time(&SOLUTIONS, |(name, what, expected)| {
        let submission = CppSubmission::find(&folder.join(name)).expect("a submission");
        let mut settings = CheckSettings { photons: 2000, ..CheckSettings::default() };
        if what.contains("never ends") {
            settings.time = Duration::from_secs(2);
        }
        let report = check(&submission, kit, &settings).expect("it can be checked");
        let found = statuses(&report).replace('~', "+");
        assert_eq!(found, *expected, "{name}: {what}: {:#?}", report.sections);
    });
}
