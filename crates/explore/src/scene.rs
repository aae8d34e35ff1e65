//! A run's scene as the page draws it.

use std::collections::BTreeSet;

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
    pub probability_of_reflection: f32,
    pub diffuse_response: [f32; 3],
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
    #[serde(skip)]
    pub triangles: Vec<[[f32; 3]; 3]>,
}

pub fn surfaces(scene: &Scene) -> Vec<PageSurface> {
    let surface = |name: &str, diffuse: Vec3| PageSurface {
        name: name.to_owned(),
        probability_of_reflection: diffuse.max_element(),
        diffuse_response: diffuse.to_array(),
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
                    .map(|it| it.vertices.map(|corner| run.placement.to_world(corner).to_array()))
                    .collect(),
            }
        })
        .collect();
    faces.sort_by_key(|face| (face.surface, face.facet));
    faces
}

/// The outlines of `faces`: the edges of a face's triangles that no other of them has.
pub fn edges(faces: &[PageFace]) -> Vec<[[f32; 3]; 2]> {
    let outline = |face: &PageFace| {
        let mut edges = BTreeSet::new();
        for corners in &face.triangles {
            let [a, b, c] = corners.map(|corner| corner.map(f32::to_bits));
            for [from, to] in [[a, b], [b, c], [c, a]] {
                let edge = [from.min(to), from.max(to)];
                if !edges.remove(&edge) {
                    edges.insert(edge);
                }
            }
        }
        edges.into_iter().map(|edge| edge.map(|end| end.map(f32::from_bits)))
    };
    faces.iter().flat_map(outline).collect()
}

/// The camera of the button, that with which the page opens, and that of the picture: the
/// handout's. A camera has the point it turns around, the distance, the direction in radians, half
/// the height of its picture at distance 1, and the size of the scene.
pub fn cameras(is_handout: bool, faces: &[PageFace], size: f32) -> [Value; 3] {
    let handout = assignment8::create_camera(assignment8::WIDTH, assignment8::HEIGHT);
    let camera = |target: Vec3, distance: f32, yaw: f32, pitch: f32| {
        json!({
            "target": target.to_array(), "distance": distance, "yaw": yaw, "pitch": pitch,
            "halfHeight": handout.half_height, "size": size,
        })
    };
    // It turns around the point before it that is nearest to the middle of the box.
    let distance = -handout.position.dot(handout.forward);
    let target = handout.position + distance * handout.forward;
    let picture = camera(target, distance, 0.0, 0.0);
    if is_handout {
        // From a little farther off, the light is in sight.
        let first = camera(target + 0.2 * Vec3::Z, 1.3 * distance, 0.3, -0.16);
        return [picture.clone(), first, picture];
    }
    let corners = || {
        let corners = faces.iter().flat_map(|face| face.triangles.as_flattened());
        corners.map(|corner| Vec3::from_array(*corner))
    };
    let low = corners().fold(Vec3::INFINITY, Vec3::min);
    let high = corners().fold(Vec3::NEG_INFINITY, Vec3::max);
    let whole = camera((low + high) / 2.0, 2.8 * size, 0.5, -0.35);
    [whole.clone(), whole, picture]
}
