//! Eq. (5) of \[000\] at every sample: the polynomial through the accepted samples on both sides and the sample itself.

use super::candidates::candidates;
use crate::method::Damaged;
use crate::method::filtered::{Filter, Filtered, Fit, Settled, fits};
use crate::stop::{Stop, Stopped};

/// The model of the method: the polynomial of the highest order.
pub(super) struct BothSides;

impl Filter for BothSides {
    fn about(&self) -> &'static str {
        "polynomial of the highest order through the accepted samples on both sides and the sample"
    }

    fn run(&self, settled: &Settled<'_>, stop: &Stop) -> Result<Filtered, Stopped> {
        let Damaged { segment, settings, .. } = settled.damaged;
        let Some(highest) = candidates(settings).into_iter().next() else {
            return Ok(Filtered::none(segment.len()));
        };
        let accepted = settled.accepted();
        let (points, order) = (highest.points, highest.order);
        let fit = Fit { before: points, after: points, order, least: highest.need(), sigma: segment.sigma };
        fits(segment.t, segment.y, |i| accepted[i], &fit, stop)
    }
}
