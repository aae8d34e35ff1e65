//! The order of a ray's axes, as `ShearedRay::axes` has it, without its branches.

use glam::Vec3;

/// The axis along which `direction` runs farthest.
#[inline(always)]
pub fn axis_of(direction: Vec3) -> i32 {
    let size = direction.abs();
    // Both comparisons always, where `&&` would branch.
    let along_x = (size.x >= size.y) & (size.x >= size.z);
    let along_y = size.y >= size.z;
    if along_x {
        0
    } else if along_y {
        1
    } else {
        2
    }
}

/// The coordinates of `place` in the order of a ray that runs along `axis`.
#[inline(always)]
pub fn turn(axis: i32, place: Vec3) -> Vec3 {
    let (along_x, along_y) = (axis == 0, axis == 1);
    let choose = |x: f32, y: f32, z: f32| {
        if along_x {
            x
        } else if along_y {
            y
        } else {
            z
        }
    };
    let Vec3 { x, y, z } = place;
    Vec3::new(choose(y, z, x), choose(z, x, y), choose(x, y, z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use photon_mapping::scene::triangle::ShearedRay;

    #[test]
    fn the_order_is_that_of_a_sheared_ray() {
        let sizes = [-2.0, -1.0, -0.0, 0.0, 1.0, 2.0];
        for x in sizes {
            for y in sizes {
                for z in sizes {
                    let direction = Vec3::new(x, y, z);
                    let expected = ShearedRay::axes(direction).map(|axis| direction[axis]);
                    assert_eq!(turn(axis_of(direction), direction).to_array(), expected);
                }
            }
        }
    }
}
