//! `spline`: the natural cubic spline through accepted samples on both sides.

use super::{ANCHORS, Around};
use crate::math::spline;
use crate::param::Settings;

/// Values on the natural cubic spline through the nearest `anchors` samples of each side (a line through two).
pub(super) fn values(around: &Around<'_>, at: &[f64], settings: &Settings) -> Option<Vec<f64>> {
    let (t, y, _) = around.nearest(settings.whole(ANCHORS.key));
    let spline = spline::Natural::through(&t, &y);
    Some(at.iter().map(|&t| spline.at(t)).collect())
}
