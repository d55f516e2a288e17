//! Threshold advice for a channel of a record: [`wildpoint_core::sweep`] on its samples and its truth column.

use super::Setup;
use super::analysis::{companions, rate_of};
use crate::analysis::Input;
use crate::error::Result;
use crate::param::Param;
use crate::stop::Stop;
use crate::track::{Channel, Samples, Track};

pub use wildpoint_core::sweep::{
    FROM, Plateau, Point, STEPS, Sweep, TO, Threshold, grid, multiplier, numeric, usual_values,
};

/// Counts what the method of `setup` flags for each of `values` (ascending) of its parameter `param`, as
/// [`wildpoint_core::sweep::sweep`] does.
///
/// # Errors
/// What that gives, and [`crate::error::Error::Usage`] when the method needs a rate channel and has none.
pub fn sweep(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    setup: &Setup,
    (param, values): (&'static Param, &[f64]),
    stop: &Stop,
) -> Result<Sweep> {
    let series = samples.series(channel, &track.time);
    let rate = rate_of(track, channel, setup)?;
    let companions = companions(track, channel, &series, setup)?;
    let input = Input { companions: &companions, ..Input::new(&series, rate.as_ref()) };
    Ok(wildpoint_core::sweep::sweep(input, track.truth_for(&channel.name), setup, (param, values), stop)?)
}
