//! The way of one ray through the tree.

use glam::Vec3;
use pulp::{cast, f32x8};

use super::eight::{Eight, WithEight};
use super::{CHILDREN, LEAF, Leaf, NO_CHILD, NORMALS, SLACK, Tree, TreeNode, WIDTH};
use photon_mapping::scene::ray::Ray;
use photon_mapping::scene::triangle::{ShearedRay, Triangle, meet};

/// Few rays have so many boxes waiting: 22 at most in a mesh of a million triangles.
const ORDINARY_STACK: usize = 32;

/// The search for the closest hit of `ray` of those that `of` takes.
pub struct TreeSearch<'a, F> {
    pub tree: &'a Tree,
    pub ray: &'a Ray,
    pub triangles: &'a [Triangle],
    pub of: F,
    pub any_will_do: bool,
}

impl<F: Fn(&Triangle, f32) -> bool> WithEight for TreeSearch<'_, F> {
    type Output = Option<(usize, f32, bool)>;

    #[inline(always)]
    fn with<E: Eight>(self, eight: E) -> Self::Output {
        let Self { tree, ray, triangles, of, any_will_do } = self;
        let (nodes, leaves) = (tree.nodes.values(), tree.leaves.values());
        let mut way = Way::new(eight, ray, tree);
        let mut waiting = Stack::new();
        let mut next = Some(0);
        while let Some(place) = next {
            next = if place & LEAF == 0 {
                way.enter(&nodes[place as usize], &mut waiting)
            } else {
                way.test(&leaves[(place & !LEAF) as usize], triangles, &of);
                if any_will_do && way.index != NO_CHILD {
                    break;
                }
                None
            };
            while next.is_none()
                && let Some(child) = waiting.pop()
            {
                next = (distance(child) <= way.limit).then_some(child as u32);
            }
        }
        (way.index != NO_CHILD).then_some((way.index as usize, way.closest, way.is_front))
    }
}

/// A ray on its way through the tree.
struct Way<E> {
    eight: E,
    origin: [f32; 3],
    sheared: ShearedRay,
    reciprocal: [f32x8; 3],
    /// The origin, moved by the slack so that boxes begin earlier.
    before: [f32x8; 3],
    /// The origin, moved by the slack so that boxes end later.
    behind: [f32x8; 3],
    /// For each axis, which of a node's ends comes first.
    first: [usize; 3],
    slack: f32,
    closest: f32,
    /// How far away a box may begin that has something to offer.
    limit: f32,
    index: u32,
    is_front: bool,
}

impl<E: Eight> Way<E> {
    #[inline(always)]
    fn new(eight: E, ray: &Ray, tree: &Tree) -> Self {
        let (origin, direction) = (ray.position(), ray.ray_direction());
        let reach = (tree.bounds.low - origin).abs().max((tree.bounds.high - origin).abs());
        let slack = SLACK * reach.max_element() + ray.start_error;
        let mut way = Self {
            eight,
            origin: origin.to_array(),
            sheared: ShearedRay::new(ray),
            reciprocal: [eight.splat_f32s(0.0); 3],
            before: [eight.splat_f32s(0.0); 3],
            behind: [eight.splat_f32s(0.0); 3],
            first: [0; 3],
            slack,
            closest: ray.max_t,
            limit: ray.max_t + 2.0 * slack,
            index: NO_CHILD,
            is_front: false,
        };
        // Loops, because the closure of an array's `map` would not be inlined.
        for axis in 0..3 {
            let is_backwards = direction[axis].is_sign_negative();
            let outwards = if is_backwards { -slack } else { slack };
            way.first[axis] = usize::from(is_backwards);
            way.reciprocal[axis] = eight.splat_f32s(1.0 / direction[axis]);
            way.before[axis] = eight.splat_f32s(origin[axis] + outwards);
            way.behind[axis] = eight.splat_f32s(origin[axis] - outwards);
        }
        way
    }

    /// The child of `node` whose box begins nearest of those that the ray enters. The others wait.
    #[inline(always)]
    fn enter(&self, node: &TreeNode, waiting: &mut Stack) -> Option<u32> {
        let eight = self.eight;
        let mut near = eight.splat_f32s(0.0);
        let mut far = eight.splat_f32s(f32::INFINITY);
        for axis in 0..3 {
            let first = self.first[axis] & 1;
            let (starts, ends) = (cast(node[3 * first + axis]), cast(node[3 - 3 * first + axis]));
            let along =
                |ends, origin| eight.mul_f32s(eight.sub_f32s(ends, origin), self.reciprocal[axis]);
            // Not a number when the ray runs along the box's side: then this axis does not count.
            near = eight.greater(along(starts, self.before[axis]), near);
            far = eight.smaller(along(ends, self.behind[axis]), far);
        }
        let far = eight.mul_f32s(far, eight.splat_f32s(1.0 + 4.0 * f32::EPSILON));
        let last = eight.smaller(far, eight.splat_f32s(self.limit));
        let mut entered = eight.bits(eight.less_than_or_equal_f32s(near, last));
        let count = entered.count_ones();
        if count == 0 {
            return None;
        }
        let distances: [f32; WIDTH] = cast(near);
        let mut take = || {
            let slot = entered.trailing_zeros() as usize % WIDTH;
            entered &= entered - 1;
            u64::from(distances[slot].to_bits()) << 32 | u64::from(node[CHILDREN][slot].to_bits())
        };
        let mut nearest = take();
        let first = waiting.count;
        for _ in 1..count {
            // Without a branch, since which one is nearer cannot be predicted.
            let child = take();
            waiting.push(nearest.max(child));
            nearest = nearest.min(child);
        }
        waiting.sort_from(first);
        Some(nearest as u32)
    }

    /// Tests the triangles of `leaf`.
    #[inline(always)]
    fn test(&mut self, leaf: &Leaf, triangles: &[Triangle], of: impl Fn(&Triangle, f32) -> bool) {
        let eight = self.eight;
        let mut seen = [[eight.splat_f32s(0.0); 3]; 3];
        for (corner, seen) in seen.iter_mut().enumerate() {
            *seen = self.see(leaf, corner);
        }
        let [a, b, c] = seen;
        let u = eight.cross(c[0], b[1], c[1], b[0]);
        let v = eight.cross(a[0], c[1], a[1], c[0]);
        let w = eight.cross(b[0], a[1], b[1], a[0]);
        let zero = eight.splat_f32s(0.0);
        let least = eight.smaller(eight.smaller(u, v), w);
        let greatest = eight.greater(eight.greater(u, v), w);
        let negative = eight.bits(eight.less_than_f32s(least, zero));
        let positive = eight.bits(eight.greater_than_f32s(greatest, zero));
        let mut met = !(negative & positive) & ((1 << WIDTH) - 1);
        if met == 0 {
            return;
        }
        // Beside a true negative and a true positive one, a zero changes nothing.
        let in_doubt = eight.bits(eight.equal_f32s(least, zero))
            | eight.bits(eight.equal_f32s(greatest, zero));
        let determinant = eight.add_f32s(eight.add_f32s(u, v), w);
        let (ua, vb, wc) =
            (eight.mul_f32s(u, a[2]), eight.mul_f32s(v, b[2]), eight.mul_f32s(w, c[2]));
        let distances = eight.div_f32s(eight.add_f32s(eight.add_f32s(ua, vb), wc), determinant);
        let distances: [f32; WIDTH] = cast(distances);
        while met != 0 {
            let lane = met.trailing_zeros() as usize % WIDTH;
            met &= met - 1;
            let mut t = distances[lane];
            if in_doubt >> lane & 1 == 1 {
                let Some(exact) = meet([of_lane(&a, lane), of_lane(&b, lane), of_lane(&c, lane)])
                else {
                    continue;
                };
                t = exact;
            }
            if t > self.closest {
                continue;
            }
            let normal = &leaf[NORMALS..].as_flattened()[4 * lane..4 * lane + 4];
            let index = normal[3].to_bits();
            let triangle = &triangles[index as usize];
            let is_tie = t == self.closest && self.index != NO_CHILD && index < self.index;
            let cosine = self.sheared.cosine(Vec3::from_slice(normal));
            if (t < self.closest || is_tie) && self.sheared.reaches(cosine, t) && of(triangle, t) {
                (self.closest, self.index, self.is_front) = (t, index, cosine <= 0.0);
                self.limit = t + 2.0 * self.slack;
            }
        }
    }

    /// The triangles' corners number `corner` as the ray sees them, with the roundings of
    /// [`Triangle::intersect`].
    #[inline(always)]
    fn see(&self, leaf: &Leaf, corner: usize) -> [f32x8; 3] {
        let eight = self.eight;
        let [x, y, z] = self.sheared.order();
        let shear = self.sheared.shear();
        let corner = &leaf[3 * corner..3 * corner + 3];
        let depth = eight.sub_f32s(cast(corner[z]), eight.splat_f32s(self.origin[z]));
        let beside_x = eight.sub_f32s(cast(corner[x]), eight.splat_f32s(self.origin[x]));
        let beside_y = eight.sub_f32s(cast(corner[y]), eight.splat_f32s(self.origin[y]));
        [
            eight.sub_f32s(beside_x, eight.mul_f32s(eight.splat_f32s(shear.x), depth)),
            eight.sub_f32s(beside_y, eight.mul_f32s(eight.splat_f32s(shear.y), depth)),
            eight.mul_f32s(eight.splat_f32s(shear.z), depth),
        ]
    }
}

/// The corner in `lane`.
#[inline(always)]
fn of_lane(corner: &[f32x8; 3], lane: usize) -> Vec3 {
    let [x, y, z] = corner;
    let [x, y, z]: [[f32; WIDTH]; 3] = [cast(*x), cast(*y), cast(*z)];
    Vec3::new(x[lane], y[lane], z[lane])
}

/// Children that are still to be visited: how far away their boxes begin, in the upper bits, and
/// what they are. Distances are not negative, so their bits have the same order.
struct Stack {
    /// On the processor's stack, because to ask for memory takes as long as to enter some nodes.
    first: [u64; ORDINARY_STACK],
    count: usize,
    more: Vec<u64>,
}

/// How far away the box of `child` begins.
#[inline(always)]
fn distance(child: u64) -> f32 {
    f32::from_bits((child >> 32) as u32)
}

impl Stack {
    #[inline(always)]
    fn new() -> Self {
        Self { first: [0; ORDINARY_STACK], count: 0, more: Vec::new() }
    }

    #[inline(always)]
    fn push(&mut self, child: u64) {
        if let Some(place) = self.first.get_mut(self.count) {
            *place = child;
            self.count += 1;
        } else {
            self.more.push(child);
        }
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<u64> {
        if !self.more.is_empty() {
            return self.more.pop();
        }
        self.count = self.count.checked_sub(1)?;
        Some(self.first[self.count])
    }

    /// Puts the nearest of the children from `start` on last. Those beyond the ordinary stack may
    /// come in any order: it only costs time.
    #[inline(always)]
    fn sort_from(&mut self, start: usize) {
        for end in start + 1..self.count.min(ORDINARY_STACK) {
            // Without a branch that depends on the distances.
            for place in (start..end).rev() {
                let (one, other) = (self.first[place], self.first[place + 1]);
                (self.first[place], self.first[place + 1]) = (one.max(other), one.min(other));
            }
        }
    }
}
