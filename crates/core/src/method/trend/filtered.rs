//! The trend through what is left.

use super::blocks;
use crate::math::polyfit::Polynomial;
use crate::method::filtered::{Filter, Filtered, Settled};
use crate::method::{Damaged, shared};
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

/// The model of the criteria, which a trend of order 0 is not: that is one number for the whole track.
pub(in crate::method) fn filter(settings: &Settings) -> Option<&'static dyn Filter> {
    (settings.whole(shared::TREND_ORDER.key) > 0).then_some(&Trend)
}

struct Trend;

impl Filter for Trend {
    fn about(&self) -> &'static str {
        "trend through the samples that are not wild"
    }

    fn run(&self, settled: &Settled<'_>, stop: &Stop) -> Result<Filtered, Stopped> {
        let Damaged { segment, settings, .. } = settled.damaged;
        let (order, check) = (settings.whole(shared::TREND_ORDER.key), || stop.check());
        let accepted = settled.accepted();
        let mut value = vec![f64::NAN; segment.len()];
        for block in blocks(segment.len(), settings.whole(shared::BLOCK.key)) {
            let left = block.clone().filter(|&i| accepted[i]);
            let (t, y): (Vec<f64>, Vec<f64>) = left.map(|i| (segment.t[i], segment.y[i])).unzip();
            if t.len() >= order + 3 {
                let trend = Polynomial::fit_long(&t, &y, order, &check)?;
                trend.values_long(&segment.t[block.clone()], &mut value[block], &check)?;
            }
        }
        Ok(Filtered::of_values(value))
    }
}
