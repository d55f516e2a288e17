//! What the user should know about the results of whole-segment criteria ("Warnings" of section 2).

use std::ops::Range;
use std::sync::OnceLock;

use super::{Criterion, Limit};
use crate::math::order::median_in_place;
use crate::math::polyfit::Polynomial;
use crate::method::{Segment, noise, shared};
use crate::param::Settings;
use crate::series::Series;
use crate::stop::{Stop, Stopped};

/// How many scales a lone spike reaches at most among `n` residuals, at a place with this leverage.
#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(in crate::method) fn reach(n: usize, leverage: f64) -> f64 {
    ((n as f64 - 1.0) * (1.0 - leverage).max(0.0)).sqrt()
}

/// The warning for blocks of `n` samples in which a lone spike can or cannot reach `limit` scales: at its ends
/// (`end`) and where the trend leaves it most freedom (`best`).
pub(in crate::method) fn of_block(n: usize, limit: f64, end: f64, best: f64) -> Option<String> {
    let what = if best < limit {
        format!("cannot flag anything: among {n} samples a lone spike reaches at most {best:.2} sigma")
    } else if end < limit {
        format!("cannot flag a lone spike at an end: among {n} samples it reaches at most {end:.2} sigma there")
    } else {
        return None;
    };
    Some(format!("{what}, and {limit:.2} are needed; use a longer block, a lower trend_order or a smaller tolerance"))
}

/// That a criterion could not reach its limit in a block at these times.
pub(super) fn of_reach(criterion: &impl Criterion, t: &[f64], fit: &Polynomial) -> Option<String> {
    let n = t.len() / criterion.groups();
    if n < 3 {
        return None;
    }
    let needed = criterion.needed(n);
    // Leverages cost a walk over the block: only where the bound can be near.
    if reach(n, 0.0) > 4.0 * needed {
        return None;
    }
    let leverages = t.iter().map(|&t| fit.variance_at(t));
    let (least, most) = leverages.fold((1.0_f64, 0.0_f64), |(a, b), l| (a.min(l), b.max(l)));
    of_block(n, needed, reach(n, most), reach(n, least))
}

/// What is to be said of settings alone: blocks in which nothing, or nothing at an end, can be flagged.
pub(in crate::method) fn of_settings(criterion: &impl Criterion, settings: &Settings) -> Vec<String> {
    let block = settings.whole(shared::BLOCK.key);
    let n = block / criterion.groups();
    if n < 3 || reach(n, 0.0) > 4.0 * criterion.needed(n) {
        return Vec::new();
    }
    #[expect(clippy::cast_precision_loss, reason = "the bound above keeps it small")]
    let t: Vec<f64> = (0..block).map(|i| i as f64).collect();
    let fit = Polynomial::fit(&t, &t, settings.whole(shared::TREND_ORDER.key));
    of_reach(criterion, &t, &fit).into_iter().collect()
}

/// That the trend of a block does not follow the data; `whole` is the noise of the segment, once it is known.
pub(super) fn of_trend(
    segment: &Segment<'_>,
    block: &Range<usize>,
    limits: &[Option<Limit>],
    whole: &OnceLock<f64>,
    stop: &Stop,
) -> Result<Option<String>, Stopped> {
    // As everywhere: fewer than 50 third differences say too little by themselves.
    let noise = if block.len() < 53 {
        match whole.get() {
            Some(noise) => *noise,
            None => {
                let noise = difference_scale(segment, &(0..segment.len()), stop)?;
                *whole.get_or_init(|| noise)
            }
        }
    } else {
        difference_scale(segment, block, stop)?
    };
    let scale = limits.iter().flatten().map(|limit| limit.scale).fold(0.0, f64::max);
    let follows = scale <= 3.0 * noise.max(segment.floor);
    Ok((!follows).then(|| {
        "the trend does not follow the data: what is left of them is more than three times their noise; raise \
         trend_order or set block"
            .into()
    }))
}

/// The noise of a block by its third differences; of a long one by 64 stretches of it, whose median is within 2 % of
/// the whole and costs a thousandth.
fn difference_scale(segment: &Segment<'_>, block: &Range<usize>, stop: &Stop) -> Result<f64, Stopped> {
    const STRETCH: usize = 256;
    let n = block.len();
    let starts: Vec<usize> =
        if n <= 64 * STRETCH { vec![0] } else { (0..64).map(|i| i * (n - STRETCH) / 63).collect() };
    let length = if starts.len() == 1 { n } else { STRETCH };
    let mut scales: Vec<f64> = starts
        .iter()
        .map(|start| {
            let stretch = block.start + start..block.start + start + length;
            let mut series = Series::new(&segment.t[stretch.clone()], &segment.y[stretch]);
            series.interval = segment.interval;
            let scale = noise::by_difference(&series, std::slice::from_ref(&(0..length)), stop)?;
            Ok(scale.first().copied().unwrap_or(0.0))
        })
        .collect::<Result<_, Stopped>>()?;
    Ok(median_in_place(&mut scales))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reach_of_the_page_at_the_ends_of_a_parabola() {
        // 2.05 for n = 11, 3.46 for n = 20 (section 2, "Warnings"); with a mean only, (n - 1) / sqrt(n).
        for (n, wanted) in [(11, 2.05), (20, 3.46)] {
            let t: Vec<f64> = (0..n).map(|i| i as f64).collect();
            let fit = Polynomial::fit(&t, &t, 2);
            assert!((reach(n, fit.variance_at(0.0)) - wanted).abs() < 0.005, "{n}");
        }
        assert!((reach(10, 0.1) - 9.0 / 10.0_f64.sqrt()).abs() < 1e-12);
        assert!(of_block(10, 3.0, reach(10, 0.1), reach(10, 0.1)).is_some_and(|w| w.starts_with("cannot flag any")));
        assert!(of_block(11, 3.0, 2.05, 3.02).is_some_and(|w| w.contains("at an end")));
        assert_eq!(of_block(100, 3.0, 9.0, 9.9), None);
    }
}
