//! What a list of photons shows: counted by place, and looked over for what cannot be right.

use super::crowding::crowding;
use super::places::{Place, Places};
use super::repeats::{Copies, Repeat, are_by_rounding, copies, repeats};
use crate::limits::observation::{EXACT_DECIMALS, FEWEST_DECIMALS, LEAST_NUMBER};
use crate::limits::{HARDLY_ANY, NEARLY_ALL};
use glam::{DVec3, Vec3};
use photon_list::reader::PhotonList;
use photon_mapping::photon_list::PhotonRecord;

/// How many bounces are counted apart.
pub const BOUNCES: usize = 4;

/// Counts by place.
#[derive(Clone, Debug, PartialEq)]
pub struct CountsByPlace {
    /// By cell.
    pub cells: Vec<f64>,
    /// Where two facets meet.
    pub corner: f64,
    /// Where a box stands.
    pub footprint: f64,
    /// On no facet.
    pub off_surface: f64,
    /// Nowhere.
    pub not_finite: f64,
}

impl CountsByPlace {
    /// Nothing counted yet.
    pub fn new(places: &Places) -> Self {
        Self {
            cells: vec![0.0; places.cells],
            corner: 0.0,
            footprint: 0.0,
            off_surface: 0.0,
            not_finite: 0.0,
        }
    }

    /// Counts a photon at `place`.
    pub fn add(&mut self, place: Place) {
        match place {
            Place::Cell { cell, .. } => self.cells[cell] += 1.0,
            Place::Corner { .. } => self.corner += 1.0,
            Place::Footprint => self.footprint += 1.0,
            Place::OffSurface => self.off_surface += 1.0,
            Place::NotFinite => self.not_finite += 1.0,
        }
    }

    /// All that lie on a facet.
    pub fn on_surfaces(&self) -> f64 {
        self.cells.iter().sum::<f64>() + self.corner + self.footprint
    }
}

/// What the directions back to the light look like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToLight {
    /// Records that have one which is not zero and finite.
    pub set: u64,
    /// Of these, how many are not of length 1.
    pub not_unit: u64,
    /// How many come from behind the facet.
    pub from_behind: u64,
    /// How many point straight to the light.
    pub to_the_light: u64,
    /// Whether all are the same.
    pub all_alike: bool,
}

impl ToLight {
    /// Whether all point to the light, through surfaces if need be: then they say nothing of the
    /// way that photons came.
    pub fn is_towards_light_throughout(&self) -> bool {
        let set = self.set as f64;
        self.to_the_light as f64 > NEARLY_ALL * set && self.from_behind as f64 > HARDLY_ANY * set
    }

    /// The part of the photons that come straight from the light, if the directions tell.
    pub fn part_straight(&self) -> Option<f64> {
        let tells = !self.is_towards_light_throughout();
        tells.then(|| self.to_the_light as f64 / self.set.max(1) as f64)
    }
}

/// What a list shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// How many records it has.
    pub records: u64,
    /// Where they lie.
    pub counts: CountsByPlace,
    /// How many lie on a facet where another one does that is counted already.
    pub repeated: f64,
    /// How many lie where another one does to the last bit; nothing where that may come from
    /// rounding.
    pub identical: Option<f64>,
    /// The same by their order in the list.
    pub copies: Option<Copies>,
    /// Whether most of those that are repeated lie where another one does up to the rounding of an
    /// f32, and positions have enough decimals to tell.
    pub repeats_by_rounding: bool,
    /// The chance, at most, that photons lie as crowded as they do.
    pub crowding: f64,
    /// If the list has the numbers of photons and bounces: of the records after a path's first, how
    /// many there are, and how many have no record of the bounce before.
    pub gaps: Option<[u64; 2]>,
    /// The same without those that are repeated.
    pub distinct: CountsByPlace,
    /// How many decimals positions have, if so few that photons may lie at the same place by
    /// rounding alone: then none counts as repeated.
    pub few_decimals: Option<i32>,
    /// How many photons were emitted by the word of the intensities, if they agree with each other.
    pub emitted_by_intensity: Option<f64>,
    /// Whether the list has intensities that are of no use.
    pub has_odd_intensity: bool,
    /// The directions, if the list has them.
    pub to_light: Option<ToLight>,
    /// Counts by bounce, the first stored being the first, if the list has bounces.
    pub by_bounce: Option<Vec<CountsByPlace>>,
    /// The smallest and the largest bounce.
    pub bounces: Option<[u16; 2]>,
}

/// Whether all positions of `records` are whole numbers of the unit with `decimals` decimals.
fn are_rounded(records: &[PhotonRecord], decimals: i32) -> bool {
    let unit = 10_f64.powi(decimals);
    let mut finite = records.iter().filter(|record| record.position.is_finite()).peekable();
    let is_rounded = |coordinate: f64| {
        let scaled = coordinate * unit;
        // What f32 makes of a decimal fraction is off by half a unit in the last place.
        (scaled - scaled.round()).abs() <= 1.2e-7 * scaled.abs()
    };
    finite.peek().is_some()
        && finite.all(|record| record.position.as_dvec3().to_array().into_iter().all(is_rounded))
}

/// Looks at `list`, whose positions are in world space, with the light at `light`.
pub fn observe(list: &PhotonList, places: &Places, light: DVec3) -> Observation {
    let located: Vec<Place> =
        list.records.iter().map(|record| places.place(record.position.as_dvec3())).collect();
    let mut counts = CountsByPlace::new(places);
    let mut distinct = CountsByPlace::new(places);
    let decimals = (0..EXACT_DECIMALS).find(|decimals| are_rounded(&list.records, *decimals));
    let few_decimals = decimals.filter(|decimals| *decimals < FEWEST_DECIMALS);
    let repeats = match few_decimals {
        Some(_) => vec![Repeat::No; located.len()],
        None => repeats(&list.records, &located),
    };
    for (place, repeat) in located.iter().zip(&repeats) {
        counts.add(*place);
        if *repeat == Repeat::No {
            distinct.add(*place);
        }
    }
    let repeats_by_rounding = decimals.is_none() && are_by_rounding(&repeats);
    let count = |wanted| repeats.iter().filter(|repeat| **repeat == wanted).count() as f64;
    let identical = count(Repeat::Exactly);
    let bounces = list.columns.bounce.then(|| {
        let all = list.records.iter().map(|record| record.bounce);
        [all.clone().min().unwrap_or(0), all.max().unwrap_or(0)]
    });
    let by_bounce = bounces.map(|[first, _]| {
        let mut by_bounce = vec![CountsByPlace::new(places); BOUNCES];
        for (record, place) in list.records.iter().zip(&located) {
            if let Some(counts) = by_bounce.get_mut(usize::from(record.bounce - first)) {
                counts.add(*place);
            }
        }
        by_bounce
    });
    let is_on_facet = |place: &Place| matches!(place, Place::Cell { .. } | Place::Corner { .. });
    let on_facets = (list.records.iter().zip(&located))
        .filter(|(_, place)| is_on_facet(place))
        .map(|(record, _)| record.position.as_dvec3());
    let unit = decimals.map_or(0.0, |decimals| 10_f64.powi(-decimals));
    let gaps = (list.columns.photon && list.columns.bounce).then(|| gaps(&list.records));
    let intensity = list.columns.intensity.then(|| emitted_by_intensity(&list.records));
    Observation {
        records: list.records.len() as u64,
        repeated: count(Repeat::Closely) + count(Repeat::ByRounding) + identical,
        repeats_by_rounding,
        copies: decimals.is_none().then(|| copies(&list.records)),
        crowding: crowding(on_facets, unit),
        gaps,
        identical: decimals.is_none().then_some(identical),
        counts,
        distinct,
        few_decimals,
        emitted_by_intensity: intensity.flatten(),
        has_odd_intensity: intensity == Some(None) && !list.records.is_empty(),
        to_light: list.columns.to_light.then(|| directions(&list.records, &located, places, light)),
        by_bounce,
        bounces,
    }
}

/// How many of `records` come after a path's first, and how many of these lack the bounce before.
fn gaps(records: &[PhotonRecord]) -> [u64; 2] {
    let first = records.iter().map(|record| record.bounce).min().unwrap_or_default();
    let mut known: Vec<_> = records.iter().map(|record| (record.photon, record.bounce)).collect();
    known.sort_unstable();
    let is_known = |photon, bounce| known.binary_search(&(photon, bounce)).is_ok();
    let later = records.iter().filter(|record| record.bounce > first);
    let without = later.clone().filter(|record| !is_known(record.photon, record.bounce - 1));
    [later.count() as u64, without.count() as u64]
}

/// The intensity is the light's color, which is white, divided by the photons it emits.
fn emitted_by_intensity(records: &[PhotonRecord]) -> Option<f64> {
    let first = f64::from(records.first()?.intensity.x);
    let is_like_first = |intensity: Vec3| {
        let channels = intensity.as_dvec3().to_array();
        channels.iter().all(|channel| (channel - first).abs() <= 1e-5 * first)
    };
    let emitted = 1.0 / first;
    let is_a_number = (LEAST_NUMBER..1e12).contains(&emitted);
    let agree = is_a_number && records.iter().all(|record| is_like_first(record.intensity));
    // Of f32, whose 7 digits leave the last of a larger number open.
    agree.then(|| if emitted < 1e6 { emitted.round() } else { emitted })
}

fn directions(
    records: &[PhotonRecord],
    located: &[Place],
    places: &Places,
    light: DVec3,
) -> ToLight {
    let mut found = ToLight { all_alike: true, ..ToLight::default() };
    for (record, place) in records.iter().zip(located) {
        let direction = record.to_light.as_dvec3();
        found.all_alike &= record.to_light == records[0].to_light;
        if !direction.is_finite() || direction == DVec3::ZERO {
            continue;
        }
        found.set += 1;
        found.not_unit += u64::from((direction.length() - 1.0).abs() > 1e-3);
        if let Place::Cell { facet, .. } = place {
            found.from_behind += u64::from(direction.dot(places.facets[*facet].normal) < 0.0);
        }
        let straight = (light - record.position.as_dvec3()).normalize();
        let aside = straight.cross(direction.normalize()).length();
        found.to_the_light += u64::from(aside < 1e-3 && straight.dot(direction) > 0.0);
    }
    found.all_alike &= records.len() > 1;
    found
}
