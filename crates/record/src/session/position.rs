//! Channels that are one position.

use crate::check::{Applied, position};
use crate::error::{Error, Result, one_of};
use crate::track::{Channel, Track};

/// The check of the position of `names` (with commas between them), for `channel`, one of its channels; none for another
/// channel.
///
/// # Errors
/// [`Error::Usage`] for a channel that the record does not have, and for a number of channels that make no position.
pub fn position_check(track: &Track, channel: &Channel, names: &str) -> Result<Option<Applied>> {
    let find = |name: &str| {
        track.beside(channel, name).ok_or_else(|| {
            let all: Vec<&str> = track.channels.iter().map(|c| c.name.as_str()).collect();
            let what = format!("position {names}: no such channel: {name}");
            Error::usage(what, one_of("channels", name, &all))
        })
    };
    let channels: Vec<&Channel> = names.split(',').map(|name| find(name.trim())).collect::<Result<_>>()?;
    let mut check = Applied::new(&position::Position);
    check.channels = channels.iter().map(|c| c.name.clone()).collect();
    let is_latitude = |c: &Channel| c.unit.starts_with("deg") || c.name.to_lowercase().starts_with("lat");
    let geographic = channels.first().is_some_and(|c| is_latitude(c));
    check.set_text(position::COORDINATES, if geographic { position::GEOGRAPHIC } else { position::CARTESIAN })?;
    check.verify()?;
    Ok(channels.iter().any(|c| c.column == channel.column).then_some(check))
}
