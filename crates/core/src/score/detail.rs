//! Scores by event, by kind and by length of the true runs, and the final error against an outlier-free column.

use std::collections::BTreeMap;
use std::ops::Range;

use serde::Serialize;

use super::{Score, ratio};
use crate::analysis::Outcome;
use crate::series::Series;

/// Everything that a truth column tells about a result. A sample counts as found only when it is flagged itself:
/// an event that is found gives its other samples nothing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Scores {
    /// Sample by sample.
    #[serde(flatten)]
    pub samples: Score,
    /// Hits / wild: the rejection rate under the name that other fields give it.
    pub recall: Option<f64>,
    /// Event by event.
    pub events: Events,
    /// True runs of one sample.
    pub isolated: Part,
    /// True runs of two samples and more.
    pub patches: Part,
    /// By the length of the true run, ascending; only lengths that occur.
    pub by_run_length: Vec<RunLength>,
}

/// Runs of wild samples, and how many of them were noticed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Events {
    /// Runs that the truth marks: consecutive present samples, broken by a cut.
    pub wild: usize,
    /// Of those, runs of which at least one sample is flagged.
    pub found: usize,
    /// Of those, runs of which none is.
    pub missed: usize,
    /// Flagged runs without a single wild sample.
    pub false_alarms: usize,
}

/// What was found of the true runs of one kind.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Part {
    /// Runs.
    pub events: usize,
    /// Of those, runs of which at least one sample is flagged.
    pub found: usize,
    /// Samples in them.
    pub samples: usize,
    /// Of those, flagged.
    pub hits: usize,
    /// Hits / samples. None without samples.
    pub rejection_rate: Option<f64>,
}

/// What was found of the true runs of one length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct RunLength {
    /// Samples in each run.
    pub length: usize,
    /// What was found of them.
    #[serde(flatten)]
    pub part: Part,
}

/// Eq. (2) of \[003\]: how far the output is from the data before the outliers were added.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FinalError {
    /// `sqrt(mean((clean - reference)^2))` in the channel's units, over the samples that have a value in the output
    /// and in the reference. None when there is no such sample.
    pub rms: Option<f64>,
    /// Those samples.
    pub samples: usize,
    /// Outliers whose cell stays empty: they are in no mean, so a method that removes much is not judged by them.
    pub removed: usize,
}

impl Part {
    fn add(&mut self, samples: usize, hits: usize) {
        self.events += 1;
        self.found += usize::from(hits > 0);
        self.samples += samples;
        self.hits += hits;
        self.rejection_rate = ratio(self.hits, self.samples);
    }
}

impl Scores {
    /// The scores of `outcome`, where `truth` marks the rows that are really wild.
    #[must_use]
    pub fn of(outcome: &Outcome, series: &Series<'_>, truth: &[bool]) -> Self {
        let wild: Vec<bool> = (0..series.len()).map(|i| truth.get(series.row(i)).copied().unwrap_or(false)).collect();
        let samples = Score::of(outcome, series, truth);
        let (mut isolated, mut patches) = (Part::default(), Part::default());
        let mut lengths: BTreeMap<usize, Part> = BTreeMap::new();
        for run in true_runs(&wild, &outcome.detection.segments) {
            let hits = between(&outcome.outliers, &run);
            let kind = if run.len() == 1 { &mut isolated } else { &mut patches };
            kind.add(run.len(), hits);
            lengths.entry(run.len()).or_default().add(run.len(), hits);
        }
        let quiet = |start: usize, length: usize| !wild[start..start + length].contains(&true);
        let false_runs = outcome.runs.iter().filter(|r| quiet(r.start, r.length)).count();
        let (all, found) = (isolated.events + patches.events, isolated.found + patches.found);
        Self {
            samples,
            recall: samples.rejection_rate,
            events: Events { wild: all, found, missed: all - found, false_alarms: false_runs },
            isolated,
            patches,
            by_run_length: lengths.into_iter().map(|(length, part)| RunLength { length, part }).collect(),
        }
    }
}

/// The final error of `outcome` against `reference`, one value per row of the record.
#[must_use]
pub fn final_error(outcome: &Outcome, series: &Series<'_>, reference: &[f64]) -> FinalError {
    let (mut sum, mut samples) = (0.0, 0);
    for (i, &y) in series.y.iter().enumerate() {
        let clean = outcome.fix(i).unwrap_or(y);
        let wanted = reference.get(series.row(i)).copied().unwrap_or(f64::NAN);
        let off = clean - wanted;
        if off.is_finite() {
            sum += off * off;
            samples += 1;
        }
    }
    #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
    let rms = (samples > 0).then(|| (sum / samples as f64).sqrt());
    FinalError { rms, samples, removed: outcome.counts.removed }
}

/// Runs of true in `wild` within each of `segments`.
fn true_runs<'a>(wild: &'a [bool], segments: &'a [Range<usize>]) -> impl Iterator<Item = Range<usize>> + 'a {
    segments.iter().flat_map(move |segment| {
        let mut from = segment.start;
        std::iter::from_fn(move || {
            let start = (from..segment.end).find(|&i| wild[i])?;
            let end = (start..segment.end).find(|&i| !wild[i]).unwrap_or(segment.end);
            from = end;
            Some(start..end)
        })
    })
}

/// How many of the ascending `positions` lie in `range`.
fn between(positions: &[usize], range: &Range<usize>) -> usize {
    positions.partition_point(|p| *p < range.end) - positions.partition_point(|p| *p < range.start)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::analysis::{Detection, Input, Rows, settle};
    use crate::review::Decisions;
    use crate::setup::{Preset, Setup, method_of_id};
    use crate::stop::Stop;

    /// Ten-sample levels with spikes of 100 at the given rows, judged by `wright` with k = 1.5 on the mean, which
    /// flags exactly the spikes; the truth is what is handed in.
    fn scored(spikes: &[usize], truth: &[usize], gap: Option<usize>) -> (Scores, FinalError) {
        let t: Vec<f64> = (0..20).map(|i| if gap.is_some_and(|g| i >= g) { i + 50 } else { i } as f64).collect();
        let y: Vec<f64> = (0..20).map(|i| if spikes.contains(&i) { 100.0 } else { (i % 2) as f64 }).collect();
        let series = Series::new(&t, &y);
        let mut setup = Setup::new(method_of_id("wright").unwrap(), Preset::Default);
        setup.set_text("k", "1.5").unwrap();
        setup.set_text("max_passes", "1").unwrap();
        setup.set_text("floor", "auto").unwrap();
        let detection = Detection::of(Input::new(&series, None), &setup, &Stop::never()).unwrap();
        let rows = Rows { seconds: &t, own: None };
        let outcome = settle(&series, rows, Arc::new(detection), &Decisions::default(), &Stop::never()).unwrap();
        assert_eq!(outcome.outliers, spikes, "the method of this test flags the spikes and nothing else");
        let marks: Vec<bool> = (0..20).map(|i| truth.contains(&i)).collect();
        let reference: Vec<f64> = (0..20).map(|i| (i % 2) as f64 + if i == 19 { 3.0 } else { 0.0 }).collect();
        (Scores::of(&outcome, &series, &marks), final_error(&outcome, &series, &reference))
    }

    #[test]
    fn an_event_is_found_by_any_of_its_samples_and_gives_the_others_nothing() {
        // True: a patch 4..=6 of which one is flagged, 10 flagged, 15 missed. Flagged beside: 18, false.
        let (scores, _) = scored(&[5, 10, 18], &[4, 5, 6, 10, 15], None);
        assert_eq!((scores.samples.hits, scores.samples.missed, scores.samples.false_alarms), (2, 3, 1));
        assert_eq!(scores.recall, Some(0.4));
        assert_eq!(scores.events, Events { wild: 3, found: 2, missed: 1, false_alarms: 1 });
        let part = |events, found, samples, hits| Part {
            events,
            found,
            samples,
            hits,
            rejection_rate: Some(hits as f64 / samples as f64),
        };
        assert_eq!((scores.isolated, scores.patches), (part(2, 1, 2, 1), part(1, 1, 3, 1)));
        assert_eq!(scores.by_run_length.iter().map(|r| (r.length, r.part.hits)).collect::<Vec<_>>(), [(1, 1), (3, 1)]);
    }

    #[test]
    fn a_cut_breaks_a_true_run() {
        assert_eq!(scored(&[4, 12], &[9, 10], None).0.events.wild, 1);
        assert_eq!(scored(&[4, 12], &[9, 10], Some(10)).0.events.wild, 2);
    }

    #[test]
    fn the_final_error_is_over_what_has_a_value_and_tells_what_was_removed() {
        // `own` repair of wright removes: of the 18 left only row 19 is off, by 3.
        let (_, error) = scored(&[5, 10], &[5, 10], None);
        assert_eq!((error.samples, error.removed), (18, 2));
        assert!((error.rms.unwrap() - (9.0_f64 / 18.0).sqrt()).abs() < 1e-12);
    }
}
