//! Quadrature over triangles: two fixed rules, graded subdivision towards a near point, and
//! adaptive cubature.

use super::polygon::{bisect, fan, longest_edge};
use glam::DVec3;
use rayon::prelude::*;

/// Points of a rule as barycentric coordinates, weights that sum to 1.
pub struct TriangleRule {
    points: Vec<([f64; 3], f64)>,
}

impl TriangleRule {
    /// Radon's seven-point rule (1948), exact to degree 5.
    pub fn radon() -> Self {
        let root = 15f64.sqrt();
        let mut points = vec![([1.0 / 3.0; 3], 9.0 / 40.0)];
        for (a, weight) in [
            ((6.0 - root) / 21.0, (155.0 - root) / 1200.0),
            ((6.0 + root) / 21.0, (155.0 + root) / 1200.0),
        ] {
            let b = 1.0 - 2.0 * a;
            points.extend([([b, a, a], weight), ([a, b, a], weight), ([a, a, b], weight)]);
        }
        Self { points }
    }

    /// Three points, exact to degree 2 (Strang and Fix 1973): for functions that are dear.
    pub fn cheap() -> Self {
        let (far, near) = (2.0 / 3.0, 1.0 / 6.0);
        let points = [[far, near, near], [near, far, near], [near, near, far]];
        Self { points: points.map(|point| (point, 1.0 / 3.0)).to_vec() }
    }

    /// Product of two Gauss-Legendre rules of `order` points, the square folded onto the triangle
    /// (Duffy 1982); exact to degree 2 `order` - 2.
    pub fn folded(order: usize) -> Self {
        let line = gauss_legendre(order);
        let mut points = Vec::with_capacity(order * order);
        for &(u, wu) in &line {
            for &(v, wv) in &line {
                points.push(([1.0 - u, u * (1.0 - v), u * v], 2.0 * u * wu * wv));
            }
        }
        Self { points }
    }

    /// Points of the rule on `triangle`, with weights that sum to its area.
    pub fn on(&self, triangle: [DVec3; 3]) -> impl Iterator<Item = (DVec3, f64)> + '_ {
        let [a, b, c] = triangle;
        let area = 0.5 * (b - a).cross(c - a).length();
        self.points.iter().map(move |&([x, y, z], weight)| (a * x + b * y + c * z, weight * area))
    }

    /// Visits the rule's points on triangles that tile `polygon`, each no longer than `ratio` times
    /// its distance from every one of `poles`, points where the integrand may be steep.
    pub fn graded(
        &self,
        polygon: &[DVec3],
        poles: &[DVec3],
        ratio: f64,
        visit: &mut impl FnMut(DVec3, f64),
    ) {
        for triangle in fan(polygon) {
            self.graded_triangle(triangle, poles, ratio * ratio, MAX_DEPTH, visit);
        }
    }

    fn graded_triangle(
        &self,
        triangle: [DVec3; 3],
        poles: &[DVec3],
        ratio_squared: f64,
        depth: u32,
        visit: &mut impl FnMut(DVec3, f64),
    ) {
        let center = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        let (_, length_squared) = longest_edge(&triangle);
        let is_near = poles
            .iter()
            .any(|&pole| length_squared > ratio_squared * pole.distance_squared(center));
        if is_near && depth > 0 {
            for half in bisect(&triangle) {
                self.graded_triangle(half, poles, ratio_squared, depth - 1, visit);
            }
        } else {
            self.on(triangle).for_each(|(point, weight)| visit(point, weight));
        }
    }
}

/// Enough halvings to shrink a triangle to the tolerance that points are told apart with.
const MAX_DEPTH: u32 = 60;

/// Gauss-Legendre nodes and weights on [0, 1], by Newton's method on the recurrence (Press et al.,
/// gauleg).
fn gauss_legendre(order: usize) -> Vec<(f64, f64)> {
    let n = order as f64;
    (0..order)
        .map(|i| {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..100 {
                let (mut here, mut before) = (1.0, 0.0);
                for j in 1..=order {
                    let j = j as f64;
                    (here, before) = (((2.0 * j - 1.0) * x * here - (j - 1.0) * before) / j, here);
                }
                slope = n * (x * here - before) / (x * x - 1.0);
                let step = here / slope;
                x -= step;
                if step.abs() < 1e-15 {
                    break;
                }
            }
            (0.5 + 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope))
        })
        .collect()
}

/// A vector of integrals, each with a bound on its error.
pub struct Integral {
    pub values: Vec<f64>,
    pub errors: Vec<f64>,
}

/// A triangle of the adaptive cubature, its integral, and those of its four quarters.
struct CubatureElement {
    tag: usize,
    quarters: [([DVec3; 3], Vec<f64>); 4],
    errors: Vec<f64>,
    error: f64,
}

/// Integrates a vector of `count` functions over tagged triangles.
///
/// Each triangle is compared with its four quarters. While the errors sum to more than `tolerance`,
/// quarters replace the triangles that cause most of it. Values are the quarters' sums. Ends early,
/// with a larger error, after `most` evaluations.
///
/// The error of a value is the whole difference from its parent. That is three times the true error
/// where the integrand has a kink or jumps at a point, because four quarters err a fourth of the
/// whole. Where the integrand is smooth, the true error is far less. Parent and quarters both miss
/// narrow features between their points. In the handout's scene these bring the sum of all such
/// errors, without regard to sign, down to about the error that is left.
pub fn integrate(
    rule: &TriangleRule,
    triangles: Vec<(usize, [DVec3; 3])>,
    count: usize,
    tolerance: f64,
    most: usize,
    integrand: impl Fn(usize, DVec3) -> Vec<f64> + Sync,
) -> Integral {
    let sum = |tag: usize, triangle: [DVec3; 3]| {
        let mut total = vec![0.0; count];
        for (point, weight) in rule.on(triangle) {
            for (total, value) in total.iter_mut().zip(integrand(tag, point)) {
                *total += weight * value;
            }
        }
        total
    };
    let element = |tag: usize, triangle: [DVec3; 3], whole: Vec<f64>| {
        let [left, right] = bisect(&triangle);
        let ([a, b], [c, d]) = (bisect(&left), bisect(&right));
        let quarters = [a, b, c, d].map(|quarter| (quarter, sum(tag, quarter)));
        let errors: Vec<f64> = (0..count)
            .map(|i| (whole[i] - quarters.iter().map(|(_, q)| q[i]).sum::<f64>()).abs())
            .collect();
        CubatureElement { tag, error: errors.iter().sum(), quarters, errors }
    };
    let mut elements: Vec<CubatureElement> = triangles
        .into_par_iter()
        .map(|(tag, triangle)| element(tag, triangle, sum(tag, triangle)))
        .collect();
    let mut evaluations = elements.len() * 5 * rule.points.len();
    loop {
        elements.sort_by(|a, b| a.error.total_cmp(&b.error));
        let mut kept_sum = 0.0;
        let total: f64 = elements.iter().map(|e| e.error).sum();
        if total <= tolerance {
            break;
        }
        let kept = elements
            .iter()
            .take_while(|e| {
                kept_sum += e.error;
                kept_sum <= 0.5 * tolerance
            })
            .count();
        let refined = elements.split_off(kept.min(elements.len() - 1));
        evaluations += refined.len() * 16 * rule.points.len();
        if evaluations > most {
            elements.extend(refined);
            break;
        }
        let fresh: Vec<[CubatureElement; 4]> = refined
            .into_par_iter()
            .map(|e| e.quarters.map(|(triangle, whole)| element(e.tag, triangle, whole)))
            .collect();
        elements.extend(fresh.into_iter().flatten());
    }
    let mut result = Integral { values: vec![0.0; count], errors: vec![0.0; count] };
    for element in &elements {
        for i in 0..count {
            result.values[i] += element.quarters.iter().map(|(_, q)| q[i]).sum::<f64>();
            result.errors[i] += element.errors[i];
        }
    }
    result
}
