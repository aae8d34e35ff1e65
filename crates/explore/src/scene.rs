//! A run's scene as the page draws it.

use glam::Vec3;
use model::facets::facets;
use photon_mapping::assignment8;
use photon_mapping::scene::Scene;
use serde::Serialize;
use serde_json::{Value, json};
use variants::run::Run;

/// A mesh object.
#[derive(Debug, Serialize)]
pub struct PageSurface {
    pub name: String,
    /// P_r.
    pub survival: f32,
    pub diffuse: [f32; 3],
}

/// A face of a mesh object, with its frame, in world space.
#[derive(Debug, Serialize)]
pub struct PageFace {
    pub surface: usize,
    pub facet: usize,
    pub normal: [f32; 3],
    pub tangent: [f32; 3],
    pub bitangent: [f32; 3],
    /// The axis from which t was built.
    pub axis: [f32; 3],
    /// The length of n x axis.
    pub bare: f32,
    pub triangles: Vec<[f32; 9]>,
}

pub fn surfaces(scene: &Scene) -> Vec<PageSurface> {
    let surface = |name: &str, diffuse: Vec3| PageSurface {
        name: name.to_owned(),
        survival: diffuse.max_element(),
        diffuse: diffuse.to_array(),
    };
    let objects = scene.mesh_objects().iter();
    objects.map(|object| surface(&object.name, object.material.base_diffuse_reflection())).collect()
}

/// The faces in order of surface, then facet.
pub fn faces(run: &Run) -> Vec<PageFace> {
    let mut faces: Vec<PageFace> = facets(run.scene())
        .map(|group| {
            let normal = group[0].normal;
            let frame = run.reading.tangent_frame(normal);
            // t is at a right angle to the axis from which it was built.
            let is_built_from = |axis: Vec3| {
                let tangent = normal.cross(axis);
                tangent.length() > 0.0
                    && tangent.normalize().distance(frame.x_axis.normalize()) < 1e-3
            };
            let axis = [Vec3::X, Vec3::Y].into_iter().find(|axis| is_built_from(*axis));
            let axis = axis.unwrap_or(run.reading.fallback_axis);
            PageFace {
                surface: group[0].parent_mesh_object,
                facet: group[0].facet,
                normal: normal.to_array(),
                tangent: frame.x_axis.to_array(),
                bitangent: frame.y_axis.to_array(),
                axis: axis.to_array(),
                bare: normal.cross(axis).length(),
                triangles: group
                    .iter()
                    .map(|triangle| {
                        let corners =
                            triangle.vertices.map(|corner| run.placement.to_world(corner));
                        let mut numbers = [0.0; 9];
                        for (to, corner) in numbers.chunks_exact_mut(3).zip(corners) {
                            to.copy_from_slice(&corner.to_array());
                        }
                        numbers
                    })
                    .collect(),
            }
        })
        .collect();
    faces.sort_by_key(|face| (face.surface, face.facet));
    faces
}

/// The handout's camera, or one that sees all of another scene. It has the point it turns around,
/// the distance, the direction in radians, and half the height of its picture at distance 1.
pub fn camera(is_handout: bool, faces: &[PageFace], size: f32) -> Value {
    let camera = assignment8::create_camera(assignment8::WIDTH, assignment8::HEIGHT);
    let half_height = camera.half_height;
    if is_handout {
        // It turns around the point before it that is nearest to the middle of the box.
        let distance = -camera.position.dot(camera.forward);
        let target = (camera.position + distance * camera.forward).to_array();
        return json!({
            "target": target, "distance": distance, "yaw": 0.0, "pitch": 0.0,
            "halfHeight": half_height
        });
    }
    let corners = || {
        let triangles = faces.iter().flat_map(|face| &face.triangles);
        triangles.flat_map(|numbers| numbers.chunks_exact(3).map(Vec3::from_slice))
    };
    let low = corners().fold(Vec3::INFINITY, Vec3::min);
    let high = corners().fold(Vec3::NEG_INFINITY, Vec3::max);
    let target = ((low + high) / 2.0).to_array();
    json!({
        "target": target, "distance": 2.8 * size, "yaw": 0.5, "pitch": -0.35,
        "halfHeight": half_height
    })
}
