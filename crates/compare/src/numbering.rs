//! Which photon stored which record, where a list does not tell it but has the directions to the
//! light.
//!
//! A record's direction leads back to where its photon scattered last. If that is the first hit of
//! one of the run's photons, the record is that photon's first; if another record lies there, it is
//! its next.

use glam::Vec3;
use rayon::prelude::*;

use super::fair::Fair;
use super::fair_search::LONGEST_OFFSET;
use super::position_index::PositionIndex;
use super::tries::{Tries, other_emissions};
use crate::report::scene_size;
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::scene::ray::{IntersectionState, Ray};
use variants::run::Run;

/// How far a line back may pass from a hit, as a part of the longest edge: first without an offset
/// of the ray's start, then with longer ones. The longer, the more photons are mistaken for
/// another.
pub const REACHES: [f32; 3] = [2.5e-4, 1e-3, LONGEST_OFFSET];
/// A start this far along the direction is off the surface, as a part of the longest edge.
const OFF_SURFACE: f32 = 5e-4;
/// The part of the records that must find their photon.
const MOST: f32 = 0.6;
/// With so many, no other emission is tried.
const NEARLY_ALL: f32 = 0.95;
/// A path has hardly more records than this.
const LONGEST_PATH: usize = 40;

/// `list` with the photons and bounces of `run`; nothing where the list has them already, has no
/// directions, or most of them lead back to no photon of the run's within `reach`, one of
/// [`REACHES`].
pub fn with_photons(run: &Run, list: &PhotonList, reach: f32) -> Option<PhotonList> {
    if list.columns.photon || !list.columns.to_light || list.records.is_empty() {
        return None;
    }
    let origins: Vec<_> = list
        .records
        .par_iter()
        .map(|record| origin(run, record.position, record.to_light))
        .collect();
    let fair = Fair::of(run)?;
    let reference = Tries::REFERENCE;
    let mut emissions = vec![reference, Tries { order: [2, 1, 0], ..reference }];
    emissions.extend(other_emissions(reference).into_iter().map(|(tries, _)| tries));
    let found = |photons: &[Option<(u32, u16)>]| {
        photons.iter().flatten().count() as f32 / photons.len() as f32
    };
    let tried = if reach == REACHES[0] { &emissions[..] } else { &emissions[..2] };
    let mut best: Vec<Option<(u32, u16)>> = Vec::new();
    for tries in tried.iter().copied() {
        let photons = photons_of(run, &Fair { tries, ..fair }, list, &origins, reach);
        if best.is_empty() || found(&photons) > found(&best) {
            best = photons;
        }
        if found(&best) > NEARLY_ALL {
            break;
        }
    }
    (found(&best) > MOST).then(|| numbered(list, &best))
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

/// Photon and bounce of every record that leads back to a first hit, over other records or at once.
fn photons_of(
    run: &Run,
    fair: &Fair,
    list: &PhotonList,
    origins: &[Option<Vec3>],
    reach: f32,
) -> Vec<Option<(u32, u16)>> {
    let reach = reach * run.placement.length_to_world(scene_size(run.scene()));
    let emitted = run.renderer.emitted();
    let first: Vec<(u32, Vec3)> = (0..emitted)
        .into_par_iter()
        .filter_map(|photon| Some((photon as u32, fair.first_hit(run, photon)?)))
        .collect();
    let points: Vec<_> = first.iter().map(|(_, point)| *point).collect();
    let hits = PositionIndex::new(&points, reach);
    let positions: Vec<_> = list.records.iter().map(|record| record.position).collect();
    let records = PositionIndex::new(&positions, reach);
    let previous: Vec<Previous> = (0..list.records.len())
        .into_par_iter()
        .map(|at| {
            let Some(point) = origins[at] else { return Previous::None };
            let back = list.records[at].to_light.normalize_or_zero();
            // What is passed at the smallest distance, and that distance.
            let nearest = |index: &PositionIndex, all: &[Vec3]| {
                let starts = [0.0, 1.0, 2.0].map(|steps| point - steps * reach * back);
                let near = starts.into_iter().flat_map(|start| index.near(start, 0));
                let aside = |place: usize| (all[place] - point).cross(back).length();
                near.filter(|place| all[*place] != positions[at])
                    .map(|place| (place, aside(place)))
                    .min_by(|(_, a), (_, b)| a.total_cmp(b))
            };
            match (nearest(&hits, &points), nearest(&records, &positions)) {
                (Some((hit, a)), other) if other.is_none_or(|(_, b)| a <= b) => {
                    Previous::First(first[hit].0)
                }
                (_, Some((record, _))) => Previous::After(record),
                _ => Previous::None,
            }
        })
        .collect();
    let follow = |start: usize| {
        let mut at = start;
        for bounce in 1..=LONGEST_PATH {
            match previous[at] {
                Previous::First(photon) => return Some((photon, bounce as u16)),
                Previous::After(before) => at = before,
                Previous::None => return None,
            }
        }
        None
    };
    (0..previous.len()).map(follow).collect()
}

#[derive(Clone, Copy, Debug)]
enum Previous {
    /// The record is the first of this photon.
    First(u32),
    /// It comes after the record in this place.
    After(usize),
    None,
}

/// The point on the scene that `to_light` leads back to from `position`. World space.
fn origin(run: &Run, position: Vec3, to_light: Vec3) -> Option<Vec3> {
    let back = to_light.try_normalize()?;
    let start = run.placement.to_scene(position.as_dvec3());
    let start = start + OFF_SURFACE * scene_size(run.scene()) * back;
    let mut state = IntersectionState::new();
    let is_hit = start.is_finite() && run.scene().trace(&Ray::new(start, back), Some(&mut state));
    is_hit.then(|| run.placement.to_world(state.intersection_point()))
}
