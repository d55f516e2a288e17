//! The head of a file as it was found by the rules of [`Rules::First`](crate::track::Rules::First), within the first lines: sessions that were saved
//! then go on meaning what they meant.

use std::path::Path;

use super::super::number::Reading;
use super::super::sniff::{Look, look, most_frequent};
use super::super::table::{Line, Lines, typed_columns};
use super::super::text::Text;
use super::super::tokens::{Layout, RecordKind};
use super::super::{LoadOptions, names};
use super::{Head, MOST_PREAMBLE, SAMPLE, no_numbers, no_rows, no_table};
use crate::error::Result;

/// Cells of a line of units are shorter than this.
const LONGEST_UNIT: usize = 16;

/// Reads the head of `text`, which is laid out and read like this.
pub(super) fn head(
    text: &Text<'_>,
    (layout, reading): (Layout, Reading),
    options: &LoadOptions,
    path: &Path,
) -> Result<Head> {
    let of = Lines { body: text.body(), layout, encoding: text.encoding, skip: 0 };
    let all = of.first(SAMPLE + MOST_PREAMBLE, usize::MAX).map_err(|e| no_table(path, e))?;
    let lines: Vec<&Line> = all.iter().filter(|l| l.is_data()).collect();
    let typed = typed_columns(&lines, &reading);
    let found = lines.iter().take(MOST_PREAMBLE + 1).position(|l| is_row(l, &typed, &reading));
    let mut data = found.ok_or_else(|| no_numbers(&all, path))?;
    match options.header {
        Some(true) if data == 0 => data = 1,
        Some(false) => data = 0,
        _ => {}
    }
    let (before, rows) = lines.split_at(data.min(lines.len()));
    let [first, ..] = rows else { return Err(no_rows(path, &all)) };
    let usual = most_frequent(&counts(rows)).map_or(0, |(count, _)| count);
    let header_at = before.iter().enumerate().max_by_key(|(i, l)| (l.filled(), usize::MAX - i)).map(|(i, _)| i);
    let above = all.iter().position(Line::is_data).unwrap_or(all.len());
    let comments = all[..above].iter().filter(|l| l.kind == RecordKind::Comment);
    let header = match header_at {
        Some(at) => Some(before[at]),
        None if options.header == Some(false) => None,
        None => commented_header(comments, usual, &reading),
    };
    let units = header_at.map(|h| h + 1).filter(|u| u + 1 == data && is_units(before[*u])).map(|u| before[u]);
    let preamble = before.len();
    let complete = lines.len() == SAMPLE + MOST_PREAMBLE;
    Ok(Head { preamble, complete, ..of_lines(Found { header, units, first, rows, usual }, (layout, reading)) })
}

/// What was found among the first lines.
struct Found<'a> {
    header: Option<&'a Line>,
    units: Option<&'a Line>,
    first: &'a Line,
    rows: &'a [&'a Line],
    /// Cells that most rows have.
    usual: usize,
}

/// The head that these lines make.
fn of_lines(found: Found<'_>, (layout, reading): (Layout, Reading)) -> Head {
    let Found { header, units, first, rows, usual } = found;
    let widest = counts(rows).into_iter().max().unwrap_or(0);
    let width = header.map_or(widest, |h| h.cells.len().max(usual));
    let expected = header.map_or(width, |h| h.cells.len());
    let second = if usual.abs_diff(expected) == 1 && header.is_some() { usual } else { expected };
    let mut named = header.map(|h| h.cells.clone()).unwrap_or_default();
    named.resize(width, String::new());
    let unit = |(column, name): (usize, &String)| {
        let of_row = units.and_then(|u| u.cells.get(column)).map(|u| u.trim_matches(['(', ')', '[', ']']).trim());
        of_row.filter(|u| !u.is_empty()).map_or_else(|| names::earlier::unit_of(name), str::to_owned)
    };
    let place = |line: &Line| (line.start, line.length);
    let last = rows.last().map_or(first.start, |l| l.start);
    Head {
        layout,
        reading,
        preamble: 0,
        header: header.is_some(),
        header_line: header.map_or(first.number, |h| h.number),
        header_at: header.map(place),
        units_at: units.map(place),
        units: named.iter().enumerate().map(unit).collect(),
        names: names::unique(named),
        counts: [expected, second],
        data_start: first.start,
        data_end: None,
        data_line: first.number,
        repeats: Vec::new(),
        record_bytes: ((last - first.start) / (rows.len() - 1).max(1)).max(2),
        sample: rows.iter().map(|l| l.cells.clone()).collect(),
        oddities: vec![Vec::new(); width],
        styles: vec![None; width],
        fixed_width: false,
        asides: Vec::new(),
        format: None,
        closed: None,
        counted: None,
        utc: false,
        said: Vec::new(),
        complete: false,
    }
}

fn counts(rows: &[&Line]) -> Vec<usize> {
    rows.iter().map(|l| l.cells.len()).collect()
}

/// A row of data has numbers where the columns have them. A few may hold text, but not under the name of a time.
fn is_row(line: &Line, typed: &[bool], reading: &Reading) -> bool {
    let (mut read, mut text) = (0, 0);
    for (cell, _) in line.cells.iter().zip(typed).filter(|(_, typed)| **typed) {
        match look(cell.as_bytes(), reading) {
            Look::Number | Look::Time => read += 1,
            Look::Text if names::earlier::time_rank(cell) > 1 => return false,
            Look::Text => text += 1,
            Look::Empty => {}
        }
    }
    read > 0 && read >= text
}

fn is_units(line: &Line) -> bool {
    line.cells.iter().all(|c| c.chars().count() < LONGEST_UNIT)
}

/// The last comment that has a name for each cell of a row.
fn commented_header<'a>(
    comments: impl DoubleEndedIterator<Item = &'a Line>,
    usual: usize,
    reading: &Reading,
) -> Option<&'a Line> {
    let is_name = |cell: &String| look(cell.as_bytes(), reading) == Look::Text;
    comments.rev().find(|line| line.cells.len() == usual && usual > 1 && line.cells.iter().all(is_name))
}

#[cfg(test)]
mod tests {
    use super::super::super::{ColumnKind, LoadOptions, Rules, Source, TimeFormat, Track, load};

    fn loaded(text: &str, rules: Rules) -> Track {
        let options = LoadOptions { rules, ..LoadOptions::default() };
        load(&Source::BuiltIn { name: "test", bytes: text.as_bytes().into() }, &options).unwrap()
    }

    fn names(track: &Track) -> Vec<&str> {
        track.columns.iter().map(|c| c.name.as_str()).collect()
    }

    /// The header is the fullest line above the first row, and every line below it is a row.
    #[test]
    fn the_first_rules_take_every_line_below_the_fullest_one_above_the_rows() {
        let mut two = String::from("t,x\n");
        two.extend((0..5).map(|i| format!("{i},{}\n", i * 7 % 4)));
        two += "a,b,c\n";
        two.extend((0..30).map(|i| format!("{},{i},{}\n", i + 5, i * 7 % 4)));
        let earlier = loaded(&two, Rules::First);
        assert_eq!((earlier.rows, names(&earlier), earlier.dialect.preamble), (36, vec!["t", "x", "column_3"], 1));
        let later = loaded(&two, Rules::Second);
        assert_eq!((later.rows, names(&later)), (30, vec!["a", "b", "c"]));

        // A header that comes again was a row that could not be read.
        let again = format!("t,x\n{}t,x\n6,1\n", (0..6).map(|i| format!("{i},{}\n", i % 3)).collect::<String>());
        assert_eq!((loaded(&again, Rules::First).rows, loaded(&again, Rules::Second).rows), (8, 7));
    }

    #[test]
    fn a_row_with_a_text_among_records_of_kinds_stays_the_first_row() {
        // Android GNSS: two kinds of rows between comments. The first row was never taken for names.
        let mut text = String::from("# Fix,Provider,Lat,Lon\n#\nFix,gps,37.42,-122.07\n");
        text.extend((0..40).map(|i| format!("Raw,{i},{}.5,3\n", i * 31 % 17)));
        let track = loaded(&text, Rules::First);
        assert_eq!((track.rows, track.dialect.preamble), (41, 0));
        assert_eq!(names(&track), ["Fix", "Provider", "Lat", "Lon"]);
    }

    #[test]
    fn cells_units_and_times_are_those_of_the_first_rules() {
        let text =
            "time,age_day,is_outlier,w\n2021-03-04 23:00,1,0,5 g\n2021-03-04 24:00,2,1,6 g\n2021-03-05 01:00,3,0,7 g\n";
        let earlier = loaded(text, Rules::First);
        let kinds: Vec<ColumnKind> = earlier.columns.iter().map(|c| c.kind).collect();
        use ColumnKind::{Number, Text, Time};
        assert_eq!(kinds, [Time, Number, Number, Text]);
        assert_eq!((earlier.columns[1].unit.as_str(), earlier.faults.unreadable_times.count), ("", 1));
        assert_eq!(earlier.time.format, TimeFormat::Iso);
        let later = loaded(text, Rules::Second);
        assert_eq!((later.columns[1].unit.as_str(), later.faults.unreadable_times.count), ("d", 0));
        assert_eq!(later.columns[2].kind, ColumnKind::Truth);
    }
}
