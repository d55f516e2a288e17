//! The residuals around a sample: what is usual here.

use std::ops::Range;

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

/// Quantiles `q` of the unmasked residuals `r` (without a sign) in `span` around each sample; 0 where all are masked.
pub(super) fn background<const N: usize>(
    r: &[f64],
    masked: &[bool],
    span: Span,
    q: [f64; N],
    stop: &Stop,
) -> Result<[Vec<f64>; N], Stopped> {
    let mut all = vec![[0.0; N]; r.len().div_ceil(SHARED)];
    all.par_chunks_mut(PIECE).enumerate().try_for_each(|(piece, out)| {
        stop.check()?;
        let mut before = Side::default();
        let mut after = Side::default();
        let mut near = Ordered::default();
        for (k, out) in out.iter_mut().enumerate() {
            let center = ((piece * PIECE + k) * SHARED + SHARED / 2).min(r.len() - 1);
            before.move_to(
                center.saturating_sub(span.half)..center.saturating_sub(span.middle),
                (r, masked),
                &mut near,
            );
            let from = r.len().min(center + span.middle + 1);
            after.move_to(from..r.len().min(center + span.half + 1), (r, masked), &mut near);
            *out = q.map(|q| near.quantile(q));
        }
        Ok(())
    })?;
    Ok(std::array::from_fn(|n| (0..r.len()).map(|i| all[i / SHARED][n]).collect()))
}

/// The neighbours on one side of a sample.
#[derive(Debug, Default)]
struct Side(Range<usize>);

impl Side {
    /// Moves onwards, and with it what is `near`.
    fn move_to(&mut self, to: Range<usize>, (r, masked): (&[f64], &[bool]), near: &mut Ordered) {
        let from = std::mem::replace(&mut self.0, to.clone());
        let known = |part: Range<usize>| part.filter(|j| !masked[*j]).map(|j| r[j]);
        let (mut old, mut new) = (known(from.start..from.end.min(to.start)), known(from.end.max(to.start)..to.end));
        loop {
            match (old.next(), new.next()) {
                (Some(old), Some(new)) => near.exchange(old, new),
                (Some(old), None) => near.remove(old),
                (None, Some(new)) => near.insert(new),
                (None, None) => break,
            }
        }
    }
}

/// Residuals in ascending order, as bits: without a sign these have the order of the values, NaN last.
#[derive(Debug, Default)]
struct Ordered(Vec<u64>);

impl Ordered {
    fn place(&self, bits: u64) -> usize {
        self.0.partition_point(|other| *other < bits)
    }

    fn insert(&mut self, value: f64) {
        self.0.insert(self.place(value.to_bits()), value.to_bits());
    }

    /// Takes out a value that is there.
    fn remove(&mut self, value: f64) {
        self.0.remove(self.place(value.to_bits()));
    }

    /// Puts `new` in the place of a value that is there.
    fn exchange(&mut self, old: f64, new: f64) {
        let (from, to, all) = (self.place(old.to_bits()), self.place(new.to_bits()), &mut self.0);
        if to > from {
            all.copy_within(from + 1..to, from);
            all[to - 1] = new.to_bits();
        } else {
            all.copy_within(to..from, to + 1);
            all[to] = new.to_bits();
        }
    }

    /// Quantile `q`, the one at or below; 0 without any.
    fn quantile(&self, q: f64) -> f64 {
        if self.0.is_empty() { 0.0 } else { f64::from_bits(self.0[super::rank(self.0.len(), q)]) }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn it_follows_the_noise_and_leaves_out_the_nearest_and_the_masked() {
        let mut r: Vec<f64> = (0..1000).map(|i| if i < 500 { 1.0 } else { 8.0 }).collect();
        r[200..210].fill(99.0);
        r[100..110].fill(99.0);
        let mut masked = vec![false; 1000];
        masked[100..110].fill(true);
        let [local] = background(&r, &masked, Span { half: 50, middle: 12 }, [0.95], &Stop::never()).unwrap();
        let at = |i: usize| local[i];
        assert!([20, 104, 204, 400].map(at).iter().all(|x| (x - 1.0).abs() < 1e-12), "{:?}", &local[200..210]);
        assert!((at(900) - 8.0).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn it_is_the_quantile_of_the_neighbours_sorted_anew(
            samples in prop::collection::vec(
                (prop_oneof![0.0..9.0, (0..4).prop_map(f64::from), Just(f64::INFINITY), Just(f64::NAN)], any::<bool>()),
                1..120,
            ),
            half in 1usize..40,
            middle in 0usize..12,
        ) {
            let (r, masked): (Vec<f64>, Vec<bool>) = samples.into_iter().unzip();
            let span = Span { half, middle: middle.min(half) };
            let found = background(&r, &masked, span, [0.5, 0.95], &Stop::never()).unwrap();
            for i in 0..r.len() {
                let center = (i / SHARED * SHARED + SHARED / 2).min(r.len() - 1);
                let distance = |j: &usize| j.abs_diff(center);
                let mut near: Vec<f64> = (0..r.len())
                    .filter(|j| distance(j) <= span.half && distance(j) > span.middle && !masked[*j])
                    .map(|j| r[j])
                    .collect();
                for (found, q) in found.iter().zip([0.5, 0.95]) {
                    prop_assert_eq!(found[i].to_bits(), super::super::quantile(&mut near, q).to_bits());
                }
            }
        }
    }
}
