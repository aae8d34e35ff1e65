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

use std::sync::Arc;

use glam::Vec3;

use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::{ShearedRay, Triangle, meet};
use photon_mapping::scene::{Acceleration, Scene};

/// Scenes with at most this many triangles get no tree. Lanes trace them faster.
pub const FEW: usize = 64;

/// Gives `scene` a tree if it has many triangles.
pub fn accelerate(scene: &mut Scene) {
    if scene.triangles().len() > FEW {
        scene.set_acceleration(Arc::new(Tree::new(scene.triangles())));
    }
}

const WIDTH: usize = 8;
const IN_LEAF: usize = 4;
const BINS: usize = 16;
/// The slack of a box in units of the largest coordinate, 2^-19.
const SLACK: f32 = 1.0 / 524_288.0;
/// Marks a child that is a leaf.
const LEAF: u32 = 1 << 31;
const NO_CHILD: u32 = u32::MAX;
/// Few rays have so many boxes waiting: 22 at most in a mesh of a million triangles.
const ORDINARY_STACK: usize = 32;

type Boxes = [f32; WIDTH];
type Four = [f32; IN_LEAF];

/// Boxes around boxes around triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    nodes: Vec<TreeNode>,
    leaves: Vec<Leaf>,
    bounds: NodeBounds,
}

/// On the border of a cache line: in a large mesh most of the time is spent waiting for nodes.
#[derive(Clone, Debug, PartialEq)]
#[repr(align(64))]
struct TreeNode {
    /// The least and the greatest corners of the boxes, by axis.
    ends: [[Boxes; 3]; 2],
    children: [u32; WIDTH],
}

/// Four triangles; one that is missing is the first once more.
#[derive(Clone, Debug, PartialEq)]
struct Leaf {
    /// By corner, then axis.
    corners: [[Four; 3]; 3],
    /// By axis. The triangles have them too, but far away in memory.
    normals: [Four; 3],
    indices: [u32; IN_LEAF],
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct NodeBounds {
    low: Vec3,
    high: Vec3,
}

impl NodeBounds {
    const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    fn of(triangle: &Triangle) -> Self {
        let [a, b, c] = triangle.vertices;
        Self { low: a.min(b).min(c), high: a.max(b).max(c) }
    }

    fn and(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    fn center(self) -> Vec3 {
        0.5 * self.low + 0.5 * self.high
    }

    fn half_area(self) -> f32 {
        let d = (self.high - self.low).max(Vec3::ZERO);
        d.x * d.y + d.y * d.z + d.z * d.x
    }
}

/// A triangle on its way into the tree.
#[derive(Clone, Copy)]
struct Item {
    bounds: NodeBounds,
    index: u32,
}

/// A ray on its way through the tree.
struct TreeSearch {
    origin: Vec3,
    sheared: ShearedRay,
    reciprocal: Vec3,
    /// For each axis, which of a node's ends comes first.
    first: [usize; 3],
    slack: f32,
    closest: f32,
    index: u32,
    is_front: bool,
}

impl Tree {
    /// A tree of `triangles`, of which there must be one at least.
    pub fn new(triangles: &[Triangle]) -> Self {
        let mut items: Vec<Item> = (0..)
            .zip(triangles)
            .map(|(index, triangle)| Item { bounds: NodeBounds::of(triangle), index })
            .collect();
        let mut halving = Halving::default();
        let root = halving.add(&mut items);
        let bounds = halving.bounds(root);
        let mut tree = Self { nodes: Vec::new(), leaves: Vec::new(), bounds };
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

    fn search(
        &self,
        ray: &Ray,
        triangles: &[Triangle],
        of: impl Fn(&Triangle, f32) -> bool,
        any_will_do: bool,
    ) -> Option<((usize, f32), bool)> {
        let (origin, direction) = (ray.position(), ray.ray_direction());
        let reach = (self.bounds.low - origin).abs().max((self.bounds.high - origin).abs());
        let mut search = TreeSearch {
            origin,
            sheared: ShearedRay::new(ray),
            reciprocal: direction.recip(),
            first: direction.to_array().map(|d| usize::from(d.is_sign_negative())),
            slack: SLACK * reach.max_element() + ray.start_error,
            closest: ray.max_t,
            index: NO_CHILD,
            is_front: false,
        };
        let mut stack = Stack::new();
        let mut next = Some((0, 0.0));
        while let Some((place, distance)) = next {
            if distance <= search.closest + 2.0 * search.slack {
                if place & LEAF == 0 {
                    let node = &self.nodes[place as usize];
                    stack.push_nearest_last(&node.children, &search.enter(node));
                } else {
                    search.test(&self.leaves[(place & !LEAF) as usize], triangles, &of);
                    if any_will_do && search.index != NO_CHILD {
                        break;
                    }
                }
            }
            next = stack.pop();
        }
        let hit = (search.index as usize, search.closest);
        (search.index != NO_CHILD).then_some((hit, search.is_front))
    }
}

impl Acceleration for Tree {
    fn closest(&self, ray: &Ray, triangles: &[Triangle]) -> Option<(usize, f32, bool)> {
        let ((triangle, t), is_front) = self.search(ray, triangles, |_, _| true, false)?;
        Some((triangle, t, is_front))
    }

    fn closest_of(
        &self,
        ray: &Ray,
        triangles: &[Triangle],
        accepts: &dyn Fn(&Triangle, f32) -> bool,
    ) -> Option<(usize, f32)> {
        self.search(ray, triangles, accepts, false).map(|(hit, _)| hit)
    }

    fn any(&self, ray: &Ray, triangles: &[Triangle]) -> bool {
        self.search(ray, triangles, |_, _| true, true).is_some()
    }
}

/// Children that are still to be visited, and how far away their boxes begin.
struct Stack {
    /// On the processor's stack, because to ask for memory takes as long as to enter some nodes.
    first: [(u32, f32); ORDINARY_STACK],
    count: usize,
    more: Vec<(u32, f32)>,
}

impl Stack {
    fn new() -> Self {
        Self { first: [(NO_CHILD, 0.0); ORDINARY_STACK], count: 0, more: Vec::new() }
    }

    #[inline(always)]
    fn push(&mut self, child: (u32, f32)) {
        if let Some(place) = self.first.get_mut(self.count) {
            *place = child;
            self.count += 1;
        } else {
            self.more.push(child);
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<(u32, f32)> {
        if !self.more.is_empty() {
            return self.more.pop();
        }
        self.count = self.count.checked_sub(1)?;
        Some(self.first[self.count])
    }

    /// Adds those of a node's `children` whose `distances` are finite.
    #[inline(always)]
    fn push_nearest_last(&mut self, children: &[u32; WIDTH], distances: &Boxes) {
        let mut entered = [(NO_CHILD, 0.0); WIDTH];
        let mut count = 0;
        // Without a branch, since no processor foresees which boxes are entered.
        for (child, distance) in children.iter().zip(distances) {
            entered[count] = (*child, *distance);
            count += usize::from(*distance < f32::INFINITY);
        }
        for end in 1..count {
            let mut place = end;
            while place > 0 && entered[place - 1].1 < entered[place].1 {
                entered.swap(place - 1, place);
                place -= 1;
            }
        }
        for child in &entered[..count] {
            self.push(*child);
        }
    }
}

impl TreeSearch {
    /// How far away the boxes of `node` begin; infinite when the ray misses one.
    #[inline(always)]
    fn enter(&self, node: &TreeNode) -> Boxes {
        let mut near = [0.0; WIDTH];
        let mut far = [f32::INFINITY; WIDTH];
        for axis in 0..3 {
            let first = self.first[axis];
            let (starts, ends) = (&node.ends[first][axis], &node.ends[1 - first][axis]);
            let slack = if first == 0 { self.slack } else { -self.slack };
            let (before, behind) = (self.origin[axis] + slack, self.origin[axis] - slack);
            for lane in 0..WIDTH {
                // Not a number when the ray runs along the box's side: then this axis does not
                // count, since the comparisons are false.
                let start = (starts[lane] - before) * self.reciprocal[axis];
                let end = (ends[lane] - behind) * self.reciprocal[axis];
                near[lane] = if start > near[lane] { start } else { near[lane] };
                far[lane] = if end < far[lane] { end } else { far[lane] };
            }
        }
        let mut distances = [0.0; WIDTH];
        for lane in 0..WIDTH {
            let is_entered = (near[lane] <= far[lane] * (1.0 + 4.0 * f32::EPSILON))
                & (near[lane] <= self.closest + 2.0 * self.slack);
            distances[lane] = if is_entered { near[lane] } else { f32::INFINITY };
        }
        distances
    }

    /// Tests the triangles of `leaf`.
    #[inline(always)]
    fn test(&mut self, leaf: &Leaf, triangles: &[Triangle], of: impl Fn(&Triangle, f32) -> bool) {
        let mut seen = [[[0.0; IN_LEAF]; 3]; 3];
        let [x, y, z] = self.sheared.order();
        let shear = self.sheared.shear();
        for (seen, corner) in seen.iter_mut().zip(&leaf.corners) {
            for lane in 0..IN_LEAF {
                let depth = corner[z][lane] - self.origin[z];
                seen[0][lane] = corner[x][lane] - self.origin[x] - shear.x * depth;
                seen[1][lane] = corner[y][lane] - self.origin[y] - shear.y * depth;
                seen[2][lane] = shear.z * depth;
            }
        }
        // Here, not where a triangle is met, so that all of the leaf is waited for at once.
        let mut cosines = [0.0; IN_LEAF];
        for lane in 0..IN_LEAF {
            let normal = Vec3::from_array(leaf.normals.map(|axis| axis[lane]));
            cosines[lane] = self.sheared.cosine(normal);
        }
        let [a, b, c] = &seen;
        let mut may_be_met = [false; IN_LEAF];
        for lane in 0..IN_LEAF {
            let u = c[0][lane] * b[1][lane] - c[1][lane] * b[0][lane];
            let v = a[0][lane] * c[1][lane] - a[1][lane] * c[0][lane];
            let w = b[0][lane] * a[1][lane] - b[1][lane] * a[0][lane];
            let is_refused = ((u < 0.0) | (v < 0.0) | (w < 0.0))
                & ((u > 0.0) | (v > 0.0) | (w > 0.0))
                & (u != 0.0)
                & (v != 0.0)
                & (w != 0.0);
            may_be_met[lane] = !is_refused;
        }
        for lane in (0..IN_LEAF).filter(|lane| may_be_met[*lane]) {
            let of_lane = |corner: &[Four; 3]| Vec3::from_array(corner.map(|axis| axis[lane]));
            let Some(t) = meet([of_lane(a), of_lane(b), of_lane(c)]) else {
                continue;
            };
            let index = leaf.indices[lane];
            let is_tie = t == self.closest && self.index != NO_CHILD && index < self.index;
            if (t < self.closest || is_tie)
                && self.sheared.reaches(cosines[lane], t)
                && of(&triangles[index as usize], t)
            {
                (self.closest, self.index, self.is_front) = (t, index, cosines[lane] <= 0.0);
            }
        }
    }
}

impl Leaf {
    fn new(triangles: &[Triangle], items: &[Item]) -> Self {
        let indices = std::array::from_fn(|lane| items.get(lane).unwrap_or(&items[0]).index);
        let four = indices.map(|index: u32| &triangles[index as usize]);
        let by_axis = |vectors: [Vec3; IN_LEAF]| [0, 1, 2].map(|axis| vectors.map(|v| v[axis]));
        Self {
            corners: [0, 1, 2]
                .map(|corner| by_axis(four.map(|triangle| triangle.vertices[corner]))),
            normals: by_axis(four.map(|triangle| triangle.normal)),
            indices,
        }
    }
}

/// The triangles halved until all parts fit a leaf: what nodes are then made of, so that a ray
/// enters as few as can be. To halve three times for every node would leave half of the boxes
/// empty. (Ylitie, Karras and Laine, *Efficient Incoherent Ray Traversal on GPUs Through Compressed
/// Wide BVHs*, 2017.)
#[derive(Default)]
struct Halving<'items> {
    halved: Vec<Halved<'items>>,
}

#[derive(Clone, Copy)]
enum TreePart<'items> {
    Leaf(&'items [Item]),
    /// Its place in [`Halving::halved`].
    Halved(u32),
}

struct Halved<'items> {
    bounds: NodeBounds,
    halves: [TreePart<'items>; 2],
    /// At `n - 1`, how many nodes are entered in this part if it becomes at most `n` boxes of the
    /// node above it. It is the sum of the areas of all those nodes, because the numbers of rays
    /// are proportional to areas.
    nodes: [f32; WIDTH],
}

impl<'items> Halving<'items> {
    fn add(&mut self, items: &'items mut [Item]) -> TreePart<'items> {
        if items.len() <= IN_LEAF {
            return TreePart::Leaf(items);
        }
        let (left, right) = split(items);
        let halves = [self.add(left), self.add(right)];
        let [left, right] = halves.map(|half| self.bounds(half));
        let bounds = left.and(right);
        let nodes = self.nodes_of(bounds, halves);
        self.halved.push(Halved { bounds, halves, nodes });
        TreePart::Halved((self.halved.len() - 1) as u32)
    }

    fn bounds(&self, part: TreePart) -> NodeBounds {
        match part {
            TreePart::Leaf(items) => {
                items.iter().fold(NodeBounds::EMPTY, |all, item| all.and(item.bounds))
            }
            TreePart::Halved(place) => self.halved[place as usize].bounds,
        }
    }

    fn nodes(&self, part: TreePart) -> [f32; WIDTH] {
        match part {
            TreePart::Leaf(_) => [0.0; WIDTH],
            TreePart::Halved(place) => self.halved[place as usize].nodes,
        }
    }

    fn nodes_of(&self, bounds: NodeBounds, halves: [TreePart; 2]) -> [f32; WIDTH] {
        let [left, right] = halves.map(|half| self.nodes(half));
        let mut nodes = [bounds.half_area() + best_share(&left, &right, WIDTH).0; WIDTH];
        for boxes in 2..=WIDTH {
            nodes[boxes - 1] = nodes[boxes - 2].min(best_share(&left, &right, boxes).0);
        }
        nodes
    }

    /// The parts that become the boxes of `part`'s node.
    fn boxes(&self, part: TreePart<'items>) -> Vec<TreePart<'items>> {
        let mut boxes = Vec::with_capacity(WIDTH);
        match part {
            TreePart::Leaf(_) => boxes.push(part),
            TreePart::Halved(place) => self.share(place, WIDTH, &mut boxes),
        }
        boxes
    }

    /// Adds what becomes of the halves of the part at `place` if there are `count` boxes for them.
    fn share(&self, place: u32, count: usize, boxes: &mut Vec<TreePart<'items>>) {
        let halves = self.halved[place as usize].halves;
        let [left, right] = halves.map(|half| self.nodes(half));
        let share = best_share(&left, &right, count).1;
        for (half, count) in halves.into_iter().zip([share, count - share]) {
            let nodes = self.nodes(half);
            // Boxes without which it goes as well stay empty.
            let of_use = nodes.iter().take_while(|fewer| **fewer > nodes[count - 1]).count() + 1;
            match half {
                TreePart::Halved(place) if of_use > 1 => self.share(place, of_use, boxes),
                _ => boxes.push(half),
            }
        }
    }
}

/// How many nodes are entered in two halves that share `boxes`, when the first has as many as are
/// best, and how many these are.
fn best_share(left: &[f32; WIDTH], right: &[f32; WIDTH], boxes: usize) -> (f32, usize) {
    let shares = (1..boxes).map(|share| (left[share - 1] + right[boxes - share - 1], share));
    shares.fold((f32::INFINITY, 1), |best, share| if share.0 < best.0 { share } else { best })
}

/// Divides `items`, which do not fit a leaf, where the surface area heuristic finds it cheapest.
fn split(items: &mut [Item]) -> (&mut [Item], &mut [Item]) {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for item in &*items {
        let center = item.bounds.center();
        (low, high) = (low.min(center), high.max(center));
    }
    let extent = high - low;
    let scale = BINS as f32 * (1.0 - 1e-6) / extent;
    let bins_of = |item: &Item| {
        let places = (item.bounds.center() - low) * scale;
        places.to_array().map(|place| (place as i32 as usize).min(BINS - 1))
    };
    let mut bins = [[(0_usize, NodeBounds::EMPTY); BINS]; 3];
    for item in &*items {
        for (bins, bin) in bins.iter_mut().zip(bins_of(item)) {
            let (count, bounds) = &mut bins[bin];
            (*count, *bounds) = (*count + 1, bounds.and(item.bounds));
        }
    }
    let mut best = (f32::INFINITY, 0, 0);
    for axis in (0..3).filter(|axis| extent[*axis] > 0.0) {
        let mut right_cost = [0.0; BINS];
        let mut right = (0, NodeBounds::EMPTY);
        for cut in (1..BINS).rev() {
            let (count, bounds) = bins[axis][cut];
            right = (right.0 + count, right.1.and(bounds));
            right_cost[cut] = leaves(right.0) * right.1.half_area();
        }
        let mut left = (0, NodeBounds::EMPTY);
        for cut in 1..BINS {
            let (count, bounds) = bins[axis][cut - 1];
            left = (left.0 + count, left.1.and(bounds));
            let cost = leaves(left.0) * left.1.half_area() + right_cost[cut];
            if left.0 > 0 && left.0 < items.len() && cost < best.0 {
                best = (cost, axis, cut);
            }
        }
    }
    let (cost, axis, cut) = best;
    let middle = if cost < f32::INFINITY {
        let mut middle = 0;
        for place in 0..items.len() {
            if bins_of(&items[place])[axis] < cut {
                items.swap(place, middle);
                middle += 1;
            }
        }
        middle
    } else {
        items.len() / 2
    };
    items.split_at_mut(middle)
}

/// How many leaves `count` triangles fill at least.
fn leaves(count: usize) -> f32 {
    count.div_ceil(IN_LEAF) as f32
}
