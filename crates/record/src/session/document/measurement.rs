//! What was measured of a channel, as a session file has it.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use serde::Deserialize;

use super::write::{list, quoted};
use crate::session::Setup;
use crate::session::detectability::{Detected, Kind};
use crate::session::measurement::{Comparison, Detectability, Measurement, Row};

/// The advice of a channel as the file has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenAdvice {
    seed: u64,
    samples: usize,
    tried: usize,
    kinds: Vec<String>,
    recommended: Option<String>,
    #[serde(default)]
    reasons: Vec<String>,
    #[serde(default)]
    table: Vec<WrittenRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenRow {
    method: String,
    /// The sizes from which on wild points are found, by kind.
    #[serde(default)]
    from: BTreeMap<String, f64>,
    /// The shares that are found, by kind.
    #[serde(default)]
    found: BTreeMap<String, f64>,
    recall: f64,
    flagged: usize,
    alone: usize,
    repair_error: Option<f64>,
}

/// The detectability of a channel as the file has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenDetectability {
    seed: u64,
    kinds: Vec<String>,
    #[serde(default)]
    from: BTreeMap<String, f64>,
    #[serde(default)]
    found: BTreeMap<String, f64>,
}

/// The lines of what was measured of a plan; none where nothing was. They end its `[[channel]]`.
pub(super) fn lines(measurement: &Measurement, setup: &Setup) -> Vec<String> {
    let mut lines = Vec::new();
    if let Some(found) = measurement.detectability_of(setup) {
        lines.push("[channel.detectability]".to_owned());
        lines.push(format!("seed = {}", found.seed));
        lines.push(kinds(found.found.iter().map(|found| found.kind)));
        lines.push(format!("from = {}", sizes(&found.found)));
        lines.push(format!("found = {}", shares(&found.found)));
    }
    if let Some(advice) = &measurement.advice {
        lines.push("[channel.advice]".to_owned());
        lines.push(format!("seed = {}", advice.seed));
        lines.push(format!("samples = {}", advice.samples));
        lines.push(format!("tried = {}", advice.tried));
        lines.push(kinds(advice.kinds.iter().copied()));
        lines.extend(advice.recommended.as_ref().map(|id| format!("recommended = {}", quoted(id))));
        lines.push("reasons = [".into());
        lines.extend(advice.reasons.iter().map(|reason| format!("  {},", quoted(reason))));
        lines.push("]".into());
        lines.push("table = [".into());
        lines.extend(advice.rows.iter().map(row));
        lines.push("]".into());
    }
    lines
}

fn row(row: &Row) -> String {
    let mut text = format!("  {{ method = {}", quoted(&row.method));
    let _ = write!(text, ", from = {}, found = {}", sizes(&row.found), shares(&row.found));
    let _ = write!(text, ", recall = {:?}, flagged = {}, alone = {}", row.recall, row.flagged, row.alone);
    if let Some(error) = row.repair_error {
        let _ = write!(text, ", repair_error = {error:?}");
    }
    text + " },"
}

fn kinds(kinds: impl Iterator<Item = Kind>) -> String {
    format!("kinds = {}", list(kinds.map(Kind::key)))
}

fn sizes(found: &[Detected]) -> String {
    by_kind(found, |found| found.smallest)
}

fn shares(found: &[Detected]) -> String {
    by_kind(found, |found| found.recall)
}

fn by_kind(found: &[Detected], value: impl Fn(&Detected) -> Option<f64>) -> String {
    let all = found.iter().filter_map(|found| Some(format!("{} = {:?}", found.kind.key(), value(found)?)));
    let all: Vec<String> = all.collect();
    if all.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", all.join(", ")) }
}

/// What the file says was measured of a channel, for a plan of `setup`.
///
/// # Errors
/// The text of what is not understood.
pub(super) fn read(
    advice: Option<WrittenAdvice>,
    detectability: Option<WrittenDetectability>,
    setup: &Setup,
) -> Result<Measurement, String> {
    let detectability = detectability.map(|written| {
        let kinds = kinds_of(&written.kinds)?;
        let found = detected(&kinds, &written.from, &written.found)?;
        Ok::<_, String>(Box::new(Detectability { setup: setup.clone(), seed: written.seed, found }))
    });
    let advice = advice.map(|written| {
        let kinds = kinds_of(&written.kinds)?;
        let rows = written.table.into_iter().map(|row| row.read(&kinds)).collect::<Result<_, _>>()?;
        let WrittenAdvice { seed, samples, tried, recommended, reasons, .. } = written;
        Ok::<_, String>(Box::new(Comparison { seed, samples, tried, kinds, rows, recommended, reasons }))
    });
    Ok(Measurement { advice: advice.transpose()?, detectability: detectability.transpose()? })
}

impl WrittenRow {
    fn read(self, kinds: &[Kind]) -> Result<Row, String> {
        let found = detected(kinds, &self.from, &self.found)?;
        let Self { method, recall, flagged, alone, repair_error, .. } = self;
        Ok(Row { method, found, recall, flagged, alone, repair_error })
    }
}

fn kinds_of(keys: &[String]) -> Result<Vec<Kind>, String> {
    let of = |key: &String| Kind::ALL.into_iter().find(|kind| kind.key() == key);
    keys.iter().map(|key| of(key).ok_or_else(|| format!("kinds: there is no kind {key:?} of wild points"))).collect()
}

fn detected(
    kinds: &[Kind],
    from: &BTreeMap<String, f64>,
    found: &BTreeMap<String, f64>,
) -> Result<Vec<Detected>, String> {
    if let Some(key) = from.keys().chain(found.keys()).find(|key| kinds.iter().all(|kind| kind.key() != *key)) {
        return Err(format!("{key}: not one of the kinds"));
    }
    let of = |&kind: &Kind| Detected {
        kind,
        smallest: from.get(kind.key()).copied(),
        recall: found.get(kind.key()).copied(),
    };
    Ok(kinds.iter().map(of).collect())
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::session::detectability::OnChannel;
    use crate::session::{Preset, Session, method_of_id, parse, render};
    use crate::stop::Stop;
    use crate::track::{LoadOptions, Samples, Source, load};

    /// A session on one channel of the demonstration record, on which two methods were compared.
    fn session() -> Session {
        let track = load(&Source::demo(), &LoadOptions::default()).unwrap();
        let setup = |id: &str| Setup::new(method_of_id(id).unwrap(), Preset::Default);
        let mut session = Session::new(&track, LoadOptions::default(), &setup("hampel"));
        session.plans.truncate(1);
        let channel = track.channel(&session.plans[0].channel).unwrap();
        let samples = Samples::of(channel, &track.time);
        let on_channel = OnChannel { track: &track, channel, samples: &samples, seed: 3 };
        let advice = on_channel.advise(vec![setup("wright"), setup("hampel")], &Stop::never(), |_| ()).unwrap();
        session.plans[0].measured = Measurement::of(&advice, 3, &channel.unit, &setup("hampel"));
        session
    }

    fn text(session: &Session) -> String {
        render(session, Path::new("s.toml"), &[Vec::new()]).unwrap()
    }

    #[test]
    fn what_was_measured_reads_back_and_is_written_the_same_again() {
        let mut session = session();
        let before = session.plans[0].measured.clone();
        assert_eq!(before.advice.as_ref().unwrap().rows.len(), 2);
        assert!(before.detectability.as_ref().unwrap().in_words("m").starts_with("finds 95 % of single points from"));
        let text = text(&session);
        let mut again = parse(Path::new("s.toml"), &text).unwrap();
        assert_eq!(again.plans[0].measured, before);
        assert_eq!(self::text(&again), text);
        // It is no part of what leads to the result.
        session.plans[0].measured = Measurement::default();
        assert_eq!(session.plans, again.plans);
        // With other settings the sizes no longer hold; what was compared stays true.
        again.plans[0].setup.set_text("k", "7").unwrap();
        let turned = self::text(&again);
        assert!(!turned.contains("[channel.detectability]") && turned.contains("[channel.advice]"), "{turned}");
    }

    #[test]
    fn a_kind_that_is_not_known_is_named_with_its_line() {
        let text = text(&session());
        for (from, to, what) in [
            ("\"run-of-10\"]", "\"run-of-11\"]", "run-of-11"),
            ("from = { single", "from = { held = 2.0, single", "held"),
        ] {
            let error = parse(Path::new("s.toml"), &text.replacen(from, to, 1)).unwrap_err().to_string();
            assert!(error.contains(what) && error.contains("s.toml:"), "{error}");
        }
    }
}
