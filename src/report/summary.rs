//! What came out, in few lines for people and as JSON for programs.

use std::fmt::Write as _;

use serde::Serialize;

use super::inspection::{remarks, short};
use super::written::Written;
use crate::counted::{counted, plural};
use crate::error::{Error, Result};
use crate::method::{Verdict, Way};
use crate::param::Settings;
use crate::score::{FinalError, Scores, SplineResidual, final_error, spline_residual};
use crate::session::{Analysed, Counts, Detection, Outcome, Session};
use crate::stop::Stop;
use crate::track::{Track, printable};

/// A result in a nutshell.
#[derive(Debug, Clone, Serialize)]
pub struct Summary {
    /// The program that made it.
    pub program: &'static str,
    /// The record.
    pub file: String,
    /// SHA-256 of the record.
    pub sha256: String,
    /// Its data rows.
    pub rows: usize,
    /// Outliers in all channels.
    pub flagged: usize,
    /// SHA-256 of the cleaned file, where it was made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clean_sha256: Option<String>,
    /// How the result differs from the one that the session recorded when it was saved; empty when it does not, none
    /// when there is nothing to compare with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub differs: Option<Vec<String>>,
    /// What of the record could not be used, and what the loader remarked.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// One entry per channel.
    pub channels: Vec<ChannelSummary>,
    /// The files that were written; none where the command writes no files.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "files")]
    pub written: Option<Written>,
}

/// The files alone: what a program did not ask for is no news to it.
fn files<S: serde::Serializer>(written: &Option<Written>, out: S) -> std::result::Result<S::Ok, S::Error> {
    out.collect_seq(written.iter().flat_map(|written| &written.files))
}

/// The result of one channel in a nutshell.
#[derive(Debug, Clone, Serialize)]
pub struct ChannelSummary {
    /// Its name.
    pub channel: String,
    /// Id of the method.
    pub method: &'static str,
    /// Every setting of the method.
    pub settings: serde_json::Map<String, serde_json::Value>,
    /// Every setting of the repair.
    pub repair: serde_json::Map<String, serde_json::Value>,
    /// What was done with the channel before the method saw it.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub checks: Vec<CheckSummary>,
    /// Period of a circular channel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub period: Option<f64>,
    /// How many samples are what.
    pub counts: Counts,
    /// Stretches between cuts.
    pub segments: usize,
    /// Models that were lost and started again.
    pub restarts: Vec<RestartSummary>,
    /// What the record's own noise is, where the floor comes from the record.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub calibration: Option<CalibrationSummary>,
    /// Standard deviation about a smoothing spline, eq. (2) of \[000\], before and after the repair, in channel units.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spline_residual: Option<SplineResidual>,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// Against the truth, where it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub score: Option<Scores>,
    /// Against the outlier-free column, where one is named.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub final_error: Option<FinalError>,
}

/// What the method was calibrated to.
#[derive(Debug, Clone, Serialize)]
pub struct CalibrationSummary {
    /// The step of the grid that the values lie on; 0 where they lie on none.
    pub resolution: f64,
    /// Share of samples that repeat the value before.
    pub held: f64,
    /// The median of the residuals at which noise ends.
    pub limit: Option<f64>,
    /// The same in words.
    pub words: String,
}

/// What a check objected to before the method.
#[derive(Debug, Clone, Serialize)]
pub struct CheckSummary {
    /// The check as `--check` has it.
    pub check: String,
    /// Samples that failed.
    pub outliers: usize,
    /// Samples that are suspect.
    pub suspects: usize,
}

/// A model that was lost and started again.
#[derive(Debug, Clone, Serialize)]
pub struct RestartSummary {
    /// Data row (from 1) at which it was lost.
    pub row: usize,
    /// Time of that row.
    pub time: String,
    /// `forward` or `backward`.
    pub direction: &'static str,
}

impl Summary {
    /// The summary of a result.
    #[must_use]
    pub fn of(track: &Track, session: &Session, analysed: &Analysed) -> Self {
        let channels = session.plans.iter().zip(&analysed.channels).map(|(plan, (index, samples, outcome))| {
            let series = samples.series(&track.channels[*index], &track.time);
            let detection = &outcome.detection;
            let restarts = detection.judged.restarts().iter().map(|r| RestartSummary {
                row: series.row(r.at) + 1,
                time: track.time.full_label(series.t[r.at]),
                direction: if r.way == Way::Forward { "forward" } else { "backward" },
            });
            ChannelSummary {
                channel: plan.channel.clone(),
                method: plan.setup.method.about().id,
                settings: json_settings(&plan.setup.settings),
                repair: json_settings(&plan.setup.repair),
                checks: checks(outcome),
                period: plan.setup.preparation.period,
                counts: outcome.counts,
                segments: detection.segments.len(),
                restarts: restarts.collect(),
                calibration: calibration(detection, &track.channels[*index].unit),
                // Nobody stops it.
                spline_residual: spline_residual(outcome, &series, &Stop::never()).unwrap_or_default(),
                warnings: outcome.warnings(),
                score: track.truth_for(&plan.channel).map(|truth| Scores::of(outcome, &series, truth)),
                final_error: None,
            }
        });
        Self {
            program: concat!("wildpoint ", env!("CARGO_PKG_VERSION")),
            file: track.source.path().map_or_else(|| track.source.name(), |p| p.display().to_string()),
            sha256: track.sha256.clone(),
            rows: track.rows,
            flagged: analysed.flagged(),
            clean_sha256: None,
            differs: None,
            notes: remarks(track),
            channels: channels.collect(),
            written: None,
        }
    }

    /// The result in a line that can be quoted.
    #[must_use]
    pub fn headline(&self) -> String {
        let sum = |of: fn(&Counts) -> usize| self.channels.iter().map(|c| of(&c.counts)).sum::<usize>();
        let samples = sum(|n| n.present);
        #[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
        let share = if samples > 0 { 100.0 * self.flagged as f64 / samples as f64 } else { 0.0 };
        let mut methods: Vec<&str> = self.channels.iter().map(|c| c.method).collect();
        methods.dedup();
        let file = printable(self.file.rsplit(['/', '\\']).next().unwrap_or_default());
        let mut line = format!(
            "{file}: {} of {} flagged ({share:.2} %), {} repaired, {} removed",
            self.flagged,
            counted(samples, "sample"),
            sum(|n| n.repaired),
            sum(|n| n.removed)
        );
        for (count, what) in [(sum(|n| n.suspects), "suspect"), (sum(|n| n.unchecked), "unchecked")] {
            if count > 0 {
                let _ = write!(line, ", {count} {what}");
            }
        }
        let channels = counted(self.channels.len(), "channel");
        line + &format!(" ({channels}, {})", methods.join(", "))
    }

    /// Compares the repaired first channel with `reference`, a column of the record that holds its outlier-free
    /// values.
    ///
    /// # Errors
    /// [`Error::Usage`] when no such column was loaded.
    pub fn compare_with(&mut self, track: &Track, analysed: &Analysed, reference: &str) -> Result<()> {
        let judged = analysed.channels.first().map(|(index, _, _)| &track.channels[*index]);
        let Some(column) = judged.map_or_else(|| track.channel(reference), |c| track.beside(c, reference)) else {
            return Err(Error::usage(
                format!("{reference}: there is no such numeric column for the reference"),
                "name the column of the outlier-free values, as the header has it",
            ));
        };
        if let (Some(summary), Some((index, samples, outcome))) = (self.channels.first_mut(), analysed.channels.first())
        {
            let series = samples.series(&track.channels[*index], &track.time);
            let values: Vec<f64> = (0..track.rows).map(|row| column.value(row)).collect();
            summary.final_error = Some(final_error(outcome, &series, &values));
        }
        Ok(())
    }

    /// A few lines for people.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = self.headline() + "\n";
        for note in &self.notes {
            let _ = writeln!(out, "note: {}", printable(note));
        }
        for c in &self.channels {
            let n = c.counts;
            let _ = write!(out, "{}: {} flagged by {}", printable(&c.channel), n.flagged, c.method);
            if n.by_checks > 0 {
                let _ = write!(out, " and the checks before it ({} by checks)", n.by_checks);
            }
            let _ = write!(out, " ({} isolated, {} run{})", n.isolated, n.patches, plural(n.patches));
            let _ = write!(out, ", {} repaired, {} removed", n.repaired, n.removed);
            for (count, what) in [
                (n.suspects, "suspect"),
                (n.unchecked, "unchecked"),
                (n.filled, "filled"),
                (n.decisions, "decided by the analyst"),
                (n.conflicts, "contradicting the method"),
                (n.missing, "missing"),
                (c.restarts.len(), "restarts"),
            ] {
                if count > 0 {
                    let _ = write!(out, ", {count} {what}");
                }
            }
            let _ = writeln!(out, " of {} samples in {} segment{}", n.present, c.segments, plural(c.segments));
            if let Some(calibration) = &c.calibration {
                let _ = writeln!(out, "  the record: {}", printable(&calibration.words));
            }
            for check in &c.checks {
                let (outliers, suspects) = (check.outliers, check.suspects);
                let check = printable(&check.check);
                let _ = writeln!(out, "  checked first: {check}: {outliers} outliers, {suspects} suspects");
            }
            if let Some(period) = c.period {
                let _ = writeln!(out, "  circular: judged unwrapped, period {period}");
            }
            if let Some(residual) = &c.spline_residual {
                let _ = writeln!(out, "  {}", residual_line(residual));
            }
            if let Some(s) = &c.score {
                let _ = writeln!(out, "  truth: {}", score_line(s));
            }
            if let Some(FinalError { rms: Some(rms), samples, removed }) = c.final_error {
                let _ = write!(out, "  final error {rms:.6} over {samples} samples with a value");
                let _ = writeln!(out, " ({removed} outliers removed)");
            }
            c.warnings.iter().for_each(|w| {
                let _ = writeln!(out, "  note: {}", printable(w));
            });
        }
        for difference in self.differs.iter().flatten() {
            let _ = writeln!(out, "note: not what the session recorded: {}", printable(difference));
        }
        out += &self.written.as_ref().map(Written::text).unwrap_or_default();
        out
    }
}

/// The residual of eq. (2) in a line.
pub(super) fn residual_line(SplineResidual { before, after }: &SplineResidual) -> String {
    format!("deviation from a smoothing spline: {} before the repair, {} after it", short(*before), short(*after))
}

/// A score in a line.
pub(super) fn score_line(s: &Scores) -> String {
    let false_alarms = s.samples.false_alarms;
    let mut line = format!("{} missed, {false_alarms} false alarm{}", s.samples.missed, plural(false_alarms));
    if let Some(rate) = s.recall {
        let _ = write!(line, ", rejection rate {:.1} %", 100.0 * rate);
    }
    if let Some(precision) = s.samples.precision {
        let _ = write!(line, ", precision {:.1} %", 100.0 * precision);
    }
    for (part, what) in [(s.isolated, "isolated"), (s.patches, "runs")] {
        if part.events > 0 {
            let _ = write!(
                line,
                "; {what}: {} of {} samples, {} of {} found",
                part.hits, part.samples, part.found, part.events
            );
        }
    }
    if s.events.false_alarms > 0 {
        let _ = write!(line, "; {} false event{}", s.events.false_alarms, plural(s.events.false_alarms));
    }
    line
}

/// What each check of a result objected to; the analyst's decisions play no part.
fn checks(outcome: &Outcome) -> Vec<CheckSummary> {
    let detection = &outcome.detection;
    let applied = &detection.setup.preparation.checks;
    let mut found = vec![[0_usize; 2]; applied.len()];
    for (check, verdict) in detection.objections() {
        if let Some([outliers, suspects]) = found.get_mut(check) {
            *(if verdict == Verdict::Outlier { outliers } else { suspects }) += 1;
        }
    }
    let made = applied.iter().zip(found).filter(|(applied, _)| applied.on);
    made.map(|(applied, [outliers, suspects])| CheckSummary { check: applied.to_string(), outliers, suspects })
        .collect()
}

fn calibration(detection: &Detection, unit: &str) -> Option<CalibrationSummary> {
    let found = detection.calibration.as_deref()?;
    Some(CalibrationSummary {
        resolution: found.resolution,
        held: found.held,
        limit: found.typical_limit(),
        words: found.words(unit).join("; "),
    })
}

fn json_settings(settings: &Settings) -> serde_json::Map<String, serde_json::Value> {
    settings.iter().map(|(p, v)| (p.key.to_owned(), serde_json::json!(v))).collect()
}
