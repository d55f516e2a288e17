//! Least-squares polynomials around each sample, itself included.

use super::Filtered;
use crate::math::pieces;
use crate::math::polyfit::Polynomial;
use crate::stop::{Stop, Stopped};

/// Which samples a polynomial goes through beside the one it is asked about.
#[derive(Debug, Clone, Copy)]
pub(in crate::method) struct Fit {
    /// This many before it, or as many as there are.
    pub(in crate::method) before: usize,
    /// This many after it, or as many as there are.
    pub(in crate::method) after: usize,
    /// Order of the polynomial.
    pub(in crate::method) order: usize,
    /// With fewer points than this there is no value.
    pub(in crate::method) least: usize,
    /// Noise scale of a sample, in channel units; NaN where the method has none.
    pub(in crate::method) sigma: f64,
}

/// The polynomial's value at each of the times `t`, fitted to the values `y` that are `used`, with its standard deviation
/// for noise of the scale: that of white noise, the root of the leverage times the scale.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub(in crate::method) fn fits(
    t: &[f64],
    y: &[f64],
    used: impl Fn(usize) -> bool,
    fit: &Fit,
    stop: &Stop,
) -> Result<Filtered, Stopped> {
    let at: Vec<usize> = (0..t.len()).filter(|&i| used(i)).collect();
    let (times, values): (Vec<f64>, Vec<f64>) = at.iter().map(|&i| (t[i], y[i])).unzip();
    let both = pieces::collect(t.len(), &|| stop.check(), |i| {
        let from = at.partition_point(|&k| k < i);
        let own = usize::from(at.get(from) == Some(&i));
        let window = from.saturating_sub(fit.before)..at.len().min(from + own + fit.after);
        if window.len() < fit.least {
            return [f64::NAN; 2];
        }
        let polynomial = Polynomial::fit(&times[window.clone()], &values[window], fit.order);
        [polynomial.at(t[i]), fit.sigma * polynomial.variance_at(t[i]).sqrt()]
    })?;
    let (value, deviation) = both.into_iter().map(|[value, deviation]| (value, deviation)).unzip();
    Ok(Filtered { value, deviation })
}
