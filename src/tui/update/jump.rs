//! Jumps after `/`: to a time, a row, so much further on, or to the next sample that is looked for.

use super::super::find::Query;
use super::super::model::{Model, Tone};
use super::navigate;
use crate::track::{SECONDS_PER_DAY, printable};

/// The forms of a jump: what can be typed, and where it leads.
pub static FORMS: &[(&str, &str)] = &[
    ("1239.5  12:31:07", "the sample nearest to a time, written as in the record"),
    ("#533", "a data row of the file, from 1"),
    ("+5s  -2m  +1h", "a duration forwards or backwards"),
    ("+100  -20", "a number of samples forwards or backwards"),
    ("y>8  y<=-2.5", "the next sample by its value"),
    ("z>8", "the next sample whose residual exceeds this (panel 2)"),
    ("step>2", "the next sample whose step exceeds this"),
    ("state:suspect", "or unreviewed, accepted, rejected, byhand, conflict"),
    ("verdict:unchecked", "or outlier, suspect, normal: what the method says"),
    ("note:staging", "the next note with these words; a plain word also works"),
];

/// Jumps; nothing typed repeats the jump before.
///
/// # Errors
/// Why there is nothing to jump to.
pub(super) fn jump(model: &mut Model, text: &str) -> Result<(), String> {
    let typed = text.trim();
    let text = match (typed.is_empty(), model.jumped.clone()) {
        (false, _) => typed.to_owned(),
        (true, Some(before)) => before,
        (true, None) => return Err("nothing to repeat yet".into()),
    };
    match target(model, &text)? {
        Target::Position(position) => navigate::go_to(model, position),
        Target::Next(query) => {
            let Some((position, wrapped)) = query.next(model) else {
                return Err(format!("{}: no such sample in this channel", printable(&text)));
            };
            let here = position == model.state().cursor;
            navigate::go_to(model, position);
            let row = model.series().row(position) + 1;
            let how = match (here, wrapped) {
                (true, _) => "the only one",
                (false, true) => "from the start of the record again",
                (false, false) => "/ Enter goes on",
            };
            let tone = if wrapped { Tone::Warning } else { Tone::Done };
            model.say(tone, format!("{} at row {row} · {how}", printable(&text)));
        }
    }
    model.jumped = Some(text);
    Ok(())
}

enum Target {
    Position(usize),
    Next(Query),
}

fn target(model: &Model, text: &str) -> Result<Target, String> {
    if let Some(row) = text.strip_prefix('#') {
        return row_of(model, row.trim()).map(Target::Position);
    }
    if let Some(query) = Query::parse(text)? {
        return Ok(Target::Next(query));
    }
    let series = model.series();
    let span = (series.t.first().copied().unwrap_or(0.0), series.t.last().copied().unwrap_or(0.0));
    // `-5` may also be a time of a record that counts down to its start.
    let time = model.track.time.parse(text).filter(|t| t.is_finite());
    let inside = time.filter(|t| (span.0..=span.1).contains(t) && !text.starts_with('+'));
    if let Some(t) = inside {
        return position(model, t);
    }
    match (relative(model, text), time) {
        (Some(position), _) => Ok(Target::Position(position)),
        (None, Some(t)) => position(model, t),
        (None, None) => {
            let words = text.to_lowercase();
            let noted = model.plan().decisions.iter().any(|(_, d)| d.note.to_lowercase().contains(&words));
            if noted {
                return Ok(Target::Next(Query::Note(words)));
            }
            Err(format!("{}: no time of this record, none of the forms above, and in no note", printable(text)))
        }
    }
}

fn position(model: &Model, t: f64) -> Result<Target, String> {
    model.nearest(t).map(Target::Position).ok_or_else(|| "this channel has no samples".into())
}

fn row_of(model: &Model, text: &str) -> Result<usize, String> {
    let row: usize = text.parse().map_err(|_| format!("#{}: a row is a whole number", printable(text)))?;
    let rows = model.track.rows;
    let row = row.checked_sub(1).filter(|r| *r < rows).ok_or_else(|| format!("#{text}: rows go from 1 to {rows}"))?;
    model.series().position(row).ok_or_else(|| format!("row {} has no value or no usable time", row + 1))
}

/// This many samples or so much time from the cursor.
fn relative(model: &Model, text: &str) -> Option<usize> {
    let (forward, size) = match text.split_at_checked(1)? {
        ("+", rest) => (true, rest.trim()),
        ("-", rest) => (false, rest.trim()),
        _ => return None,
    };
    let series = model.series();
    let cursor = model.state().cursor;
    let last = series.len().checked_sub(1)?;
    if let Ok(samples) = size.parse::<usize>() {
        return Some(if forward { cursor.saturating_add(samples).min(last) } else { cursor.saturating_sub(samples) });
    }
    let number = size.trim_end_matches(char::is_alphabetic);
    let unit = match &size[number.len()..] {
        "" | "s" => 1.0,
        "ms" => 1e-3,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        "d" => SECONDS_PER_DAY,
        _ => return None,
    };
    let by = number.trim().parse::<f64>().ok().filter(|x| x.is_finite())? * unit;
    let here = series.t.get(cursor)?;
    model.nearest(if forward { here + by } else { here - by })
}
