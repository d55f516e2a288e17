//! One run of an experiment: a record goes through the same pipeline as a user's file, and is scored.

use std::sync::Arc;

use super::record::{Record, Wild};
use super::shown::{self, Shown};
use crate::error::{Error, Result};
use crate::method::shared::FLOOR;
use crate::review::Decisions;
use crate::score::{FinalError, final_error};
use crate::session::{Outcome, Preset, Setup, detect, method_of_id, settle};
use crate::stop::Stop;
use crate::track::{LoadOptions, Samples, Source, Track, load};

/// A simulated record, loaded.
#[derive(Debug)]
pub struct Trial<'a> {
    record: &'a Record,
    track: Track,
    samples: Samples,
}

/// What a result says of the samples whose truth the simulation knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally {
    /// Samples flagged.
    pub flagged: usize,
    /// Wild samples not flagged.
    pub missed: usize,
    /// Good samples flagged.
    pub false_alarms: usize,
    /// Flagged ones among those put in alone.
    pub isolated: usize,
    /// Flagged ones among those of patches.
    pub patch: usize,
    /// Flagged ones among those of the varying kind.
    pub varying: usize,
}

impl Tally {
    /// Wild samples flagged.
    #[must_use]
    pub fn hits(&self) -> usize {
        self.isolated + self.patch + self.varying
    }
}

/// Keys of a method with their values.
pub type Keys = &'static [(&'static str, &'static str)];

/// The settings of `method`: a preset and a few keys.
///
/// # Errors
/// [`Error::Usage`] for a method, key or value that does not fit.
pub fn setup(method: &str, preset: Preset, keys: &[(&str, &str)]) -> Result<Setup> {
    let mut setup = Setup::new(method_of_id(method)?, preset);
    // The documents know no calibration: what is compared with them is the method as they describe it.
    setup.set_text(FLOOR.key, "auto")?;
    keys.iter().try_for_each(|(key, value)| setup.set_text(key, value))?;
    Ok(setup)
}

impl<'a> Trial<'a> {
    /// Loads the CSV file of `record`.
    ///
    /// # Errors
    /// What the loader gives: a fault of the simulation.
    pub fn of(record: &'a Record) -> Result<Self> {
        let bytes = Arc::from(record.csv().into_bytes());
        let source = Source::BuiltIn { name: "wildpoint:simulated", bytes };
        let track = load(&source, &LoadOptions::default())?;
        let Some(channel) = track.channels.first() else {
            return Err(Error::usage("a simulated record has no channel", "this is a fault of the program: report it"));
        };
        let samples = Samples::of(channel, &track.time);
        Ok(Self { record, track, samples })
    }

    /// The record with a result on it, to be drawn.
    #[must_use]
    pub fn shown(self, title: &'static str, outcome: Outcome) -> Shown {
        Shown { title, track: self.track, samples: self.samples, outcome, filtered: None }
    }

    /// Judges and repairs the first channel. A method that needs a rate gets the second signal.
    ///
    /// # Errors
    /// [`Error::Usage`] when the method needs a rate and the record has none.
    pub fn judge(&self, setup: &Setup) -> Result<Outcome> {
        let mut setup = setup.clone();
        if setup.method.about().needs_rate {
            setup.rate = self.record.signals.get(1).map(|s| s.name.to_owned());
        }
        let channel = &self.track.channels[0];
        let stop = Stop::never();
        let detection = detect(&self.track, channel, &self.samples, &setup, None, &stop)?;
        let decisions = Decisions::default();
        Ok(settle(&self.track, channel, &self.samples, Arc::new(detection), &decisions, &stop)?)
    }

    /// The filtered track of a result.
    ///
    /// # Errors
    /// [`Error::Usage`] when its method has no model of the track.
    pub fn filtered(&self, outcome: &Outcome) -> Result<Vec<f64>> {
        Ok(shown::filtered(outcome, &self.series())?.value)
    }

    /// What `outcome` found.
    #[must_use]
    pub fn tally(&self, outcome: &Outcome) -> Tally {
        let flagged: Vec<Option<Wild>> = outcome.outliers.iter().map(|&i| self.record.wild[i]).collect();
        let count = |kind: Option<Wild>| flagged.iter().filter(|w| **w == kind).count();
        let wild = self.record.wild.iter().flatten().count();
        let false_alarms = count(None);
        Tally {
            flagged: flagged.len(),
            missed: wild + false_alarms - flagged.len(),
            false_alarms,
            isolated: count(Some(Wild::Isolated)),
            patch: count(Some(Wild::Patch)),
            varying: count(Some(Wild::Varying)),
        }
    }

    /// How far the repaired channel is from the data before the outliers were added.
    #[must_use]
    pub fn final_error(&self, outcome: &Outcome) -> FinalError {
        let series = self.samples.series(&self.track.channels[0], &self.track.time);
        let clean = self.record.signals[0].clean.as_deref().unwrap_or(&[]);
        final_error(outcome, &series, clean)
    }

    /// Root mean square of the repaired channel minus the data before the outliers were added, over the samples of
    /// one kind. None where none of them has a value.
    #[must_use]
    pub fn repair_error(&self, outcome: &Outcome, kind: Wild) -> Option<f64> {
        let signal = &self.record.signals[0];
        let clean = signal.clean.as_deref()?;
        let of_kind = (0..clean.len()).filter(|&i| self.record.wild[i] == Some(kind));
        let off = of_kind.map(|i| outcome.fix(i).unwrap_or(signal.values[i]) - clean[i]).filter(|d| d.is_finite());
        let (count, sum) = off.fold((0.0, 0.0), |(n, sum), d| (n + 1.0, sum + d * d));
        (count > 0.0).then(|| (sum / count).sqrt())
    }

    /// The samples of the judged channel.
    #[must_use]
    pub fn series(&self) -> crate::track::Series<'_> {
        self.samples.series(&self.track.channels[0], &self.track.time)
    }
}

#[cfg(test)]
mod tests {
    use super::super::record::Signal;
    use super::*;

    #[test]
    fn a_tally_tells_kinds_apart() {
        let n = 40;
        let clean: Vec<f64> = (0..n).map(|i| f64::from(i % 2)).collect();
        let mut errors = vec![0.0; 40];
        let mut wild = vec![None; 40];
        // Flagged: two of each kind but one; a patch sample too small to flag; a good one that is not what it was.
        for (at, error, kind) in [(3, 50.0, Some(Wild::Isolated)), (8, 50.0, Some(Wild::Patch))] {
            (errors[at], wild[at]) = (error, kind);
        }
        wild[9] = Some(Wild::Patch);
        (errors[20], wild[20]) = (50.0, Some(Wild::Varying));
        errors[30] = 50.0;
        let time = Signal::new("t_s", 0, (0..n).map(f64::from).collect());
        let record = Record::new(time, vec![Signal::with_errors("y", 1, &clean, &errors)], wild);
        let trial = Trial::of(&record).unwrap();
        let outcome = trial.judge(&setup("wright", Preset::Default, &[("k", "2"), ("max_passes", "1")]).unwrap());
        let tally = trial.tally(&outcome.unwrap());
        let expected = Tally { flagged: 4, missed: 1, false_alarms: 1, isolated: 1, patch: 1, varying: 1 };
        assert_eq!(tally, expected);
        assert_eq!(tally.hits(), 3);
    }
}
