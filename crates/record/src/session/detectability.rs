//! Which method to take on a channel of a record: [`wildpoint_core::detectability`] on its samples.

use super::Setup;
use super::analysis::{companions, rate_of};
use crate::analysis::Input;
use crate::error::Result;
use crate::stop::Stop;
use crate::track::{Channel, Samples, Track};

pub use wildpoint_core::detectability::{
    Advice, Budget, Curve, Kind, Measured, OF_ALL, Point, SIZES, Study, Tuned, Unsuitable,
};

/// The seed when none is given.
pub const SEED: u64 = 1;

/// A study of the methods of `setups` on a channel, with wild points from the random numbers of `seed`. `progress` hears
/// what is known after each round.
///
/// # Errors
/// What [`Study::new`] gives, and [`crate::error::Error::Usage`] when a method needs a rate channel, or a check a channel,
/// and has none.
pub fn advise(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    setups: Vec<Setup>,
    seed: u64,
    stop: &Stop,
    mut progress: impl FnMut(&Study),
) -> Result<Advice> {
    let mut study = begin(track, channel, samples, setups, seed, stop)?;
    progress(&study);
    while study.advance(stop)? {
        progress(&study);
    }
    Ok(study.advice())
}

/// A study that has not begun, of the methods of `setups` on a channel.
///
/// # Errors
/// As [`advise`].
pub fn begin(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    setups: Vec<Setup>,
    seed: u64,
    stop: &Stop,
) -> Result<Study> {
    on_channel(track, channel, samples, &setups.clone(), |input| Ok(Study::new(input, setups, seed, stop)?))
}

/// Settings with which the method of `setup` finds more on a channel, or why the channel cannot be asked: as
/// [`Study::tune`]. `allowed` says how many outliers on the record as it is (none: as many as with `setup`), and when no
/// further settings are to be tried.
///
/// # Errors
/// As [`advise`].
pub fn tune(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    setup: &Setup,
    seed: u64,
    (flags, is_over): (Option<usize>, &dyn Fn() -> bool),
    stop: &Stop,
) -> Result<std::result::Result<Tuned, Unsuitable>> {
    let mut study = begin(track, channel, samples, vec![setup.clone()], seed, stop)?;
    while study.advance(stop)? {}
    let now = study.advice().methods.first().map_or(0, |measured| measured.untouched.flagged);
    let budget = Budget { flags: flags.unwrap_or(now), is_over };
    let none = Unsuitable::TooShort { samples: samples.series(channel, &track.time).len() };
    Ok(study.tune(setup, &budget, stop)?.ok_or_else(|| study.unsuitable().unwrap_or(none)))
}

/// Does `work` on the samples of a channel, with the channels beside it that `setups` need.
fn on_channel<T>(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    setups: &[Setup],
    work: impl FnOnce(Input<'_>) -> Result<T>,
) -> Result<T> {
    let series = samples.series(channel, &track.time);
    let standard = Setup::standard();
    let first = setups.first().unwrap_or(&standard);
    let needs_rate = setups.iter().find(|setup| setup.method.about().needs_rate);
    let rate = rate_of(track, channel, needs_rate.unwrap_or(first))?;
    let companions = companions(track, channel, &series, first)?;
    work(Input { companions: &companions, ..Input::new(&series, rate.as_ref()) })
}
