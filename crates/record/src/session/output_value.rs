//! Which values the cleaned file has.

use super::{Outcome, Session};
use crate::error::{Error, Result};
use crate::method::{Filtered, METHODS};
use crate::param::Settings;
use crate::stop::Stop;
use crate::track::{Samples, Track, Worded};

/// Which values the cleaned file has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OutputValue {
    /// The measured ones, with wild points repaired or removed.
    #[default]
    Clean,
    /// Those of the method's model; where it has none, as [`OutputValue::Clean`].
    Filtered,
}

impl Worded for OutputValue {
    const WORDS: &'static [(&'static str, Self)] = &[("clean", Self::Clean), ("filtered", Self::Filtered)];
}

/// That every channel of `session` has the values that it asks for.
///
/// # Errors
/// [`Error::Usage`] naming the channel whose method has no model of the track.
pub fn check_value(session: &Session) -> Result<()> {
    let modelled = |plan: &&super::Plan| plan.setup.method.filter(&plan.setup.settings).is_some();
    match session.plans.iter().find(|plan| session.value == OutputValue::Filtered && !modelled(plan)) {
        None => Ok(()),
        Some(plan) => {
            let id = plan.setup.method.about().id;
            let what = format!("{id} has no filtered values for {}: it has no model of the track", plan.channel);
            Err(Error::usage(what, with_models()))
        }
    }
}

/// The methods that have one.
fn with_models() -> String {
    let by_default = |m: &&&dyn crate::method::Method| m.filter(&Settings::defaults(m.about().params)).is_some();
    let ids: Vec<&str> = METHODS.iter().filter(by_default).map(|m| m.about().id).collect();
    format!("take one of {}; wright has one from trend_order 1 on", ids.join(", "))
}

/// The filtered values of each channel, in the order of the plans: none where they are not asked for.
pub(super) fn filtered_of(
    session: &Session,
    track: &Track,
    channels: &[(usize, Samples, Outcome)],
    stop: &Stop,
) -> Result<Vec<Option<Filtered>>> {
    use rayon::prelude::*;
    match session.value {
        OutputValue::Clean => Ok(Vec::new()),
        OutputValue::Filtered => channels.par_iter().map(|channel| filtered(track, channel, stop)).collect(),
    }
}

/// How many present samples of each channel keep their clean value because the model has none for them, in words; nothing
/// where filtered values are not asked for.
#[must_use]
pub fn unfiltered(session: &Session, analysed: &super::Analysed) -> Vec<String> {
    let of_plan = |(plan, filtered): (&super::Plan, &Option<Filtered>)| {
        let without = filtered.as_ref()?.value.iter().filter(|value| !value.is_finite()).count();
        let are = if without == 1 { "sample has" } else { "samples have" };
        (without > 0).then(|| format!("{}: {without} {are} no filtered value, and keep the clean one", plan.channel))
    };
    session.plans.iter().zip(&analysed.filtered).filter_map(of_plan).collect()
}

/// The filtered values of a channel; none where its method has no model.
///
/// # Errors
/// [`Error::Stopped`].
pub fn filtered(
    track: &Track,
    (index, samples, outcome): &(usize, Samples, Outcome),
    stop: &Stop,
) -> Result<Option<Filtered>> {
    let series = samples.series(&track.channels[*index], &track.time);
    Ok(crate::analysis::filtered(outcome, &series, stop)?)
}
