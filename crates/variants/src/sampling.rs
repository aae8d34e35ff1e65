//! Ways to sample a direction, right and wrong, from numbers in [0, 1).

use std::f32::consts::{FRAC_PI_2, PI};

use glam::{Mat3, Vec3};

/// How a direction from the light is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Emission {
    /// Evenly over the sphere: the handout's.
    #[default]
    Sphere,
    /// From the whole cube.
    Cube,
    /// From the cube outside the sphere.
    OutsideSphere,
    /// From the cube, below the plane x + y + z = 1.
    BelowPlane,
    /// x, y and z are all positive.
    Octant,
    /// Downward.
    Down,
    /// Upward.
    Up,
    /// With the polar angle pi u about the y axis.
    PolarAboutY,
    /// The same about the z axis.
    PolarAboutZ,
}

impl Emission {
    /// The unit vector that comes of the next numbers of `rand`.
    pub fn direction(self, rand: &mut impl FnMut() -> f32) -> Vec3 {
        if matches!(self, Self::PolarAboutY | Self::PolarAboutZ) {
            let [x, y, z] = polar(PI * rand(), 2.0 * PI * rand()).to_array();
            return if self == Self::PolarAboutY { Vec3::new(x, z, y) } else { Vec3::new(x, y, z) };
        }
        loop {
            let numbers = Vec3::new(rand(), rand(), rand());
            let point = if self == Self::Octant { numbers } else { 2.0 * numbers - 1.0 };
            let is_inside = point.length_squared() <= 1.0;
            let is_accepted = match self {
                Self::Cube => true,
                Self::OutsideSphere => !is_inside,
                Self::BelowPlane => point.element_sum() <= 1.0,
                Self::Down => is_inside && point.z < 0.0,
                Self::Up => is_inside && point.z > 0.0,
                _ => is_inside,
            };
            if is_accepted && point != Vec3::ZERO {
                return point.normalize();
            }
        }
    }
}

/// How a direction over the surface is sampled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hemisphere {
    /// In proportion to the cosine: the handout's.
    #[default]
    Cosine,
    /// Evenly.
    Uniform,
    /// With r = u1 instead of its square root, normalized.
    NoSquareRoot,
    /// With r = u1, on the unit sphere.
    NoSquareRootOnSphere,
    /// With z = 1 - u1 instead of its square root, normalized.
    NoSquareRootOfHeight,
    /// With the polar angle pi/2 u1.
    LinearAngle,
    /// With the azimuth pi u2.
    HalfAzimuth,
    /// With u2 = u1.
    SameNumbers,
    /// With the roulette's number for u1.
    NumberOfRoulette,
    /// Along the normal.
    AlongNormal,
    /// The normal and a point of the unit ball.
    NormalAndBall,
    /// The normal and a point of the cube.
    NormalAndCube,
    /// A point of the cube, turned to the upper side.
    UpperCube,
    /// Evenly over the whole sphere.
    Sphere,
    /// The normal and three numbers of the normal law.
    NormalAndGaussian,
    /// With the polar angle pi u1.
    WholeAngle,
}

impl Hemisphere {
    /// A direction over a surface, of any length, for the roulette's `number` and the next of
    /// `rand`. `frame` leads from tangent space to world space.
    pub fn direction(
        self,
        normal: Vec3,
        frame: &Mat3,
        number: f32,
        rand: &mut impl FnMut() -> f32,
    ) -> Vec3 {
        match self {
            Self::NormalAndBall => normal + Emission::Sphere.direction(rand) * libm::cbrtf(rand()),
            Self::NormalAndCube => normal + in_cube(rand),
            Self::UpperCube => {
                let point = in_cube(rand);
                point * point.dot(normal).signum()
            }
            Self::Sphere => Emission::Sphere.direction(rand),
            Self::NormalAndGaussian => {
                normal + Vec3::new(gaussian(rand), gaussian(rand), gaussian(rand))
            }
            _ => *frame * self.in_tangent_space(number, rand),
        }
    }

    fn in_tangent_space(self, number: f32, rand: &mut impl FnMut() -> f32) -> Vec3 {
        let (u1, u2) = (rand(), rand());
        let azimuth = 2.0 * PI * u2;
        let round = |r: f32, azimuth: f32, z: f32| {
            Vec3::new(r * libm::cosf(azimuth), r * libm::sinf(azimuth), z)
        };
        let cosine = |u1: f32, azimuth| round(u1.sqrt(), azimuth, (1.0 - u1).sqrt());
        match self {
            Self::Uniform => round((1.0 - u1 * u1).sqrt(), azimuth, u1),
            Self::NoSquareRoot => round(u1, azimuth, (1.0 - u1).sqrt()),
            Self::NoSquareRootOnSphere => round(u1, azimuth, (1.0 - u1 * u1).sqrt()),
            Self::NoSquareRootOfHeight => round(u1.sqrt(), azimuth, 1.0 - u1),
            Self::LinearAngle => polar(FRAC_PI_2 * u1, azimuth),
            Self::WholeAngle => polar(PI * u1, azimuth),
            Self::HalfAzimuth => cosine(u1, PI * u2),
            Self::SameNumbers => cosine(u1, 2.0 * PI * u1),
            Self::NumberOfRoulette => cosine(number, 2.0 * PI * u1),
            Self::AlongNormal => Vec3::Z,
            _ => cosine(u1, azimuth),
        }
    }

    /// Whether it needs t and b.
    pub fn uses_frame(self) -> bool {
        !matches!(self, Self::AlongNormal | Self::NormalAndCube | Self::UpperCube)
            && !matches!(self, Self::NormalAndBall | Self::NormalAndGaussian | Self::Sphere)
    }

    /// Whether some directions are below the surface.
    pub fn goes_below(self) -> bool {
        matches!(self, Self::Sphere | Self::NormalAndGaussian | Self::WholeAngle)
    }
}

fn polar(angle: f32, azimuth: f32) -> Vec3 {
    let (sine, cosine) = (libm::sinf(angle), libm::cosf(angle));
    Vec3::new(sine * libm::cosf(azimuth), sine * libm::sinf(azimuth), cosine)
}

fn in_cube(rand: &mut impl FnMut() -> f32) -> Vec3 {
    2.0 * Vec3::new(rand(), rand(), rand()) - 1.0
}

/// A number of the normal law (Box and Muller).
fn gaussian(rand: &mut impl FnMut() -> f32) -> f32 {
    let (u1, u2) = (1.0 - rand(), rand());
    (-2.0 * libm::logf(u1)).sqrt() * libm::cosf(2.0 * PI * u2)
}
