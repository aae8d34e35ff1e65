//! A triangle, and the test whether a ray meets it.

use glam::Vec3;

use super::ray::Ray;

/// One triangle of a mesh, in the scene's space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// The corners.
    pub vertices: [Vec3; 3],
    /// The unit normal of the model file, or of the plane where the file gives none. It is never
    /// turned towards a ray.
    pub normal: Vec3,
    /// Which mesh object of the scene it belongs to: C++ `GetParentMeshObject()`.
    pub parent_mesh_object: usize,
    /// Which face of that mesh it is part of; a quad is one facet of two triangles.
    pub facet: usize,
}

/// What a ray brings to every triangle test: the axis along which it runs farthest becomes z, and
/// a shear makes it run along z alone.
#[derive(Clone, Copy, Debug)]
pub struct ShearedRay {
    origin: Vec3,
    direction: Vec3,
    start_error: f32,
    axes: [usize; 3],
    shear: Vec3,
}

impl ShearedRay {
    /// Prepares `ray`, whose direction must not be zero.
    pub fn new(ray: &Ray) -> Self {
        let direction = ray.ray_direction();
        let [x, y, z] = Self::axes(direction);
        let origin = ray.position();
        Self {
            origin: Vec3::new(origin[x], origin[y], origin[z]),
            direction,
            start_error: ray.start_error,
            axes: [x, y, z],
            shear: Vec3::new(
                direction[x] / direction[z],
                direction[y] / direction[z],
                1.0 / direction[z],
            ),
        }
    }

    /// The axes of the scene that are x, y and z for this ray.
    #[inline(always)]
    pub fn order(&self) -> [usize; 3] {
        self.axes
    }

    /// The shears along x and y, and the reciprocal of the direction along z.
    #[inline(always)]
    pub fn shear(&self) -> Vec3 {
        self.shear
    }

    /// The cosine of the ray's direction to `normal`: not above 0 where the ray meets the side it
    /// points to.
    #[inline(always)]
    pub fn cosine(&self, normal: Vec3) -> f32 {
        self.direction.dot(normal)
    }

    /// The axes of the scene that become x, y and z for a ray in `direction`.
    #[inline(always)]
    pub fn axes(direction: Vec3) -> [usize; 3] {
        let size = direction.abs();
        if size.x >= size.y && size.x >= size.z {
            [1, 2, 0]
        } else if size.y >= size.z {
            [2, 0, 1]
        } else {
            [0, 1, 2]
        }
    }

    /// Whether the ray meets a triangle at the distance `t` by what is known of its start: see
    /// [`Ray::start_error`]. The [`Self::cosine`] is that of the triangle's normal.
    #[inline(always)]
    pub fn reaches(&self, cosine: f32, t: f32) -> bool {
        if self.start_error == 0.0 {
            return t > 0.0;
        }
        if cosine <= 0.0 { t > -self.start_error } else { t * cosine > self.start_error }
    }

    /// `vertex` as the ray sees it: x and y across the ray, z along it in units of the ray's t.
    #[inline(always)]
    fn see(&self, vertex: &Vec3) -> Vec3 {
        let [x, y, z] = self.axes;
        let vertex: &[f32; 3] = vertex.as_ref();
        let depth = vertex[z] - self.origin.z;
        Vec3::new(
            vertex[x] - self.origin.x - self.shear.x * depth,
            vertex[y] - self.origin.y - self.shear.y * depth,
            self.shear.z * depth,
        )
    }
}

impl Triangle {
    fn edges(&self) -> [Vec3; 3] {
        let [a, b, c] = self.vertices;
        [b - a, c - b, a - c]
    }

    /// The length of the longest edge.
    pub fn longest_edge(&self) -> f32 {
        self.edges().map(Vec3::length).into_iter().fold(0.0, f32::max)
    }

    /// The height over the longest edge.
    pub fn width(&self) -> f32 {
        let [a, b, _] = self.edges();
        a.cross(b).length() / self.longest_edge()
    }

    /// The distance t at which `ray` meets the triangle, from either side; `None` when it passes
    /// beside it, within its plane, or when the triangle lies behind the ray's start: t > 0,
    /// but for the [`Ray::start_error`].
    ///
    /// The framework uses the test of Moller and Trumbore, which can let a ray slip between two
    /// triangles that share an edge. This is the watertight test of Woop, Benthin and Wald
    /// (*Watertight Ray/Triangle Intersection*, JCGT 2013): seen along the ray, the sign of each
    /// edge function is exact, so the two triangles at an edge can never both refuse a ray.
    pub fn intersect(&self, ray: &ShearedRay) -> Option<f32> {
        let [a, b, c] = &self.vertices;
        let t = meet([ray.see(a), ray.see(b), ray.see(c)])?;
        ray.reaches(ray.cosine(self.normal), t).then_some(t)
    }

    /// Whether the two have a corner in common, or `other` lies in this one's plane, no farther
    /// than `rounding`.
    pub fn touches(&self, other: &Self, rounding: f32) -> bool {
        let height = |corner: Vec3| self.normal.dot(corner - self.vertices[0]);
        self.vertices.iter().any(|corner| other.vertices.contains(corner))
            || other.vertices.iter().all(|corner| height(*corner).abs() <= rounding)
    }

    /// Whether a ray in `direction` meets the side to which the normal points.
    pub fn faces(&self, direction: Vec3) -> bool {
        direction.dot(self.normal) <= 0.0
    }
}

/// The test of [`Triangle::intersect`] for the corners `a`, `b` and `c` as the ray sees them: the
/// distance may be 0 or less, or not a number.
#[inline(always)]
pub fn meet([a, b, c]: [Vec3; 3]) -> Option<f32> {
    let mut u = c.x * b.y - c.y * b.x;
    let mut v = a.x * c.y - a.y * c.x;
    let mut w = b.x * a.y - b.y * a.x;
    if (u == 0.0) | (v == 0.0) | (w == 0.0) {
        // Rounding is monotonic: a difference of two rounded products has the right sign or is
        // zero. In f64 the products are exact, so there even the zeros are true.
        u = exact_edge(c, b);
        v = exact_edge(a, c);
        w = exact_edge(b, a);
    }
    let any_negative = (u < 0.0) | (v < 0.0) | (w < 0.0);
    let any_positive = (u > 0.0) | (v > 0.0) | (w > 0.0);
    if any_negative & any_positive {
        return None;
    }
    let determinant = u + v + w;
    if determinant == 0.0 {
        return None;
    }
    Some((u * a.z + v * b.z + w * c.z) / determinant)
}

fn exact_edge(p: Vec3, q: Vec3) -> f32 {
    let (p, q) = (p.as_dvec3(), q.as_dvec3());
    (p.x * q.y - p.y * q.x) as f32
}
