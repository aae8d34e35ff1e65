//! Judges in f64 whether a path is possible in this scene.

use glam::DVec3;

use super::hits::surface_hits;
use model::facets::{Footprint, facet_of_triangles, plane_normal};
use photon_mapping::rendering::photon_mapping_renderer::PathVertex;
use photon_mapping::scene::Scene;

/// What the judged paths did.
#[derive(Clone, Copy, Debug, Default)]
pub struct HitVerdict {
    /// Hits on the plane that the photon had just left.
    pub self_hits: u64,
    /// Hits from behind a surface, and hits on the floor within the footprint of a box.
    pub leaks: u64,
    /// Photons stored before anything impossible happened on their path.
    pub sound: u64,
}

/// What a judge has to know of a scene made like the handout's.
pub struct HitJudge {
    facets: Vec<usize>,
    /// The plane normals of the triangles, to the side of the model's normal.
    normals: Vec<DVec3>,
    floor: usize,
    footprints: [Footprint; 2],
}

impl HitJudge {
    /// A judge of paths in `scene`: the handout's, scaled or moved.
    pub fn new(scene: &Scene) -> Self {
        let surface = |name: &str| {
            let mut mesh_objects = scene.mesh_objects().iter();
            mesh_objects.position(|mesh| mesh.name == name).expect("the handout's surfaces")
        };
        Self {
            facets: facet_of_triangles(scene),
            normals: scene.triangles().iter().map(plane_normal).collect(),
            floor: surface("floor"),
            footprints: ["shortBox", "tallBox"].map(|name| Footprint::of_box(scene, surface(name))),
        }
    }

    /// Adds what `path` did to `verdict`, up to its first impossible hit. What follows from that
    /// hit means nothing.
    pub fn look(&self, scene: &Scene, path: &[PathVertex], verdict: &mut HitVerdict) {
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
            if is_behind
                || is_on_floor && self.footprints.iter().any(|footprint| footprint.holds(point))
            {
                verdict.leaks += 1;
                return;
            }
            verdict.sound += u64::from(number > 0);
        }
    }
}
