//! `polynomial`: a least-squares polynomial through accepted samples on both sides. The least noisy repair: 0.33 to
//! 0.49 sigma for patches of 1 to 20, against 1.2 to 6.4 for the spline.

use super::{Around, REPAIR_ORDER, REPAIR_POINTS};
use crate::math::polyfit::Polynomial;
use crate::param::Settings;

/// Fewer accepted samples than this on a side do not carry a cubic over a hole.
const AT_LEAST: usize = 4;

/// Values of the polynomial of `repair_order` through the nearest `repair_points` samples of each side.
pub(super) fn values(around: &Around<'_>, at: &[f64], settings: &Settings) -> Option<Vec<f64>> {
    let (t, y, before) = around.nearest(settings.whole(REPAIR_POINTS.key));
    if before < AT_LEAST || t.len() - before < AT_LEAST {
        return None;
    }
    let fit = Polynomial::fit(&t, &y, settings.whole(REPAIR_ORDER.key));
    Some(at.iter().map(|&t| fit.at(t)).collect())
}
