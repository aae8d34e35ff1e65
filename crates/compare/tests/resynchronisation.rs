//! Lists without numbers: deleted, inserted and moved records are counted right.

use glam::Vec3;
use proptest::prelude::*;

use compare::alignment::align;
use compare::differences::count;
use photon_list::reader::PhotonList;
use photon_list::record::Columns;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::random::photon_random;

const TOLERANCE: f32 = 2e-4;
const NONE: Columns =
    Columns { intensity: false, to_light: false, photon: false, bounce: false, surface: false };

#[derive(Clone, Copy, Debug)]
enum Edit {
    Keep,
    Delete,
    /// So many records of their own come before.
    Insert(usize),
    Move,
}

fn edit() -> impl Strategy<Value = Edit> {
    prop_oneof![
        4 => Just(Edit::Keep),
        1 => Just(Edit::Delete),
        1 => (1..4_usize).prop_map(Edit::Insert),
        1 => Just(Edit::Move),
    ]
}

fn list(positions: Vec<Vec3>) -> PhotonList {
    let record = |position| PhotonRecord { position, ..photon_list::record::ABSENT };
    PhotonList { columns: NONE, records: positions.into_iter().map(record).collect() }
}

fn point(rand: &mut impl FnMut() -> f32) -> Vec3 {
    Vec3::new(rand(), rand(), rand())
}

/// The counts for a list of random points edited by `edits`, and what they should be: missing,
/// extra and moved.
fn counted_and_expected(seed: u64, edits: &[Edit]) -> ([u64; 3], [u64; 3]) {
    let mut rand = photon_random(seed, 0);
    let (mut reference, mut submission) = (Vec::new(), Vec::new());
    let [mut missing, mut extra, mut moved] = [0; 3];
    for edit in edits {
        let position = point(&mut rand);
        reference.push(position);
        match *edit {
            Edit::Keep => submission.push(position),
            Edit::Delete => missing += 1,
            Edit::Insert(inserted) => {
                submission.extend((0..inserted).map(|_| point(&mut rand)));
                submission.push(position);
                extra += inserted as u64;
            }
            Edit::Move => {
                submission.push(position + Vec3::new(0.0, 0.01, 0.0));
                moved += 1;
            }
        }
        // Side by side, an inserted and a deleted record are a moved one.
        let between = point(&mut rand);
        reference.push(between);
        submission.push(between);
    }
    let (reference, submission) = (list(reference), list(submission));
    let pairings = align(&reference, &submission, TOLERANCE);
    let (counts, _) = count(&reference, &submission, &pairings, TOLERANCE);
    let reference_records = reference.records.len() as u64;
    assert_eq!(counts.matched + counts.missing + counts.moved, reference_records);
    ([counts.missing, counts.extra, counts.moved], [missing, extra, moved])
}

proptest! {
    #[test]
    fn edits_are_counted_right(seed: u64, edits in prop::collection::vec(edit(), 0..200)) {
        let (counted, expected) = counted_and_expected(seed, &edits);
        prop_assert_eq!(counted, expected);
    }

    /// Whatever the lists are, every record is in exactly one pairing.
    #[test]
    fn every_record_is_paired_once(
        reference in prop::collection::vec(0..5_u8, 0..40),
        submission in prop::collection::vec(0..5_u8, 0..40),
    ) {
        // Few different places, so that many pairs are possible.
        let points = |places: &[u8]| {
            let position = |place: &u8| match place {
                4 => Vec3::NAN,
                place => Vec3::splat(f32::from(*place)),
            };
            list(places.iter().map(position).collect())
        };
        let (reference, submission) = (points(&reference), points(&submission));
        let pairings = align(&reference, &submission, TOLERANCE);
        let (counts, _) = count(&reference, &submission, &pairings, TOLERANCE);
        let found = counts.matched + counts.moved;
        prop_assert_eq!(found + counts.missing, reference.records.len() as u64);
        prop_assert_eq!(found + counts.extra, submission.records.len() as u64);
    }
}

/// A run of 1,000,000 photons stores 50,000 records; with every direct hit, 286,000.
#[test]
fn long_lists_are_counted() {
    let edits: Vec<_> =
        [Edit::Keep, Edit::Insert(3), Edit::Delete, Edit::Move].repeat(50_000 / 4).to_vec();
    let (counted, expected) = counted_and_expected(148, &edits);
    assert_eq!(counted, expected);
}

/// The worst there is: all in one place, or nothing alike. If time grew with the square of the
/// records, this would take minutes.
#[test]
fn the_worst_lists_come_to_an_end() {
    let same = |count| list(vec![Vec3::ONE; count]);
    assert_eq!(align(&same(500_000), &same(490_000), TOLERANCE).len(), 500_000);
    let mut rand = photon_random(1, 1);
    let mut random = || list((0..500_000).map(|_| point(&mut rand)).collect());
    align(&random(), &random(), TOLERANCE);
}
