//! The natural cubic smoothing spline (Reinsch), in linear time.

/// The smoothing parameter that halves the power at a period of 20 intervals: (20 / (2 pi))^4.
pub const HALF_POWER_AT_20: f64 = 102.659_822_546_843_39;

/// The spline f that minimises `sum (y - f)^2 + lambda * integral f''^2`, with time in units of `unit`, at the
/// samples. `t` must increase. With fewer than three samples it goes through them.
#[must_use]
pub fn smooth(t: &[f64], y: &[f64], unit: f64, lambda: f64) -> Vec<f64> {
    let n = y.len();
    if n < 3 {
        return y.to_vec();
    }
    let h: Vec<f64> = t.windows(2).map(|w| (w[1] - w[0]) / unit).collect();
    let m = n - 2;
    // Reinsch: (R + lambda Q'Q) gamma = Q'y, f = y - lambda Q gamma. The matrix has five bands and is positive
    // definite; gamma holds the second derivatives at the inner samples.
    let (mut main, mut first, mut second) = (vec![0.0; m], vec![0.0; m], vec![0.0; m]);
    let mut gamma = vec![0.0; m];
    // Row j of Q' has 1/h[j], -1/h[j]-1/h[j+1], 1/h[j+1] at j, j+1, j+2.
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

/// Sample standard deviation (divisor n - 1) of `y` minus its smoothing spline with half power at a period of
/// 20 intervals; 0 with fewer than three samples.
#[must_use]
pub fn residual_deviation(t: &[f64], y: &[f64], interval: f64) -> f64 {
    let n = y.len();
    if n < 3 {
        return 0.0;
    }
    // The spline of y - c is that of y minus c: the first value is taken off so that an offset costs no digits.
    let y: Vec<f64> = y.iter().map(|v| v - y[0]).collect();
    let f = smooth(t, &y, interval, HALF_POWER_AT_20);
    let residuals: Vec<f64> = y.iter().zip(f).map(|(y, f)| y - f).collect();
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let n = n as f64;
    let mean = residuals.iter().sum::<f64>() / n;
    (residuals.iter().map(|r| (r - mean) * (r - mean)).sum::<f64>() / (n - 1.0)).sqrt()
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

#[cfg(test)]
mod tests {
    use super::*;

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
