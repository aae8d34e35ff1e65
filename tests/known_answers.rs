//! Runs held against what is known without tracing.


use fixtures::{closed_cube, handout, list};
use glam::DVec3;
use oracle::table::ExpectedTable;
use photon_list::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};

/// Hits on every surface at every bounce, from the first hit on.
fn hits(renderer: &PhotonMappingRenderer) -> Vec<Vec<u64>> {
    let mut hits = vec![Vec::new(); renderer.stored_scene.mesh_objects().len()];
    let all = 0..renderer.emitted();
    let mut photon_map = Vec::new();
    renderer.generic_photon_map_generation(&mut photon_map, all, |_, path, _| {
        for (bounce, vertex) in path[1..].iter().enumerate() {
            let PathVertex::Surface(state) = vertex else { unreachable!() };
            let surface = state.primitive(&renderer.stored_scene).parent_mesh_object;
            let of_surface: &mut Vec<u64> = &mut hits[surface];
            if of_surface.len() <= bounce {
                of_surface.resize(bounce + 1, 0);
            }
            of_surface[bounce] += 1;
        }
    });
    hits
}

/// By how many standard deviations `count` of `emitted` photons differs from `probability`.
fn deviations(count: u64, emitted: u64, probability: f64) -> f64 {
    let emitted = emitted as f64;
    let deviation = (emitted * probability * (1.0 - probability)).sqrt();
    (count as f64 - emitted * probability) / deviation
}

/// First, second and third hits per emitted photon, in the order of the model file: shortBox,
/// rightWall, tallBox, floor. Closed form and cubature in f64.
const HITS: [[f64; 3]; 4] = [
    [0.016710788766, 0.007977496, 0.00167178],
    [0.132736677536, 0.009668818, 0.00449688],
    [0.045214549333, 0.010443310, 0.00153398],
    [0.041323923772, 0.005324345, 0.00330447],
];
#[test]
fn hits_of_the_handout_by_surface_and_bounce() {
    let emitted = 4_000_000;
    let hits = hits(&handout(2, emitted));
    for (surface, expected) in HITS.iter().enumerate() {
        for (bounce, probability) in expected.iter().enumerate() {
            let z = deviations(hits[surface][bounce], emitted, *probability);
            assert!(z.abs() < 4.0, "surface {surface}, bounce {bounce}: {z:.1} deviations");
        }
    }
}

#[test]
fn stored_photons_of_the_handout_by_surface() {
    let emitted = 4_000_000;
    let expected = ExpectedTable::of_assignment8();
    let list = list(&handout(3, emitted));
    let deviations = |found: usize, probability: f64, variance: f64| {
        (found as f64 - probability * emitted as f64) / (variance * emitted as f64).sqrt()
    };
    for (surface, row) in expected.surfaces.iter().enumerate() {
        let found = list.iter().filter(|record| usize::from(record.surface) == surface).count();
        let z = deviations(found, row.stored, expected.covariance[surface][surface]);
        assert!(z.abs() < 4.0, "{}: {z:.1} deviations", row.name);
    }
    let variance = expected.covariance.iter().flatten().sum();
    let z = deviations(list.len(), expected.total.stored, variance);
    assert!(z.abs() < 4.0, "all surfaces: {z:.1} deviations");
}

#[test]
fn rays_and_ends_of_the_handout() {
    let emitted = 2_000_000;
    let renderer = handout(4, emitted);
    let total: u64 = hits(&renderer).iter().flatten().sum();
    // Hits are 0.235986 at first and 0.050158 later, with less spread than a variance of 0.6 a photon.
    let z = (total as f64 - 0.286144 * emitted as f64) / (0.6 * emitted as f64).sqrt();
    assert!(z.abs() < 4.0, "{z:.1}");
}

#[test]
fn hits_in_a_closed_cube_form_a_geometric_series() {
    let (albedo, emitted) = (0.75, 200_000);
    let hits = hits(&closed_cube(albedo, 5, emitted));
    for bounce in 0..12 {
        let total: u64 = hits.iter().map(|surface| surface[bounce]).sum();
        let probability = f64::from(albedo).powi(bounce as i32);
        if bounce == 0 {
            assert_eq!(total, emitted, "nothing leaves a closed cube");
        } else {
            let z = deviations(total, emitted, probability);
            assert!(z.abs() < 4.0, "bounce {bounce}: {z:.1} deviations");
        }
    }
}

#[test]
fn each_face_of_a_cube_gets_a_sixth() {
    let emitted = 400_000;
    let hits = hits(&closed_cube(0.75, 6, emitted));
    for surface in &hits {
        for (bounce, count) in surface.iter().take(6).enumerate() {
            let probability = 0.75_f64.powi(bounce as i32) / 6.0;
            let z = deviations(*count, emitted, probability);
            assert!(z.abs() < 4.0, "bounce {bounce}: {z:.1} deviations");
        }
    }
}

#[test]
fn photons_lie_on_planes_arrive_in_front_and_never_twice_on_one() {
    let renderer = handout(7, 1_000_000);
    let scene = &renderer.stored_scene;
    let mut photon_map = Vec::new();
    let mut surfaces = 0;
    renderer.generic_photon_map_generation(&mut photon_map, 0..1_000_000, |photon, path, _| {
        let mut last_plane: Option<(DVec3, f64)> = None;
        for vertex in &path[1..] {
            let PathVertex::Surface(state) = vertex else { unreachable!() };
            let triangle = state.primitive(scene);
            let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
            let normal = (b - a).cross(c - a).normalize();
            let distance = normal.dot(state.intersection_point().as_dvec3() - a).abs();
            assert!(distance < 1e-6, "photon {photon} is {distance} off its plane");
            let cosine = -state.intersection_ray.ray_direction().dot(triangle.normal);
            assert!(cosine > 0.0, "photon {photon} came from behind");
            let plane = (normal, normal.dot(a));
            let same = |last: (DVec3, f64)| {
                last.0.dot(plane.0).abs() > 1.0 - 1e-9 && (last.1 - plane.1).abs() < 1e-9
            };
            assert!(!last_plane.is_some_and(same), "photon {photon} hit one plane twice");
            last_plane = Some(plane);
            surfaces += 1;
        }
    });
    assert!(surfaces > 280_000);
}

#[test]
fn intensity_is_the_light_shared_among_its_photons() {
    let list = list(&handout(8, 50_000));
    let is_right = |record: &PhotonRecord| record.intensity.to_array() == [1.0 / 50_000.0; 3];
    assert!(!list.is_empty() && list.iter().all(is_right));
}
