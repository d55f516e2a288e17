//! Gains of the alpha-beta-gamma filter: section 4 of `docs/methods.md`, \[001\] eqs. (23)-(25).

/// Gains of position, velocity and acceleration; the latter two are divided by the step and its square when they
/// are applied.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gains {
    /// Of the position.
    pub a: f64,
    /// Of the velocity times the step.
    pub b: f64,
    /// Of the acceleration times the squared step.
    pub g: f64,
}

/// Gains of a growing memory with the `j`-th sample (from 3): the filter is then the least-squares parabola through
/// all samples so far.
#[must_use]
pub fn growing(j: usize) -> Gains {
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let j = j as f64;
    let all = j * (j + 1.0) * (j + 2.0);
    Gains { a: 3.0 * (3.0 * j * j - 3.0 * j + 2.0) / all, b: 18.0 * (2.0 * j - 1.0) / all, g: 60.0 / all }
}

/// Steady gains for the position gain `alpha` in (0, 1): those of a Kalman filter in its steady state.
#[must_use]
pub fn steady(alpha: f64) -> Gains {
    let b = 2.0 * (2.0 - alpha) - 4.0 * (1.0 - alpha).sqrt();
    Gains { a: alpha, b, g: b * b / (2.0 * alpha) }
}

/// The gains for the `j`-th sample: growing until their `a` has come down to `alpha`, steady from then on.
#[must_use]
pub fn at(j: usize, alpha: f64) -> Gains {
    let growing = growing(j);
    if growing.a <= alpha { steady(alpha) } else { growing }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_third_sample_is_met_exactly_and_the_memory_then_grows() {
        let third = growing(3);
        assert_eq!((third.a, third.b, third.g), (1.0, 1.5, 1.0), "the exact parabola");
        assert!((growing(4).a - 0.95).abs() < 1e-15, "the leverage of the last of four points on a parabola");
    }

    #[test]
    fn gains_are_steady_once_alpha_is_reached() {
        let first = (3..).find(|&j| growing(j).a <= 0.4).unwrap_or_default();
        assert_eq!(at(first, 0.4), steady(0.4));
        assert_eq!(at(first - 1, 0.4), growing(first - 1));
    }
}
