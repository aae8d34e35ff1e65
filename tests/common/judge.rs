//! Judges photons in f64, by what none can do in the handout's scene, wherever it stands.

use std::ops::Range;

use glam::{DVec2, DVec3};
use photon_mapping::lanes::LaneTracer;
use photon_mapping::lanes::width::Width;
use photon_mapping::photon_list::record::PhotonRecord;
use photon_mapping::rendering::photon_mapping_renderer::{PathVertex, PhotonMappingRenderer};
use photon_mapping::scene::Scene;
use photon_mapping::scene::triangle::Triangle;
use rayon::prelude::*;

/// What some photons did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judgement {
    /// Stored photons, by surface.
    pub stored: Vec<u64>,
    /// Hits on the face that the photon had just left.
    pub self_hits: u64,
    /// Hits from behind: every surface of the scene is closed or faces all others.
    pub leaks: u64,
    /// Photons on the floor inside the footprint of a box.
    pub under_boxes: u64,
}

impl Judgement {
    pub fn impossible(&self) -> [u64; 3] {
        [self.self_hits, self.leaks, self.under_boxes]
    }

    fn join(mut self, other: Self) -> Self {
        self.stored.resize(self.stored.len().max(other.stored.len()), 0);
        self.stored.iter_mut().zip(other.stored).for_each(|(sum, stored)| *sum += stored);
        self.self_hits += other.self_hits;
        self.leaks += other.leaks;
        self.under_boxes += other.under_boxes;
        self
    }
}

struct Plane {
    normal: DVec3,
    distance: f64,
    /// How far off the plane a rounded point may lie.
    tolerance: f64,
    surface: usize,
    facet: usize,
}

impl Plane {
    fn new(triangle: &Triangle) -> Self {
        let [a, b, c] = triangle.vertices.map(|vertex| vertex.as_dvec3());
        let normal = (b - a).cross(c - a).normalize();
        // Some quads of the model wind against their normal.
        let normal = normal * normal.dot(triangle.normal.as_dvec3()).signum();
        Self {
            normal,
            distance: normal.dot(a),
            tolerance: 1e-5 * (b - a).length() + 8.0 * f64::from(f32::EPSILON) * a.length(),
            surface: triangle.parent_mesh_object,
            facet: triangle.facet,
        }
    }

    fn holds(&self, point: DVec3) -> bool {
        let distance = self.normal.dot(point) - self.distance;
        distance.abs() < self.tolerance
    }
}

/// A judge of the photons of one renderer.
pub struct Judge {
    renderer: PhotonMappingRenderer,
    planes: Vec<Plane>,
    floor: usize,
    /// The boxes seen from above, their corners in order.
    footprints: Vec<Vec<DVec2>>,
    /// So deep inside a footprint no rounding has brought a photon.
    margin: f64,
}

impl Judge {
    /// A judge of `renderer`'s photons where they are traced: world coordinates would be rounded more.
    pub fn new(renderer: &PhotonMappingRenderer) -> Self {
        let scene = &renderer.stored_scene;
        let in_its_own_space = Scene::new(
            scene.mesh_objects().to_vec(),
            scene.triangles().to_vec(),
            scene.lights().to_vec(),
        );
        let surface =
            |name| scene.mesh_objects().iter().position(|mesh| mesh.name == name).unwrap();
        let footprints: Vec<_> =
            ["shortBox", "tallBox"].map(|name| footprint(scene, surface(name))).into();
        let corners = || footprints.iter().flatten();
        let largest = corners().map(|corner| corner.abs().max_element()).fold(0.0, f64::max);
        let size = footprints[0][0].distance(footprints[0][2]);
        Self {
            renderer: PhotonMappingRenderer { stored_scene: in_its_own_space, ..renderer.clone() },
            planes: scene.triangles().iter().map(Plane::new).collect(),
            floor: surface("floor"),
            margin: 1e-6 * size + 8.0 * f64::from(f32::EPSILON) * largest,
            footprints,
        }
    }

    /// Traces the photons numbered `photons` on the fast path and judges all that are stored.
    pub fn judge(&self, photons: Range<u64>) -> Judgement {
        const PIECE: usize = 65_536;
        let lanes = LaneTracer::new(&self.renderer, Width::widest()).expect("the scene is small");
        let piece = |start: u64| {
            let records = lanes.trace_piece(start..photons.end.min(start + PIECE as u64));
            self.judge_records(&records)
        };
        let starts: Vec<_> = photons.clone().step_by(PIECE).collect();
        let pieces: Vec<_> = starts.into_par_iter().map(piece).collect();
        pieces.into_iter().fold(Judgement::default(), Judgement::join)
    }

    /// Judges the photons numbered `photons` by their paths alone.
    pub fn judge_all_paths(&self, photons: Range<u64>) -> Judgement {
        let mut judgement = Judgement::default();
        photons.for_each(|photon| self.judge_path(photon, &mut judgement));
        judgement
    }

    /// A list does not tell a photon's first hit, which is not stored, nor the triangles of the others.
    /// So whatever may be wrong in it is traced again and judged by its path.
    fn judge_records(&self, records: &[PhotonRecord]) -> Judgement {
        let surfaces = self.renderer.stored_scene.mesh_objects().len();
        let mut judgement = Judgement { stored: vec![0; surfaces], ..Judgement::default() };
        for path in records.chunk_by(|a, b| a.photon == b.photon) {
            let mut left = None;
            let mut is_suspect = false;
            for record in path {
                judgement.stored[usize::from(record.surface)] += 1;
                let mut face = None;
                for plane in &self.planes {
                    if plane.surface == usize::from(record.surface)
                        && plane.holds(record.position.as_dvec3())
                    {
                        is_suspect |= plane.normal.dot(record.to_light.as_dvec3()) <= 0.0;
                        face = Some((plane.surface, plane.facet));
                    }
                }
                is_suspect |= face.is_none() || face == left;
                is_suspect |= usize::from(record.surface) == self.floor
                    && self.is_under_a_box(record.position.as_dvec3());
                left = face;
            }
            if is_suspect {
                self.judge_path(u64::from(path[0].photon), &mut judgement);
            }
        }
        judgement
    }

    fn judge_path(&self, photon: u64, judgement: &mut Judgement) {
        let mut photon_map = Vec::new();
        let one = photon..photon + 1;
        self.renderer.generic_photon_map_generation(&mut photon_map, one, |_, path, _| {
            let mut left = None;
            for vertex in &path[1..] {
                let PathVertex::Surface(state) = vertex else { unreachable!() };
                let plane = &self.planes[state.intersected_primitive];
                let face = Some((plane.surface, plane.facet));
                let direction = state.intersection_ray.ray_direction().as_dvec3();
                if face == left {
                    judgement.self_hits += 1;
                } else if plane.normal.dot(direction) >= 0.0 {
                    judgement.leaks += 1;
                } else if plane.surface == self.floor
                    && self.is_under_a_box(state.intersection_point().as_dvec3())
                {
                    judgement.under_boxes += 1;
                }
                left = face;
            }
        });
    }

    fn is_under_a_box(&self, point: DVec3) -> bool {
        self.footprints.iter().any(|corners| {
            let depth = |k: usize| {
                let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
                (b - a).normalize().perp_dot(point.truncate() - a)
            };
            (0..corners.len()).all(|k| depth(k) > self.margin)
        })
    }
}

/// The corners of the top of box `surface`, counterclockwise from above.
fn footprint(scene: &Scene, surface: usize) -> Vec<DVec2> {
    let is_top = |t: &&Triangle| (t.parent_mesh_object, t.facet) == (surface, 0);
    let top: Vec<_> = scene.triangles().iter().filter(is_top).collect();
    let corners = top[0].vertices.iter().chain([&top[1].vertices[2]]);
    let mut corners: Vec<_> = corners.map(|corner| corner.as_dvec3().truncate()).collect();
    if (corners[1] - corners[0]).perp_dot(corners[2] - corners[0]) < 0.0 {
        corners.reverse();
    }
    corners
}
