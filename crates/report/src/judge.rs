//! Whether a path is possible: judged in f64, by what no photon in this scene can do.

use glam::{DVec2, DVec3};

use super::hits::surface_hits;
use model::facets::facet_of_triangles;
use photon_mapping::rendering::photon_mapping_renderer::PathVertex;
use photon_mapping::scene::Scene;

/// What the paths that were looked at did.
#[derive(Clone, Copy, Debug, Default)]
pub struct Verdict {
    /// Hits on the plane that the photon had just left.
    pub self_hits: u64,
    /// Hits from behind a surface, and hits on the floor within the footprint of a box.
    pub leaks: u64,
    /// Photons stored before anything impossible happened on their path.
    pub sound: u64,
}

/// What a judge has to know of a scene made like the handout's.
pub struct Judge {
    facets: Vec<usize>,
    /// The plane normals of the triangles, to the side of the model's normal.
    normals: Vec<DVec3>,
    floor: usize,
    /// Corners of the boxes seen from above, a little within their edges.
    footprints: Vec<Vec<DVec2>>,
}

impl Judge {
    /// A judge of paths in `scene`: the handout's, scaled or moved.
    pub fn new(scene: &Scene) -> Self {
        let normals = scene.triangles().iter().map(|triangle| {
            let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
            let normal = (b - a).cross(c - a).normalize();
            normal * normal.dot(triangle.normal.as_dvec3()).signum()
        });
        let surface = |name: &str| {
            let mut mesh_objects = scene.mesh_objects().iter();
            mesh_objects.position(|mesh| mesh.name == name).expect("the handout's surfaces")
        };
        let footprint = |name: &str| {
            let number = surface(name);
            let mut top = scene
                .triangles()
                .iter()
                .filter(|triangle| (triangle.parent_mesh_object, triangle.facet) == (number, 0));
            let first = top.next().expect("a box has a top").vertices;
            let corners = first.into_iter().chain(top.map(|triangle| triangle.vertices[2]));
            shrink(&corners.map(|corner| corner.as_dvec3().truncate()).collect::<Vec<_>>())
        };
        Self {
            facets: facet_of_triangles(scene),
            normals: normals.collect(),
            floor: surface("floor"),
            footprints: vec![footprint("shortBox"), footprint("tallBox")],
        }
    }

    /// Adds what `path` did to `verdict`. After the first impossible hit the path is not followed:
    /// what comes of it says nothing more.
    pub fn look(&self, scene: &Scene, path: &[PathVertex], verdict: &mut Verdict) {
        let mut left = None;
        for (number, hit) in surface_hits(path).enumerate() {
            let triangle = hit.intersected_primitive;
            if left == Some(self.facets[triangle]) {
                verdict.self_hits += 1;
                return;
            }
            left = Some(self.facets[triangle]);
            let direction = hit.intersection_ray.ray_direction().as_dvec3();
            let is_behind = direction.dot(self.normals[triangle]) >= 0.0;
            let is_on_floor = scene.triangles()[triangle].parent_mesh_object == self.floor;
            let point = hit.intersection_point().as_dvec3().truncate();
            if is_behind || is_on_floor && self.footprints.iter().any(|box_| contains(box_, point))
            {
                verdict.leaks += 1;
                return;
            }
            verdict.sound += u64::from(number > 0);
        }
    }
}

/// `corners` drawn to their middle by what rounding may do to a point: 1e-5 of the size, and four
/// units in the last place of the largest coordinate.
fn shrink(corners: &[DVec2]) -> Vec<DVec2> {
    let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
    let largest = corners.iter().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
    let inward = |corner: &DVec2| {
        let length = corner.distance(middle);
        let margin = 1e-5 * length + 8.0 * f64::from(f32::EPSILON) * largest;
        *corner + (middle - *corner) * (margin / length).min(1.0)
    };
    corners.iter().map(inward).collect()
}

fn contains(polygon: &[DVec2], point: DVec2) -> bool {
    let side = |k: usize| {
        let (a, b) = (polygon[k], polygon[(k + 1) % polygon.len()]);
        (b - a).perp_dot(point - a)
    };
    let first = side(0);
    (1..polygon.len()).all(|k| side(k) * first > 0.0)
}
