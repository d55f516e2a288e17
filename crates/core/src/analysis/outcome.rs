//! What comes out for one channel: the method's word, the analyst's, and the repair.

use std::sync::Arc;

use super::Detection;
use crate::method::Verdict;
use crate::review::Ruling;

/// A sample that somebody has something to say about.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Mark {
    /// Position among the present samples.
    pub position: u32,
    /// What the method says.
    pub verdict: Verdict,
    /// What the analyst decided, if anything.
    pub ruling: Option<Ruling>,
    /// What the method said then, where that is known.
    pub said: Option<Verdict>,
}

impl Mark {
    /// What holds: the analyst's word where there is one.
    #[must_use]
    #[inline]
    pub fn effective(&self) -> Verdict {
        self.ruling.map_or(self.verdict, Ruling::verdict)
    }

    /// True when the analyst's word agreed with the method when it was given and is against what the method now
    /// says. (Overruling a flag, or flagging by hand, is no conflict: that is what decisions are for.)
    #[must_use]
    #[inline]
    pub fn conflict(&self) -> bool {
        let (Some(ruling), Some(said)) = (self.ruling, self.said) else { return false };
        let wild = ruling == Ruling::Outlier;
        wild == (said == Verdict::Outlier) && wild != (self.verdict == Verdict::Outlier)
    }
}

/// Consecutive outliers, within a segment.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Run {
    /// Position of the first.
    pub start: usize,
    /// How many.
    pub length: usize,
}

/// A missing sample that is filled.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Fill {
    /// Where it goes.
    pub place: Place,
    /// Its time in seconds.
    pub seconds: f64,
    /// Its value.
    pub value: f64,
}

/// Where a filled sample goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
pub enum Place {
    /// The empty cell of this row (from 0).
    Cell(usize),
    /// A new row after this one, the n-th of its gap (from 0).
    NewRow(usize, usize),
}

/// The result for one channel: the method's word, the analyst's, and the repair.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// What the method says.
    pub detection: Arc<Detection>,
    /// Outliers, suspects, and every sample that somebody decided on, by position.
    pub marks: Vec<Mark>,
    /// Positions of the outliers that hold, ascending.
    pub outliers: Vec<usize>,
    /// What takes the place of each of them; NaN where it is removed.
    pub fixes: Vec<f64>,
    /// The runs they form.
    pub runs: Vec<Run>,
    /// Missing samples that are filled, by place.
    pub fills: Vec<Fill>,
    /// How many of what.
    pub counts: Counts,
    /// What should be looked at before it is trusted, a line each: more than 5 % flagged, more than 5 % not judged,
    /// with the likely cause.
    pub doubts: Vec<String>,
    /// What should be known of the method's own repair, a line each.
    pub notes: Vec<String>,
}

/// How many samples of a channel are what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Counts {
    /// Rows of the file (in a table of several tracks: those of the track).
    pub rows: usize,
    /// Samples with a time and a value.
    pub present: usize,
    /// Rows without.
    pub missing: usize,
    /// Outliers that hold.
    pub flagged: usize,
    /// Those of them that a check failed.
    #[serde(skip_serializing_if = "is_zero")]
    pub by_checks: usize,
    /// Outliers alone.
    pub isolated: usize,
    /// Runs of two and more.
    pub patches: usize,
    /// Undecided suspects.
    pub suspects: usize,
    /// Samples with too few neighbours to judge.
    pub unchecked: usize,
    /// Outliers that got another value.
    pub repaired: usize,
    /// Outliers whose cell stays empty.
    pub removed: usize,
    /// Missing samples that were filled.
    pub filled: usize,
    /// Decisions of the analyst.
    pub decisions: usize,
    /// Decisions that the method contradicts.
    pub conflicts: usize,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde hands over a reference")]
fn is_zero(n: &usize) -> bool {
    *n == 0
}

impl Outcome {
    /// What the user should know, a line each: settings that cannot work, what the method ran into, and the doubts.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let setup = &self.detection.setup;
        let mut all = setup.method.warnings(&setup.settings);
        all.extend(self.detection.judged.warnings().iter().cloned());
        all.extend(self.doubts.iter().chain(&self.notes).cloned());
        all
    }

    /// The mark of the sample at `position`, if somebody has something to say about it.
    #[must_use]
    #[inline]
    pub fn mark(&self, position: usize) -> Option<&Mark> {
        let at = self.marks.binary_search_by_key(&position, |m| m.position as usize).ok()?;
        self.marks.get(at)
    }

    /// What holds for the sample at `position`.
    #[must_use]
    #[inline]
    pub fn verdict(&self, position: usize) -> Verdict {
        match self.mark(position) {
            Some(mark) => mark.effective(),
            None => self.detection.judged.verdict().get(position).copied().unwrap_or(Verdict::Missing),
        }
    }

    /// What takes the place of the outlier at `position`: none when it is no outlier, NaN when it is removed.
    #[must_use]
    #[inline]
    pub fn fix(&self, position: usize) -> Option<f64> {
        self.outliers.binary_search(&position).ok().and_then(|i| self.fixes.get(i).copied())
    }

    /// The run that holds the outlier at `position`.
    #[must_use]
    #[inline]
    pub fn run(&self, position: usize) -> Option<&Run> {
        let after = self.runs.partition_point(|r| r.start <= position);
        let run = self.runs.get(after.checked_sub(1)?)?;
        (position < run.start + run.length).then_some(run)
    }
}
