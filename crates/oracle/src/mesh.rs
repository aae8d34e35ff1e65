//! Triangles that tile the facets, cut where the view changes abruptly, for functions that are
//! linear on each.

use super::cuts::{cutting_planes, strips};
use super::direct::kernel;
use super::polygon::{ON_PLANE, Plane, Polygon, bisect, fan, longest_edge, range, split};
use super::scene::PlateScene;
use super::solid_angle::form_factor;
use super::triangle_rules::TriangleRule;
use glam::DVec3;

/// The nodes of a cell in barycentric coordinates: a rule exact to degree 2 with weights of a third
/// (Strang and Fix).
const NODES: [[f64; 3]; 3] = [
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// A triangle that carries three nodes.
pub struct MeshCell {
    pub plate: usize,
    pub nodes: [DVec3; 3],
    /// Area in square scene units.
    pub area: f64,
    /// Affine functions that are 1 at one node and 0 at the others: `normal . p - offset`.
    basis: [(DVec3, f64); 3],
}

/// Binary tree of cuts; leaves are cells.
enum Branch {
    Cut(Plane, Box<Branch>, Box<Branch>),
    Cell(usize),
    Empty,
}

pub struct Mesh {
    pub cells: Vec<MeshCell>,
    trees: Vec<Branch>,
    widths: Option<&'static [f64]>,
}

impl Mesh {
    /// Cells with edges no longer than `longest` scene units.
    ///
    /// `widths` asks for cells that end where the plane of another facet meets theirs. Across such
    /// a line the other facet comes into view and the density has a kink, or a jump if the
    /// facets touch there. Along edges where facets that see each other touch, strips are cut
    /// off, `widths` times `longest` wide: there the density varies as d log d with
    /// the distance d.
    pub fn new(scene: &PlateScene, longest: f64, widths: Option<&'static [f64]>) -> Self {
        let mut mesh = Self { cells: Vec::new(), trees: Vec::new(), widths };
        for plate in 0..scene.plates.len() {
            let planes = if widths.is_some() { cutting_planes(scene, plate) } else { Vec::new() };
            let tree =
                mesh.grow(scene, plate, scene.plates[plate].corners.clone(), &planes, longest);
            mesh.trees.push(tree);
        }
        mesh
    }

    fn grow(
        &mut self,
        scene: &PlateScene,
        plate: usize,
        polygon: Polygon,
        planes: &[Plane],
        longest: f64,
    ) -> Branch {
        if polygon.len() < 3 {
            return Branch::Empty;
        }
        let Some((plane, others)) = planes.split_first() else {
            let widths: Vec<f64> =
                self.widths.unwrap_or_default().iter().map(|width| width * longest).collect();
            let strips = strips(scene, plate, &polygon, &widths);
            return self.cut_strips(scene, plate, polygon, &strips, longest);
        };
        let (positive, negative) = split(&polygon, plane);
        if positive.is_empty() || negative.is_empty() {
            return self.grow(scene, plate, polygon, others, longest);
        }
        let positive = self.grow(scene, plate, positive, others, longest);
        let negative = self.grow(scene, plate, negative, others, longest);
        Branch::Cut(*plane, Box::new(positive), Box::new(negative))
    }

    fn cut_strips(
        &mut self,
        scene: &PlateScene,
        plate: usize,
        polygon: Polygon,
        strips: &[Plane],
        longest: f64,
    ) -> Branch {
        let Some((plane, others)) = strips.split_first() else {
            return self.grow_fan(scene, plate, &polygon, longest);
        };
        let (positive, negative) = split(&polygon, plane);
        if positive.len() < 3 || negative.len() < 3 {
            return self.cut_strips(scene, plate, polygon, others, longest);
        }
        let positive = self.cut_strips(scene, plate, positive, others, longest);
        let negative = self.cut_strips(scene, plate, negative, others, longest);
        Branch::Cut(*plane, Box::new(positive), Box::new(negative))
    }

    fn grow_fan(
        &mut self,
        scene: &PlateScene,
        plate: usize,
        polygon: &[DVec3],
        longest: f64,
    ) -> Branch {
        let normal = scene.plates[plate].plane.normal;
        let mut triangles: Vec<[DVec3; 3]> = fan(polygon).collect();
        let Some(last) = triangles.pop() else {
            return Branch::Empty;
        };
        let mut branch = self.grow_triangle(scene, plate, last, longest);
        while let Some(triangle) = triangles.pop() {
            let this = self.grow_triangle(scene, plate, triangle, longest);
            let diagonal = triangle[0] - triangle[2];
            branch = match normal.cross(diagonal).try_normalize() {
                Some(inward) => Branch::Cut(
                    Plane::through(triangle[0], inward),
                    Box::new(this),
                    Box::new(branch),
                ),
                None => branch,
            };
        }
        branch
    }

    fn grow_triangle(
        &mut self,
        scene: &PlateScene,
        plate: usize,
        triangle: [DVec3; 3],
        longest: f64,
    ) -> Branch {
        let normal = scene.plates[plate].plane.normal;
        let (edge, length_squared) = longest_edge(&triangle);
        // Smaller where a small thing is near: in the handout's scene nowhere.
        let longest_here = longest * (8.0 * scene.detail_near(plate, &triangle)).min(1.0);
        if length_squared <= (longest_here * longest_here).max(1e-12) {
            return self.add(plate, normal, triangle);
        }
        let [left, right] = bisect(&triangle);
        // The cut runs from the middle of the longest edge to the corner across, the left half on
        // its left.
        let across = triangle[(edge + 2) % 3] - left[1];
        match normal.cross(across).try_normalize() {
            Some(inward) => {
                let cut = Plane::through(left[1], inward);
                let left = self.grow_triangle(scene, plate, left, longest);
                let right = self.grow_triangle(scene, plate, right, longest);
                Branch::Cut(cut, Box::new(left), Box::new(right))
            }
            None => Branch::Empty,
        }
    }

    fn add(&mut self, plate: usize, normal: DVec3, triangle: [DVec3; 3]) -> Branch {
        let double_area = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).dot(normal);
        if double_area.abs() < 1e-24 {
            return Branch::Empty;
        }
        let basis = [0, 1, 2].map(|i| {
            let (b, c) = (triangle[(i + 1) % 3], triangle[(i + 2) % 3]);
            let rise = normal.cross(c - b) / double_area;
            // Barycentric coordinate l as rise . (p - b); nodal function 2 l - 1/3.
            (2.0 * rise, 2.0 * rise.dot(b) + 1.0 / 3.0)
        });
        let nodes = NODES.map(|[a, b, c]| triangle[0] * a + triangle[1] * b + triangle[2] * c);
        self.cells.push(MeshCell { plate, nodes, area: 0.5 * double_area.abs(), basis });
        Branch::Cell(self.cells.len() - 1)
    }

    /// Adds weights w to `row`, with integral of f cos cos / (pi r^2) = sum of w f(node), for a
    /// function f that is linear on each cell. The integral is over what `seen`, a piece of plate
    /// `target`, fills of the cosine lobe of `eye`.
    ///
    /// Exact if the function is constant; else the mean position in each cell is a quadrature.
    pub fn gather(
        &self,
        scene: &PlateScene,
        view: &PlateView,
        target: usize,
        seen: Polygon,
        row: &mut TransportRow,
    ) {
        self.descend(scene, view, &self.trees[target], target, seen, row);
    }

    fn descend(
        &self,
        scene: &PlateScene,
        view: &PlateView,
        branch: &Branch,
        target: usize,
        piece: Polygon,
        row: &mut TransportRow,
    ) {
        if piece.len() < 3 {
            return;
        }
        match branch {
            Branch::Empty => {}
            Branch::Cut(plane, positive, negative) => {
                // Most cuts miss the piece: it goes on as it is, without a copy.
                let (lowest, highest) = range(&piece, plane);
                if lowest >= -ON_PLANE {
                    return self.descend(scene, view, positive, target, piece, row);
                }
                if highest <= ON_PLANE {
                    return self.descend(scene, view, negative, target, piece, row);
                }
                let (above, below) = split(&piece, plane);
                self.descend(scene, view, positive, target, above, row);
                self.descend(scene, view, negative, target, below, row);
            }
            Branch::Cell(index) => {
                let factor = form_factor(&piece, view.eye, view.normal);
                let source = scene.plates[target].plane.normal;
                let (mut moment, mut weights) = (DVec3::ZERO, 0.0);
                view.rule.graded(&piece, &[view.eye], view.ratio, &mut |point, weight| {
                    let kernel = weight * kernel(point - view.eye, view.normal, source);
                    moment += kernel * (point - view.eye);
                    weights += kernel;
                });
                if weights > 0.0 {
                    let mean = view.eye + moment / weights;
                    row.add(
                        *index,
                        self.cells[*index]
                            .basis
                            .map(|(rise, offset)| factor * (rise.dot(mean) - offset)),
                    );
                }
            }
        }
    }
}

/// Where a row is gathered, and how finely.
pub struct PlateView<'a> {
    pub eye: DVec3,
    /// Unit normal of the lobe.
    pub normal: DVec3,
    pub rule: &'a TriangleRule,
    pub ratio: f64,
}

/// Weights per cell, collected densely, handed out sparsely.
pub struct TransportRow {
    weights: Vec<[f64; 3]>,
    touched: Vec<usize>,
}

impl TransportRow {
    pub fn new(cells: usize) -> Self {
        Self { weights: vec![[0.0; 3]; cells], touched: Vec::new() }
    }

    fn add(&mut self, cell: usize, weights: [f64; 3]) {
        let here = &mut self.weights[cell];
        if *here == [0.0; 3] {
            self.touched.push(cell);
        }
        for (here, weight) in here.iter_mut().zip(weights) {
            *here += weight;
        }
    }

    /// Empties the row into (cell, weights) pairs, cells ascending.
    pub fn take(&mut self) -> Vec<(u32, [f64; 3])> {
        self.touched.sort_unstable();
        self.touched.dedup();
        let row = self
            .touched
            .iter()
            .map(|&cell| (cell as u32, std::mem::take(&mut self.weights[cell])))
            .collect();
        self.touched.clear();
        row
    }
}
