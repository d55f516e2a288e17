//! What the figures of a document show, from a run here: results on a record to be drawn, and curves over many runs.

use super::record::Record;
use super::trial::{Keys, Trial, setup};
use crate::error::{Error, Result};
use crate::method::Filtered;
use crate::session::{Outcome, Preset};
use crate::stop::Stop;
use crate::track::{Samples, Series, Track};

/// A result that is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Picture {
    /// Which figures of the document it stands for, and what was done.
    pub title: &'static str,
    /// Id of the method.
    pub method: &'static str,
    /// The settings it starts from.
    pub preset: Preset,
    /// What differs from them.
    pub keys: Keys,
}

/// A record with the result that a [`Picture`] asks for.
#[derive(Debug)]
pub struct Shown {
    /// The title of the picture.
    pub title: &'static str,
    /// The record.
    pub track: Track,
    /// The samples of its first channel.
    pub samples: Samples,
    /// What came out.
    pub outcome: Outcome,
    /// The filtered track, where the document's figure shows it.
    pub filtered: Option<Filtered>,
}

impl Shown {
    /// Adds the filtered track.
    ///
    /// # Errors
    /// [`Error::Usage`] when the method has no model of the track.
    pub fn filter(&mut self) -> Result<()> {
        self.filtered = Some(filtered(&self.outcome, &self.samples.series(&self.track.channels[0], &self.track.time))?);
        Ok(())
    }
}

/// The filtered track of a result.
pub(super) fn filtered(outcome: &Outcome, series: &Series<'_>) -> Result<Filtered> {
    let none = || Error::usage("no model of the track", "this is a fault of the program: report it");
    crate::analysis::filtered(outcome, series, &Stop::never())?.ok_or_else(none)
}

/// Curves in one frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// What goes to the right.
    pub x: &'static str,
    /// What goes up.
    pub y: &'static str,
    /// True where x is on a logarithmic axis, as y always is.
    pub logarithmic_x: bool,
    /// The curves.
    pub curves: Vec<Curve>,
}

/// One curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name.
    pub name: &'static str,
    /// Its points, x ascending, both above 0.
    pub points: Vec<(f64, f64)>,
}

/// Judges a record for each of the pictures.
///
/// # Errors
/// What [`Trial::judge`] gives.
pub fn show(record: &Record, pictures: &[Picture]) -> Result<Vec<Shown>> {
    let one = |picture: &Picture| {
        let trial = Trial::of(record)?;
        let outcome = trial.judge(&setup(picture.method, picture.preset, picture.keys)?)?;
        Ok(trial.shown(picture.title, outcome))
    };
    pictures.iter().map(one).collect()
}
