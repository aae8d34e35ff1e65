//! A tree of boxes for scenes of many triangles. The handout's scene has none.
//!
//! **Hits do not depend on the tree.** It only leaves out triangles.
//! [`photon_mapping::scene::triangle`] tests each that remains, and of hits at the same distance
//! the lowest index counts, as without a tree.
//!
//! So the tree must never leave out a triangle that the test would accept. The test sees each
//! corner a few roundings off: one of `corner - origin` and three of the shear. Each is at most
//! 2^-24 of the largest coordinate M of `corner - origin`. A ray that it accepts therefore passes
//! the exact triangle within 6 * 2^-24 M. Its rounded t lies within 12 * 2^-24 M of the exact
//! distance.
//!
//! Every box is larger by 2^-19 M on each side, with M over the whole scene, found once for a ray.
//! A box counts as too far only beyond twice that. That is 32 of these roundings, and covers those
//! of the box test itself (Ize, *Robust BVH Ray Traversal*, JCGT 2013).
//!
//! A node has eight boxes and a leaf eight triangles. Each is tested at once, in the processor's
//! vectors (`eight`), so that few are waited for one after another. The tree is built from the
//! top by the surface area heuristic with bins (Wald, *On fast Construction of SAH-based Bounding
//! Volume Hierarchies*, 2007). It is our own, because the crates for such trees bring their own
//! triangle tests, or boxes that are not conservative.

mod build;
mod eight;
mod pages;
mod search;

use std::sync::Arc;

use crate::lanes::width::Width;
use build::{Halving, Item, NodeBounds, TreePart};
use pages::LargePages;
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::Triangle;
use photon_mapping::scene::{Acceleration, Scene};
use search::TreeSearch;

/// Scenes with at most this many triangles get no tree. Lanes trace them faster.
pub const FEW: usize = 64;

/// Gives `scene` a tree if it has many triangles.
pub fn accelerate(scene: &mut Scene) {
    if scene.triangles().len() > FEW {
        scene.set_acceleration(Arc::new(Tree::new(scene.triangles())));
    }
}

/// How many boxes a node has, and how many triangles a leaf.
const WIDTH: usize = 8;
/// The slack of a box in units of the largest coordinate, 2^-19.
const SLACK: f32 = 1.0 / 524_288.0;
/// Marks a child that is a leaf.
const LEAF: u32 = 1 << 31;
const NO_CHILD: u32 = u32::MAX;

type Lanes = [f32; WIDTH];

/// The least corners of eight boxes, by axis, then the greatest. Then come the bits of what is in
/// the boxes, and a row that puts every node on the border of a cache line.
type TreeNode = [Lanes; 8];
const CHILDREN: usize = 6;

/// Eight triangles: their corners, by corner, then axis. Then come four numbers for each triangle,
/// which are only read of what is met: its normal, which the triangles have too, but far away in
/// memory, and the bits of its index. A triangle that is missing is the first once more.
type Leaf = [Lanes; 13];
const NORMALS: usize = 9;

/// Boxes around boxes around triangles.
#[derive(Debug)]
pub struct Tree {
    nodes: LargePages,
    leaves: LargePages,
    bounds: NodeBounds,
    width: Width,
}

/// Nodes and leaves while a tree is built.
struct Growing<'a> {
    triangles: &'a [Triangle],
    halving: Halving<'a>,
    nodes: Vec<TreeNode>,
    leaves: Vec<Leaf>,
}

impl Tree {
    /// A tree of `triangles`, of which there must be one at least.
    pub fn new(triangles: &[Triangle]) -> Self {
        Self::with_width(triangles, Width::widest())
    }

    /// As [`Self::new`], for vectors of `width`.
    pub fn with_width(triangles: &[Triangle], width: Width) -> Self {
        let mut items: Vec<Item> = (0..)
            .zip(triangles)
            .map(|(index, triangle)| Item { bounds: NodeBounds::of(triangle), index })
            .collect();
        let mut halving = Halving::default();
        let root = halving.add(&mut items);
        let bounds = halving.bounds(root);
        let (nodes, leaves) = (Vec::new(), Vec::new());
        let mut growing = Growing { triangles, halving, nodes, leaves };
        growing.add_node(root);
        let Growing { nodes, leaves, .. } = growing;
        Self { nodes: LargePages::of(&nodes), leaves: LargePages::of(&leaves), bounds, width }
    }

    #[inline(always)]
    fn search(
        &self,
        ray: &Ray,
        triangles: &[Triangle],
        of: impl Fn(&Triangle, f32) -> bool,
        any_will_do: bool,
    ) -> Option<(usize, f32, bool)> {
        eight::with_eight(self.width, TreeSearch { tree: self, ray, triangles, of, any_will_do })
    }
}

impl Acceleration for Tree {
    fn closest(&self, ray: &Ray, triangles: &[Triangle]) -> Option<(usize, f32, bool)> {
        self.search(ray, triangles, |_, _| true, false)
    }

    fn closest_of(
        &self,
        ray: &Ray,
        triangles: &[Triangle],
        accepts: &dyn Fn(&Triangle, f32) -> bool,
    ) -> Option<(usize, f32)> {
        self.search(ray, triangles, accepts, false).map(|(triangle, t, _)| (triangle, t))
    }

    fn any(&self, ray: &Ray, triangles: &[Triangle]) -> bool {
        self.search(ray, triangles, |_, _| true, true).is_some()
    }
}

impl Growing<'_> {
    /// Adds a node for `part` and all below it, and gives its place.
    fn add_node(&mut self, part: TreePart) -> u32 {
        let place = self.nodes.len();
        let [inf, zero] = [f32::INFINITY, 0.0].map(|value| [value; WIDTH]);
        let none = [f32::from_bits(NO_CHILD); WIDTH];
        let less = inf.map(|value| -value);
        self.nodes.push([inf, inf, inf, less, less, less, none, zero]);
        for (slot, part) in self.halving.boxes(part).into_iter().enumerate() {
            let NodeBounds { low, high } = self.halving.bounds(part);
            let child = match part {
                TreePart::Leaf(items) => {
                    self.leaves.push(leaf(self.triangles, items));
                    (self.leaves.len() - 1) as u32 | LEAF
                }
                TreePart::Halved(_) => self.add_node(part),
            };
            let values = [low.x, low.y, low.z, high.x, high.y, high.z, f32::from_bits(child)];
            for (row, value) in self.nodes[place].iter_mut().zip(values) {
                row[slot] = value;
            }
        }
        place as u32
    }
}

fn leaf(triangles: &[Triangle], items: &[Item]) -> Leaf {
    let mut leaf = [[0.0; WIDTH]; 13];
    for lane in 0..WIDTH {
        let index = items.get(lane).unwrap_or(&items[0]).index;
        let Triangle { vertices: [a, b, c], normal, .. } = triangles[index as usize];
        let corners = [a, b, c].into_iter().flat_map(|corner| corner.to_array());
        for (row, coordinate) in leaf.iter_mut().zip(corners) {
            row[lane] = coordinate;
        }
        leaf[NORMALS..].as_flattened_mut()[4 * lane..4 * lane + 4]
            .copy_from_slice(&normal.extend(f32::from_bits(index)).to_array());
    }
    leaf
}
