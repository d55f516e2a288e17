//! Recall by size, and the smallest size that is found.

use super::event::{Kind, SIZES};

/// A size counts as found where at least this share of the wild points of that size is found.
pub const OF_ALL: f64 = 0.95;

/// What is found of the wild points of one kind and size.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Point {
    /// Their size in limits of the noise; none for a kind without sizes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits: Option<f64>,
    /// How many were put in.
    pub events: usize,
    /// Those of which at least half of the samples are outliers.
    pub found: usize,
    /// Those of which at least half of the samples are outliers or suspects.
    pub seen: usize,
}

/// What is found of the wild points of one kind.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Curve {
    /// The kind.
    pub kind: Kind,
    /// From the smallest size to the largest.
    pub points: Vec<Point>,
    /// Share found, the mean over all sizes; none before any was put in.
    pub recall: Option<f64>,
    /// The size from which on [`OF_ALL`] are found, in channel units at the median limit of the record; none where the
    /// largest are not.
    pub smallest: Option<f64>,
}

impl Point {
    /// The share that is found; none before any was put in.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "small counts")]
    pub fn recall(&self) -> Option<f64> {
        (self.events > 0).then(|| self.found as f64 / self.events as f64)
    }
}

impl Curve {
    /// The curve of `points`, by ascending size, on a record with noise up to `limit` in channel units.
    #[must_use]
    pub fn new(kind: Kind, points: Vec<Point>, limit: f64) -> Self {
        let known: Vec<f64> = points.iter().filter_map(Point::recall).collect();
        #[expect(clippy::cast_precision_loss, reason = "small counts")]
        let recall = (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64);
        let smallest = if kind.has_sizes() { smallest(&points).map(|limits| limits * limit) } else { None };
        Self { kind, points, recall, smallest }
    }
}

/// The size in limits from which on [`OF_ALL`] are found: between two sizes on the line between their shares, over the
/// logarithm of the size.
fn smallest(points: &[Point]) -> Option<f64> {
    let shares = rising(points);
    let first = shares.iter().position(|share| share.recall >= OF_ALL)?;
    let Share { limits, recall } = shares[first];
    let Some(below) = first.checked_sub(1).map(|i| shares[i]) else { return Some(limits) };
    let way = (OF_ALL - below.recall) / (recall - below.recall);
    Some(below.limits * (limits / below.limits).powf(way))
}

/// The share found of the wild points of one size.
#[derive(Debug, Clone, Copy)]
struct Share {
    limits: f64,
    recall: f64,
}

/// The shares that rise with the size and are nearest to those of `points`, weighted by their numbers: where a larger
/// size was found less often, which is chance, neighbours get the mean of their shares (pool adjacent violators).
fn rising(points: &[Point]) -> Vec<Share> {
    struct Pool {
        sizes: Vec<f64>,
        found: usize,
        events: usize,
    }
    let mut pools: Vec<Pool> = Vec::new();
    for (limits, point) in points.iter().filter_map(|p| Some((p.limits?, p))).filter(|(_, p)| p.events > 0) {
        let mut pool = Pool { sizes: vec![limits], found: point.found, events: point.events };
        // a / b > c / d as a d > c b, in whole numbers.
        while let Some(before) = pools.pop_if(|before| before.found * pool.events > pool.found * before.events) {
            pool.sizes.splice(0..0, before.sizes);
            pool.found += before.found;
            pool.events += before.events;
        }
        pools.push(pool);
    }
    #[expect(clippy::cast_precision_loss, reason = "small counts")]
    let shares = |pool: Pool| {
        let recall = pool.found as f64 / pool.events as f64;
        pool.sizes.into_iter().map(move |limits| Share { limits, recall })
    };
    pools.into_iter().flat_map(shares).collect()
}

/// The points of a kind before anything was put in.
pub(super) fn sizes(kind: Kind) -> impl Iterator<Item = Option<f64>> {
    let sized = SIZES.iter().map(|size| Some(*size)).take(if kind.has_sizes() { SIZES.len() } else { 0 });
    sized.chain((!kind.has_sizes()).then_some(None))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(found: &[usize]) -> Curve {
        let point = |(i, &found): (usize, &usize)| Point { limits: Some(SIZES[i]), events: 20, found, seen: 20 };
        Curve::new(Kind::Single, found.iter().enumerate().map(point).collect(), 2.0)
    }

    #[test]
    fn the_smallest_size_is_that_from_which_on_nearly_all_are_found() {
        // Between 1.6 limits (17 of 20) and 2.5 (all): a share of (0.95 - 0.85) / 0.15 of the way.
        let expected = 2.0 * 1.6 * (2.5_f64 / 1.6).powf(2.0 / 3.0);
        assert!((curve(&[3, 17, 20, 20, 20]).smallest.unwrap() - expected).abs() < 1e-12);
        assert_eq!(curve(&[19, 20, 20]).smallest, Some(2.0), "the smallest size of all");
        assert_eq!(curve(&[3, 20, 16]).smallest, None, "the largest are not found: 36 of 40 together");
        // One that was missed by chance among the larger ones: 39 of 40 together.
        assert_eq!(curve(&[20, 19, 20]).smallest, Some(2.0));
        assert!((curve(&[0, 20, 19, 20]).smallest.unwrap() - 2.0 * 1.6_f64.powf(0.95 / 0.975)).abs() < 1e-12);
        assert_eq!(curve(&[10, 20]).recall, Some(0.75));
    }

    #[test]
    fn a_size_that_was_not_put_in_says_nothing() {
        let mut points = curve(&[19, 0, 20]).points;
        points[1].events = 0;
        let curve = Curve::new(Kind::Single, points, 1.0);
        assert_eq!((curve.smallest, curve.recall), (Some(1.0), Some(0.975)));
    }
}
