//! Upper quantiles of the normal and of Student's distribution, for tail probabilities small enough that `1 - p` would
//! lose them.

use statrs::function::beta::beta_reg;
use statrs::function::erf::erfc_inv;
use statrs::function::gamma::ln_gamma;

/// From this many degrees of freedom on, the expansion about the normal quantile has no error that shows.
const MANY: f64 = 2000.0;

/// The value that a standard normal variable exceeds with probability `p` (0 < p < 1).
#[must_use]
pub fn normal_upper(p: f64) -> f64 {
    std::f64::consts::SQRT_2 * erfc_inv(2.0 * p)
}

/// The value that Student's t with `freedom >= 1` degrees of freedom exceeds with probability `p` (0 < p < 1/2).
#[must_use]
pub fn student_upper(p: f64, freedom: f64) -> f64 {
    let z = normal_upper(p);
    if freedom > MANY {
        return expanded(z, freedom);
    }
    // Newton on the logarithm of the tail against the logarithm of t. It is concave and falls, so the first step
    // leaves to the right of the root and all others approach it from there.
    let (mut x, target) = (z.max(0.1).ln(), p.ln());
    for _ in 0..60 {
        let t = x.exp();
        let tail = 0.5 * beta_reg(freedom / 2.0, 0.5, freedom / (freedom + t * t));
        let step = (tail.ln() - target) * tail / (density(t, freedom) * t);
        x += step;
        if step.abs() < 1e-14 {
            break;
        }
    }
    x.exp()
}

fn density(t: f64, freedom: f64) -> f64 {
    let half = freedom / 2.0;
    let log = ln_gamma(half + 0.5) - ln_gamma(half) - (half + 0.5) * (t * t / freedom).ln_1p();
    log.exp() / (freedom * std::f64::consts::PI).sqrt()
}

/// The expansion of the quantile in powers of 1 / freedom about the normal one `z` (Abramowitz and Stegun 26.7.5,
/// with the fifth term of Goldberg and Levine 1946).
fn expanded(z: f64, freedom: f64) -> f64 {
    let q = z * z;
    let g1 = (q + 1.0) / 4.0;
    let g2 = ((5.0 * q + 16.0) * q + 3.0) / 96.0;
    let g3 = (((3.0 * q + 19.0) * q + 17.0) * q - 15.0) / 384.0;
    let g4 = ((((79.0 * q + 776.0) * q + 1482.0) * q - 1920.0) * q - 945.0) / 92_160.0;
    let g5 = (((((27.0 * q + 339.0) * q + 930.0) * q - 1782.0) * q - 765.0) * q + 17_955.0) / 368_640.0;
    let f = 1.0 / freedom;
    z * (1.0 + f * (g1 + f * (g2 + f * (g3 + f * (g4 + f * g5)))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_of_the_textbooks_hold() {
        // Two-sided 5 % and 1 % points of Student's t as every table prints them.
        for (freedom, five, one) in [
            (1.0, 12.706_204_736, 63.656_741_162),
            (2.0, 4.302_652_730, 9.924_843_201),
            (5.0, 2.570_581_836, 4.032_142_984),
            (10.0, 2.228_138_852, 3.169_272_673),
            (30.0, 2.042_272_456, 2.749_995_654),
            (120.0, 1.979_930_405, 2.617_421_145),
        ] {
            assert!((student_upper(0.025, freedom) - five).abs() < 1e-8, "{freedom}");
            assert!((student_upper(0.005, freedom) - one).abs() < 1e-7, "{freedom}");
        }
        assert!((normal_upper(0.025) - 1.959_963_984_540_054).abs() < 1e-13);
        assert!((normal_upper(1e-9) - 5.997_807_015_008_182).abs() < 1e-11);
    }

    #[test]
    fn one_and_two_degrees_of_freedom_have_closed_forms() {
        for p in [0.24, 0.025, 1e-3, 1e-6, 1e-10] {
            let cauchy = 1.0 / (std::f64::consts::PI * p).tan();
            assert!((student_upper(p, 1.0) / cauchy - 1.0).abs() < 1e-11, "{p}");
            let two = (1.0 - 2.0 * p) / (2.0 * p * (1.0 - p)).sqrt();
            assert!((student_upper(p, 2.0) / two - 1.0).abs() < 1e-11, "{p}");
        }
    }

    #[test]
    fn the_expansion_meets_the_exact_quantile_where_it_takes_over() {
        for p in [0.25, 0.005, 1e-6, 1e-10] {
            let (exact, expanded) = (student_upper(p, MANY), expanded(normal_upper(p), MANY));
            assert!((exact / expanded - 1.0).abs() < 1e-11, "{p}: {exact} {expanded}");
        }
    }
}
