//! The methods that a command puts side by side, with their settings.

use crate::cli::{CandidateArgs, PresetArg};
use crate::error::{Error, Result};
use crate::method::shared::MAX_GAP;
use crate::method::{Method, voting};
use crate::session::{Preset, Setup, candidates as all_of, method_of_id};

/// What the command line says of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked<'a> {
    /// Ids of methods; empty: all.
    pub(super) methods: &'a [String],
    /// The values they start from.
    pub(super) preset: PresetArg,
    /// The channel that measures the rate.
    pub(super) rate: Option<&'a str>,
    /// The gap limit of all.
    pub(super) max_gap: Option<&'a str>,
    /// `[ID.]KEY` and value.
    pub(super) set: &'a [(String, String)],
}

impl<'a> From<&'a CandidateArgs> for Asked<'a> {
    fn from(args: &'a CandidateArgs) -> Self {
        Self {
            methods: &args.method,
            preset: args.preset,
            rate: args.rate.as_deref(),
            max_gap: args.max_gap.as_deref(),
            set: &args.set,
        }
    }
}

/// The methods that take part, and the ids of those that cannot, since they need a rate channel.
#[derive(Debug)]
pub(super) struct Candidates {
    pub(super) setups: Vec<Setup>,
    pub(super) left_out: Vec<&'static str>,
}

/// The methods that were asked for.
///
/// # Errors
/// [`Error::Usage`] for a method, key or value that does not fit, and where no method takes part.
pub(super) fn candidates(asked: &Asked<'_>) -> Result<Candidates> {
    let named: Vec<&'static dyn Method> =
        asked.methods.iter().map(|id| Ok(method_of_id(id)?)).collect::<Result<_>>()?;
    let all = if named.is_empty() { voting().collect() } else { named };
    let (mut setups, left_out) = all_of(all, Preset::from(asked.preset), asked.rate);
    if setups.is_empty() {
        return Err(Error::usage("no method takes part", "name a rate channel with --rate, or another --method"));
    }
    if let Some(gap) = asked.max_gap {
        assign(&mut setups, MAX_GAP.key, gap)?;
    }
    for (key, value) in asked.set {
        assign(&mut setups, key, value)?;
    }
    Ok(Candidates { setups, left_out })
}

/// Sets `ID.KEY` of one method, or `KEY` of all that have it.
fn assign(setups: &mut [Setup], key: &str, value: &str) -> Result<()> {
    if let Some((id, key)) = key.split_once('.') {
        let method = method_of_id(id)?.about().id;
        return match setups.iter_mut().find(|s| s.method.about().id == method) {
            Some(setup) => Ok(setup.settings.set_text(method, key, value)?),
            None => {
                Err(Error::usage(format!("{id}: does not take part"), "name it with --method, or leave out its --set"))
            }
        };
    }
    let mut known = false;
    for setup in setups.iter_mut().filter(|s| s.settings.get(key).is_some()) {
        known = true;
        setup.settings.set_text(setup.method.about().id, key, value).map_err(|e| match e.into() {
            Error::Usage { what, help } => Error::usage(
                format!("{}: {what}", setup.method.about().id),
                format!("{help}\n  or set it for some methods only: --set ID.{key}=VALUE"),
            ),
            other => other,
        })?;
    }
    if known {
        return Ok(());
    }
    Err(Error::usage(format!("{key}: no method has such a parameter"), "see `wildpoint methods`; --set ID.KEY=VALUE"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_goes_to_one_method_or_to_all_that_have_it() {
        let ids = ["hampel", "two-sided"];
        let mut setups: Vec<Setup> =
            ids.iter().map(|id| Setup::new(method_of_id(id).unwrap(), Preset::Default)).collect();
        assign(&mut setups, "hampel.k", "7").unwrap();
        assign(&mut setups, "max_gap", "off").unwrap();
        assert_eq!((setups[0].settings.real("k"), setups[1].settings.real("k")), (7.0, 4.0));
        assert!(setups.iter().all(|s| s.settings.whole_or_off("max_gap").is_none()));
        for (key, value) in [("gesd.alpha", "0.1"), ("nonsense", "1"), ("hampel.nonsense", "1"), ("k", "x")] {
            assert!(assign(&mut setups, key, value).is_err(), "{key}={value}");
        }
    }
}
