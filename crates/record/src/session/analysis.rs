//! The pipeline of `wildpoint-core` on the channels of a record.

use std::sync::Arc;

use super::{Detection, Outcome, Setup};
use crate::analysis::{Input, Rows};
use crate::check::Applied;
use crate::error::{Error, Result, one_of};
use crate::review::Decisions;
use crate::stop::{Stop, Stopped};
use crate::track::{Channel, Samples, Series, Track};

/// Runs the method of `setup` over a channel. `previous` is another detection of the same channel: its scores are used
/// again where only a multiplier that gates differs, and its calibration where its method saw the same samples. The
/// result is the same to the last bit.
///
/// # Errors
/// [`Error::Stopped`]; [`Error::Memory`]; [`Error::Usage`] when the method needs a rate channel, or a check a channel, and
/// has none.
pub fn detect(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    setup: &Setup,
    previous: Option<&Detection>,
    stop: &Stop,
) -> Result<Detection> {
    detect_taught(track, channel, samples, (setup, &Decisions::default()), previous, stop)
}

/// [`detect`] that lets the method learn from the analyst's decisions, where the setup says so.
///
/// # Errors
/// As [`detect`].
pub fn detect_taught(
    track: &Track,
    channel: &Channel,
    samples: &Samples,
    (setup, decisions): (&Setup, &Decisions),
    previous: Option<&Detection>,
    stop: &Stop,
) -> Result<Detection> {
    let series = samples.series(channel, &track.time);
    let input = Input { decisions: Some(decisions), ..Input::new(&series, None) };
    if let Some(previous) = previous
        && let Some(detection) = previous.regated(input, setup, stop)?
    {
        return Ok(detection);
    }
    let rate = rate_of(track, channel, setup)?;
    let companions = companions(track, channel, &series, setup)?;
    let input = Input { rate: rate.as_ref(), companions: &companions, ..input };
    Ok(Detection::calibrated(input, setup, previous, stop)?)
}

/// The values of the channels that each check of `setup` names, at the samples of `series`.
pub(super) fn companions(
    track: &Track,
    channel: &Channel,
    series: &Series<'_>,
    setup: &Setup,
) -> Result<Vec<Vec<Vec<f64>>>> {
    let names = || track.channels.iter().map(|c| c.name.as_str()).collect::<Vec<_>>();
    let of_check = |applied: &Applied| {
        let values = |name: &String| match track.beside(channel, name) {
            Some(other) => Ok((0..series.len()).map(|i| other.value(series.row(i))).collect()),
            None => {
                let what = format!("{name}: there is no such channel for the check {}", applied.id());
                Err(Error::usage(what, one_of("channels", name, &names())))
            }
        };
        if applied.on { applied.channels.iter().map(values).collect() } else { Ok(Vec::new()) }
    };
    setup.preparation.checks.iter().map(of_check).collect()
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
    let names: Vec<&str> = track.channels.iter().map(|c| c.name.as_str()).collect();
    let Some(name) = &setup.rate else {
        return Err(Error::usage(
            format!("{id} needs a channel that measures the rate of the first"),
            format!("name it with --rate, or in the workbench at `rate` (3); channels: {}", names.join(", ")),
        ));
    };
    let found = track.beside(channel, name);
    found.map(Some).ok_or_else(|| {
        Error::usage(format!("{name}: there is no such channel for the rate"), one_of("channels", name, &names))
    })
}

/// A channel that is judged together with others.
#[derive(Debug, Clone, Copy)]
pub struct Member<'a> {
    /// The channel.
    pub channel: &'a Channel,
    /// Its present samples.
    pub samples: &'a Samples,
    /// Its setup: the method and its settings are those of all members.
    pub setup: &'a Setup,
    /// The analyst's decisions about it.
    pub decisions: &'a Decisions,
}

/// Runs a method that judges channels together ([`Method::together`](crate::method::Method::together)) over all
/// `members`; one detection for each.
///
/// # Errors
/// [`Error::Stopped`]; [`Error::Memory`]; [`Error::Usage`] when a check needs a channel that the record does not have.
pub fn detect_together(track: &Track, members: &[Member<'_>], stop: &Stop) -> Result<Vec<Detection>> {
    let series: Vec<Series<'_>> = members.iter().map(|m| m.samples.series(m.channel, &track.time)).collect();
    let beside = members.iter().zip(&series).map(|(m, series)| companions(track, m.channel, series, m.setup));
    let beside: Vec<Vec<Vec<Vec<f64>>>> = beside.collect::<Result<_>>()?;
    let mut channels = Vec::with_capacity(members.len());
    for ((member, series), companions) in members.iter().zip(&series).zip(&beside) {
        let input = Input { companions, decisions: Some(member.decisions), ..Input::new(series, None) };
        channels.push((input, member.setup));
    }
    Ok(Detection::together(&channels, stop)?)
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
