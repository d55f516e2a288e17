//! The filtered values of a channel: its method's model over the samples that are not wild.

use std::ops::Range;

use super::{Outcome, Seen, sight};
use crate::method::{Damaged, Filter, Filtered, Segment, Settled, Way};
use crate::series::Series;
use crate::stop::{Stop, Stopped};

/// What the model of the channel's method makes of it, after the analyst's decisions; one entry for each present
/// sample, on the scale of the record. None where the method has no model. Nothing (NaN) at samples that the method does
/// not see.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn filtered(outcome: &Outcome, series: &Series<'_>, stop: &Stop) -> Result<Option<Filtered>, Stopped> {
    let detection = &*outcome.detection;
    let setup = &detection.setup;
    let Some(filter) = setup.method.filter(&setup.settings) else { return Ok(None) };
    let seen = Seen { measured: series, series: detection.sight.series(series), detection };
    let mut all = Filtered::none(series.len());
    for (index, range) in detection.segments.iter().enumerate() {
        stop.check_at(64 * index)?;
        let from = outcome.outliers.partition_point(|&i| i < range.start);
        let to = outcome.outliers.partition_point(|&i| i < range.end);
        let part = seen.filtered(filter, index, &outcome.outliers[from..to], stop)?;
        let begin = detection.sight.seen_range(range).start;
        for i in range.clone() {
            let Some(k) = detection.sight.seen(i).map(|place| place - begin) else { continue };
            let (Some(&value), Some(&deviation)) = (part.value.get(k), part.deviation.get(k)) else { continue };
            // Values near the largest double may overflow.
            if value.is_finite() {
                all.value[i] = detection.written(value);
                all.deviation[i] = if deviation.is_finite() { deviation } else { f64::NAN };
            }
        }
    }
    Ok(Some(all))
}

impl Seen<'_> {
    /// The values of the segment with this index, of the samples that the method sees.
    fn filtered(
        &self,
        filter: &dyn Filter,
        index: usize,
        outliers: &[usize],
        stop: &Stop,
    ) -> Result<Filtered, Stopped> {
        let Self { measured, series, detection } = self;
        let (range, setup, sight) = (&detection.segments[index], &detection.setup, &detection.sight);
        let seen_range = sight.seen_range(range);
        if seen_range.is_empty() {
            return Ok(Filtered::default());
        }
        let judged = detection.judged.part(range.clone());
        let gathered = sight.gathered(&judged, range, &measured.y);
        let judged = gathered.as_ref().map_or(judged, sight::Gathered::part);
        let segment = Segment::of(series, &seen_range, &detection.scales[index], None);
        let settings = &setup.settings.at_interval(segment.interval);
        let local = |position: &usize| sight.seen(*position).map(|place| place - seen_range.start);
        let outliers: Vec<usize> = outliers.iter().filter_map(local).collect();
        let damaged = Damaged { segment: &segment, settings, judged, outliers: &outliers };
        let own = setup.method.own_repair(&damaged, stop)?;
        let restarts: Vec<usize> = self.restarts(range).filter_map(|at| local(&at)).collect();
        filter.run(&Settled { damaged, own: &own, restarts: &restarts }, stop)
    }

    /// Where the model was started again on its way with time.
    fn restarts(&self, range: &Range<usize>) -> impl Iterator<Item = usize> {
        let restarts = self.detection.judged.restarts();
        let forward = restarts.iter().filter(|restart| restart.way == Way::Forward && range.contains(&restart.at));
        let mut at: Vec<usize> = forward.map(|restart| restart.at).collect();
        at.sort_unstable();
        at.dedup();
        at.into_iter()
    }
}
