//! What a report says of a channel.

use super::super::summary::{ChannelSummary, residual_line, score_line};
use super::super::svg::{Pictures, figures};
use super::flagged::{self, Flagged};
use super::{Section, Table, measured};
use crate::analysis::filtered;
use crate::param::{Param, Settings, Value};
use crate::repair;
use crate::session::{Counts, Outcome, OutputValue, Plan, Preset};
use crate::stop::Stop;
use crate::track::{Samples, Track};

/// The section about the channel of `plan`, with its table of flags. Its pictures show the filtered track where `value`
/// says that it is what the cleaned file has.
pub(super) fn section(
    track: &Track,
    (plan, value): (&Plan, OutputValue),
    (index, samples, outcome): (usize, &Samples, &Outcome),
    summary: &ChannelSummary,
    (flagged, beside): (Flagged, Option<&str>),
) -> Section {
    let channel = &track.channels[index];
    let about = plan.setup.method.about();
    let series = samples.series(channel, &track.time);
    let unit = if channel.unit.is_empty() { String::new() } else { format!(" [{}]", channel.unit) };
    let rate = plan.setup.rate.as_ref().map_or(String::new(), |rate| format!(", with the rate {rate}"));
    let chosen = repair::chosen(&plan.setup.repair);
    let calibration = summary.calibration.as_ref().map(|found| format!("the record: {}", found.words));
    let mut notes: Vec<String> = calibration.into_iter().chain(summary.warnings.iter().cloned()).collect();
    notes.extend(measured::statement(plan, &channel.unit));
    notes.extend(summary.spline_residual.as_ref().map(residual_line));
    notes.extend(summary.score.as_ref().map(|s| format!("truth: {}", score_line(s))));
    notes.extend(
        summary
            .restarts
            .iter()
            .take(20)
            .map(|r| format!("the model restarted at row {} ({}), {}", r.row, r.time, r.direction)),
    );
    if summary.restarts.len() > 20 {
        notes.push(format!("… and {} more restarts", summary.restarts.len() - 20));
    }
    let rest = flagged::in_words(&flagged, beside);
    let listed = if flagged.table.rows.is_empty() { nothing_listed(&summary.counts) } else { rest };
    let filtered = (value == OutputValue::Filtered).then(|| filtered(outcome, &series, &Stop::never()).ok().flatten());
    let filtered = filtered.flatten();
    let Pictures { figures, close } = figures(track, channel, series, outcome, filtered.as_ref());
    Section {
        title: format!("{}{unit}", plan.channel),
        method: format!(
            "{} ({}; {}){rate}. Repair {}: {}.",
            about.id,
            about.name,
            about.source,
            chosen.id,
            chosen.help.trim_end_matches('.')
        ),
        counts: counts(summary),
        settings: settings(plan, &channel.unit),
        compared: measured::compared(plan, &channel.unit),
        notes,
        advice: about.advice.split_whitespace().collect::<Vec<_>>().join(" "),
        figures,
        filtered: filtered.is_some(),
        close,
        flags: flagged.table,
        listed,
        beside: beside.filter(|_| flagged.more > 0).map(str::to_owned),
    }
}

/// That no sample is listed, and of how many that is said.
fn nothing_listed(counts: &Counts) -> String {
    let nothing = "No sample is flagged, suspect or decided on";
    match counts.unchecked {
        0 => format!("{nothing}."),
        n => format!("{nothing}; {n} of {} could not be judged.", counts.present),
    }
}

fn counts(summary: &ChannelSummary) -> Vec<(String, String)> {
    let n = summary.counts;
    let all = [
        (n.present, "samples", true),
        (n.missing, "missing", false),
        (summary.segments, "segments", true),
        (n.flagged, "flagged", true),
        (n.isolated, "isolated", false),
        (n.patches, "runs", false),
        (n.repaired, "repaired", false),
        (n.removed, "removed", false),
        (n.filled, "filled", false),
        (n.suspects, "suspect", false),
        (n.unchecked, "unchecked", false),
        (n.decisions, "decided by the analyst", false),
        (n.conflicts, "decisions that contradict the method", false),
    ];
    let shown = all.into_iter().filter(|(count, _, always)| *always || *count > 0);
    shown.map(|(count, what, _)| (what.to_owned(), count.to_string())).collect()
}

/// The settings that matter, and where they come from.
fn settings(plan: &Plan, unit: &str) -> Table {
    let head = vec![("setting", false), ("value", true), ("unit", false), ("", false), ("meaning", false)];
    let method = plan.setup.method;
    let (default, paper) = (Preset::Default.settings(method), Preset::Paper.settings(method));
    let mut rows: Vec<Vec<String>> =
        plan.setup.settings.mattering().map(|(p, v)| row(p, v, &default, Some(&paper))).collect();
    let default = Settings::defaults(repair::PARAMS);
    rows.extend(plan.setup.repair.mattering().map(|(p, v)| row(p, v, &default, None)));
    for check in &plan.setup.preparation.checks {
        let (about, default) = (check.check.about(), Settings::defaults(check.settings.params()));
        let on = if check.on { "on" } else { "off" };
        let what = [&[on.to_owned()], check.channels.as_slice()].concat().join(" ");
        rows.push(vec![about.id.to_owned(), what, String::new(), "check before the method".into(), about.help.into()]);
        rows.extend(check.settings.mattering().map(|(p, v)| row(p, v, &default, None)));
    }
    if let Some(period) = plan.setup.preparation.period {
        let help = "a circular channel: judged unwrapped, written wrapped";
        rows.push(vec!["period".into(), period.to_string(), "channel units".into(), "set".into(), help.into()]);
    }
    if plan.setup.preparation.exclude_decided {
        let help = "samples accepted as outliers are excluded from the method";
        rows.push(vec!["exclude_decided".into(), "true".into(), String::new(), "set".into(), help.into()]);
    }
    // Where the unit is that of the channel, it is known here.
    let known = rows.iter_mut().filter(|row| row[2] == "channel units" && !unit.is_empty());
    known.for_each(|row| unit.clone_into(&mut row[2]));
    Table { head, rows, ..Table::default() }
}

fn row(param: &Param, value: Value, default: &Settings, paper: Option<&Settings>) -> Vec<String> {
    let is = |settings: &Settings| settings.get(param.key) == Some(value);
    let origin = match (is(default), paper.is_some_and(is) && param.paper.is_some_and(|p| p.printed)) {
        (true, true) => "default and paper",
        (true, false) => "default",
        (false, true) => "as in the paper",
        (false, false) => "set",
    };
    let key = if param.key == repair::METHOD.key && paper.is_none() { "repair" } else { param.key };
    vec![key.to_owned(), value.to_string(), param.unit_of(value).to_owned(), origin.to_owned(), param.help.to_owned()]
}
