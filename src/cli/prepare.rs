//! The options of what is done with channels before their methods see them.

use clap::Args;

use super::PresetArg;
use crate::check::parse_all;
use crate::error::{Error, Result, one_of};
use crate::session::{Preparation, Session, parse_period, position_check, suggested};
use crate::track::{Channel, Track};

/// What is done with the channels before their methods see them.
#[derive(Debug, Clone, Default, Args)]
pub struct PrepareArgs {
    /// A check before the method; repeatable. What it flags is an outlier or a suspect, and the method does not see it.
    ///
    /// valid-range:low=L,high=H; missing-values:values=-9999,1e20; stuck:fail=N,suspect=N (equal values in a row);
    /// rate:fail=R,suspect=R (change per second); null-island:channels=LAT,LON; none. Without this option, checks that the
    /// record clearly needs are made; `inspect` lists them.
    #[arg(long, value_name = "ID[:KEY=VALUE,...]")]
    pub check: Vec<String>,
    /// Period of circular channels (360, 24, 2pi), judged unwrapped and written wrapped; off: none. Repeatable, with the
    /// name of a channel before it [default: by unit and name, if the data agree].
    #[arg(long, value_name = "[CHANNEL=]PERIOD")]
    pub period: Vec<String>,
    /// Channels that are one position: a fix that cannot be reached at the largest speed of the track is an outlier in
    /// all of them. Latitude and longitude in degrees, height in metres; or x, y, z of one unit of length.
    #[arg(long, value_name = "LAT,LON[,HEIGHT]")]
    pub position: Option<String>,
}

impl PrepareArgs {
    /// What is done with `channel`. What the record suggests is left alone with the values of the papers, and where the
    /// user says otherwise.
    ///
    /// # Errors
    /// [`Error::Usage`] for an option that is not understood, or names a channel that is not there.
    pub fn of(&self, track: &Track, channel: &Channel, preset: PresetArg) -> Result<Preparation> {
        let wants = preset == PresetArg::Default && (self.check.is_empty() || self.period.is_empty());
        let own = if wants { suggested(channel) } else { Preparation::default() };
        let mut preparation = Preparation::default();
        let checks = if self.check.is_empty() { own.checks } else { parse_all(&self.check)? };
        checks.into_iter().for_each(|check| preparation.add(check));
        preparation.period = own.period.filter(|_| self.period.is_empty());
        for text in &self.period {
            let (name, period) = text.rsplit_once('=').map_or((None, text.as_str()), |(name, p)| (Some(name), p));
            let period = parse_period(period)?;
            if name.is_none_or(|name| track.means(name, channel)) {
                preparation.period = period;
            }
        }
        if let Some(names) = &self.position
            && let Some(check) = position_check(track, channel, names)?
        {
            preparation.add(check);
        }
        Ok(preparation)
    }

    /// Whether every option is understood, whatever the channels are.
    ///
    /// # Errors
    /// [`Error::Usage`] for an option that is not understood.
    pub fn understood(&self) -> Result<()> {
        parse_all(&self.check)?;
        for text in &self.period {
            parse_period(text.rsplit_once('=').map_or(text.as_str(), |(_, period)| period))?;
        }
        Ok(())
    }

    /// Prepares every channel of `session`.
    ///
    /// # Errors
    /// As [`PrepareArgs::of`]; [`Error::Usage`] for a channel that the record does not have.
    pub fn prepare(&self, session: &mut Session, track: &Track, preset: PresetArg) -> Result<()> {
        let named = self.period.iter().filter_map(|text| text.rsplit_once('=')).map(|(name, _)| name);
        for name in named {
            if !track.channels.iter().any(|channel| track.means(name, channel)) {
                return Err(no_such(track, name, "--period"));
            }
        }
        for plan in &mut session.plans {
            if let Some(channel) = track.channel(&plan.channel) {
                plan.setup.preparation = self.of(track, channel, preset)?;
            }
        }
        Ok(())
    }
}

fn no_such(track: &Track, name: &str, option: &str) -> Error {
    let names: Vec<&str> = track.channels.iter().map(|c| c.name.as_str()).collect();
    Error::usage(format!("{option} {name}: there is no such channel"), one_of("channels", name, &names))
}
