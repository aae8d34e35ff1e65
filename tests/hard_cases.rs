//! Hard cases of directions, frames, draws, edges and bounces, each with what is right.


use fixtures::{closed_cube, draws, handout, list};
use glam::{DVec3, Vec3};
use photon_mapping::assignment8;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use variants::reading::Reading;
use photon_mapping::rendering::sampling::{sample_hemisphere, tangent_frame};
use photon_mapping::scene::LARGE_EPSILON;
use photon_mapping::scene::ray::IntersectionState;
use model::obj::{self, Model};
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::{ShearedRay, Triangle};

const LARGEST_BELOW_ONE: f32 = 1.0 - 1.0 / 16_777_216.0;

/// Largest deviation of the frame over `normal` from an orthonormal, right-handed one, in f64.
fn frame_error(normal: Vec3) -> f64 {
    let frame = tangent_frame(normal, &Reading::REFERENCE);
    let [t, b, n] = [frame.x_axis, frame.y_axis, frame.z_axis].map(|axis| axis.as_dvec3());
    [t.length() - 1.0, b.length() - 1.0, t.dot(b), t.dot(n), b.dot(n), (t.cross(b) - n).length()]
        .into_iter()
        .map(f64::abs)
        .fold(0.0, |worst, error| if error <= worst { worst } else { error })
}

#[test]
fn normal_exactly_along_x() {
    for normal in [Vec3::X, Vec3::NEG_X, Vec3::new(1.0, 1e-23, 0.0), Vec3::new(-1.0, 0.0, 1e-23)] {
        assert!(frame_error(normal) < 3e-7, "{normal}");
    }
}

#[test]
fn normal_next_to_x() {
    for x in [1.0_f32, -1.0] {
        for tilt in [1e-7_f32, -1e-7, 1e-4, 0.1, 0.141, 0.142] {
            let along_x = x * (1.0 - tilt * tilt).sqrt();
            for normal in [Vec3::new(along_x, tilt, 0.0), Vec3::new(along_x, 0.0, tilt)] {
                assert!(frame_error(normal) < 3e-7, "{normal}");
            }
        }
    }
}

#[test]
fn box_side_normals() {
    let scene = assignment8::create_scene();
    let sides = scene.triangles().iter().filter(|triangle| triangle.normal.x.abs() > 0.95);
    let sides: Vec<_> = sides.filter(|triangle| triangle.normal.x.abs() < 0.97).collect();
    assert_eq!(sides.len(), 8, "two triangles on each of four sides");
    for side in sides {
        assert!(frame_error(side.normal) < 3e-7);
        let frame = tangent_frame(side.normal, &Reading::REFERENCE);
        let cells = 256;
        let mut sin_squared = 0.0;
        for i in 0..cells {
            for j in 0..cells {
                let middle = |k| (k as f32 + 0.5) / cells as f32;
                let direction = (frame * sample_hemisphere(middle(i), middle(j))).normalize();
                sin_squared += 1.0 - f64::from(direction.dot(side.normal)).powi(2);
            }
        }
        let mean = sin_squared / f64::from(cells * cells);
        assert!((mean - 0.5).abs() < 1e-4, "E[sin^2 theta] = {mean}");
    }
}

#[test]
fn three_draws_give_the_zero_vector() {
    let light = fixtures::light();
    let mut rand = draws(&[0.5, 0.5, 0.5, 0.5, 0.5, 0.75]);
    assert_eq!(light.generate_random_photon_ray(&mut rand).ray_direction(), Vec3::Z);
}

#[test]
fn squared_length_exactly_one() {
    let light = fixtures::light();
    let mut rand = draws(&[0.0, 0.5, 0.5]);
    assert_eq!(light.generate_random_photon_ray(&mut rand).ray_direction(), Vec3::NEG_X);
}

#[test]
fn squared_length_just_above_one() {
    let light = fixtures::light();
    let mut rand = draws(&[0.0, 0.5, 0.501, 0.5, 0.0, 0.5]);
    assert_eq!(light.generate_random_photon_ray(&mut rand).ray_direction(), Vec3::NEG_Y);
}

#[test]
fn u1_zero() {
    assert_eq!(sample_hemisphere(0.0, 0.3), Vec3::Z);
}

#[test]
fn u1_largest() {
    for u2 in [0.0, 0.25, 0.3, LARGEST_BELOW_ONE] {
        let direction = sample_hemisphere(LARGEST_BELOW_ONE, u2);
        assert!((direction.z - 2.44e-4).abs() < 1e-6 && direction.is_normalized(), "{direction}");
    }
}

/// How often the photon whose numbers are `numbers` scatters in a cube of `albedo`.
fn hits(albedo: f32, max_photon_bounces: i32, numbers: &[f32]) -> usize {
    let renderer = PhotonMappingRenderer { max_photon_bounces, ..closed_cube(albedo, 148, 1) };
    let mut rand = draws(numbers);
    let ray = Ray::new(Vec3::ZERO, Vec3::X);
    let mut path = vec![PathVertex::Light];
    renderer.trace_photon(
        &mut Vec::new(),
        &ray,
        Vec3::ONE,
        &mut path,
        max_photon_bounces,
        &mut rand,
    );
    path.len() - 1
}

#[test]
fn probability_of_reflection_zero() {
    assert_eq!(hits(0.0, 1000, &[0.0]), 1);
}

#[test]
fn probability_of_reflection_one() {
    let numbers = [LARGEST_BELOW_ONE, 0.3, 0.4].repeat(1001);
    assert_eq!(hits(1.0, 1000, &numbers), 1001);
}

#[test]
fn roulette_is_strict() {
    assert_eq!(hits(0.5, 1000, &[0.5]), 1);
    assert_eq!(hits(0.5, 1, &[f32::from_bits(0.5_f32.to_bits() - 1), 0.3, 0.4, 0.9]), 2);
}

#[test]
fn no_bounce_allowed() {
    let none = PhotonMappingRenderer { max_photon_bounces: 0, ..handout(148, 20_000) };
    assert!(list(&none).is_empty());
    assert!(!list(&handout(148, 20_000)).is_empty());
}

#[test]
fn one_bounce_allowed() {
    let one = PhotonMappingRenderer { max_photon_bounces: 1, ..handout(148, 20_000) };
    let first_bounces: Vec<_> =
        list(&handout(148, 20_000)).into_iter().filter(|record| record.bounce == 1).collect();
    assert_eq!(list(&one), first_bounces);
}

fn square(z: f32) -> [Triangle; 2] {
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let [a, b, c, d] = corners.map(|(x, y)| Vec3::new(x, y, z));
    [[a, b, c], [a, c, d]].map(|vertices| Triangle {
        vertices,
        normal: Vec3::Z,
        parent_mesh_object: 0,
        facet: 0,
    })
}

fn scene_of(triangles: Vec<Triangle>) -> photon_mapping::scene::Scene {
    photon_mapping::scene::Scene::new(Vec::new(), triangles, Vec::new())
}

/// The triangle that a ray from `from` towards `to` meets.
fn met(triangles: &[Triangle], from: Vec3, to: Vec3) -> Option<usize> {
    let mut state = IntersectionState::new();
    let ray = Ray::new(from, (to - from).normalize());
    scene_of(triangles.to_vec())
        .trace(&ray, Some(&mut state))
        .then_some(state.intersected_primitive)
}

#[test]
fn ray_through_a_diagonal() {
    let square = square(0.0);
    for k in -99..=99 {
        let on_diagonal = Vec3::new(k as f32 / 100.0, k as f32 / 100.0, 0.0);
        let straight = on_diagonal + Vec3::Z;
        assert_eq!(met(&square, straight, on_diagonal), Some(0), "both meet it, the first counts");
        for from in [Vec3::new(0.3, -0.7, 2.0), Vec3::new(-5.0, 0.1, 0.01)] {
            assert!(
                met(&square, from, on_diagonal).is_some(),
                "{from} to {on_diagonal} slips through"
            );
        }
    }
}

#[test]
fn ray_through_an_edge_or_a_vertex() {
    let near = square(0.0);
    for target in [Vec3::new(1.0, 0.3, 0.0), Vec3::new(1.0, 1.0, 0.0), Vec3::new(-1.0, -1.0, 0.0)] {
        let hit = met(&near, target + Vec3::Z, target);
        assert!(hit.is_some(), "the border belongs to the triangle");
    }
}

#[test]
fn ray_in_the_plane_of_a_triangle() {
    for from in [Vec3::new(-3.0, 0.2, 0.0), Vec3::new(0.5, 0.2, 0.0)] {
        assert_eq!(met(&square(0.0), from, from + Vec3::new(1.0, 0.1, 0.0)), None);
    }
}

#[test]
fn triangle_slightly_behind_the_start() {
    let start = Vec3::new(0.2, -0.3, 1e-7);
    assert_eq!(met(&square(0.0), start, start + Vec3::Z), None);
    assert_eq!(met(&square(0.0), start, start - Vec3::Z), Some(0));
}

/// Rounding may put a start behind a surface that it is on: where a wall meets the floor, a little below.
#[test]
fn triangle_behind_the_start_by_its_rounding() {
    let scene = scene_of(square(0.0).to_vec());
    let met = |height: f32, direction: Vec3, start_error: f32| {
        let mut ray = Ray::new(Vec3::new(0.2, -0.3, height), direction.normalize());
        ray.start_error = start_error;
        let mut state = IntersectionState::new();
        scene.trace(&ray, Some(&mut state)).then_some(state.intersection_t)
    };
    let (up, down) = (Vec3::new(0.3, 0.1, 1.0), Vec3::new(0.3, 0.1, -1.0));
    let t = met(-1e-7, down, 1e-6).expect("the floor is not left through its face");
    assert!(t < 0.0 && t > -2e-7, "{t}");
    assert_eq!(met(0.0, down, 1e-6), Some(0.0));
    assert_eq!(met(-1e-7, up, 1e-6), None, "and its back is not met from so near");
    assert!(met(-1e-5, up, 1e-6).is_some());
    assert_eq!(met(-1e-5, down, 1e-6), None);
    for height in [0.0, -1e-7] {
        assert_eq!(met(height, down, 0.0), None, "no error, no mercy");
    }
}

/// A sheet seen from behind hides what lies close behind it and faces the ray.
#[test]
fn back_hides_a_front_close_behind_it() {
    for gap in [1e-6, 1e-5, 3e-5, 1e-4] {
        let other = square(gap).map(|triangle| Triangle { normal: Vec3::NEG_Z, ..triangle });
        let sheets = [square(0.0), other].concat();
        for target in [Vec3::ZERO, Vec3::new(0.3, -0.2, 0.0), Vec3::new(0.99, 0.99, 0.0)] {
            let met = met(&sheets, target - Vec3::Z, target).expect("it is met");
            assert!(met < 2, "{gap}: {met}");
        }
    }
    let [a, b] = square(0.0);
    let turned = [a, b].map(|triangle| Triangle { normal: Vec3::NEG_Z, ..triangle });
    // Two sheets in one place that look opposite ways are one with two sides.
    for (sheets, from_above) in
        [([a, b, turned[0], turned[1]], 0), ([turned[0], turned[1], a, b], 2)]
    {
        let target = Vec3::new(0.3, -0.2, 0.0);
        assert_eq!(met(&sheets, target + Vec3::Z, target), Some(from_above));
        assert_eq!(met(&sheets, target - Vec3::Z, target), Some(2 - from_above));
    }
    // As where a box stands on a floor.
    let bottom = square(0.0).map(|triangle| Triangle {
        vertices: triangle.vertices.map(|corner| 0.4 * corner),
        normal: Vec3::NEG_Z,
        ..triangle
    });
    let sheets = [square(0.0), bottom].concat();
    for k in 0..1000 {
        let target = Vec3::new(0.3, 1e-4 * k as f32, 0.0);
        let from = Vec3::new(0.1, -0.2, -0.7);
        assert!(met(&sheets, from, target).is_some_and(|met| met >= 2), "{target}");
    }
}

/// At an edge of a box that stands out against what lies behind it, a ray enters and leaves at once: it
/// meets the face that looks at it.
#[test]
fn edge_of_a_box_is_met_from_the_front() {
    let scene = handout(148, 1).stored_scene;
    let boxes = scene.triangles().iter().filter(|triangle| triangle.parent_mesh_object < 2);
    let boxes: Vec<_> = boxes.collect();
    let mut from_behind = 0;
    for k in 0..1_000_000_u64 {
        let mut rand = photon_mapping::random::photon_random(98, k);
        let Triangle { vertices, .. } = boxes[k as usize % boxes.len()];
        let corner = (rand() * 3.0) as usize;
        let target = vertices[corner].lerp(vertices[(corner + 1) % 3], rand());
        let from = Vec3::new(1.6 * rand() - 0.8, 1.6 * rand() - 0.8, 1.4 + 0.3 * rand());
        let direction = (target - from).normalize();
        let mut state = IntersectionState::new();
        // Beside a box, a ray may leave through the open front.
        if !scene.trace(&Ray::new(from, direction), Some(&mut state)) {
            continue;
        }
        // A face seen so much from the side may look either way by the rounding of its corners.
        from_behind += u32::from(direction.dot(state.compute_normal(&scene)) > 1e-5);
    }
    assert_eq!(from_behind, 0);
}

#[test]
fn duplicated_triangles_count_once() {
    let [a, b] = square(0.0);
    let from = Vec3::new(0.4, 0.1, 1.0);
    let single = met(&[a, b], from, Vec3::ZERO);
    assert_eq!(met(&[a, b, a, b], from, Vec3::ZERO), single);
}

#[test]
fn sliver_triangles() {
    let sliver = Triangle {
        vertices: [Vec3::ZERO, Vec3::X, Vec3::new(0.5, 1e-6, 0.0)],
        normal: Vec3::Z,
        parent_mesh_object: 0,
        facet: 0,
    };
    let inside = Vec3::new(0.5, 5e-7, 0.0);
    assert_eq!(met(&[sliver], inside + Vec3::Z, inside), Some(0));
    let beside = Vec3::new(0.5, 2e-6, 0.0);
    assert_eq!(met(&[sliver], beside + Vec3::Z, beside), None);
    let ray = Ray::new(inside + 1e-6 * Vec3::Z, Vec3::X);
    assert!(sliver.intersect(&ShearedRay::new(&ray)).is_none(), "parallel to it");
}

/// The model with these lines, or what is wrong with it.
fn model(lines: &str, response: &str) -> Result<Model, String> {
    let text = format!("mtllib materials\nusemtl grey\n{lines}");
    let materials = format!("newmtl grey\nKd {response}\n");
    obj::parse(&text, |_| Ok(materials.clone())).map_err(|error| error.to_string())
}

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\n";

#[test]
fn degenerate_triangles_are_skipped() {
    let faces = "f 1 2 4\nf 1 2 3\nf 1 1 4\nf 2 3 4\nf 4 4 4\n";
    let facets = |model: Model| model.triangles.iter().map(|t| t.facet).collect::<Vec<_>>();
    // Those that remain keep their numbers.
    assert_eq!(model(&format!("{CORNERS}{faces}"), "0.5 0.5 0.5").map(facets), Ok(vec![0, 3]));
    // Of a quad with three corners in a line, one half is left.
    assert_eq!(model(&format!("{CORNERS}f 1 2 3 4\n"), "0.5 0.5 0.5").map(facets), Ok(vec![0]));
}

#[test]
fn normal_of_the_file_off_its_plane_only_chooses_the_side() {
    let normal = |vn: &str| {
        let text = format!("{CORNERS}vn {vn}\nf 1//1 2//1 4//1\n");
        model(&text, "0.5 0.5 0.5").map(|model| model.triangles[0].normal)
    };
    // The model has y up, so its z is the scene's -y.
    assert_eq!(normal("1 0 1"), Ok(Vec3::NEG_Y));
    assert_eq!(normal("1 0 -1"), Ok(Vec3::Y));
    // As in the handout's file, whose normals have five digits.
    for side in [1.0, -1.0] {
        let as_written = Vec3::new(0.0002, -side, 0.0).normalize();
        let of_file = normal(&format!("0.0002 0 {side}")).unwrap();
        assert!(of_file.x != 0.0 && of_file.distance(as_written) < 1e-6, "{of_file}");
    }
}

#[test]
fn degenerate_triangles_alone_are_refused() {
    let error = model(&format!("{CORNERS}f 1 2 3\nf 1 1 4\n"), "0.5 0.5 0.5").unwrap_err();
    assert!(error.contains(":8:") && error.contains("only degenerate ones (2)"), "{error}");
}

#[test]
fn not_a_number_infinite_or_1e38_is_refused() {
    for wrong in ["nan", "NaN", "inf", "-inf", "infinity", "1e38", "-1e38", "1e999"] {
        for (line, lines) in [
            (3, format!("v {wrong} 0 0")),
            (4, format!("\nv 0 0 {wrong}")),
            (3, format!("vn 0 {wrong} 0")),
        ] {
            let error = model(&lines, "0.5 0.5 0.5").unwrap_err();
            let place = format!("model:{line}: ");
            assert!(error.starts_with(&place) && error.contains(&format!("'{wrong}'")), "{error}");
        }
        let error = model(CORNERS, &format!("0.5 {wrong} 0.5")).unwrap_err();
        assert!(error.starts_with("materials:2: ") && error.contains(wrong), "{error}");
    }
}

/// Whether `point`, in world space, lies in the footprint of one of the boxes, deeper than `margin`.
fn in_a_footprint(point: DVec3, margin: f64) -> bool {
    let short = [(0.53, -0.75), (0.70, -0.17), (0.13, 0.0), (-0.05, -0.57)];
    let tall = [(-0.53, -0.09), (0.04, 0.09), (-0.14, 0.67), (-0.71, 0.49)];
    [short, tall].iter().any(|corners| {
        (0..4).all(|k| {
            let (ax, ay) = corners[k];
            let (bx, by) = corners[(k + 1) % 4];
            let (dx, dy) = (bx - ax, by - ay);
            let inward = dx * (point.y - ay) - dy * (point.x - ax);
            inward / f64::hypot(dx, dy) > margin
        })
    })
}

/// Photons that start within 1e-4 of the edge at which the short box's front meets the floor, half
/// of them on the box and half on the floor, in all directions of the hemisphere. Every other pair starts
/// within twice the rounding of a point, so that half of those lie on the wrong side of the edge: there
/// directions along the other surface are left out, which no rule could decide.
#[test]
fn scattered_where_a_box_meets_the_floor() {
    let scene = handout(148, 1).stored_scene;
    let front = Vec3::new(-0.2964, -0.9551, 0.0).normalize();
    let (a, b) = (Vec3::new(0.53, -0.75, 0.0), Vec3::new(-0.05, -0.57, 0.0));
    let mut on_floor = 0;
    for k in 0..400_000_u32 {
        let mut rand = photon_mapping::random::photon_random(99, u64::from(k));
        let edge = a.lerp(b, rand());
        let is_rounded = k % 4 < 2;
        let away = if is_rounded { 2e-7 * (2.0 * rand() - 1.0) } else { 1e-4 * rand() };
        let on_box = k % 2 == 0;
        let (normal, other) = if on_box { (front, Vec3::Z) } else { (Vec3::Z, front) };
        let point = edge + away * other;
        let frame = tangent_frame(normal, &Reading::REFERENCE);
        let direction = (frame * sample_hemisphere(rand(), rand())).normalize();
        if is_rounded && direction.dot(other).abs() < 0.05 {
            continue;
        }
        let start = Reading::REFERENCE.offset.start(point, normal, direction, LARGE_EPSILON);
        let mut ray = Ray::new(start, direction);
        ray.start_error = Reading::REFERENCE.offset.start_error(LARGE_EPSILON);
        let mut state = IntersectionState::new();
        let is_met = scene.trace(&ray, Some(&mut state));
        let may_miss = !is_rounded || direction.dot(other) > 0.0;
        assert!(is_met || may_miss, "{point} towards {direction} slips through");
        if is_met {
            let hit = state.intersection_point();
            assert!(direction.dot(state.compute_normal(&scene)) < 0.0, "{point} to {hit}");
            if scene.mesh_objects()[state.primitive(&scene).parent_mesh_object].name == "floor" {
                on_floor += 1;
                assert!(!in_a_footprint(hit.as_dvec3(), 1e-6), "{point} to {hit}");
            }
        }
    }
    assert!(on_floor > 50_000, "only {on_floor} came to the floor");
}

#[test]
fn footprints_stay_empty() {
    let list = list(&handout(148, 1_000_000));
    let floor = list.iter().filter(|record| record.surface == 3);
    assert!(floor.clone().count() > 9_000);
    let inside = floor.filter(|record| in_a_footprint(record.position.as_dvec3(), 1e-6)).count();
    assert_eq!(inside, 0);
}
