//! Puts the pieces together: each bounce by the best method at hand, each with its error.

use super::bounces::{Bounces, follow};
use super::cuts::{cut_all, cutting_planes};
use super::direct::Direct;
use super::expectation::{Bounded, Expectation, FacetHits};
use super::mesh::Mesh;
use super::polygon::{area_vector, fan};
use super::scene::{Scene, Side};
use super::solid_angle::form_factor;
use super::triangle_rules::{Integral, Rule, integrate};
use super::visibility::seen_from_plate;
use super::{Accuracy, Emitter, Facet};
use glam::DVec3;

/// Rounding of a sum of closed forms; the error given where nothing else is.
const ROUNDING: f64 = 1e-14;
/// Hits of one path that are followed at most, should nothing absorb them: the handout's limit.
const MOST_BOUNCES: usize = 1001;
/// Scenes of more facets are not cut along every facet's plane, as the cuts would outnumber the cells, and integrated
/// with fewer points.
const MOST_FACETS_FOR_CUTS: usize = 40;

/// No edge is longer, in scene units.
const WHOLE_SCENE: f64 = 4.0;

/// Expected hits per emitted photon on every facet, for every bounce.
pub fn expect(facets: &[Facet], emitters: &[Emitter], accuracy: Accuracy) -> Expectation {
    let scene = Scene::new(facets, emitters);
    let settings = Settings::of(accuracy);
    let direct = Direct::new(&scene, Rule::folded(settings.gather_order), settings.gather_ratio);
    let cuts = scene.plates.len() <= MOST_FACETS_FOR_CUTS;

    let first_errors = direct.hits.iter().map(|_| ROUNDING).collect();
    let second = second_hits(&scene, &direct, &settings, cuts);
    let mut known = vec![direct.hits.clone(), second.values];
    let mut errors = vec![first_errors, second.errors];
    if let Some(tolerance) = settings.third_tolerance {
        let third = third_hits(&scene, &direct, tolerance, settings.third_evaluations, cuts);
        known.push(third.values);
        errors.push(third.errors);
    }

    let mut surfaces: Vec<usize> = facets.iter().map(|facet| facet.surface).collect();
    surfaces.sort_unstable();
    surfaces.dedup();
    let surface_of: Vec<usize> = scene
        .plates
        .iter()
        .map(|plate| surfaces.binary_search(&facets[plate.facet].surface).unwrap_or_default())
        .collect();
    let widths = cuts.then_some(settings.strips);
    let coarse = mesh_of(&scene, settings.cells[0], widths);
    // Two meshes that hardly differ would agree whatever their error.
    let fine = mesh_of(&scene, settings.cells[1].max(3 * coarse.cells.len()), widths);
    let [coarse, fine] = [coarse, fine]
        .map(|mesh| follow(&scene, &direct, &mesh, &known, &surface_of, MOST_BOUNCES));
    add_differences(&mut errors, &coarse, &fine);

    let mut result = Expectation {
        facets: facets.iter().map(|facet| empty_hits(facet, fine.hits.len())).collect(),
        covariance: Vec::new(),
        surfaces,
    };
    for (index, plate) in scene.plates.iter().enumerate() {
        let facet = &mut result.facets[plate.facet];
        facet.hits = fine.hits.iter().map(|hits| hits[index]).collect();
        facet.error = errors.iter().map(|errors| errors[index] + ROUNDING).collect();
    }
    result.covariance = covariance(&result, &coarse, &fine);
    result
}

struct Settings {
    /// Sum over facets of the error of the second hits.
    second_tolerance: f64,
    second_evaluations: usize,
    third_tolerance: Option<f64>,
    third_evaluations: usize,
    /// Cells of the two meshes, at most if the facets allow.
    cells: [usize; 2],
    /// Widths of the strips along touching edges, over the longest edge of a cell.
    strips: &'static [f64],
    gather_order: usize,
    gather_ratio: f64,
}

impl Settings {
    fn of(accuracy: Accuracy) -> Self {
        match accuracy {
            Accuracy::Quick => Self {
                second_tolerance: 1e-5,
                second_evaluations: 40_000,
                third_tolerance: None,
                third_evaluations: 0,
                cells: [300, 1000],
                strips: &[0.4, 0.1],
                gather_order: 3,
                gather_ratio: 1.0,
            },
            Accuracy::Full => Self {
                second_tolerance: 1e-8,
                second_evaluations: 4_000_000,
                third_tolerance: Some(3e-8),
                third_evaluations: 300_000,
                cells: [900, 3000],
                strips: &[0.5, 0.15, 0.04],
                gather_order: 5,
                gather_ratio: 1.0,
            },
        }
    }
}

fn empty_hits(facet: &Facet, bounces: usize) -> FacetHits {
    let survival = if facet.survival.is_finite() { facet.survival.clamp(0.0, 1.0) } else { 0.0 };
    FacetHits {
        surface: facet.surface,
        survival,
        hits: vec![0.0; bounces],
        error: vec![0.0; bounces],
    }
}

/// N2: the lit pieces, cut where a facet comes into view, are integrated with the chance to reach each facet.
fn second_hits(scene: &Scene, direct: &Direct, settings: &Settings, cuts: bool) -> Integral {
    let mut triangles = Vec::new();
    for (index, piece) in direct.pieces.iter().enumerate() {
        if scene.plates[piece.plate].survival > 0.0 {
            let planes = if cuts { cutting_planes(scene, piece.plate) } else { Vec::new() };
            let pieces = cut_all(piece.corners.clone(), &planes);
            triangles.extend(
                pieces.iter().flat_map(|piece| fan(piece)).map(|triangle| (index, triangle)),
            );
        }
    }
    let integrand = |index: usize, point: DVec3| {
        let piece = &direct.pieces[index];
        let density = direct.density(scene, piece.emitter, piece.plate, point);
        reached_from(scene, piece.plate, point, density)
    };
    let rule = if cuts { Rule::radon() } else { Rule::cheap() };
    integrate(
        &rule,
        triangles,
        scene.plates.len(),
        settings.second_tolerance,
        settings.second_evaluations,
        integrand,
    )
}

/// N3: as N2, over all facets and with the gathered density of second hits.
fn third_hits(scene: &Scene, direct: &Direct, tolerance: f64, most: usize, cuts: bool) -> Integral {
    let mut triangles = Vec::new();
    for (index, plate) in scene.plates.iter().enumerate() {
        if plate.survival > 0.0 {
            let planes = if cuts { cutting_planes(scene, index) } else { Vec::new() };
            let pieces = plate.parts.iter().flat_map(|part| cut_all(part.clone(), &planes));
            triangles.extend(
                pieces
                    .flat_map(|piece| fan(&piece).collect::<Vec<_>>())
                    .map(|triangle| (index, triangle)),
            );
        }
    }
    let integrand = |plate: usize, point: DVec3| {
        let density = direct.second_hit_density(scene, plate, point);
        reached_from(scene, plate, point, density)
    };
    integrate(&Rule::radon(), triangles, scene.plates.len(), tolerance, most, integrand)
}

/// Density of hits on each plate by photons that hit `point` of `plate` with density `density`.
fn reached_from(scene: &Scene, plate: usize, point: DVec3, density: f64) -> Vec<f64> {
    let source = &scene.plates[plate];
    (0..scene.plates.len())
        .map(|target| {
            if density == 0.0 {
                return 0.0;
            }
            let seen = seen_from_plate(scene, plate, Side::Front, point, target);
            let factor: f64 =
                seen.iter().map(|piece| form_factor(piece, point, source.plane.normal)).sum();
            density * source.survival * factor
        })
        .collect()
}

/// A mesh of nearly `most` cells; of more, if the facets themselves are more.
fn mesh_of(scene: &Scene, most: usize, widths: Option<&'static [f64]>) -> Mesh {
    let area: f64 =
        scene.plates.iter().map(|plate| 0.5 * area_vector(&plate.corners).length()).sum();
    // No triangle has more area than a quarter of its longest edge squared if it comes from halving a square.
    let least = (4.0 * area / most as f64).sqrt();
    for widths in [widths, None] {
        let mut longest = least;
        while longest < WHOLE_SCENE {
            let mesh = Mesh::new(scene, longest, widths);
            if mesh.cells.len() <= most {
                return mesh;
            }
            longest *= 1.05;
        }
    }
    Mesh::new(scene, WHOLE_SCENE, None)
}

/// Bounces of which the relative differences are compared: later ones are alike.
const BOUNCES_COMPARED: usize = 6;

/// Adds the errors of the bounces that the meshes have followed.
///
/// How the two meshes differ on a facet at one bounce may be small by chance, where the difference changes its sign from
/// bounce to bounce. So each facet's largest relative difference counts at all of its bounces, and a quarter of the
/// usual one besides.
fn add_differences(errors: &mut Vec<Vec<f64>>, coarse: &Bounces, fine: &Bounces) {
    let followed = errors.len()..fine.hits.len();
    let before =
        |bounce: usize, plate: usize| coarse.hits.get(bounce).map_or(0.0, |hits| hits[plate]);
    let difference =
        |bounce: usize, plate: usize| (fine.hits[bounce][plate] - before(bounce, plate)).abs();
    let relative = |bounce: usize, plate: usize| {
        let hits = fine.hits[bounce][plate];
        if hits > 0.0 { difference(bounce, plate) / hits } else { 0.0 }
    };
    for bounce in followed.clone() {
        let hits = &fine.hits[bounce];
        let plates = 0..hits.len();
        let all: f64 = plates.clone().map(|plate| difference(bounce, plate)).sum();
        let total: f64 = hits.iter().sum();
        let usual = if total > 0.0 { 0.25 * all / total } else { 0.0 };
        let error = |plate: usize| {
            let compared = followed.clone().take(BOUNCES_COMPARED);
            let largest = compared.map(|other| relative(other, plate)).fold(0.0, f64::max);
            difference(bounce, plate).max(largest * hits[plate]) + usual * hits[plate]
        };
        errors.push(plates.map(error).collect());
    }
}

/// Covariance of the stored hits: E[S_a S_b] counts every ordered pair of two hits of a path, and each hit with itself.
fn covariance(result: &Expectation, coarse: &Bounces, fine: &Bounces) -> Vec<Vec<Bounded>> {
    let stored: Vec<Bounded> =
        result.surfaces.iter().map(|&surface| result.on_surface_from(surface, 2)).collect();
    let entry = |pairs: &[Vec<f64>], a: usize, b: usize| {
        let at =
            |a: usize, b: usize| pairs.get(a).and_then(|row| row.get(b)).copied().unwrap_or(0.0);
        at(a, b) + at(b, a) - stored[a].value * stored[b].value
            + if a == b { stored[a].value } else { 0.0 }
    };
    (0..stored.len())
        .map(|a| {
            (0..stored.len())
                .map(|b| {
                    let value = entry(&fine.ordered_pairs, a, b);
                    let difference = (value - entry(&coarse.ordered_pairs, a, b)).abs();
                    let of_means =
                        stored[a].error * stored[b].value + stored[b].error * stored[a].value;
                    let of_self = if a == b { stored[a].error } else { 0.0 };
                    Bounded { value, error: difference + of_means + of_self }
                })
                .collect()
        })
        .collect()
}
