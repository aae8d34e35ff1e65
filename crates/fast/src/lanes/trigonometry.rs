//! Sine and cosine with the bits of `libm::sinf` and `libm::cosf`, without their branches.

use std::f64::consts::FRAC_PI_2;

/// Sine and cosine of `angle`, in radians and in [0, 2 pi].
///
/// The arithmetic of FreeBSD's msun, of which `libm` is a port (`s_sinf.c`, `k_sinf.c`, `k_cosf.c`;
/// Sun Microsystems 1993, converted by Ian Lance Taylor, optimized by Bruce D. Evans). It takes the
/// nearest multiple of pi / 2 off the angle in f64, and sums one polynomial for each function in
/// f64. A test compares every angle that a photon can draw.
#[inline(always)]
pub fn sine_and_cosine(angle: f32) -> (f32, f32) {
    let x = f64::from(angle);
    // The same limits as msun: the floats next to the odd multiples of pi / 4.
    let bits = angle.to_bits();
    let quarter = i32::from(bits > 0x3f49_0fda)
        + i32::from(bits > 0x4016_cbe3)
        + i32::from(bits > 0x407b_53d1)
        + i32::from(bits > 0x40af_eddf);
    let rest = x - f64::from(quarter) * FRAC_PI_2;
    let (sine, cosine) = (sine_near_zero(rest), cosine_near_zero(rest));
    // Negating is exact, and both polynomials are odd or even to the last bit. Masks and sign bits
    // keep the compiler from branching where it should stay in lanes.
    let quarter = quarter as u32;
    let swap = (quarter & 1).wrapping_neg();
    let difference = (sine.to_bits() ^ cosine.to_bits()) & swap;
    let sine_sign = (quarter & 2) << 30;
    let cosine_sign = ((quarter + 1) & 2) << 30;
    let sine = f32::from_bits(sine.to_bits() ^ difference ^ sine_sign);
    let cosine = f32::from_bits(cosine.to_bits() ^ difference ^ cosine_sign);
    // Below 2^-12 msun gives the angle and 1. There the polynomials round to the same.
    (sine, cosine)
}

#[inline(always)]
fn sine_near_zero(x: f64) -> f32 {
    const S1: f64 = -0.166_666_666_416_265_24;
    const S2: f64 = 0.008_333_329_385_889_463;
    const S3: f64 = -0.000_198_393_348_360_966_32;
    const S4: f64 = 0.000_002_718_311_493_989_822;
    let z = x * x;
    let w = z * z;
    let r = S3 + z * S4;
    let s = z * x;
    ((x + s * (S1 + z * S2)) + s * w * r) as f32
}

#[inline(always)]
fn cosine_near_zero(x: f64) -> f32 {
    const C0: f64 = -0.499_999_997_251_031;
    const C1: f64 = 0.041_666_623_323_739_06;
    const C2: f64 = -0.001_388_676_377_460_993;
    const C3: f64 = 0.000_024_390_448_796_277_41;
    let z = x * x;
    let w = z * z;
    let r = C2 + z * C3;
    (((1.0 + z * C0) + w * C1) + (w * z) * r) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_angle_a_photon_can_draw_has_the_bits_of_libm() {
        for number in 0..1 << 24 {
            let u2 = number as f32 * (1.0 / 16_777_216.0);
            let angle = 2.0 * std::f32::consts::PI * u2;
            let (sine, cosine) = sine_and_cosine(angle);
            assert_eq!(sine.to_bits(), libm::sinf(angle).to_bits(), "sine of {angle:?}");
            assert_eq!(cosine.to_bits(), libm::cosf(angle).to_bits(), "cosine of {angle:?}");
        }
    }
}
