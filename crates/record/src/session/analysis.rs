//! The pipeline of `wildpoint-core` on the channels of a record.

use std::sync::Arc;

use super::{Detection, Outcome, Setup};
use crate::analysis::{Input, Rows};
use crate::error::{Error, Result};
use crate::review::Decisions;
use crate::stop::{Stop, Stopped};
use crate::track::{Channel, Samples, Series, Track};

/// Runs the method of `setup` over a channel. With `previous`, a detection of the same channel that differs in a
/// multiplier that only gates, its scores are used again; the result is the same to the last bit.
///
/// # Errors
/// [`Error::Stopped`]; [`Error::Usage`] when the method needs a rate channel and has none.
pub fn detect(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    setup: &Setup,
    previous: Option<&Detection>,
    stop: &Stop,
) -> Result<Detection> {
    let series = samples.series(channel, &track.time);
    if let Some(previous) = previous
        && let Some(detection) = previous.regated(&series, setup, stop)?
    {
        return Ok(detection);
    }
    let rate = rate_of(track, channel, setup)?;
    Ok(Detection::of(Input { series: &series, rate: rate.as_ref() }, setup, stop)?)
}

/// The samples of the channel that measures the rate of `channel`, where the method of `setup` needs one.
pub(super) fn rate_of<'a>(track: &'a Track, channel: &Channel, setup: &Setup) -> Result<Option<Series<'a>>> {
    Ok(rate_channel(track, channel, setup)?.map(|c| c.series(&track.time)))
}

fn rate_channel<'a>(track: &'a Track, channel: &Channel, setup: &Setup) -> Result<Option<&'a Channel>> {
    let id = setup.method.about().id;
    if !setup.method.about().needs_rate {
        return Ok(None);
    }
    let names = || track.channels.iter().map(|c| c.name.as_str()).collect::<Vec<_>>().join(", ");
    let Some(name) = &setup.rate else {
        return Err(Error::usage(
            format!("{id} needs a channel that measures the rate of the first"),
            format!("name it with --rate, or in the workbench at `rate` (3); channels: {}", names()),
        ));
    };
    let found = track.beside(channel, name);
    found.map(Some).ok_or_else(|| {
        Error::usage(format!("{name}: there is no such channel for the rate"), format!("channels: {}", names()))
    })
}

/// Runs a method that judges channels together ([`Method::together`](crate::method::Method::together)) over all
/// `channels` that share `setup`; one detection for each.
///
/// # Errors
/// [`Error::Stopped`].
pub fn detect_together(
    track: &Track,
    channels: &[(&Channel, &Samples)],
    setup: &Setup,
    stop: &Stop,
) -> Result<Vec<Detection>> {
    let series: Vec<Series<'_>> =
        channels.iter().map(|(channel, samples)| samples.series(channel, &track.time)).collect();
    let series: Vec<&Series<'_>> = series.iter().collect();
    Ok(Detection::together(&series, setup, stop)?)
}

/// Lets the decisions win over the detection, repairs the outliers that hold, and fills gaps.
///
/// # Errors
/// [`Stopped`] as soon as nobody waits for the result any more.
pub fn settle(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    detection: Arc<Detection>,
    decisions: &Decisions,
    stop: &Stop,
) -> std::result::Result<Outcome, Stopped> {
    let series = samples.series(channel, &track.time);
    let own = channel.target.as_ref().map(|t| &*t.rows);
    let rows = Rows { seconds: &track.time.seconds, own };
    crate::analysis::settle(&series, rows, detection, decisions, stop)
}
