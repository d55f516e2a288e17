//! Criteria that flag everything beyond a limit at once in each pass: Wright, Chauvenet, odd-even extraction.

use rayon::prelude::*;

use super::{Criterion, Limit, Pass, Survivors};
use crate::math::moments::Moments;
use crate::math::student::normal_upper;
use crate::method::reaches;
use crate::stop::{Stop, Stopped};

/// Residuals in one piece of work.
const CHUNK: usize = 16_384;

/// Flags every residual whose deviation from the mean of its group reaches `multiplier(n)` standard deviations.
#[derive(Debug)]
pub(in crate::method) struct AtOnce<F> {
    /// How many groups are judged by themselves.
    pub(in crate::method) groups: usize,
    /// The multiplier for a group of `n`.
    pub(in crate::method) multiplier: F,
}

/// Chauvenet's multiplier for `n` samples: `PhiInv(1 - 1 / (4 n))`.
#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(in crate::method) fn normal_at(n: usize) -> f64 {
    normal_upper(1.0 / (4.0 * n as f64))
}

impl<F: Fn(usize) -> f64 + Sync> AtOnce<F> {
    /// What `residual` are judged by; none when they are fewer than three.
    fn limit(&self, residual: &[f64], survivors: &Survivors<'_>, stop: &Stop) -> Result<Option<Limit>, Stopped> {
        if residual.len() < 3 {
            return Ok(None);
        }
        let moments = Moments::of_long(residual, &|| stop.check())?;
        let scale = survivors.bounded(moments.deviation());
        Ok(Some(Limit { mean: moments.mean, scale, tolerance: (self.multiplier)(residual.len()) * scale }))
    }
}

impl<F: Fn(usize) -> f64 + Sync> Criterion for AtOnce<F> {
    fn groups(&self) -> usize {
        self.groups
    }

    fn needed(&self, n: usize) -> f64 {
        (self.multiplier)(n)
    }

    fn pass(&self, survivors: &Survivors<'_>, stop: &Stop) -> Result<Pass, Stopped> {
        let groups: Vec<Option<Limit>> = if self.groups == 1 {
            vec![self.limit(survivors.residual, survivors, stop)?]
        } else {
            let mut members = vec![Vec::new(); self.groups];
            for (i, (&v, &p)) in survivors.residual.iter().zip(survivors.position).enumerate() {
                stop.check_at(i)?;
                members[p % self.groups].push(v);
            }
            members.iter().map(|m| self.limit(m, survivors, stop)).collect::<Result<_, _>>()?
        };
        let chunks = survivors.residual.par_chunks(CHUNK).zip(survivors.position.par_chunks(CHUNK)).enumerate();
        let flagged: Vec<Vec<usize>> = chunks
            .map(|(chunk, (residual, position))| {
                stop.check()?;
                let beyond = |limit: Option<Limit>, v: f64| {
                    limit.is_some_and(|limit| reaches((v - limit.mean).abs(), limit.tolerance))
                };
                let from = chunk * CHUNK;
                let all = residual.iter().zip(position).enumerate();
                Ok(match groups.as_slice() {
                    &[limit] => all.filter(|(_, (v, _))| beyond(limit, **v)).map(|(i, _)| from + i).collect(),
                    groups => all
                        .filter(|(_, (v, p))| beyond(groups[**p % groups.len()], **v))
                        .map(|(i, _)| from + i)
                        .collect(),
                })
            })
            .collect::<Result<_, Stopped>>()?;
        let flagged = flagged.concat();
        Ok(Pass { flagged, groups })
    }
}
