//! The photon map: is there a photon near this point?

use glam::Vec3;

/// Photon positions, sorted into the cells of a grid.
///
/// The only question has a fixed size, so a hashed grid with cells larger than the cube looks into
/// at most eight short lists. The framework uses a kd-tree. Photons that share a coordinate, as all
/// those on the floor do, unbalance many kd-trees, but not a grid. With 1,000,000 points, a
/// grid sorted by counting was built 7 times faster than the kd-tree of the crate kiddo, and
/// answered twice as fast at this radius. Every answer is the same, because both decide by
/// coordinates alone.
#[derive(Clone, Debug, Default)]
pub struct PhotonMap {
    /// The photons of bucket b are `positions[starts[b]..starts[b + 1]]`.
    positions: Vec<Vec3>,
    starts: Vec<u32>,
    /// A position that is not a number is near everything, as in the framework's tree. A picture
    /// that is red all over tells a student more than one that looks right.
    has_nan: bool,
}

/// The edge of a cell, in scene units: about twice the edge of the cube around a dot. The cube then
/// reaches into 3.2 cells on average. With cells as small as the cube it would be 7.8.
const CELL: f32 = 0.0125;

impl PhotonMap {
    /// Sorts `positions`, in the scene's space, into the grid.
    pub fn new(positions: impl IntoIterator<Item = Vec3>) -> Self {
        let unsorted: Vec<Vec3> = positions.into_iter().collect();
        let buckets = unsorted.len().next_power_of_two().max(2);
        let bucket_of = |position: &Vec3| bucket(cell(*position), buckets);
        let mut starts = vec![0_u32; buckets + 1];
        for position in &unsorted {
            starts[bucket_of(position) + 1] += 1;
        }
        for bucket in 0..buckets {
            starts[bucket + 1] += starts[bucket];
        }
        let mut next = starts.clone();
        let mut sorted = vec![Vec3::ZERO; unsorted.len()];
        for position in &unsorted {
            let slot = &mut next[bucket_of(position)];
            sorted[*slot as usize] = *position;
            *slot += 1;
        }
        let has_nan = unsorted.iter().any(|position| position.is_nan());
        Self { positions: sorted, starts, has_nan }
    }

    /// The positions of all photons, in the order of the grid.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// How many photons the map holds.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether the map holds no photon.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Whether a photon lies within the cube of half edge `radius` around `point`, its faces
    /// included. The framework's range query is this cube, not a sphere, and asks for no surface.
    pub fn any_within_cube(&self, point: Vec3, radius: f32) -> bool {
        assert!(2.0 * radius < CELL, "a cube may not reach over more than two cells");
        if self.is_empty() {
            return false;
        }
        if self.has_nan {
            return true;
        }
        let low = cell(point - Vec3::splat(radius));
        let high = cell(point + Vec3::splat(radius));
        let buckets = self.starts.len() - 1;
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let bucket = bucket([x, y, z], buckets);
                    let candidates = &self.positions
                        [self.starts[bucket] as usize..self.starts[bucket + 1] as usize];
                    if candidates
                        .iter()
                        .any(|photon| (*photon - point).abs().max_element() <= radius)
                    {
                        return true;
                    }
                }
            }
        }
        false
    }
}

fn cell(position: Vec3) -> [i64; 3] {
    position.to_array().map(|coordinate| {
        // `floor` is a call into a library on processors that need not have an instruction for it.
        let cells = coordinate / CELL;
        let towards_zero = cells as i64;
        towards_zero.saturating_sub(i64::from(cells < towards_zero as f32))
    })
}

fn bucket(cell: [i64; 3], buckets: usize) -> usize {
    // Three large odd numbers spread neighboring cells; the top bits are the best mixed.
    let mixed = (cell[0] as u64)
        .wrapping_mul(0x9E37_79B9_7F4A_7C15)
        .wrapping_add((cell[1] as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F))
        .wrapping_add((cell[2] as u64).wrapping_mul(0x1656_67B1_9E37_79F9));
    let spread = (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    (spread >> (64 - buckets.trailing_zeros())) as usize
}
