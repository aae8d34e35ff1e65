//! Puts the pieces together: each bounce by the best method at hand, each with its error.

use super::between_meshes::{add_differences, covariance, left_over};
use super::bounces::follow;
use super::cuts::{cut_all, cutting_planes};
use super::direct::Direct;
use super::expectation::{Expectation, FacetHits};
use super::mesh::Mesh;
use super::polygon::{area_vector, bisect, fan, longest_edge};
use super::scene::{GAP, PlateScene, Side};
use super::settings::SolveSettings;
use super::solid_angle::form_factor;
use super::triangle_rules::{Integral, TriangleRule, integrate};
use super::visibility::seen_from_plate;
use super::{Accuracy, Emitter, Facet};
use glam::DVec3;

/// Rounding of a sum of closed forms; the error given where nothing else is.
const ROUNDING: f64 = 1e-14;
/// Hits of one path that are followed at most, should nothing absorb them: the handout's limit.
const MOST_BOUNCES: usize = 1001;
/// Scenes of more facets are not cut along every facet's plane, as the cuts would outnumber the
/// cells, and integrated with fewer points.
const MOST_FACETS_FOR_CUTS: usize = 40;

/// A detail is small when it is smaller than this, in scene units. The handout has none.
const SMALL: f64 = 0.1;

/// No edge is longer, in scene units.
const WHOLE_SCENE: f64 = 4.0;

/// Expected hits per emitted photon on every facet, for every bounce.
pub fn expect(facets: &[Facet], emitters: &[Emitter], accuracy: Accuracy) -> Expectation {
    expect_with(facets, emitters, &SolveSettings::of(accuracy))
}

fn expect_with(facets: &[Facet], emitters: &[Emitter], settings: &SolveSettings) -> Expectation {
    let scene = PlateScene::new(facets, emitters);
    let direct =
        Direct::new(&scene, TriangleRule::folded(settings.gather_order), settings.gather_ratio);
    let cuts = scene.plates.len() <= MOST_FACETS_FOR_CUTS;

    let first_errors = vec![0.0; direct.hits.len()];
    let second = second_hits(&scene, &direct, settings, cuts);
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
    let refinement = fine.cells.len() as f64 / coarse.cells.len().max(1) as f64;
    let left_over = if cuts { left_over(refinement, settings.safety) } else { 1.0 };
    let [coarse, fine] = [coarse, fine]
        .map(|mesh| follow(&scene, &direct, &mesh, &known, &surface_of, MOST_BOUNCES));
    add_differences(&mut errors, &coarse, &fine, left_over);

    let mut result = Expectation {
        facets: facets.iter().map(|facet| empty_hits(facet, fine.hits.len())).collect(),
        covariance: Vec::new(),
        surfaces,
    };
    for (index, plate) in scene.plates.iter().enumerate() {
        let facet = &mut result.facets[plate.facet];
        facet.hits = fine.hits.iter().map(|hits| hits[index]).collect();
        // Sums of nothing but exact zeros have nothing to round.
        let of_gap = if scene.is_parted { 10.0 * GAP } else { 0.0 };
        let rounding = |hits: f64| if hits == 0.0 { 0.0 } else { ROUNDING + of_gap };
        let errors = errors.iter().map(|errors| errors[index]).zip(&facet.hits);
        facet.error = errors.map(|(error, hits)| error + rounding(*hits)).collect();
    }
    result.covariance = covariance(&result, &coarse, &fine);
    result
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

/// `triangle` of `plate` in parts small enough that none can hide the narrow peak that a small
/// thing nearby makes. Where all things are about as large as the scene, it stays whole.
fn halved(scene: &PlateScene, plate: usize, triangle: [DVec3; 3]) -> Vec<[DVec3; 3]> {
    let detail = scene.detail_near(plate, &triangle);
    let (_, length_squared) = longest_edge(&triangle);
    if detail > SMALL || length_squared <= (4.0 * detail).powi(2) || length_squared < 1e-12 {
        return vec![triangle];
    }
    bisect(&triangle).into_iter().flat_map(|half| halved(scene, plate, half)).collect()
}

/// N2: the lit pieces, cut where a facet comes into view, are integrated with the chance to reach
/// each facet.
fn second_hits(
    scene: &PlateScene,
    direct: &Direct,
    settings: &SolveSettings,
    cuts: bool,
) -> Integral {
    let mut triangles = Vec::new();
    for (index, piece) in direct.pieces.iter().enumerate() {
        if scene.plates[piece.plate].survival > 0.0 {
            let planes = if cuts { cutting_planes(scene, piece.plate) } else { Vec::new() };
            let pieces = cut_all(piece.corners.clone(), &planes);
            triangles.extend(
                pieces
                    .iter()
                    .flat_map(|polygon| fan(polygon))
                    .flat_map(|triangle| halved(scene, piece.plate, triangle))
                    .map(|triangle| (index, triangle)),
            );
        }
    }
    let integrand = |index: usize, point: DVec3| {
        let piece = &direct.pieces[index];
        let density = direct.density(scene, piece.emitter, piece.plate, point);
        reached_from(scene, piece.plate, point, density)
    };
    let rule = if cuts { TriangleRule::radon() } else { TriangleRule::cheap() };
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
fn third_hits(
    scene: &PlateScene,
    direct: &Direct,
    tolerance: f64,
    most: usize,
    cuts: bool,
) -> Integral {
    let mut triangles = Vec::new();
    for (index, plate) in scene.plates.iter().enumerate() {
        if plate.survival > 0.0 {
            let planes = if cuts { cutting_planes(scene, index) } else { Vec::new() };
            let pieces = plate.parts.iter().flat_map(|part| cut_all(part.clone(), &planes));
            triangles.extend(
                pieces
                    .flat_map(|piece| fan(&piece).collect::<Vec<_>>())
                    .flat_map(|triangle| halved(scene, index, triangle))
                    .map(|triangle| (index, triangle)),
            );
        }
    }
    let integrand = |plate: usize, point: DVec3| {
        let density = direct.second_hit_density(scene, plate, point);
        reached_from(scene, plate, point, density)
    };
    integrate(&TriangleRule::radon(), triangles, scene.plates.len(), tolerance, most, integrand)
}

/// Density of hits on each plate by photons that hit `point` of `plate` with density `density`.
fn reached_from(scene: &PlateScene, plate: usize, point: DVec3, density: f64) -> Vec<f64> {
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
fn mesh_of(scene: &PlateScene, most: usize, widths: Option<&'static [f64]>) -> Mesh {
    let area: f64 =
        scene.plates.iter().map(|plate| 0.5 * area_vector(&plate.corners).length()).sum();
    // No triangle has more area than a quarter of its longest edge squared if it comes from halving
    // a square.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{FLOOR, RIGHT_WALL, SHORT_BOX, TALL_BOX, cube, handout};

    #[test]
    fn without_absorption_a_path_ends_at_the_handouts_limit() {
        let light = [Emitter { position: DVec3::ZERO, share: 1.0 }];
        // In a cube any mesh will do, and each of its nodes is seen a thousand times.
        let settings = SolveSettings { cells: [100, 300], ..SolveSettings::of(Accuracy::Quick) };
        let result = expect_with(&cube(1.0), &light, &settings);
        assert_eq!(result.bounces(), 1001);
        let last = result.total(1001);
        assert!((last.value - 1.0).abs() <= last.error + 1e-9, "{last:?}");
        // Every path stores exactly 1000 hits. The mean square is a million.
        assert!(result.variance().value.abs() < 100.0, "{:?}", result.variance());
        let numbers = result.facets.iter().flat_map(|facet| facet.hits.iter().chain(&facet.error));
        assert!(numbers.copied().all(f64::is_finite));
    }

    /// N2 the other way round: gathered on the facets it hits, instead of sent from those first
    /// hit. What the two share is visibility and the closed form factor; points, cuts and the
    /// quadrature differ.
    #[test]
    #[ignore = "a minute of processor time"]
    fn second_hits_gathered_are_those_sent() {
        let (facets, emitters) = handout();
        let scene = PlateScene::new(&facets, &emitters);
        let settings = SolveSettings::of(Accuracy::Full);
        let direct = Direct::new(&scene, TriangleRule::folded(7), 0.7);
        let sent = second_hits(&scene, &direct, &settings, true);
        let on_tall_box = |plate: &usize| facets[scene.plates[*plate].facet].surface == TALL_BOX;
        let mut triangles = Vec::new();
        for plate in (0..scene.plates.len()).filter(on_tall_box) {
            let pieces =
                cut_all(scene.plates[plate].corners.clone(), &cutting_planes(&scene, plate));
            let fans = pieces.iter().flat_map(|piece| fan(piece));
            triangles.extend(fans.map(|triangle| (plate, triangle)));
        }
        let density = |plate: usize, point| vec![direct.second_hit_density(&scene, plate, point)];
        let gathered = integrate(&TriangleRule::radon(), triangles, 1, 4e-10, 1_000_000, density);
        let sum = |numbers: &[f64]| {
            (0..numbers.len()).filter(on_tall_box).map(|plate| numbers[plate]).sum::<f64>()
        };
        let (value, error) = (sum(&sent.values), sum(&sent.errors));
        let distance = (gathered.values[0] - value).abs();
        println!(
            "{value:.13} +- {error:e}, {:.13} +- {:e}",
            gathered.values[0], gathered.errors[0]
        );
        assert!(distance <= error + gathered.errors[0], "{distance:e} apart");
        assert!(error + gathered.errors[0] < 1e-9);
        let digits = [(SHORT_BOX, 0.007977496), (RIGHT_WALL, 0.009668818), (FLOOR, 0.005324345)];
        for (surface, known) in [(TALL_BOX, 0.010443311)].into_iter().chain(digits) {
            let is_there = |plate: &usize| facets[scene.plates[*plate].facet].surface == surface;
            let all = (0..scene.plates.len()).filter(is_there);
            let (value, error) =
                all.fold((0.0, 0.0), |(v, e), k| (v + sent.values[k], e + sent.errors[k]));
            assert!((value - known).abs() < 1e-9 && error < 3e-10, "{value} instead of {known}");
        }
    }

    #[test]
    #[ignore = "a minute of processor time"]
    fn third_hits_have_the_known_digits() {
        let (facets, emitters) = handout();
        let full = SolveSettings::of(Accuracy::Full);
        // What is looked at here does not depend on the meshes.
        let settings = SolveSettings { second_tolerance: 1e-6, cells: [100, 300], ..full };
        let result = expect_with(&facets, &emitters, &settings);
        let known = [
            (FLOOR, 0.00330447),
            (RIGHT_WALL, 0.00449688),
            (SHORT_BOX, 0.00167178),
            (TALL_BOX, 0.00153398),
        ];
        for (surface, known) in known {
            let found = result.on_surface(surface, 3);
            assert!((found.value - known).abs() < 2e-8, "{found:?} instead of {known}");
        }
        assert!((result.total(3).value - 0.01100711).abs() < 3e-8);
        assert!(result.total(3).error <= 3.1e-8);
    }
}
