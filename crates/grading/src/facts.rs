//! What a list shows without statistics: positions that cannot be, and what costs nothing.

use super::limits::{
    FEW_EMITTED, HARDLY_ANY, LEAST_EMITTED, MOST_ASTRAY, MOST_GAPS, MOST_IDENTICAL, MOST_REPEATED,
    MOST_STRAIGHT, NEARLY_ALL, SIGNIFICANCE,
};
use super::observation::{Observation, ToLight};
use super::places::Places;
use super::text::rounded;
use super::verdict::{Finding, Weight};
use compare::numbers::thousands;
use variants::section::Section;

/// The check of photons that crowd on spots or lines.
pub const SPREAD: &str = "spread";

/// What can be said without statistics.
pub fn plain_findings(observation: &Observation, places: &Places) -> Vec<Finding> {
    let counts = &observation.counts;
    let records = observation.records as f64;
    let finite = records - counts.not_finite;
    let transformation = Section::HemisphereRayTransformation;
    let storage = Section::PhotonStorage;
    let fact = |check, section: Section, expected: &str, found, passed, weight, advice| {
        Finding::new(check, expected, found, advice).of(section).weighing(weight).passed_if(passed)
    };
    let of_all = |part: f64, all: f64| format!("{} of {}", rounded(part), rounded(all));
    let (repeated, on_facets) = (observation.repeated, counts.on_surfaces());
    let surfaces = places.surfaces.len();
    let is_repeated = repeated > (MOST_REPEATED * on_facets).max(2.0);
    let identical = observation.identical.unwrap_or_default();
    let is_identical = identical > (MOST_IDENTICAL * on_facets).max(2.0);
    let (same, exactly) =
        if is_identical && !is_repeated { (identical, "exactly ") } else { (repeated, "") };
    let are_few_places = observation.copies.is_some_and(|copies| copies.are_few_places());
    let are_apart = observation.copies.is_some_and(|copies| copies.side_by_side < 0.5);
    let paths_come_again = is_identical && (are_few_places || are_apart);
    let mut findings = vec![
        fact(
            "finite",
            transformation,
            "every position is finite",
            format!("{} positions are not finite", of_all(counts.not_finite, records)),
            counts.not_finite == 0.0,
            Weight::Grave,
            "Look for what makes numbers that are not finite: a division by 0, the root of a \
             negative number, or a vector of length 0 that is normalized.",
        ),
        fact(
            "on surfaces",
            storage,
            &format!("every photon lies on one of the {surfaces} surfaces, up to 0.007 off"),
            format!("{} photons are off the surfaces", of_all(counts.off_surface, finite)),
            counts.off_surface <= (MOST_ASTRAY * finite).max(1.0),
            Weight::Grave,
            "The position is state.intersectionRay.GetRayPosition(state.intersectionT), in world \
             space.",
        ),
        fact(
            "footprints",
            transformation,
            "no photon lies on the floor beneath a box",
            format!("{} photons are under a box", of_all(counts.footprint, finite)),
            counts.footprint <= (MOST_ASTRAY * finite).max(1.0),
            Weight::Fault,
            "A photon got into a box: directions must be in the hemisphere over the normal, and \
             the scattered ray must start above the surface.",
        ),
        fact(
            "same place",
            if paths_come_again { Section::PhotonEmission } else { transformation },
            "hardly any two photons lie at the same place",
            format!("{} photons are {exactly}where another one is", of_all(same, on_facets)),
            !is_repeated && !is_identical,
            if are_few_places { Weight::Grave } else { Weight::Fault },
            if paths_come_again {
                "Whole paths come again: check that the generator is seeded once for the whole \
                 run, and that threads do not share a seed."
            } else if observation.repeats_by_rounding || observation.identical.is_none() {
                "Scattered rays hit the triangle they leave: start them a little above the \
                 surface, or check that no photon is inserted twice."
            } else {
                "Scattered rays come back at once to the surface they leave: check that directions \
                 are in the hemisphere over the normal, and that rays start above the surface."
            },
        ),
    ];
    let same_place = findings.pop();
    // Where many lie at the same place, they are crowded for that reason.
    let is_crowded = observation.crowding < SIGNIFICANCE && !is_repeated && !is_identical;
    findings.push(Finding {
        p_value: (!is_repeated && !is_identical).then_some(observation.crowding),
        ..fact(
            SPREAD,
            storage,
            "photons spread over the surfaces, not on a few spots or lines",
            if is_crowded { "they crowd on a few spots or lines" } else { "they spread" }
                .to_owned(),
            !is_crowded,
            Weight::Fault,
            "Check that every photon has random numbers of its own, and that the position is where \
             it hit.",
        )
    });
    findings.extend(same_place);
    if let Some([later, without]) = observation.gaps
        && later > 0
    {
        let part = without as f64 / later as f64;
        // Where most have none, the column counts something else than paths.
        let counts_paths = part < MOST_GAPS;
        findings.push(fact(
            "whole paths",
            storage,
            "for every bounce of a photon, a record of the one before",
            format!("{} of {} records lack the one before", thousands(without), thousands(later)),
            without as f64 <= (MOST_ASTRAY * later as f64).max(2.0),
            if counts_paths { Weight::Fault } else { Weight::Remark },
            if counts_paths {
                "Records are lost. Lock the photon map while a thread inserts into it, or give \
                 every thread its own."
            } else {
                "Let 'photon' number the photons that are emitted, and 'bounce' count each one's \
                 hits."
            },
        ));
    }
    if let Some(decimals) = observation.few_decimals {
        findings.retain(|finding| finding.check != "same place");
        findings.push(fact(
            "same place",
            storage,
            "positions with at least four decimals",
            format!(
                "positions have {decimals} decimals: whether photons hit the triangle they \
                     leave cannot be told"
            ),
            false,
            Weight::Remark,
            "Write positions with all their digits, such as nine.",
        ));
    }
    findings
}

/// The check of how many photons there are: a list that fails it alone is not decided.
pub const ENOUGH_PHOTONS: &str = "enough photons";

/// Whether the list is long enough to be what the handout asks for. Only where it `is_fair`, it is
/// told how many photons fit it.
pub fn enough(
    observation: &Observation,
    emitted: Option<f64>,
    fitted: f64,
    is_fair: bool,
) -> Finding {
    let passed = emitted.is_some() || fitted >= FEW_EMITTED;
    let found = match (emitted, is_fair) {
        (None, true) => {
            let stored = thousands(observation.records);
            format!("{stored} photons, of about {} emitted", rounded(fitted))
        }
        _ => format!("{} photons", thousands(observation.records)),
    };
    let finding = Finding::new(
        ENOUGH_PHOTONS,
        format!("the photons of at least {} emitted", rounded(FEW_EMITTED)),
        found,
        "The framework emits 1,000,000 photons. If yours did, look at where paths end; if it \
         emitted fewer, grade with --emitted.",
    );
    let weight = if fitted < LEAST_EMITTED { Weight::Fault } else { Weight::Remark };
    finding.of(Section::PhotonStorage).weighing(weight).passed_if(passed)
}

/// The check of photons that come straight from the light.
pub fn straight_from_the_light(found: String, passed: bool) -> Finding {
    let finding = Finding::new(
        "indirect only",
        "photons that have bounced, not those straight from the light",
        found,
        "Do not store a photon while the size of 'path' is 1.",
    );
    let weight = if passed { Weight::Remark } else { Weight::Grave };
    finding.of(Section::PhotonStorage).weighing(weight).passed_if(passed)
}

/// What costs nothing, since the handout says that positions are sufficient. `emitted` is how many
/// photons were emitted by the word of the course, and `is_ruled_out` whether the photons lie where
/// those straight from the light do not.
pub fn remarks(
    observation: &Observation,
    emitted: Option<f64>,
    is_ruled_out: bool,
) -> Vec<Finding> {
    let remark = |check, expected: &str, found: String, passed, advice| {
        Finding::new(check, expected, found, advice).of(Section::PhotonStorage).passed_if(passed)
    };
    let mut findings = Vec::new();
    if observation.has_odd_intensity {
        findings.push(remark(
            "intensity",
            "one intensity for all: the light's color divided by the photons emitted",
            "intensities that differ, or say nothing".to_owned(),
            false,
            "Set 'intensity' to lightIntensity as it is.",
        ));
    }
    if let (Some(emitted), Some(says)) = (emitted, observation.emitted_by_intensity)
        && (says / emitted - 1.0).abs() > 1e-3
    {
        findings.push(remark(
            "intensity",
            "the light's color divided by the photons emitted",
            format!("it is of {} emitted, not of {}", rounded(says), rounded(emitted)),
            false,
            "Set 'intensity' to lightIntensity as it is.",
        ));
    }
    let Some(to_light) = observation.to_light else {
        return findings;
    };
    let ToLight { set, not_unit, from_behind, to_the_light, all_alike } = to_light;
    let records = observation.records;
    let of_set = |part: u64| format!("{} of {}", thousands(part), thousands(set));
    let is_set = set == records && !all_alike;
    findings.push(remark(
        "to_light set",
        "a direction for every photon",
        if all_alike {
            "all the same".to_owned()
        } else {
            format!("{} of {} have one", thousands(set), thousands(records))
        },
        is_set,
        "Set 'toLightRay' to a ray in the opposite direction of the photon ray.",
    ));
    if !is_set {
        return findings;
    }
    let nearly_all = |count: u64| count as f64 > NEARLY_ALL * set as f64;
    let few = |count: u64| count as f64 <= HARDLY_ANY * set as f64;
    findings.push(remark(
        "to_light length",
        "directions of length 1",
        format!("{} are not", of_set(not_unit)),
        few(not_unit),
        "Normalize the direction.",
    ));
    findings.push(remark(
        "to_light direction",
        "directions to where the photon came from, in front of the surface",
        format!("{} point behind the surface", of_set(from_behind)),
        few(from_behind),
        if nearly_all(from_behind) {
            "The sign is reversed: it points in the OPPOSITE direction of the photon ray."
        } else {
            "The photon ray's direction, with the opposite sign."
        },
    ));
    if to_light.is_towards_light_throughout() {
        return findings;
    }
    let is_indirect = to_the_light as f64 <= (MOST_STRAIGHT * set as f64).max(3.0);
    findings.push(if !is_indirect && is_ruled_out {
        remark(
            "to_light source",
            "directions to where the photon came from",
            format!(
                "{} point straight to the light, but the photons do not lie where those straight \
                 from the light do",
                of_set(to_the_light)
            ),
            false,
            "Set 'toLightRay' to a ray in the opposite direction of the photon ray that came here.",
        )
    } else {
        let found = format!("{} come straight from the light", of_set(to_the_light));
        straight_from_the_light(found, is_indirect)
    });
    findings
}
