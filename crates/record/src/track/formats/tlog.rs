//! Mission Planner: telemetry logs as text, each message a line of names and values.

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::view::{Cell, Field, Kinds, Piece, Row, Sheet, Want, lines};

pub(super) const FORMAT: Format = Format {
    name: "Mission Planner telemetry (text)",
    about: "telemetry logs (tlog) that Mission Planner converted to text or CSV",
    known_by: "lines with a time and a name `mavlink_…_t`",
    maps: "a table for each message (`--table`), by default the one with the most rows; time at the start of the line; a track for \
           each system, where there are several; types and times of boot are not channels",
    known: |text| {
        let first: Vec<&str> = text.lines().filter(|l| !l.trim().is_empty()).take(20).collect();
        let messages = first.iter().filter(|l| l.contains("mavlink_") && l.starts_with(|c: char| c.is_ascii_digit()));
        messages.count() * 2 > first.len()
    },
    sheet: Some(sheet),
    ..PLAIN
};

/// Names that tell what is meant, not what was measured.
const NO_MEASUREMENTS: [(&str, Aside); 12] = [
    ("time_boot_ms", Aside::Time),
    ("time_usec", Aside::Time),
    ("time_unix_usec", Aside::Time),
    ("target_system", Aside::Id),
    ("target_component", Aside::Id),
    ("id", Aside::Id),
    ("fix_type", Aside::Quality),
    ("satellites_visible", Aside::Quality),
    ("type", Aside::Quality),
    ("autopilot", Aside::Quality),
    ("base_mode", Aside::Quality),
    ("system_status", Aside::Quality),
];

/// A message: its name, what stands before it, the names and values after it.
struct Message<'a> {
    time: Piece<'a>,
    system: String,
    name: &'a str,
    values: Vec<(String, Piece<'a>)>,
}

/// The message of a line, in cells between commas or blanks.
fn message(line: Piece<'_>) -> Option<Message<'_>> {
    let cells = if line.bytes.contains(&b',') { line.split(b',') } else { line.words() };
    let at = cells.iter().position(|c| c.bytes.starts_with(b"mavlink_"))?;
    let name = cells[at].text().trim_start_matches("mavlink_").trim_end_matches("_t");
    // System, component and number of the message stand right before its name.
    let system = at.checked_sub(3).and_then(|at| cells.get(at)).map_or_else(String::new, |c| c.decoded());
    let mut values: Vec<(String, Piece<'_>)> = Vec::new();
    let (mut key, mut count) = ("", 0);
    for cell in cells.iter().skip(at + 1).filter(|c| !c.bytes.is_empty()) {
        let text = cell.text();
        let is_name = text.starts_with(|c: char| c.is_ascii_alphabetic()) && !text.eq_ignore_ascii_case("nan");
        if is_name && (key.is_empty() || count > 0) {
            (key, count) = (text, 0);
            continue;
        }
        // A list of values stands under one name.
        let full = if count == 0 { key.to_owned() } else { format!("{key}[{count}]") };
        count += 1;
        if key != "Len" {
            values.push((full, *cell));
        }
    }
    Some(Message { time: *cells.first()?, system, name, values })
}

fn sheet(body: &[u8], want: Want) -> Result<Sheet> {
    let mut sheet = Sheet { timed: true, ..Sheet::default() };
    let mut kinds = Kinds::default();
    lines(body).filter_map(|line| message(line.all)).for_each(|m| kinds.count(m.name));
    let Some(chosen) = kinds.chosen(want, &[], &mut sheet.said)?.map(str::to_owned) else { return Ok(sheet) };
    sheet.fields = vec![Field::new("time", ""), Field::new("system", "").aside(Aside::Id)];
    let mut systems: Vec<String> = Vec::new();
    for line in lines(body) {
        let Some(message) = message(line.all).filter(|m| m.name == chosen) else { continue };
        let mut cells = vec![(0, Cell::At(message.time.range())), (1, Cell::Made(message.system.clone()))];
        for (name, value) in message.values {
            let field = sheet.fields.iter().position(|f| f.name == name).unwrap_or_else(|| {
                let aside = NO_MEASUREMENTS.iter().find(|(n, _)| *n == name).map(|(_, aside)| *aside);
                let field = Field::new(name, "");
                sheet.fields.push(match aside {
                    Some(aside) => field.aside(aside),
                    None => field,
                });
                sheet.fields.len() - 1
            });
            cells.push((field, Cell::At(value.range())));
        }
        if !systems.contains(&message.system) {
            systems.push(message.system);
        }
        sheet.rows.push(Row { line: line.number, cells });
    }
    sheet.track = Some(1).filter(|_| systems.len() > 1);
    Ok(sheet)
}
