//! The scenes of the plan, as lines for the harness.

use glam::Vec3;
use photon_mapping::assignment8;

use crate::plan::{COLORS, LIGHT, PlanStep};

/// The middle of walls and cubes.
pub(crate) const CENTER: Vec3 = Vec3::new(0.137, -0.211, 0.423);

/// Adds the scene of a step to `file`.
pub(crate) fn add_scene(step: PlanStep, file: &mut String) {
    line(file, "scene");
    match step {
        step if step.is_emission() => {
            line(file, &format!("light{}{}", vector_text(LIGHT), vector_text(Vec3::ONE)));
        }
        PlanStep::StoreFirst | PlanStep::StoreLater(_) | PlanStep::Black => {
            wall(file, Vec3::Z, Vec3::ZERO)
        }
        PlanStep::Remaining(_) | PlanStep::GrowPath => cubes(file, Vec3::ONE),
        PlanStep::GrayCube => cubes(file, Vec3::splat(0.5)),
        PlanStep::White | PlanStep::Around => wall(file, Vec3::Z, Vec3::ONE),
        PlanStep::Color(index) => wall(file, Vec3::Z, COLORS[index]),
        PlanStep::Threshold(_) | PlanStep::Floor => wall(file, Vec3::Z, Vec3::splat(0.5)),
        PlanStep::Wall(normal) => wall(file, normal, Vec3::splat(0.5)),
        PlanStep::Whole => handout(file),
        // A ray meets nothing there.
        _ => {}
    }
}

fn handout(file: &mut String) {
    let scene = assignment8::create_scene();
    let mut current = None;
    for triangle in scene.triangles() {
        if current != Some(triangle.parent_mesh_object) {
            current = Some(triangle.parent_mesh_object);
            let object = &scene.mesh_objects()[triangle.parent_mesh_object];
            let diffuse = object.material.base_diffuse_reflection();
            line(file, &format!("object {}{}", object.name, vector_text(diffuse)));
        }
        triangle_line(file, triangle.vertices, triangle.normal);
    }
    for light in scene.lights() {
        line(file, &format!("light{}{}", vector_text(light.position), vector_text(light.color)));
    }
}

fn wall(file: &mut String, normal: Vec3, diffuse: Vec3) {
    line(file, &format!("object wall{}", vector_text(diffuse)));
    square(file, CENTER, normal, 2.0);
}

/// A small cube within a closed one; photons fly between them. Those that scatter below the small
/// cube's surface fly within it, and are not lost either.
fn cubes(file: &mut String, diffuse: Vec3) {
    line(file, &format!("object cubes{}", vector_text(diffuse)));
    for (half, outward) in [(0.5, 1.0), (1.0, -1.0)] {
        for normal in [Vec3::X, Vec3::Y, Vec3::Z].into_iter().flat_map(|axis| [axis, -axis]) {
            square(file, CENTER + half * outward * normal, normal, half);
        }
    }
}

/// A square around `center` with edges of twice `half`.
fn square(file: &mut String, center: Vec3, normal: Vec3, half: f32) {
    let across = half * square_axis(normal);
    let along = normal.cross(across);
    let corners = [-across - along, across - along, across + along, along - across]
        .map(|corner| center + corner);
    triangle_line(file, [corners[0], corners[1], corners[2]], normal);
    triangle_line(file, [corners[0], corners[2], corners[3]], normal);
}

/// A unit vector in the plane; along an axis where the normal is, so that the sides of a cube meet.
fn square_axis(normal: Vec3) -> Vec3 {
    match normal.abs().max_position() {
        _ if normal.abs().max_element() < 1.0 => normal.any_orthonormal_vector(),
        0 => Vec3::Y,
        1 => Vec3::Z,
        _ => Vec3::X,
    }
}

fn triangle_line(file: &mut String, corners: [Vec3; 3], normal: Vec3) {
    let [a, b, c] = corners.map(vector_text);
    line(file, &format!("triangle{a}{b}{c}{}", vector_text(normal)));
}

/// Floats have as many digits as bring back the same bits.
pub(crate) fn vector_text(v: Vec3) -> String {
    format!(" {} {} {}", v.x, v.y, v.z)
}

pub(crate) fn line(file: &mut String, text: &str) {
    file.push_str(text);
    file.push('\n');
}
