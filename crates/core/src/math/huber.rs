//! Huber's scale over the latest residuals, step by step: \[001\] eqs. (27)-(34).

use super::tie::TIE;
use statrs::distribution::{Continuous, ContinuousCDF, Normal};

/// How residuals beyond c scales enter the next scale.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Update {
    /// As c scales.
    Winsor,
    /// Not at all: eq. (34) of \[001\] as printed.
    Printed,
}

/// `2 Phi(c) - 1 - 2 c phi(c) + 2 c^2 (1 - Phi(c))`: the mean of min(x^2, c^2) for standard normal x; 0.7785 at
/// c = 1.5 (\[001\] eq. (31)).
#[must_use]
pub fn beta(c: f64) -> f64 {
    let normal = Normal::standard();
    let (cdf, pdf) = (normal.cdf(c), normal.pdf(c));
    2.0 * cdf - 1.0 - 2.0 * c * pdf + 2.0 * c * c * (1.0 - cdf)
}

/// The scale of the last this many residuals, each step from the one before.
#[derive(Debug, Clone)]
pub struct HuberScale {
    /// Squared residuals in a ring of `window`, then zeros up to whole lanes.
    squares: Vec<f64>,
    window: usize,
    next: usize,
    seen: usize,
    c: f64,
    /// Number of residuals times beta.
    n_beta: f64,
    update: Update,
    /// Squares of the initial scale, of the least one, and of the scale now: the root is only taken for the caller.
    initial: f64,
    floor: f64,
    square: f64,
}

/// Sums run in this many lanes of fixed order.
const LANES: usize = 8;

impl HuberScale {
    /// A scale over `window` residuals, `initial` until there are this many, at least `floor` afterwards.
    #[must_use]
    pub fn new(window: usize, c: f64, update: Update, initial: f64, floor: f64) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "windows are small")]
        let n = window as f64;
        Self {
            squares: vec![0.0; window.next_multiple_of(LANES)],
            window,
            next: 0,
            seen: 0,
            c,
            n_beta: n * beta(c),
            update,
            initial: initial * initial,
            floor: floor * floor,
            square: initial * initial,
        }
    }

    /// Forgets all residuals.
    pub fn reset(&mut self) {
        self.next = 0;
        self.seen = 0;
        self.square = self.initial;
    }

    /// Takes in a residual.
    #[inline]
    pub fn push(&mut self, residual: f64) {
        self.squares[self.next] = residual * residual;
        self.next = if self.next + 1 == self.window { 0 } else { self.next + 1 };
        self.seen += 1;
    }

    /// The scale for the next residual, from the residuals so far and the scale before.
    #[inline]
    pub fn advance(&mut self) -> f64 {
        if self.seen >= self.window {
            let limit = self.c * self.c * self.square;
            let square = match self.update {
                Update::Winsor => sum_below(&self.squares, limit) / self.n_beta,
                Update::Printed => self.printed(limit),
            };
            let square = square.max(self.floor);
            if square > 0.0 {
                self.square = square;
            }
        }
        self.square.sqrt()
    }

    /// Eq. (34); `limit` is squared.
    fn printed(&self, limit: f64) -> f64 {
        let reach = limit * (1.0 + TIE) * (1.0 + TIE);
        let (mut sum, mut beyond) = (0.0, 0.0);
        for &square in &self.squares {
            if square <= reach {
                sum += square;
            } else {
                beyond += 1.0;
            }
        }
        let divisor = self.n_beta - beyond * self.c * self.c;
        // Too many beyond the limit: the divisor says nothing any more and the scale stays.
        if divisor < self.n_beta / 2.0 * (1.0 - TIE) { self.square } else { sum / divisor }
    }
}

/// Sum of min(square, most).
#[inline]
fn sum_below(squares: &[f64], most: f64) -> f64 {
    let mut sums = [0.0; LANES];
    for chunk in squares.chunks_exact(LANES) {
        for (sum, square) in sums.iter_mut().zip(chunk) {
            *sum += if *square < most { *square } else { most };
        }
    }
    ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residuals_beyond_the_limit_count_as_the_limit_or_not_at_all() {
        let mut winsor = HuberScale::new(16, 1.5, Update::Winsor, 1.0, 0.0);
        let mut printed = HuberScale::new(16, 1.5, Update::Printed, 1.0, 0.0);
        for scale in [&mut winsor, &mut printed] {
            (0..15).for_each(|i| scale.push(if i % 2 == 0 { 1.0 } else { -1.0 }));
            assert!((scale.advance() - 1.0).abs() < 1e-15, "not yet 16");
            scale.push(100.0);
        }
        let n_beta = 16.0 * beta(1.5);
        assert!((winsor.advance() - ((15.0 + 2.25) / n_beta).sqrt()).abs() < 1e-12);
        assert!((printed.advance() - (15.0 / (n_beta - 2.25)).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_zero_scale_is_not_taken_and_the_floor_holds() {
        let mut scale = HuberScale::new(16, 1.5, Update::Winsor, 1.0, 0.0);
        (0..16).for_each(|_| scale.push(0.0));
        assert!((scale.advance() - 1.0).abs() < 1e-15);
        let mut scale = HuberScale::new(16, 1.5, Update::Winsor, 1.0, 0.3);
        (0..16).for_each(|_| scale.push(0.0));
        assert!((scale.advance() - 0.3).abs() < 1e-15);
    }
}
