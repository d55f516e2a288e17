//! `clean --suggest`: thresholds from the record itself (section 8a of `docs/methods.md`).

use crate::cli::{AUTO, Shared};
use crate::error::{Error, Result};
use crate::session::sweep::{Threshold, multiplier, sweep, usual_values};
use crate::session::{Session, Setup};
use crate::stop::Stop;
use crate::track::{Samples, Track};

/// Gives each plan of `session` the suggested multiplier, where its channel has a clear gap between noise and wild
/// points. Returns what was done, a line for each plan.
///
/// # Errors
/// [`Error::Usage`] for a method without a multiplier; what a sweep gives.
pub(super) fn suggest(session: &mut Session, track: &Track) -> Result<Vec<String>> {
    let mut lines = Vec::with_capacity(session.plans.len());
    for plan in &mut session.plans {
        let param = multiplier(&plan.setup)?;
        let key = param.key;
        let Some(channel) = track.channel(&plan.channel) else { continue };
        let samples = Samples::of(channel, &track.time);
        let swept = sweep(track, channel, &samples, &plan.setup, (param, &usual_values(param)), &Stop::never())?;
        lines.push(match swept.threshold {
            Threshold::Suggested { suggestion, range } => {
                plan.setup.set_text(key, &suggestion.to_string())?;
                let (from, to) = (range.from, range.to);
                format!("{key} = {suggestion} was suggested: {range} from {key} = {from:.3} to {to:.3}")
            }
            Threshold::None { no_suggestion } => {
                let kept = plan.setup.settings.get(key).map_or(String::new(), |v| format!(": {key} stays {v}"));
                format!("nothing was suggested, {no_suggestion}{kept}")
            }
        });
    }
    Ok(lines)
}

/// Refuses a threshold that is both given and to be found.
///
/// # Errors
/// [`Error::Usage`].
pub(super) fn check(shared: &Shared, setup: &Setup) -> Result<()> {
    if shared.is_auto() {
        let what = format!("--suggest and --method {AUTO} both choose");
        return Err(Error::usage(what, "leave one of them out: the advice holds at the calibrated threshold"));
    }
    let key = multiplier(setup)?.key;
    if shared.set.iter().any(|(k, _)| k == key) {
        return Err(Error::usage(
            format!("--suggest finds {key} itself"),
            format!("leave out --set {key}, or --suggest"),
        ));
    }
    Ok(())
}

/// The session file with `lines`, one for each plan, as comments under the names of the channels.
pub(super) fn noted(document: &str, lines: &[String]) -> String {
    let mut lines = lines.iter();
    let mut out = String::with_capacity(document.len());
    let mut begins = false;
    for line in document.lines() {
        out += line;
        out.push('\n');
        if begins && let Some(note) = lines.next() {
            out += &format!("# {note}\n");
        }
        begins = line == "[[channel]]";
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_channel_has_its_note_under_its_name() {
        let document = "format = 1\n\n[[channel]]\nname = \"a\"\nmethod = \"x\"\n\n[[channel]]\nname = \"b\"\n";
        let noted = noted(document, &["one".into(), "two".into()]);
        assert!(noted.contains("name = \"a\"\n# one\nmethod") && noted.ends_with("name = \"b\"\n# two\n"), "{noted}");
    }
}
