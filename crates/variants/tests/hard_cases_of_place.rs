//! Hard cases of size and place: the whole scene scaled or moved, or a small detail of a wide one.

use fast::lanes::offset::Offset;
use fixtures::judge::{Judge, PathJudgment};
use fixtures::{handout, handout_on_a_plain, handout_over_a_square, light, list, moved_handout};
use glam::{DVec3, Vec3};
use model::placement::Placement;
use oracle::Accuracy;
use oracle::table::ExpectedTable;
use photon_mapping::photon_list::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::PathVertex;
use photon_mapping::scene::Material;
use photon_mapping::scene::MeshObject;
use photon_mapping::scene::Scene;
use photon_mapping::scene::numerics::LARGE_EPSILON;
use photon_mapping::scene::point_light::PointLight;
use photon_mapping::scene::triangle::Triangle;
use variants::reading::Reading;
use variants::run::Run;

/// Whether `judgment` of `count` photons has nothing impossible in it, and on the handout's
/// surfaces what the oracle of the unmoved scene expects.
fn check(judgment: &PathJudgment, count: u64, case: &str) {
    assert_eq!(judgment.impossible(), [0; 3], "{case}: self-hits, leaks, under boxes");
    let expected = ExpectedTable::of_assignment8();
    for (surface, row) in expected.surfaces.iter().enumerate() {
        let deviation = (expected.covariance[surface][surface] * count as f64).sqrt();
        let z = (judgment.stored[surface] as f64 - row.stored * count as f64) / deviation;
        assert!(z.abs() < 4.5, "{case}: {} is {z:.1} off", row.name);
    }
}

fn check_moved(scale: f64, shift: DVec3, seed: u64, count: u64) {
    let judgment = Judge::new(&moved_handout(scale, shift, seed, count)).judge(0..count);
    check(&judgment, count, &format!("scale {scale}, shift {shift}"));
}

#[test]
fn whole_scene_scaled() {
    for scale in [1e-4, 1e-3, 0.1, 10.0, 1e3, 1e4] {
        check_moved(scale, DVec3::ZERO, 21, 1_000_000);
    }
}

#[test]
fn whole_scene_moved() {
    for distance in [1e4, 1e5] {
        for direction in [DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::ONE] {
            check_moved(1.0, distance * direction, 22, 300_000);
        }
    }
}

#[test]
fn whole_scene_moved_far_and_scaled() {
    check_moved(1e-4, DVec3::new(100.0, -37.0, 5.0), 23, 1_000_000);
    check_moved(1e4, DVec3::new(-1e5, 1e5, 3e4), 24, 1_000_000);
}

/// A detail in the middle of a wide scene has all the digits of f32, so nothing at all may change
/// but by the length of the offset.
#[test]
fn small_detail_of_a_wide_scene() {
    let count = 1_000_000;
    let at_home = Judge::new(&handout(32, count)).judge(0..count);
    for extent in [20.0, 200.0, 2e3, 2e4] {
        let run = handout_over_a_square(extent, DVec3::ZERO, 32, count);
        let judgment = Judge::new(&run).judge(0..count);
        check(&judgment, count, &format!("over a square of {extent}"));
        let pairs = judgment.stored.iter().zip(&at_home.stored);
        let differences: Vec<_> = pairs.map(|(here, there)| here.abs_diff(*there)).collect();
        assert!(differences.iter().all(|difference| *difference <= 5), "{extent}: {differences:?}");
    }
}

/// Away from the middle, coordinates have fewer digits: `rounding` is their last place, in units of
/// the handout's scene. A photon that lands as near to an edge may come out on its other side, and
/// rays start a few such places off. Of a million photons, 10^4 times `rounding` may come from
/// behind, and counts differ by 10^5 times `rounding`, beside the few of the test above.
#[test]
fn small_detail_away_from_the_middle() {
    let count = 1_000_000;
    let at_home = Judge::new(&handout(33, count)).judge(0..count);
    for extent in [20.0, 200.0, 2e3, 2e4, 2e5] {
        for direction in [DVec3::new(0.9, -0.3, 0.0), DVec3::new(-0.2, 0.5, 0.0)] {
            let shift = extent * direction;
            let rounding = f64::from(f32::EPSILON) * shift.abs().max_element();
            let run = handout_over_a_square(extent, shift, 33, count);
            let judgment = Judge::new(&run).judge(0..count);
            let pairs = judgment.stored.iter().zip(&at_home.stored);
            let differences: Vec<_> = pairs.map(|(a, b)| a.abs_diff(*b)).collect();
            let case = format!("{shift} in {extent}: {:?}, {differences:?}", judgment.impossible());
            assert!(
                judgment.impossible().iter().sum::<u64>() as f64 <= 3.0 + 1e4 * rounding,
                "{case}"
            );
            let bound = 10.0 + 1e5 * rounding;
            assert!(differences.iter().all(|difference| *difference as f64 <= bound), "{case}");
        }
    }
}

/// Also the oracle must see a small thing on a wide floor, where all of a density is in a narrow
/// peak.
#[test]
fn expected_hits_on_a_wide_plain() {
    let count = 1_000_000;
    for extent in [20.0, 500.0] {
        let run = handout_on_a_plain(extent, DVec3::ZERO, 37, count);
        let scene = run.scene();
        let expected = ExpectedTable::compute(scene, &[count], Accuracy::Quick);
        let records = list(&run);
        for (surface, row) in expected.surfaces.iter().enumerate() {
            for bounce in 1..=3 {
                let is_one =
                    |r: &&PhotonRecord| (usize::from(r.surface), r.bounce) == (surface, bounce);
                let stored = records.iter().filter(is_one).count() as f64;
                let [mean, error] =
                    [&row.hits, &row.error].map(|it| it[usize::from(bounce)] * count as f64);
                let off = (stored - mean).abs();
                let case = format!("{extent}: {}, bounce {bounce}: {stored}, {mean}", row.name);
                assert!(off < 4.5 * mean.sqrt() + error, "{case} +- {error}");
                // The bound is to be of use where the quick way has one.
                assert!(bounce > 1 || error < 0.01 * mean, "{case} +- {error}");
            }
        }
    }
}

/// Two facets in one place that look opposite ways are met from their fronts, also by the oracle.
#[test]
fn expected_hits_on_a_sheet_of_two_sides() {
    let square = |height: f32, size: f32, normal: Vec3, surface: usize| {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let [a, b, c, d] = corners.map(|(x, y)| Vec3::new(size * x, size * y, height));
        [[a, b, c], [a, c, d]].map(|vertices| Triangle {
            vertices,
            normal,
            parent_mesh_object: surface,
            facet: 0,
        })
    };
    let gray =
        |name: &str| MeshObject { name: name.into(), material: Material::new(Vec3::splat(0.5)) };
    let names = ["floor", "up", "down", "roof"].map(gray);
    // The sheet's lower side is smaller, so that the upper one is met from behind beside it.
    let triangles = [
        square(0.0, 1.0, Vec3::Z, 0),
        square(0.5, 0.5, Vec3::Z, 1),
        square(0.5, 0.3, Vec3::NEG_Z, 2),
        square(1.2, 1.0, Vec3::NEG_Z, 3),
    ];
    let light = PointLight { position: Vec3::new(0.0, 0.7, 0.9), color: Vec3::ONE };
    let scene = Scene::new(names.into(), triangles.concat(), vec![light]);
    let count = 300_000;
    let expected = ExpectedTable::compute(&scene, &[count], Accuracy::Quick);
    let run = Run::of_scene(scene, Placement::WORLD, 38, count);
    let records = list(&run);
    for (surface, row) in expected.surfaces.iter().enumerate() {
        let stored = records.iter().filter(|r| usize::from(r.surface) == surface).count() as f64;
        let deviation = (expected.covariance[surface][surface] * count as f64).sqrt();
        let off = (stored - row.stored * count as f64).abs();
        assert!(off < 4.5 * deviation + 0.01 * stored, "{}: {stored}, {}", row.name, row.stored);
        assert!(stored > 500.0, "{}: {stored}", row.name);
    }
}

/// What the judge reads from a list it would also have read from all paths.
#[test]
fn judge_misses_nothing() {
    for offset in [Offset::None, Offset::AlongNormal(-0.3), Offset::AlongNormal(0.01)] {
        let reading = Reading { offset, ..Reading::REFERENCE };
        let mut run = Run { reading, ..handout(35, 100_000) };
        run.renderer.max_photon_bounces = 20;
        let judge = Judge::new(&run);
        let by_list = judge.judge(0..100_000).impossible();
        assert_eq!(by_list, judge.judge_all_paths(0..100_000).impossible(), "{offset:?}");
        if offset == Offset::AlongNormal(-0.3) {
            assert!(by_list.iter().all(|count| *count > 100), "{by_list:?}");
        }
    }
}

/// What the tests above hold, for 10^8 photons each, kept in `golden/leaks.csv`: `cargo test
/// --release -- --ignored`. Every case has a seed of its own, since the paths of a moved scene are
/// those at home.
#[test]
#[ignore = "takes many minutes"]
fn no_self_hit_and_no_leak_in_a_hundred_million_rays() {
    const PHOTONS: u64 = 100_000_000;
    let details = [2e4, 2e3, 200.0, 20.0].map(|extent| {
        (("amid a square", extent), handout_over_a_square(extent, DVec3::ZERO, 0, PHOTONS))
    });
    let directions =
        [DVec3::new(-1.0, 0.7, -0.3), DVec3::ONE, DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
    let moved = [1e5, 1e4, 1e3, 1e2, 1e1].into_iter().flat_map(|distance| {
        directions.map(|direction| {
            (("moved", distance), moved_handout(1.0, distance * direction, 0, PHOTONS))
        })
    });
    let scaled = [1.0, 1e-4, 1e-3, 1e-2, 1e-1, 1e1, 1e2, 1e3, 1e4]
        .map(|scale| (("scaled", scale), moved_handout(scale, DVec3::ZERO, 0, PHOTONS)));
    let mut table = "case,by,photons,self_hits,from_behind,under_a_box\n".to_owned();
    let cases = details.into_iter().chain(moved).chain(scaled);
    for (seed, ((case, by), mut run)) in (1100..).zip(cases) {
        run.renderer.seed = seed;
        let judgment = Judge::new(&run).judge(0..PHOTONS);
        let stored: u64 = judgment.stored.iter().sum();
        let [self_hits, leaks, under_boxes] = judgment.impossible();
        table += &format!("{case},{by:e},{PHOTONS},{self_hits},{leaks},{under_boxes}\n");
        assert!(stored > PHOTONS / 20, "{case} {by}: only {stored} photons were judged");
        check(&judgment, PHOTONS, &format!("{case} {by}"));
    }
    let golden = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden/leaks.csv");
    std::fs::write(golden, table).expect("golden/ can be written");
}

/// The bound on what moving does: nothing to the paths, and to a position in the list at most half
/// a unit in the last place of its world coordinates.
#[test]
fn moving_rounds_positions_once() {
    let at_home = list(&handout(26, 100_000));
    for distance in [1e4, 1e5] {
        let shift = DVec3::splat(distance);
        let moved = list(&moved_handout(1.0, shift, 26, 100_000));
        assert_eq!(at_home.len(), moved.len());
        let half_unit = f64::from((distance as f32).next_up() - distance as f32) / 2.0;
        for (here, there) in at_home.iter().zip(&moved) {
            assert_eq!((here.photon, here.bounce), (there.photon, there.bounce));
            let distance = there.position.as_dvec3() - shift - here.position.as_dvec3();
            assert!(distance.abs().max_element() <= half_unit * 1.001, "{here:?} {there:?}");
            assert!((here.to_light - there.to_light).length() < 1e-6);
        }
    }
}

#[test]
fn handout_is_traced_where_it_stands() {
    let run = moved_handout(1.0, DVec3::ZERO, 1, 1);
    assert_eq!(run.placement, Placement::WORLD);
    assert_eq!(light().position, Vec3::new(0.01909, 0.0101, 1.77640));
}

#[test]
fn rays_of_the_handout_start_where_the_framework_starts_them() {
    for (scale, shift) in [(1.0, DVec3::ZERO), (1e-4, DVec3::ONE), (1e4, DVec3::ZERO)] {
        let run = moved_handout(scale, shift, 36, 100_000);
        let scene = run.scene();
        let mut hits = 0;
        run.trace_photons(0..100_000, |_, path, _| {
            for vertex in &path[1..] {
                let PathVertex::Surface(state) = vertex else { unreachable!() };
                let (point, t) = (state.intersection_point(), state.intersection_t);
                assert_eq!(scene.offset(state.intersected_primitive, point, t), LARGE_EPSILON);
                hits += 1;
            }
        });
        assert!(hits > 25_000, "{hits}");
    }
}
