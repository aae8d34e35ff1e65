//! Where in a scene no photon is near, told faster than by the photon map.

use glam::Vec3;

use photon_mapping::rendering::photon_map::PhotonMap;

/// The edge of a cell, in scene units: some times that of the cube around a dot, so that this
/// mostly reaches into one.
const CELL: f32 = 0.025;
/// Bits for every photon, so that few cells without one share a bit with others.
const BITS: usize = 64;

/// A bit for every cell of a grid, by a hash of its place: whether a point in it may be near a
/// photon.
#[derive(Clone, Debug)]
pub struct Neighborhood {
    words: Vec<u32>,
    shift: u32,
}

impl Neighborhood {
    /// The cells that the cubes of half edge `radius` around the photons of `map` reach into.
    ///
    /// Rounding is monotonic, and so are the cells along an axis. So the cell of a point between
    /// two others lies between theirs. A little more than `radius` covers the rounding of the
    /// distance that [`PhotonMap::any_within_cube`] compares.
    pub fn new(map: &PhotonMap, radius: f32) -> Self {
        let bits = (BITS * map.len()).next_power_of_two().clamp(1 << 10, 1 << 20);
        let mut marked = Self { words: vec![0; bits / 32], shift: 32 - bits.trailing_zeros() };
        if map.positions().iter().any(|position| position.is_nan()) {
            // Then every point is near.
            marked.words.fill(u32::MAX);
        }
        let reach = Vec3::splat(1.001 * radius);
        for position in map.positions() {
            let (low, high) = (cell(*position - reach), cell(*position + reach));
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    for z in low[2]..=high[2] {
                        let (word, bit) = marked.place([x, y, z]);
                        marked.words[word] |= bit;
                    }
                }
            }
        }
        marked
    }

    /// Whether a photon may be near `point`.
    #[inline(always)]
    pub fn may_have(&self, point: Vec3) -> bool {
        let (word, bit) = self.place(cell(point));
        self.words[word] & bit != 0
    }

    #[inline(always)]
    fn place(&self, [x, y, z]: [i32; 3]) -> (usize, u32) {
        // Three large odd numbers spread neighboring cells; the top bits are the best mixed.
        let mixed = (x as u32)
            .wrapping_mul(0x9E37_79B1)
            .wrapping_add((y as u32).wrapping_mul(0x85EB_CA77))
            .wrapping_add((z as u32).wrapping_mul(0xC2B2_AE3D));
        let place = mixed >> self.shift;
        ((place / 32) as usize, 1 << (place % 32))
    }
}

#[inline(always)]
fn cell(point: Vec3) -> [i32; 3] {
    point.to_array().map(|coordinate| (coordinate * (1.0 / CELL)) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use photon_mapping::random::photon_random;

    #[test]
    fn no_point_near_a_photon_is_left_out() {
        const RADIUS: f32 = 0.003;
        let (mut near, mut far) = (0, 0);
        for number in 0..200 {
            let mut random = photon_random(13, number);
            let scale = [0.1, 1.0, 300.0][number as usize % 3];
            let mut point = || Vec3::from_array([0; 3].map(|_| scale * (random() - 0.5)));
            let photons: Vec<Vec3> = (0..30).map(|_| point()).collect();
            let map = PhotonMap::new(photons.iter().copied());
            let neighborhood = Neighborhood::new(&map, RADIUS);
            for photon in photons {
                let aside = [RADIUS, -RADIUS, 0.999 * RADIUS, 0.0, 0.7 * RADIUS, 1.001 * RADIUS];
                for (x, y) in aside.iter().zip(aside.iter().cycle().skip(1)) {
                    let point = photon + Vec3::new(*x, *y, 0.5 * x);
                    if map.any_within_cube(point, RADIUS) {
                        near += 1;
                        assert!(neighborhood.may_have(point), "{point:?}");
                    }
                }
            }
            far += (0..100).filter(|_| !neighborhood.may_have(point())).count();
        }
        assert!(near > 10_000 && far > 10_000, "{near} {far}");
    }

    #[test]
    fn every_point_is_near_what_is_not_a_number() {
        let map = PhotonMap::new([Vec3::NAN, Vec3::ONE]);
        assert!(Neighborhood::new(&map, 0.003).may_have(Vec3::splat(7.0)));
    }
}
