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
//! A node has eight boxes, so that few nodes are waited for one after another. A leaf has four
//! triangles, because every processor of the common targets has vectors of four. The tree is built
//! from the top by the surface area heuristic with bins (Wald, *On fast Construction of SAH-based
//! Bounding Volume Hierarchies*, 2007). It is our own, because the crates for such trees bring
//! their own triangle tests, or boxes that are not conservative.

mod build;
mod eight;
mod search;

use std::sync::Arc;

use glam::Vec3;

use crate::lanes::width::Width;
use build::{Halving, Item, NodeBounds, TreePart};
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::Triangle;
use photon_mapping::scene::{Acceleration, Scene};
use search::Search;

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

/// Boxes around boxes around triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    nodes: Vec<TreeNode>,
    leaves: Vec<Leaf>,
    bounds: NodeBounds,
    width: Width,
}

/// On the border of a cache line: in a large mesh most of the time is spent waiting for nodes.
#[derive(Clone, Debug, PartialEq)]
#[repr(align(64))]
struct TreeNode {
    /// The least and the greatest corners of the boxes, by axis.
    ends: [[Lanes; 3]; 2],
    children: [u32; WIDTH],
}

/// Eight triangles; one that is missing is the first once more.
#[derive(Clone, Debug, PartialEq)]
#[repr(align(64))]
struct Leaf {
    /// By corner, then axis.
    corners: [[Lanes; 3]; 3],
    indices: [u32; WIDTH],
    /// By axis. The triangles have them too, but far away in memory.
    normals: [Lanes; 3],
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
        let mut tree = Self { nodes: Vec::new(), leaves: Vec::new(), bounds, width };
        tree.add_node(triangles, &halving, root);
        tree
    }

    /// Adds a node for `part` and all below it, and gives its place.
    fn add_node(&mut self, triangles: &[Triangle], halving: &Halving, part: TreePart) -> u32 {
        let place = self.nodes.len();
        let empty = [[f32::INFINITY; WIDTH]; 3];
        self.nodes.push(TreeNode {
            ends: [empty, empty.map(|axis| axis.map(|low| -low))],
            children: [NO_CHILD; WIDTH],
        });
        for (slot, part) in halving.boxes(part).into_iter().enumerate() {
            let bounds = halving.bounds(part);
            let child = match part {
                TreePart::Leaf(items) => {
                    self.leaves.push(Leaf::new(triangles, items));
                    (self.leaves.len() - 1) as u32 | LEAF
                }
                TreePart::Halved(_) => self.add_node(triangles, halving, part),
            };
            let node = &mut self.nodes[place];
            node.children[slot] = child;
            for axis in 0..3 {
                node.ends[0][axis][slot] = bounds.low[axis];
                node.ends[1][axis][slot] = bounds.high[axis];
            }
        }
        place as u32
    }

    #[inline(always)]
    fn search(
        &self,
        ray: &Ray,
        triangles: &[Triangle],
        of: impl Fn(&Triangle, f32) -> bool,
        any_will_do: bool,
    ) -> Option<(usize, f32, bool)> {
        eight::with_eight(self.width, Search { tree: self, ray, triangles, of, any_will_do })
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

impl Leaf {
    fn new(triangles: &[Triangle], items: &[Item]) -> Self {
        let indices = std::array::from_fn(|lane| items.get(lane).unwrap_or(&items[0]).index);
        let eight = indices.map(|index: u32| &triangles[index as usize]);
        let by_axis = |vectors: [Vec3; WIDTH]| [0, 1, 2].map(|axis| vectors.map(|v| v[axis]));
        Self {
            corners: [0, 1, 2]
                .map(|corner| by_axis(eight.map(|triangle| triangle.vertices[corner]))),
            indices,
            normals: by_axis(eight.map(|triangle| triangle.normal)),
        }
    }
}
