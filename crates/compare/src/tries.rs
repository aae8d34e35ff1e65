//! The numbers of the emission, drawn and taken as the handout has it, or as students do.

use glam::Vec3;

use variants::hypotheses::Hypothesis;
use variants::misreadings::misreadings;
use variants::reading::Reading;
use variants::sampling::Emission;

/// Which of the three numbers of a try is x, y and z, and which of them are turned to 1 - 2u.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tries {
    /// The places of x, y and z among the draws.
    pub order: [usize; 3],
    /// Whether x, y and z have the other sign.
    pub turned: [bool; 3],
    /// Which tries are taken.
    pub taken: Taken,
    /// Whether x, y and z are u itself, not 2u - 1. No fair reading, as all but [`Taken::Inside`].
    pub unscaled: bool,
}

/// Which tries of the emission are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// Those in the ball: the handout's.
    Inside,
    /// All of the cube.
    All,
    /// Those outside the ball.
    Outside,
}

impl Tries {
    /// The reference's.
    pub const REFERENCE: Self =
        Self { order: [0, 1, 2], turned: [false; 3], taken: Taken::Inside, unscaled: false };

    fn takes(&self, point: Vec3) -> bool {
        let squared = point.length_squared();
        squared > 0.0
            && match self.taken {
                Taken::Inside => squared <= 1.0,
                Taken::All => true,
                Taken::Outside => squared > 1.0,
            }
    }

    /// The tries, of which the last one is taken.
    pub(crate) fn until_taken(&self, rand: &mut impl FnMut() -> f32) -> Vec<Vec3> {
        let mut tries = Vec::new();
        while tries.last().is_none_or(|point| !self.takes(*point)) {
            tries.push(self.draw(rand));
        }
        tries
    }

    fn draw(&self, rand: &mut impl FnMut() -> f32) -> Vec3 {
        let drawn = [0; 3].map(|_| if self.unscaled { rand() } else { 2.0 * rand() - 1.0 });
        let coordinate = |axis: usize| {
            let number = drawn[self.order[axis]];
            if self.turned[axis] { -number } else { number }
        };
        Vec3::new(coordinate(0), coordinate(1), coordinate(2))
    }
}

/// What students do instead of drawing from the ball, with what it is called.
pub fn other_emissions(fair: Tries) -> Vec<(Tries, String)> {
    let of = |misreading: Hypothesis| {
        if misreading.variation.reading != Reading::REFERENCE {
            return None;
        }
        let tries = match misreading.variation.emission {
            Emission::Cube => Tries { taken: Taken::All, ..fair },
            Emission::Octant => Tries { unscaled: true, ..fair },
            Emission::OutsideSphere => Tries { taken: Taken::Outside, ..fair },
            _ => return None,
        };
        Some((tries, misreading.title))
    };
    let mut all: Vec<_> = misreadings().into_iter().filter_map(of).collect();
    let both = "x, y and z are never negative, and no try is rejected".to_owned();
    all.push((Tries { taken: Taken::All, unscaled: true, ..fair }, both));
    all
}
