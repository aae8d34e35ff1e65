//! Where on the assignment's scene a photon lies: on which facet, and in which cell of it.

use glam::{DVec3, Vec3};

use super::limits::LEEWAY;
pub use super::limits::places::MARGIN;
use super::limits::places::{CELLS_OF_LARGE, CELLS_OF_SMALL, FAR_OFF, LARGE, PROBES};
use model::facets::Footprint;
use photon_mapping::scene::Scene;

/// Where a position lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// On a facet, in a cell of it, both counted over the scene.
    Cell {
        /// Which facet.
        facet: usize,
        /// Which cell.
        cell: usize,
    },
    /// So close to where two facets meet that it may belong to either.
    Corner {
        /// Which facet is closer.
        facet: usize,
    },
    /// On the floor where a box stands.
    Footprint,
    /// Not on any facet.
    OffSurface,
    /// Infinite, or not a number.
    NotFinite,
}

/// One facet: a quad, with the cells into which it is divided.
#[derive(Clone, Debug)]
pub struct FacetCells {
    /// Which mesh object of the scene it belongs to.
    pub surface: usize,
    /// Its corners, in world space.
    pub corners: [DVec3; 4],
    /// The unit normal of its plane, on the side of the model's normal.
    pub normal: DVec3,
    /// For each edge, which way leads out of the facet, in its plane.
    outward: [DVec3; 4],
    /// Into how many cells each side is divided.
    pub divisions: usize,
    /// The number of its first cell.
    pub first_cell: usize,
}

/// The facets of the scene.
#[derive(Clone, Debug)]
pub struct Places {
    /// In the model file's order.
    pub facets: Vec<FacetCells>,
    /// The names of the mesh objects.
    pub surfaces: Vec<String>,
    /// How many cells all facets have together.
    pub cells: usize,
    /// The facet of each.
    pub facet_of_cell: Vec<usize>,
    /// For each box that stands on a facet: that facet, and what it covers of it.
    footprints: Vec<(usize, Footprint)>,
}

impl FacetCells {
    /// How far `point` is in front of the facet's plane.
    pub fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.corners[0])
    }

    /// Where `point`, seen along the normal, lies between the facet's edges: each in [0, 1] on it.
    pub fn coordinates(&self, point: DVec3) -> [f64; 2] {
        // The facets are parallelograms but for the floor, whose shape is off by one part in a
        // hundred.
        let along = self.corners[1] - self.corners[0];
        let across = self.corners[3] - self.corners[0];
        let from = point - self.corners[0];
        let (aa, ac, cc) = (along.dot(along), along.dot(across), across.dot(across));
        let (fa, fc) = (from.dot(along), from.dot(across));
        let determinant = aa * cc - ac * ac;
        [(fa * cc - fc * ac) / determinant, (fc * aa - fa * ac) / determinant]
    }

    /// The distance from `point` to the facet.
    pub fn distance(&self, point: DVec3) -> f64 {
        let is_within = |(outward, a): (&DVec3, &DVec3)| outward.dot(point - *a) <= 0.0;
        if self.outward.iter().zip(&self.corners).all(is_within) {
            return self.height(point).abs();
        }
        let to_edge = |corner: usize| {
            let (a, b) = (self.corners[corner], self.corners[(corner + 1) % 4]);
            let along = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            point.distance(a + along * (b - a))
        };
        (0..4).map(to_edge).fold(f64::INFINITY, f64::min)
    }

    /// Which cell `point` is in.
    fn cell(&self, point: DVec3) -> usize {
        let step = |coordinate: f64| {
            let step = (coordinate * self.divisions as f64) as usize;
            step.min(self.divisions - 1)
        };
        let [u, v] = self.coordinates(point).map(step);
        self.first_cell + v * self.divisions + u
    }
}

impl Places {
    /// The facets of `scene`, all of which must be quads.
    pub fn new(scene: &Scene) -> Self {
        let world = |point: Vec3| point.as_dvec3();
        let mut facets: Vec<FacetCells> = Vec::new();
        let mut cells = 0;
        for triangles in model::facets::facets(scene) {
            let [first, second] = triangles else {
                unreachable!("every facet of the assignment's scene is a quad");
            };
            let [a, b, c] = first.vertices.map(world);
            let d = world(second.vertices[2]);
            let plane = (c - a).cross(d - b).normalize();
            let normal = plane * plane.dot(first.normal.as_dvec3()).signum();
            let turn = (b - a).cross(c - b).dot(normal).signum();
            let outward = [b - a, c - b, d - c, a - d].map(|edge| edge.cross(normal) * turn);
            let longest = a.distance(b).max(a.distance(d));
            let divisions = if longest > LARGE { CELLS_OF_LARGE } else { CELLS_OF_SMALL };
            facets.push(FacetCells {
                surface: first.parent_mesh_object,
                corners: [a, b, c, d],
                normal,
                outward,
                divisions,
                first_cell: cells,
            });
            cells += divisions * divisions;
        }
        let surfaces: Vec<_> =
            scene.mesh_objects().iter().map(|mesh_object| mesh_object.name.clone()).collect();
        let cells_of =
            |(at, facet): (usize, &FacetCells)| vec![at; facet.divisions * facet.divisions];
        let facet_of_cell = facets.iter().enumerate().flat_map(cells_of).collect();
        let footprints = footprints(scene, &facets);
        Self { facets, surfaces, cells, facet_of_cell, footprints }
    }

    /// By which part of itself the number of photons in `cell` may be off.
    pub fn leeway_of_cell(&self, cell: usize) -> f64 {
        LEEWAY * self.facets[self.facet_of_cell[cell]].divisions as f64
    }

    /// The same of all cells.
    pub fn leeway_of_cells(&self) -> Vec<f64> {
        (0..self.cells).map(|cell| self.leeway_of_cell(cell)).collect()
    }

    /// The area of each cell, without what is too close to other facets, or under a box.
    pub fn areas_of_cells(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.cells];
        let part = |along: usize| (along as f64 + 0.5) / PROBES as f64;
        for FacetCells { corners: [a, b, c, d], .. } in self.facets.iter().cloned() {
            let area = 0.5 * (c - a).cross(d - b).length() / (PROBES * PROBES) as f64;
            for probe in 0..PROBES * PROBES {
                let (u, v) = (part(probe % PROBES), part(probe / PROBES));
                let place = self.place(a.lerp(b, u).lerp(d.lerp(c, u), v));
                if let Place::Cell { cell, .. } = place {
                    areas[cell] += area;
                }
            }
        }
        areas
    }

    /// Where `position`, in world space, lies.
    pub fn place(&self, position: DVec3) -> Place {
        if !position.is_finite() {
            return Place::NotFinite;
        }
        let near = |facet: &FacetCells| facet.height(position).abs() <= FAR_OFF;
        let distances = self.facets.iter().enumerate().filter(|(_, facet)| near(facet));
        let closest = distances
            .map(|(index, facet)| (index, facet.distance(position)))
            .filter(|(_, distance)| *distance <= FAR_OFF)
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((facet, _)) = closest else {
            return Place::OffSurface;
        };
        let on = &self.facets[facet];
        let foot = position - on.height(position) * on.normal;
        let is_close = |(index, other): (usize, &FacetCells)| {
            index != facet && other.height(foot).abs() < MARGIN && other.distance(foot) < MARGIN
        };
        if self.facets.iter().enumerate().any(is_close) {
            return Place::Corner { facet };
        }
        let is_under = |(floor, footprint): &(usize, Footprint)| {
            *floor == facet && footprint.holds(foot.truncate())
        };
        if self.footprints.iter().any(is_under) {
            return Place::Footprint;
        }
        Place::Cell { facet, cell: on.cell(foot) }
    }

    /// The class of `place`, which is its facet, or one for all corners, or one for all footprints,
    /// and its cell; nothing for places on no facet.
    pub fn class_and_cell(&self, place: Place) -> Option<(usize, Option<usize>)> {
        match place {
            Place::Cell { facet, cell } => Some((facet, Some(cell))),
            Place::Corner { .. } => Some((self.facets.len(), None)),
            Place::Footprint => Some((self.facets.len() + 1, None)),
            Place::OffSurface | Place::NotFinite => None,
        }
    }

    /// The name of class `class`, see [`Self::class_and_cell`].
    pub fn class_name(&self, class: usize) -> String {
        match class.checked_sub(self.facets.len()) {
            None => self.name(class),
            Some(0) => "corners between surfaces".to_owned(),
            Some(_) => "beneath the boxes".to_owned(),
        }
    }

    /// The name of cell `cell`: its facet, and its place in the facet's grid.
    pub fn cell_name(&self, cell: usize) -> String {
        let facet = self.facet_of_cell[cell];
        let FacetCells { first_cell, divisions, .. } = self.facets[facet];
        let (row, column) = ((cell - first_cell) / divisions, (cell - first_cell) % divisions);
        format!("{} cell {}/{}", self.name(facet), row + 1, column + 1)
    }

    /// The name of facet `facet`: its surface, and where it looks if the surface has several.
    pub fn name(&self, facet: usize) -> String {
        let FacetCells { surface, normal, .. } = self.facets[facet];
        let surface_name = &self.surfaces[surface];
        if self.facets.iter().filter(|other| other.surface == surface).count() == 1 {
            return surface_name.clone();
        }
        let side = match normal.abs().to_array() {
            [_, _, z] if z > 0.5 => "top",
            [x, y, _] if x > y => {
                if normal.x > 0.0 {
                    "right side"
                } else {
                    "left side"
                }
            }
            _ if normal.y > 0.0 => "back",
            _ => "front",
        };
        format!("{surface_name} {side}")
    }
}

/// What boxes cover of the facets that look up, which is where z is: each with that facet's number.
fn footprints(scene: &Scene, facets: &[FacetCells]) -> Vec<(usize, Footprint)> {
    let count = |surface| facets.iter().filter(|facet| facet.surface == surface).count();
    let boxes = (0..scene.mesh_objects().len()).filter(|surface| count(*surface) > 1);
    let looks_up = |at: &usize| facets[*at].normal.z > 0.9 && count(facets[*at].surface) == 1;
    let floors: Vec<usize> = (0..facets.len()).filter(looks_up).collect();
    let of_box = |surface| floors.iter().map(move |floor| (*floor, surface));
    let footprints = boxes.flat_map(of_box);
    footprints.map(|(floor, surface)| (floor, Footprint::of_box(scene, surface))).collect()
}
