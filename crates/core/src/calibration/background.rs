//! The residuals around a sample: what is usual here.

use rayon::prelude::*;

use crate::stop::{Stop, Stopped};

/// Which neighbours are looked at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    /// This many on either side …
    pub half: usize,
    /// … but for this many nearest ones, among which a patch may lie.
    pub middle: usize,
}

/// This many samples share one figure: the noise does not change faster.
const SHARED: usize = 4;

/// Figures computed in one piece of parallel work.
const PIECE: usize = 1024;

/// Quantile `q` of the unmasked residuals in `span` around each sample; 0 where all are masked.
pub(super) fn background(r: &[f64], masked: &[bool], span: Span, q: f64, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let mut all = vec![0.0; r.len()];
    all.par_chunks_mut(PIECE * SHARED).enumerate().try_for_each(|(piece, out)| {
        stop.check()?;
        let mut near = Vec::with_capacity(2 * span.half);
        for (k, out) in out.chunks_mut(SHARED).enumerate() {
            let center = (piece * PIECE * SHARED + k * SHARED + SHARED / 2).min(r.len() - 1);
            let outer = center.saturating_sub(span.half)..r.len().min(center + span.half + 1);
            let inner = center.saturating_sub(span.middle)..r.len().min(center + span.middle + 1);
            near.clear();
            let sides = (outer.start..inner.start).chain(inner.end..outer.end);
            near.extend(sides.filter(|j| !masked[*j]).map(|j| r[j]));
            out.fill(super::quantile(&mut near, q));
        }
        Ok(())
    })?;
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_follows_the_noise_and_leaves_out_the_nearest_and_the_masked() {
        let mut r: Vec<f64> = (0..1000).map(|i| if i < 500 { 1.0 } else { 8.0 }).collect();
        r[200..210].fill(99.0);
        r[100..110].fill(99.0);
        let mut masked = vec![false; 1000];
        masked[100..110].fill(true);
        let local = background(&r, &masked, Span { half: 50, middle: 12 }, 0.95, &Stop::never()).unwrap();
        let at = |i: usize| local[i];
        assert!([20, 104, 204, 400].map(at).iter().all(|x| (x - 1.0).abs() < 1e-12), "{:?}", &local[200..210]);
        assert!((at(900) - 8.0).abs() < 1e-12);
    }
}
