//! Scenes the tests share.

use super::{Emitter, Facet};
use glam::DVec3;

pub const SHORT_BOX: usize = 0;
pub const RIGHT_WALL: usize = 1;
pub const TALL_BOX: usize = 2;
pub const FLOOR: usize = 3;

/// The handout's scene: corners in model axes, a point inside the box (or behind the wall, or below
/// the floor) that the normals point away from.
pub fn handout() -> (Vec<Facet>, Vec<Emitter>) {
    let short = [0.325, 0.3, 0.375];
    let tall = [-0.335, 0.6, -0.29];
    let quads: [(usize, [f64; 3], [[f64; 3]; 4]); 12] = [
        (
            SHORT_BOX,
            short,
            [[0.53, 0.6, 0.75], [0.7, 0.6, 0.17], [0.13, 0.6, 0.0], [-0.05, 0.6, 0.57]],
        ),
        (
            SHORT_BOX,
            short,
            [[-0.05, 0.0, 0.57], [-0.05, 0.6, 0.57], [0.13, 0.6, 0.0], [0.13, 0.0, 0.0]],
        ),
        (
            SHORT_BOX,
            short,
            [[0.53, 0.0, 0.75], [0.53, 0.6, 0.75], [-0.05, 0.6, 0.57], [-0.05, 0.0, 0.57]],
        ),
        (
            SHORT_BOX,
            short,
            [[0.13, 0.0, 0.0], [0.13, 0.6, 0.0], [0.7, 0.6, 0.17], [0.7, 0.0, 0.17]],
        ),
        (
            SHORT_BOX,
            short,
            [[0.7, 0.0, 0.17], [0.7, 0.6, 0.17], [0.53, 0.6, 0.75], [0.53, 0.0, 0.75]],
        ),
        (
            RIGHT_WALL,
            [2.0, 1.0, 0.0],
            [[1.0, 0.0, -1.04], [1.0, 0.0, 0.99], [1.0, 1.99, 0.99], [1.0, 1.99, -1.04]],
        ),
        (
            TALL_BOX,
            tall,
            [[-0.53, 1.2, 0.09], [0.04, 1.2, -0.09], [-0.14, 1.2, -0.67], [-0.71, 1.2, -0.49]],
        ),
        (
            TALL_BOX,
            tall,
            [[-0.53, 0.0, 0.09], [-0.53, 1.2, 0.09], [-0.71, 1.2, -0.49], [-0.71, 0.0, -0.49]],
        ),
        (
            TALL_BOX,
            tall,
            [[-0.71, 0.0, -0.49], [-0.71, 1.2, -0.49], [-0.14, 1.2, -0.67], [-0.14, 0.0, -0.67]],
        ),
        (
            TALL_BOX,
            tall,
            [[-0.14, 0.0, -0.67], [-0.14, 1.2, -0.67], [0.04, 1.2, -0.09], [0.04, 0.0, -0.09]],
        ),
        (
            TALL_BOX,
            tall,
            [[0.04, 0.0, -0.09], [0.04, 1.2, -0.09], [-0.53, 1.2, 0.09], [-0.53, 0.0, 0.09]],
        ),
        (
            FLOOR,
            [0.0, -1.0, 0.0],
            [[-1.01, 0.0, 0.99], [1.0, 0.0, 0.99], [1.0, 0.0, -1.04], [-0.99, 0.0, -1.04]],
        ),
    ];
    let facets = quads
        .into_iter()
        .map(|(surface, behind, corners)| {
            let survival = if surface == RIGHT_WALL { 0.45 } else { 0.725 };
            facet(surface, corners.map(to_world).to_vec(), to_world(behind), survival)
        })
        .collect();
    (facets, vec![Emitter { position: DVec3::new(0.01909, 0.0101, 1.77640), share: 1.0 }])
}

/// Cube of side 2 about the origin, normals inward, one surface a face.
pub fn cube(survival: f64) -> Vec<Facet> {
    [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z]
        .into_iter()
        .enumerate()
        .map(|(surface, out)| {
            let (u, v) = (DVec3::new(out.y, out.z, out.x), DVec3::new(out.z, out.x, out.y));
            facet(
                surface,
                vec![out - u - v, out + u - v, out + u + v, out - u + v],
                2.0 * out,
                survival,
            )
        })
        .collect()
}

/// A facet whose normal side is away from `behind`; the normal itself is left rough.
pub fn facet(surface: usize, vertices: Vec<DVec3>, behind: DVec3, survival: f64) -> Facet {
    let normal = vertices.iter().sum::<DVec3>() / vertices.len() as f64 - behind;
    Facet { surface, vertices, normal, survival }
}

fn to_world([x, y, z]: [f64; 3]) -> DVec3 {
    DVec3::new(x, -z, y)
}
