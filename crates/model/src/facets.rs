//! The flat faces of a scene: a quad of the model is one facet of two triangles.
//!
//! Everything here is in the space in which the scene is traced.

use glam::{DVec2, DVec3};
use photon_mapping::scene::Scene;
use photon_mapping::scene::triangle::Triangle;

/// The facets of `scene`, each as its triangles, in the model's order.
pub fn facets(scene: &Scene) -> impl Iterator<Item = &[Triangle]> {
    scene.triangles().chunk_by(|a, b| facet_of(a) == facet_of(b))
}

/// The index of the facet, in the order of [`facets`], of every triangle of `scene`.
pub fn facet_of_triangles(scene: &Scene) -> Vec<usize> {
    let facets = facets(scene).enumerate();
    facets.flat_map(|(index, triangles)| vec![index; triangles.len()]).collect()
}

fn facet_of(triangle: &Triangle) -> (usize, usize) {
    (triangle.parent_mesh_object, triangle.facet)
}

/// The unit normal of the plane of `triangle`, to the side of the model's normal: some quads of the
/// handout's model wind against theirs.
pub fn plane_normal(triangle: &Triangle) -> DVec3 {
    let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
    let normal = (b - a).cross(c - a).normalize();
    normal * normal.dot(triangle.normal.as_dvec3()).signum()
}

/// What a box of the handout covers of the floor.
#[derive(Clone, Debug)]
pub struct Footprint {
    /// Counterclockwise from above.
    corners: Vec<DVec2>,
    /// No rounding brings a photon this deep inside.
    margin: f64,
}

impl Footprint {
    /// The footprint of the mesh object `surface` of `scene`, a box whose first facet is its top.
    pub fn of_box(scene: &Scene, surface: usize) -> Self {
        let is_top = |t: &&Triangle| (t.parent_mesh_object, t.facet) == (surface, 0);
        let top: Vec<_> = scene.triangles().iter().filter(is_top).collect();
        let corners = top[0].vertices.iter().chain([&top[1].vertices[2]]);
        let mut corners: Vec<_> = corners.map(|corner| corner.as_dvec3().truncate()).collect();
        if (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) < 0.0 {
            corners.reverse();
        }
        let largest = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
        let size = corners[0].distance(corners[2]);
        Self { margin: 1e-6 * size + 8.0 * f64::from(f32::EPSILON) * largest, corners }
    }

    /// Whether a photon on the floor at `point` lies under the box.
    pub fn holds(&self, point: DVec2) -> bool {
        let depth = |k: usize| {
            let (a, b) = (self.corners[k], self.corners[(k + 1) % self.corners.len()]);
            (b - a).normalize().perp_dot(point - a)
        };
        (0..self.corners.len()).all(|k| depth(k) > self.margin)
    }
}
