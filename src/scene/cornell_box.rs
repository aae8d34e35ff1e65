//! The model of the assignment: a Cornell box without its back wall, left wall and ceiling.
//!
//! The Cornell box model is by Guedis Cardenas and Morgan McGuire, Williams College 2011, licensed
//! CC BY 3.0 (<https://creativecommons.org/licenses/by/3.0/>), reduced here to four objects.

use glam::Vec3;

use super::triangle::Triangle;
use super::{Material, MeshObject};

/// A quad in the model's axes, y up: four corners, and the normal of the model file with its four
/// decimals.
type Quad = ([[f32; 3]; 4], [f32; 3]);

const WHITE: Vec3 = Vec3::new(0.725, 0.71, 0.68);
const GREEN: Vec3 = Vec3::new(0.14, 0.45, 0.091);

#[rustfmt::skip]
const SHORT_BOX: [Quad; 5] = [
    ([[0.53, 0.60, 0.75], [0.70, 0.60, 0.17], [0.13, 0.60, 0.00], [-0.05, 0.60, 0.57]],
     [0.0, 1.0, 0.0]),
    ([[-0.05, 0.0, 0.57], [-0.05, 0.60, 0.57], [0.13, 0.60, 0.00], [0.13, 0.0, 0.00]],
     [-0.9536, 0.0, -0.3011]),
    ([[0.53, 0.0, 0.75], [0.53, 0.60, 0.75], [-0.05, 0.60, 0.57], [-0.05, 0.0, 0.57]],
     [-0.2964, 0.0, 0.9551]),
    ([[0.13, 0.0, 0.00], [0.13, 0.60, 0.00], [0.70, 0.60, 0.17], [0.70, 0.0, 0.17]],
     [0.2858, 0.0, -0.9583]),
    ([[0.70, 0.0, 0.17], [0.70, 0.60, 0.17], [0.53, 0.60, 0.75], [0.53, 0.0, 0.75]],
     [0.9596, 0.0, 0.2813]),
];

#[rustfmt::skip]
const RIGHT_WALL: [Quad; 1] = [
    ([[1.00, 0.0, -1.04], [1.00, 0.0, 0.99], [1.00, 1.99, 0.99], [1.00, 1.99, -1.04]],
     [-1.0, 0.0, 0.0]),
];

#[rustfmt::skip]
const TALL_BOX: [Quad; 5] = [
    ([[-0.53, 1.20, 0.09], [0.04, 1.20, -0.09], [-0.14, 1.20, -0.67], [-0.71, 1.20, -0.49]],
     [0.0, 1.0, 0.0]),
    ([[-0.53, 0.0, 0.09], [-0.53, 1.20, 0.09], [-0.71, 1.20, -0.49], [-0.71, 0.0, -0.49]],
     [-0.9551, 0.0, 0.2964]),
    ([[-0.71, 0.0, -0.49], [-0.71, 1.20, -0.49], [-0.14, 1.20, -0.67], [-0.14, 0.0, -0.67]],
     [-0.3011, 0.0, -0.9536]),
    ([[-0.14, 0.0, -0.67], [-0.14, 1.20, -0.67], [0.04, 1.20, -0.09], [0.04, 0.0, -0.09]],
     [0.9551, 0.0, -0.2964]),
    ([[0.04, 0.0, -0.09], [0.04, 1.20, -0.09], [-0.53, 1.20, 0.09], [-0.53, 0.0, 0.09]],
     [0.3011, 0.0, 0.9536]),
];

#[rustfmt::skip]
const FLOOR: [Quad; 1] = [
    ([[-1.01, 0.0, 0.99], [1.00, 0.0, 0.99], [1.00, 0.0, -1.04], [-0.99, 0.0, -1.04]],
     [0.0, 1.0, 0.0]),
];

/// The four mesh objects and their 24 triangles, in world space.
pub fn load() -> (Vec<MeshObject>, Vec<Triangle>) {
    let model: [(&str, Vec3, &[Quad]); 4] = [
        ("shortBox", WHITE, &SHORT_BOX),
        ("rightWall", GREEN, &RIGHT_WALL),
        ("tallBox", WHITE, &TALL_BOX),
        ("floor", WHITE, &FLOOR),
    ];
    let mut mesh_objects = Vec::new();
    let mut triangles = Vec::new();
    for (name, diffuse, quads) in model {
        let parent_mesh_object = mesh_objects.len();
        mesh_objects.push(MeshObject { name: name.to_owned(), material: Material::new(diffuse) });
        for (facet, (corners, normal)) in quads.iter().enumerate() {
            let [a, b, c, d] = corners.map(turn);
            let normal = turn(*normal).normalize();
            for vertices in [[a, b, c], [a, c, d]] {
                triangles.push(Triangle { vertices, normal, parent_mesh_object, facet });
            }
        }
    }
    (mesh_objects, triangles)
}

/// From y up to z up, as the framework turns the model: +90 degrees about x.
fn turn([x, y, z]: [f32; 3]) -> Vec3 {
    // A difference, because the negative of 0 would be -0.
    Vec3::new(x, 0.0 - z, y)
}
