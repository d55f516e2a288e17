//! Which method to take on a channel of a record: [`wildpoint_core::detectability`] on its samples.

use super::Setup;
use super::analysis::{companions, rate_of};
use crate::analysis::Input;
use crate::error::Result;
use crate::stop::Stop;
use crate::track::{Channel, Samples, Track};

pub use wildpoint_core::detectability::{
    Advice, Budget, Curve, Detected, Kind, Measured, OF_ALL, Point, SIZES, Study, Tuned, Unsuitable, two_digits,
};

/// The seed when none is given.
pub const SEED: u64 = 1;

/// A channel that methods are measured on.
#[derive(Debug, Clone, Copy)]
pub struct OnChannel<'a> {
    /// The record.
    pub track: &'a Track,
    /// The channel.
    pub channel: &'a Channel,
    /// Its present samples.
    pub samples: &'a Samples,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl OnChannel<'_> {
    /// The advice on the methods of `setups`. `progress` hears what is known after each round.
    ///
    /// # Errors
    /// What [`Study::new`] gives, and [`crate::error::Error::Usage`] when a method needs a rate channel, or a check a
    /// channel, and has none.
    pub fn advise(&self, setups: Vec<Setup>, stop: &Stop, mut progress: impl FnMut(&Study)) -> Result<Advice> {
        let mut study = self.begin(setups, stop)?;
        progress(&study);
        while study.advance(stop)? {
            progress(&study);
        }
        Ok(study.advice())
    }

    /// A study that has not begun, of the methods of `setups`.
    ///
    /// # Errors
    /// As [`OnChannel::advise`].
    pub fn begin(&self, setups: Vec<Setup>, stop: &Stop) -> Result<Study> {
        self.with(&setups.clone(), |input| Ok(Study::new(input, setups, self.seed, stop)?))
    }

    /// Settings with which the method of `setup` finds more, or why the channel cannot be asked: as [`Study::tune`].
    ///
    /// # Errors
    /// As [`OnChannel::advise`].
    pub fn tune(
        &self,
        setup: &Setup,
        budget: &Budget<'_>,
        stop: &Stop,
    ) -> Result<std::result::Result<Tuned, Unsuitable>> {
        let mut study = self.begin(vec![setup.clone()], stop)?;
        while study.advance(stop)? {}
        let none = Unsuitable::TooShort { samples: self.samples.series(self.channel, &self.track.time).len() };
        Ok(study.tune(setup, budget, stop)?.ok_or_else(|| study.unsuitable().unwrap_or(none)))
    }

    /// Does `work` on the samples, with the channels beside them that `setups` need.
    fn with<T>(&self, setups: &[Setup], work: impl FnOnce(Input<'_>) -> Result<T>) -> Result<T> {
        let Self { track, channel, samples, .. } = *self;
        let series = samples.series(channel, &track.time);
        let standard = Setup::standard();
        let first = setups.first().unwrap_or(&standard);
        let needs_rate = setups.iter().find(|setup| setup.method.about().needs_rate);
        let rate = rate_of(track, channel, needs_rate.unwrap_or(first))?;
        let companions = companions(track, channel, &series, first)?;
        work(Input { companions: &companions, ..Input::new(&series, rate.as_ref()) })
    }
}
