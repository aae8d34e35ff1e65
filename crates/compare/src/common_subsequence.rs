//! What two sequences of positions have in common, in the order of both.

use std::num::NonZeroU32;

use glam::Vec3;

use super::position_index::{PositionIndex, is_near};

/// The longest sequence of pairs of positions within `tolerance` of each other that is in the order
/// of both lists.
///
/// J. W. Hunt and T. G. Szymanski, *A Fast Algorithm for Computing Longest Common Subsequences*
/// (CACM 1977): since hardly two photons of a list lie in one place, there are about as many pairs
/// as records.
pub fn common_subsequence(
    reference: &[Vec3],
    submission: &[Vec3],
    tolerance: f32,
) -> Vec<(usize, usize)> {
    let both_near = |(a, b): &(&Vec3, &Vec3)| is_near(**a, **b, tolerance);
    let start = reference.iter().zip(submission).take_while(both_near).count();
    let (a, b) = (&reference[start..], &submission[start..]);
    let end = a.iter().rev().zip(b.iter().rev()).take_while(both_near).count();
    let (a, b) = (&a[..a.len() - end], &b[..b.len() - end]);

    // A pair, and the place of the pair before it in the longest sequence that ends with it.
    let mut links: Vec<([u32; 2], Option<NonZeroU32>)> = vec![([0; 2], None)];
    // Of all sequences of length k + 1, the last link of the one that ends earliest in `a`.
    let mut shortest: Vec<NonZeroU32> = Vec::new();
    let index = PositionIndex::new(a, tolerance);
    for (j, position) in b.iter().enumerate() {
        let around = (j as u64 * a.len() as u64 / b.len() as u64) as usize;
        for i in index.near(*position, around).into_iter().rev() {
            let link = |place: NonZeroU32| links[place.get() as usize];
            let length = shortest.partition_point(|place| (link(*place).0[0] as usize) < i);
            let before = length.checked_sub(1).map(|before| shortest[before]);
            let place = u32::try_from(links.len()).ok().and_then(NonZeroU32::new);
            let Some(place) = place else { break };
            links.push(([i as u32, j as u32], before));
            if length == shortest.len() {
                shortest.push(place);
            } else {
                shortest[length] = place;
            }
        }
    }
    let mut middle = Vec::new();
    let mut last = shortest.last().copied();
    while let Some(place) = last {
        let ([i, j], before) = links[place.get() as usize];
        middle.push((start + i as usize, start + j as usize));
        last = before;
    }
    middle.reverse();
    let (a_end, b_end) = (start + a.len(), start + b.len());
    let head = (0..start).map(|place| (place, place));
    let tail = (0..end).map(|place| (a_end + place, b_end + place));
    head.chain(middle).chain(tail).collect()
}
