//! How the triangles are divided among the boxes of a tree.

use glam::Vec3;

use super::WIDTH;
use photon_mapping::scene::triangle::Triangle;

const BINS: usize = 16;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeBounds {
    pub low: Vec3,
    pub high: Vec3,
}

impl NodeBounds {
    const EMPTY: Self = Self { low: Vec3::INFINITY, high: Vec3::NEG_INFINITY };

    pub fn of(triangle: &Triangle) -> Self {
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
pub struct Item {
    pub bounds: NodeBounds,
    pub index: u32,
}

/// The triangles halved until all parts fit a leaf: what nodes are then made of, so that a ray
/// enters as few as can be. To halve three times for every node would leave half of the boxes
/// empty. (Ylitie, Karras and Laine, *Efficient Incoherent Ray Traversal on GPUs Through Compressed
/// Wide BVHs*, 2017.)
#[derive(Default)]
pub struct Halving<'items> {
    halved: Vec<Halved<'items>>,
}

#[derive(Clone, Copy)]
pub enum TreePart<'items> {
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
    pub fn add(&mut self, items: &'items mut [Item]) -> TreePart<'items> {
        if items.len() <= WIDTH {
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

    pub fn bounds(&self, part: TreePart) -> NodeBounds {
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
    pub fn boxes(&self, part: TreePart<'items>) -> Vec<TreePart<'items>> {
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
    count.div_ceil(WIDTH) as f32
}
