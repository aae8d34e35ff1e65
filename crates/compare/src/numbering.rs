//! Which photon stored which record, where a list does not tell it but has the directions to the
//! light.
//!
//! A record's direction leads back to where its photon scattered last. If that is the first hit of
//! one of the run's photons, the record is that photon's first; if another record lies there, it is
//! its next. The ray may have started off the surface: a few records show how far.

use std::sync::Arc;

use glam::Vec3;
use rayon::prelude::*;

use super::fair::{Fair, HitPoint, Shift};
use super::fair_search::LONGEST_OFFSET;
use super::position_index::PositionIndex;
use super::tries::{Tries, other_emissions};
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::scene::ray::{IntersectionState, Ray};
use variants::run::Run;

/// How far a line back may pass from a ray's start that is known, as a part of the longest edge.
const REACH: f32 = 1.25e-4;
/// How far from a hit where the start is not known. The longer, the more photons are mistaken for
/// another.
const LONG_REACHES: [f32; 2] = [1e-3, LONGEST_OFFSET];
/// So many records show where rays start.
const SAMPLE: usize = 300;
/// The part of them that must agree. Two in three records are the first of their photon.
const AGREEING: f32 = 0.15;
/// With so many, no other emission is tried.
const MOST_AGREE: f32 = 0.4;
/// A start this far along the direction is off the surface, as a part of the longest edge.
const OFF_SURFACE: f32 = 5e-4;
/// Nearer than this, a place is the record's own, as a part of the longest edge.
const ROUNDING: f32 = 2e-6;
/// The part of the records that must find their photon.
const MOST: f32 = 0.6;
/// A path has hardly more records than this.
const LONGEST_PATH: usize = 40;
/// A line that grazes a surface is looked at for so many steps.
const MOST_STEPS: usize = 64;

/// How records are led back to photons.
#[derive(Clone, Debug)]
pub struct Link {
    /// What the run's photons hit first, as they are emitted in this link.
    first: Arc<[(u32, HitPoint)]>,
    /// How far from a hit the scattered ray starts.
    shift: Shift,
    /// How far a line back may pass from there, in world units.
    reach: f32,
    /// Whether the start was measured, so that hardly a photon is mistaken for another.
    pub is_measured: bool,
}

/// The ways in which the records of `list` may lead back to the photons of `run`, the surest first;
/// none where the list tells its photons already, or has no directions. Positions that are no
/// numbers would be left out, and they are what is wrong.
pub fn links(run: &Run, list: &PhotonList) -> Vec<Link> {
    let has_direction =
        |record: &PhotonRecord| record.to_light.is_finite() && record.to_light != Vec3::ZERO;
    let leads_back = list.columns.to_light
        && list.records.iter().all(|record| record.position.is_finite())
        && list.records.iter().any(has_direction);
    if list.columns.photon || !leads_back {
        return Vec::new();
    }
    let Some(fair) = Fair::of(run) else { return Vec::new() };
    let size = run.size();
    let reference = Tries::REFERENCE;
    let mut emissions = vec![reference, Tries { order: [2, 1, 0], ..reference }];
    emissions.extend(other_emissions(reference).into_iter().map(|(tries, _)| tries));
    let step = list.records.len().div_ceil(SAMPLE);
    let sample: Vec<_> = list.records.iter().step_by(step).collect();
    let of_reference = first_hits(run, &Fair { tries: reference, ..fair });
    let mut best = (0.0, of_reference.clone(), Shift::default());
    for tries in emissions {
        let first = match tries == reference {
            true => of_reference.clone(),
            false => first_hits(run, &Fair { tries, ..fair }),
        };
        let (votes, shift) = measured_shift(&first, &sample, size);
        let part = votes as f32 / sample.len() as f32;
        if part > best.0 {
            best = (part, first, shift);
        }
        if best.0 > MOST_AGREE {
            break;
        }
    }
    let (agreeing, first, shift) = best;
    let has_agreed = agreeing > AGREEING;
    let long = LONG_REACHES.map(|reach| Link {
        first: if has_agreed { first.clone() } else { of_reference.clone() },
        shift: Shift::default(),
        reach: reach * size,
        is_measured: false,
    });
    let measured = Link { first, shift, reach: REACH * size, is_measured: true };
    has_agreed.then_some(measured).into_iter().chain(long).collect()
}

/// `list` with the photons and bounces of `run`; nothing where most records lead back to none.
pub fn with_photons(run: &Run, list: &PhotonList, link: &Link) -> Option<PhotonList> {
    let photons = photons_of(run, list, link);
    let found = photons.iter().flatten().count();
    (found as f32 > MOST * photons.len() as f32).then(|| numbered(list, &photons))
}

/// `list` with `photons`, the photon and bounce of every record; those without are left out.
fn numbered(list: &PhotonList, photons: &[Option<(u32, u16)>]) -> PhotonList {
    let mut numbered = list.clone();
    numbered.columns.photon = true;
    numbered.columns.bounce = true;
    let told = list.records.iter().zip(photons).filter_map(|(record, number)| {
        number.map(|(photon, bounce)| PhotonRecord { photon, bounce, ..*record })
    });
    numbered.records = told.collect();
    numbered
}

fn first_hits(run: &Run, fair: &Fair) -> Arc<[(u32, HitPoint)]> {
    let photons = (0..run.renderer.emitted()).into_par_iter();
    photons.filter_map(|photon| Some((photon as u32, fair.first_hit(run, photon)?))).collect()
}

/// How far from their first hits the rays start that lead to `sample`, along the normal or back
/// along the ray, and how many of the records agree.
fn measured_shift(
    first: &[(u32, HitPoint)],
    sample: &[&PhotonRecord],
    size: f32,
) -> (usize, Shift) {
    let width = REACH * size;
    let longest = LONGEST_OFFSET * size;
    // The shifts of both kinds under which the line back of a record meets a start.
    let shifts_of = |record: &&PhotonRecord| {
        let back = record.to_light.normalize_or_zero();
        let across = |v: Vec3| v - v.dot(back) * back;
        let shifts = move |(_, hit): &(u32, HitPoint)| {
            let aside = across(hit.point - record.position);
            if aside.length_squared() > longest * longest {
                return None;
            }
            Some([hit.normal, -hit.incoming].map(|way| {
                let way = across(way);
                // Along the line itself, any shift would do.
                let along = -aside.dot(way) / way.length_squared().max(0.01);
                let is_met = (aside + along * way).length() <= width;
                (is_met && (-width..=longest).contains(&along)).then_some(along)
            }))
        };
        first.iter().filter_map(shifts).collect::<Vec<_>>()
    };
    let all: Vec<_> = sample.par_iter().flat_map_iter(shifts_of).collect();
    let [along_normal, back] = [0, 1].map(|kind| {
        let mut shifts: Vec<f32> = all.iter().filter_map(|shifts| shifts[kind]).collect();
        shifts.sort_unstable_by(f32::total_cmp);
        densest(&shifts, width)
    });
    if along_normal.0 > back.0 {
        (along_normal.0, Shift { along_normal: along_normal.1, back: 0.0 })
    } else {
        (back.0, Shift { along_normal: 0.0, back: back.1 })
    }
}

/// How many of the ascending `values` lie within twice `width` at most, and their median.
fn densest(values: &[f32], width: f32) -> (usize, f32) {
    let after =
        |start: usize| values[start..].partition_point(|v| *v <= values[start] + 2.0 * width);
    let best = (0..values.len()).map(|start| (after(start), start)).max_by_key(|(count, _)| *count);
    best.map_or((0, 0.0), |(count, start)| (count, values[start + count / 2]))
}

/// Photon and bounce of every record that leads back to a first hit, over other records or at once.
fn photons_of(run: &Run, list: &PhotonList, link: &Link) -> Vec<Option<(u32, u16)>> {
    let Link { ref first, shift, reach, .. } = *link;
    let size = run.size();
    let points: Vec<_> = first.iter().map(|(_, hit)| hit.point).collect();
    let own = PositionIndex::new(&points, ROUNDING * size);
    let after_first = first.iter().map(|(_, hit)| hit.start(shift)).collect::<Vec<_>>();
    let hits: Vec<_> =
        list.records.par_iter().map(|record| hit_of(run, record, size, shift)).collect();
    let after_record: Vec<_> = hits.iter().map(|hit| hit.start(shift)).collect();
    let step = reach + shift.length() / 4.0;
    let starts = [&after_first, &after_record].map(|starts| PositionIndex::new(starts, step));
    let previous_of = |at: usize| {
        let record = &list.records[at];
        let back = record.to_light.normalize_or_zero();
        if let Some(hit) = own.near(record.position, 0).first() {
            let (photon, hit) = first[*hit];
            let is_direct = hit.incoming.dot(back) < -0.9999;
            return if is_direct { Previous::Itself(photon) } else { Previous::First(photon) };
        }
        if back == Vec3::ZERO || !record.position.is_finite() {
            return Previous::None;
        }
        // Starts lie on the line back, near its ends.
        let steps_near = |normal: Vec3| {
            let height = shift.length() / normal.dot(back).abs().max(1e-3);
            2 + ((height / step) as usize).min(MOST_STEPS)
        };
        let along = |from: Vec3, normal: Vec3, step: f32| {
            (0..=steps_near(normal)).map(move |steps| from + steps as f32 * step * back)
        };
        let off_surface = record.position + OFF_SURFACE * size * back;
        let far_end = met(run, off_surface, back);
        let places: Vec<_> = along(record.position, hits[at].normal, step)
            .chain(far_end.into_iter().flat_map(|(point, normal)| along(point, normal, -step)))
            .collect();
        // What is passed at the smallest distance, and that distance.
        let nearest = |index: &PositionIndex, own: Option<usize>| {
            let near = places.iter().flat_map(|place| index.near(*place, 0));
            near.filter(|place| Some(*place) != own)
                .map(|place| (place, index.positions[place] - record.position))
                .filter(|(_, way)| way.dot(back) > ROUNDING * size)
                .map(|(place, way)| (place, way.cross(back).length()))
                .filter(|(_, aside)| *aside <= reach)
                .min_by(|(_, a), (_, b)| a.total_cmp(b))
        };
        match (nearest(&starts[0], None), nearest(&starts[1], Some(at))) {
            (Some((hit, a)), other) if other.is_none_or(|(_, b)| a <= b) => {
                Previous::First(first[hit].0)
            }
            (_, Some((record, _))) => Previous::After(record),
            _ => Previous::None,
        }
    };
    let previous: Vec<_> = (0..list.records.len()).into_par_iter().map(previous_of).collect();
    let follow = |start: usize| {
        let mut at = start;
        for bounce in 1..=LONGEST_PATH as u16 {
            match previous[at] {
                Previous::Itself(photon) => return Some((photon, bounce - 1)),
                Previous::First(photon) => return Some((photon, bounce)),
                Previous::After(before) => at = before,
                Previous::None => return None,
            }
        }
        None
    };
    (0..previous.len()).map(follow).collect()
}

/// The hit that `record` stands for, which it may have been stored off.
fn hit_of(run: &Run, record: &PhotonRecord, size: f32, shift: Shift) -> HitPoint {
    let incoming = -record.to_light.normalize_or_zero();
    let as_stored = HitPoint { point: record.position, normal: Vec3::ZERO, incoming };
    if shift == Shift::default() {
        return as_stored;
    }
    let before = record.position - LONGEST_OFFSET * size * incoming;
    let hit = met(run, before, incoming);
    let hit = hit.filter(|(point, _)| point.distance(before) <= 2.0 * LONGEST_OFFSET * size);
    hit.map_or(as_stored, |(point, normal)| HitPoint { point, normal, incoming })
}

#[derive(Clone, Copy, Debug)]
enum Previous {
    /// The record is the first hit of this photon.
    Itself(u32),
    /// The record is the first of this photon.
    First(u32),
    /// It comes after the record in this place.
    After(usize),
    None,
}

/// The point of the scene that a ray from `start` meets, and the normal there. World space.
fn met(run: &Run, start: Vec3, direction: Vec3) -> Option<(Vec3, Vec3)> {
    let start = run.placement.to_scene(start.as_dvec3());
    let mut state = IntersectionState::new();
    let is_met = start.is_finite()
        && direction != Vec3::ZERO
        && run.scene().trace(&Ray::new(start, direction), Some(&mut state));
    let point = || run.placement.to_world(state.intersection_point());
    is_met.then(|| (point(), state.compute_normal(run.scene())))
}
