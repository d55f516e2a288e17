//! The natural cubic smoothing spline (Reinsch), in linear time. By hand: nalgebra has no banded matrices, and its dense
//! Cholesky takes cubic time (the tests compare with it).

use std::ops::Range;

use super::pieces::{Check, PIECE};

/// The smoothing parameter that halves the power at a period of 20 intervals: (20 / (2 pi))^4.
pub const HALF_POWER_AT_20: f64 = 102.659_822_546_843_39;

/// Samples worked on at a time; between them the elimination keeps what it carries on.
const BLOCK: usize = PIECE;

/// Sample standard deviation (divisor n - 1) of `y` minus its smoothing spline with half power at a period of
/// 20 intervals; 0 with fewer than three samples. The spline f minimises `sum (y - f)^2 + lambda * integral f''^2`,
/// with time in units of `interval`; `t` must increase.
///
/// # Errors
/// What `check` gives, which is asked before each piece of work.
pub fn residual_deviation<E>(t: &[f64], y: &[f64], interval: f64, check: &impl Check<E>) -> Result<f64, E> {
    if y.len() < 3 {
        return Ok(0.0);
    }
    let bands = Bands { t, y, unit: interval, lambda: HALF_POWER_AT_20 };
    let mut residuals = bands.solve(check)?;
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let n = y.len() as f64;
    let mean = bands.sum_of_residuals(&mut residuals, check)? / n;
    let mut squares = 0.0;
    for piece in residuals.chunks(PIECE) {
        check()?;
        piece.iter().for_each(|r| squares += (r - mean) * (r - mean));
    }
    Ok((squares / (n - 1.0)).sqrt())
}

/// Reinsch: `(R + lambda Q'Q) gamma = Q'y`, `f = y - lambda Q gamma`. The matrix has five bands and is positive
/// definite; gamma holds the second derivatives at the inner samples. It is the only list that is kept whole: at ten
/// million samples each costs 80 MB, and the elimination gives three more, which are worked out twice instead.
struct Bands<'a> {
    t: &'a [f64],
    y: &'a [f64],
    unit: f64,
    lambda: f64,
}

/// Steps of the time from a row of a block on, and what 1 is divided by them.
struct Steps {
    begin: usize,
    h: Vec<f64>,
    inverse: Vec<f64>,
}

impl Steps {
    /// Row j of Q' has `1/h[j]`, `-1/h[j] - 1/h[j+1]`, `1/h[j+1]` at j, j+1, j+2.
    #[inline]
    fn q(&self, j: usize) -> [f64; 3] {
        let (a, c) = (self.inverse[j - self.begin], self.inverse[j + 1 - self.begin]);
        [a, -a - c, c]
    }
}

/// What the elimination of a row takes off the two after it.
#[derive(Debug, Clone, Copy, Default)]
struct Carried {
    /// Off the main band, the first band and the right side of the next row.
    next: [f64; 3],
    /// Off the main band and the right side of the next row, by the row two before that.
    also: [f64; 2],
    /// Off the main band and the right side of the row after the next.
    second: [f64; 2],
}

impl Bands<'_> {
    fn rows(&self) -> usize {
        self.y.len() - 2
    }

    /// A value less the first one: the spline of y - c is that of y minus c, so that an offset costs no digits.
    #[inline]
    fn value(&self, i: usize) -> f64 {
        self.y[i] - self.y[0]
    }

    /// The steps that the rows of a block need.
    fn steps(&self, rows: &Range<usize>) -> Steps {
        let t = &self.t[rows.start..(rows.end + 4).min(self.t.len())];
        let h: Vec<f64> = t.windows(2).map(|w| (w[1] - w[0]) / self.unit).collect();
        let inverse = h.iter().map(|h| 1.0 / h).collect();
        Steps { begin: rows.start, h, inverse }
    }

    /// Eliminates row j of L D L': its two entries of L', and its right side over its entry of D.
    #[inline]
    fn eliminate(&self, j: usize, steps: &Steps, carried: &mut Carried) -> [f64; 3] {
        let (m, lambda) = (self.rows(), self.lambda);
        let (a, h0, h1) = (steps.q(j), steps.h[j - steps.begin], steps.h[j + 1 - steps.begin]);
        let mut main = (h0 + h1) / 3.0 + lambda * (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
        let (mut first, mut second) = (0.0, 0.0);
        if j + 1 < m {
            let b = steps.q(j + 1);
            first = h1 / 6.0 + lambda * (a[1] * b[0] + a[2] * b[1]);
        }
        if j + 2 < m {
            second = lambda * a[2] * steps.q(j + 2)[0];
        }
        let y = [self.value(j), self.value(j + 1), self.value(j + 2)];
        let mut right = (y[2] - y[1]) / h1 - (y[1] - y[0]) / h0;
        main = main - carried.also[0] - carried.next[0];
        first -= carried.next[1];
        right = right - carried.also[1] - carried.next[2];
        let (l1, l2) = (first / main, second / main);
        *carried = Carried {
            next: [l1 * first, l1 * second, l1 * right],
            also: carried.second,
            second: [l2 * second, l2 * right],
        };
        [l1, l2, right / main]
    }

    fn blocks(&self) -> impl DoubleEndedIterator<Item = Range<usize>> + use<> {
        let m = self.rows();
        (0..m.div_ceil(BLOCK)).map(move |block| block * BLOCK..m.min((block + 1) * BLOCK))
    }

    /// The second derivatives at the inner samples.
    fn solve<E>(&self, check: &impl Check<E>) -> Result<Vec<f64>, E> {
        let mut carried = Carried::default();
        let mut at_begin = Vec::new();
        for rows in self.blocks() {
            check()?;
            at_begin.push(carried);
            let steps = self.steps(&rows);
            rows.for_each(|j| {
                self.eliminate(j, &steps, &mut carried);
            });
        }
        // Room for what the spline leaves of all values.
        let mut gamma = Vec::with_capacity(self.y.len());
        gamma.resize(self.rows(), 0.0);
        let [mut next, mut second] = [0.0; 2];
        let mut eliminated = Vec::with_capacity(BLOCK);
        for (rows, mut carried) in self.blocks().zip(at_begin).collect::<Vec<_>>().into_iter().rev() {
            check()?;
            let steps = self.steps(&rows);
            eliminated.clear();
            eliminated.extend(rows.clone().map(|j| self.eliminate(j, &steps, &mut carried)));
            for (gamma, [l1, l2, right]) in gamma[rows].iter_mut().zip(&eliminated).rev() {
                *gamma = right - l1 * next - l2 * second;
                (next, second) = (*gamma, next);
            }
        }
        Ok(gamma)
    }

    /// Puts what the spline leaves of the values in the place of `gamma`, and gives its sum.
    fn sum_of_residuals<E>(&self, gamma: &mut Vec<f64>, check: &impl Check<E>) -> Result<f64, E> {
        let mut sum = 0.0;
        // What rows before take off the next two samples: each takes `lambda Q gamma` off three.
        let [mut once, mut twice] = [[0.0; 2]; 2];
        for rows in self.blocks() {
            check()?;
            let steps = self.steps(&rows);
            for j in rows {
                let off = steps.q(j).map(|q| self.lambda * q * gamma[j]);
                let y = self.value(j);
                // No later row needs this `gamma`.
                gamma[j] = y - (y - twice[0] - once[0] - off[0]);
                sum += gamma[j];
                (twice, once) = ([once[1], 0.0], [off[1], off[2]]);
            }
        }
        for (i, off) in (self.rows()..).zip([[twice[0], once[0]], [once[1], 0.0]]) {
            let y = self.value(i);
            let residual = y - (y - off[0] - off[1]);
            sum += residual;
            gamma.push(residual);
        }
        Ok(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::super::pieces::{certain, to_the_end};
    use super::*;

    /// The spline that minimises its functional, with every list written down.
    fn smooth(t: &[f64], y: &[f64], unit: f64, lambda: f64) -> Vec<f64> {
        let n = y.len();
        let h: Vec<f64> = t.windows(2).map(|w| (w[1] - w[0]) / unit).collect();
        let m = n - 2;
        let (mut main, mut first, mut second) = (vec![0.0; m], vec![0.0; m], vec![0.0; m]);
        let mut gamma = vec![0.0; m];
        let q = |j: usize| {
            let (a, c) = (1.0 / h[j], 1.0 / h[j + 1]);
            [a, -a - c, c]
        };
        for j in 0..m {
            let a = q(j);
            main[j] = (h[j] + h[j + 1]) / 3.0 + lambda * (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
            if j + 1 < m {
                let b = q(j + 1);
                first[j] = h[j + 1] / 6.0 + lambda * (a[1] * b[0] + a[2] * b[1]);
            }
            if j + 2 < m {
                second[j] = lambda * a[2] * q(j + 2)[0];
            }
            gamma[j] = (y[j + 2] - y[j + 1]) / h[j + 1] - (y[j + 1] - y[j]) / h[j];
        }
        solve_five_bands(&mut main, &mut first, &mut second, &mut gamma);
        let mut f = y.to_vec();
        for (j, g) in gamma.iter().enumerate() {
            for (k, q) in q(j).iter().enumerate() {
                f[j + k] -= lambda * q * g;
            }
        }
        f
    }

    /// Solves A x = b in place for a symmetric positive definite A with two bands above the diagonal, by L D L'.
    fn solve_five_bands(main: &mut [f64], first: &mut [f64], second: &mut [f64], x: &mut [f64]) {
        let n = main.len();
        for i in 0..n {
            let d = main[i];
            let l1 = first[i] / d;
            let l2 = second[i] / d;
            if i + 1 < n {
                main[i + 1] -= l1 * first[i];
                first[i + 1] -= l1 * second[i];
                x[i + 1] -= l1 * x[i];
            }
            if i + 2 < n {
                main[i + 2] -= l2 * second[i];
                x[i + 2] -= l2 * x[i];
            }
            first[i] = l1;
            second[i] = l2;
            x[i] /= d;
        }
        for i in (0..n).rev() {
            if i + 1 < n {
                x[i] -= first[i] * x[i + 1];
            }
            if i + 2 < n {
                x[i] -= second[i] * x[i + 2];
            }
        }
    }

    #[test]
    fn the_deviation_is_that_of_its_plain_twin_to_the_last_bit() {
        for n in [3, 4, 5, 60, BLOCK + 1, BLOCK + 2, BLOCK + 3, BLOCK + 4, 3 * BLOCK + 77] {
            let t: Vec<f64> = (0..n).map(|i| i as f64 * 0.5 + 0.1 * (i % 3) as f64).collect();
            let y: Vec<f64> = t.iter().map(|t| 1e6 + (t / 30.0).sin() * 50.0 + (t * 99.7).sin()).collect();
            let level: Vec<f64> = y.iter().map(|v| v - y[0]).collect();
            let f = smooth(&t, &level, 0.5, HALF_POWER_AT_20);
            let rest: Vec<f64> = level.iter().zip(f).map(|(y, f)| y - f).collect();
            let mean = rest.iter().sum::<f64>() / n as f64;
            let want = (rest.iter().map(|r| (r - mean) * (r - mean)).sum::<f64>() / (n as f64 - 1.0)).sqrt();
            let got = certain(residual_deviation(&t, &y, 0.5, &to_the_end));
            assert_eq!(got.to_bits(), want.to_bits(), "{n}: {got} {want}");
        }
    }

    #[test]
    fn a_line_is_left_alone_and_the_constant_is_what_its_formula_says() {
        let t: Vec<f64> = (0..50).map(|i| f64::from(i) + 0.3 * f64::from(i % 3)).collect();
        let y: Vec<f64> = t.iter().map(|t| 7.0 - 2.0 * t).collect();
        let f = smooth(&t, &y, 1.0, HALF_POWER_AT_20);
        assert!(f.iter().zip(&y).all(|(f, y)| (f - y).abs() < 1e-9));
        assert!((HALF_POWER_AT_20 - (10.0 / std::f64::consts::PI).powi(4)).abs() < 1e-9);
    }

    #[test]
    fn a_wave_of_twenty_intervals_keeps_half_its_height() {
        // The transfer of the smoother at angular frequency w is 1 / (1 + lambda w^4): one half at w = 2 pi / 20.
        let w = std::f64::consts::TAU / 20.0;
        let t: Vec<f64> = (0..400).map(f64::from).collect();
        let y: Vec<f64> = t.iter().map(|t| (w * t).sin()).collect();
        let f = smooth(&t, &y, 1.0, HALF_POWER_AT_20);
        let middle = 150..250;
        let ratio = middle.clone().map(|i| f[i] * y[i]).sum::<f64>() / middle.map(|i| y[i] * y[i]).sum::<f64>();
        assert!((ratio - 0.5).abs() < 0.01, "{ratio}");
    }

    #[test]
    fn it_is_the_minimum_of_its_functional() {
        // Independent check: no small change of the fitted values may lower penalty + misfit, where the penalty of
        // values is that of the natural spline through them, found by the dense equations.
        let t = [0.0, 1.0, 2.5, 3.0, 4.2, 6.0];
        let y = [1.0, -1.0, 2.0, 0.5, 3.0, -2.0];
        let lambda = 0.7;
        let cost = |f: &[f64]| {
            let h: Vec<f64> = t.windows(2).map(|w| w[1] - w[0]).collect();
            let m = f.len() - 2;
            let r = nalgebra::DMatrix::from_fn(m, m, |i, j| match i.abs_diff(j) {
                0 => (h[i] + h[i + 1]) / 3.0,
                1 => h[i.max(j)] / 6.0,
                _ => 0.0,
            });
            let b = nalgebra::DVector::from_fn(m, |j, _| (f[j + 2] - f[j + 1]) / h[j + 1] - (f[j + 1] - f[j]) / h[j]);
            let g = r.lu().solve(&b).unwrap();
            f.iter().zip(&y).map(|(f, y)| (f - y) * (f - y)).sum::<f64>() + lambda * b.dot(&g)
        };
        let f = smooth(&t, &y, 1.0, lambda);
        let best = cost(&f);
        for i in 0..f.len() {
            for d in [-1e-3, 1e-3] {
                let mut g = f.clone();
                g[i] += d;
                assert!(cost(&g) > best, "moving {i} by {d}");
            }
        }
    }
}
