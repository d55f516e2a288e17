//! The names and units of a table, in the lines above its rows.

use super::super::Delimiter;
use super::super::time::{DateOrder, fields};
use super::super::tokens::{Layout, RecordKind};
use super::units::{Kind, kind_of};
use super::{Line, Lines, Look, Reading, look, names, usual_width};

/// What the lines above the rows say of the columns.
#[derive(Debug, Clone, Default)]
pub(crate) struct Heading {
    /// The line of the names.
    pub(crate) names_at: Option<usize>,
    /// The names, one for each column; empty texts where there is none.
    pub(crate) names: Vec<String>,
    /// The line of the units.
    pub(crate) units_at: Option<usize>,
    /// The units, as the line has them.
    pub(crate) units: Vec<String>,
    /// How many cells the names have in their line.
    pub(crate) cells: Option<usize>,
}

impl Heading {
    /// The units alone, where they stand below line `at`.
    pub(crate) fn only_units_below(self, at: usize) -> Self {
        let units_at = self.units_at.filter(|u| *u > at);
        let units = if units_at.is_some() { self.units } else { Vec::new() };
        Self { units_at, units, ..Self::default() }
    }
}

/// The names in a line that the user says is the header.
pub(crate) fn named_cells(
    line: &Line,
    usual: usize,
    of: &Lines<'_>,
    row: Option<&Line>,
    reading: &Reading,
) -> Vec<String> {
    fitting(line, usual, of, row, reading).unwrap_or_else(|| line.cells.clone())
}

/// Lines that are looked at above the rows.
const MOST: usize = 12;

/// The heading of the rows that begin at `first`. Comments are asked where no other line has names, or where they alone
/// name a time.
pub(crate) fn heading(lines: &[Line], first: usize, of: &Lines<'_>, reading: &Reading) -> Heading {
    super::aligned::with_units(found(lines, first, of, reading), lines, first, of)
}

fn found(lines: &[Line], first: usize, of: &Lines<'_>, reading: &Reading) -> Heading {
    let plain = heading_among(lines, first, of, reading, false);
    let timed = |h: &Heading| h.names.iter().any(|n| names::time_rank(n) > 0);
    if plain.names_at.is_some() && timed(&plain) {
        return plain;
    }
    let all = heading_among(lines, first, of, reading, true);
    if all.names_at.is_some() && (plain.names_at.is_none() || timed(&all)) {
        return all;
    }
    if plain.names_at.is_some() {
        return plain;
    }
    let usual = usual_width(lines[first..].iter().filter(|l| l.is_data()).take(200));
    let loose = loose(lines, first, usual);
    loose.map_or(plain, |(at, cells)| Heading {
        names_at: Some(at),
        cells: Some(cells.len()),
        names: cells,
        ..Heading::default()
    })
}

fn heading_among(lines: &[Line], first: usize, of: &Lines<'_>, reading: &Reading, comments: bool) -> Heading {
    let rows: Vec<&Line> = lines[first..].iter().filter(|l| l.is_data()).take(200).collect();
    let usual = usual_width(rows.iter().copied());
    let mut heading = Heading::default();
    let mut above: Option<(usize, Vec<String>)> = None;
    let mut passed = 0;
    for at in (0..first).rev() {
        let line = &lines[at];
        let blank = line.kind == RecordKind::Blank || line.text.is_empty() || line.filled() == 0;
        passed += usize::from(!blank);
        if passed > MOST {
            break;
        }
        if blank || (line.kind == RecordKind::Comment && !comments) {
            continue;
        }
        let Some(cells) = fitting(line, usual, of, rows.first().copied(), reading) else {
            // A ruler may be of any width; what else does not fit ends the heading.
            let ruler = kind_of(&line.cells) == Kind::Ruler;
            // Among comments, rows of another kind may stand between the names and the rows.
            let other = comments && line.cells.iter().any(|c| look(c.as_bytes(), reading) == Look::Number);
            if ruler || (above.is_none() && (line.kind == RecordKind::Comment || other)) {
                continue;
            }
            break;
        };
        match kind_of(&cells) {
            Kind::Ruler | Kind::Types => {}
            Kind::Units if heading.units_at.is_none() && above.is_none() => {
                (heading.units_at, heading.units) = (Some(at), cells);
            }
            // The letters of dates (`YY MM DD hh mm`) are names above units like `yr mo dy hr mn`.
            Kind::Names | Kind::Units => match &above {
                None => above = Some((at, cells)),
                Some((names_at, below)) => {
                    // Units that nobody knows, below names of which one is that of a time.
                    let right_above = first == names_at + 1;
                    let beside =
                        right_above && rows.first().is_some_and(|row| are_settings(&cells, below, row, reading));
                    let later = heading.units_at.is_none()
                        && (beside || are_units(&cells, below, line, &lines[*names_at], right_above));
                    if later {
                        let is_number = |cell: &String| look(cell.as_bytes(), reading) == Look::Number;
                        let units = below.iter().map(|cell| if is_number(cell) { String::new() } else { cell.clone() });
                        (heading.units_at, heading.units) = (Some(*names_at), units.collect());
                        above = Some((at, cells));
                    }
                    break;
                }
            },
        }
    }
    if above.is_none() && heading.units_at.is_some() {
        // Nothing but words for units: they are the names then.
        let units = std::mem::take(&mut heading.units);
        above = heading.units_at.take().map(|at| (at, units));
    }
    if let Some((at, cells)) = above {
        heading.cells = Some(lines[at].cells.len());
        (heading.names_at, heading.names) = (Some(at), cells);
    }
    heading
}

/// Of the lines right above the rows the one that fills the most cells, where rows have now more cells and now less.
fn loose(lines: &[Line], first: usize, usual: usize) -> Option<(usize, Vec<String>)> {
    let above =
        (0..first).rev().take_while(|at| lines[*at].kind != RecordKind::Blank).filter(|at| lines[*at].is_data());
    let keyed = |line: &Line| line.cells.iter().any(|c| c == "=" || c == ":") || line.text.contains(" = ");
    let plain = Reading::default();
    let worded = |line: &Line| {
        let texts = line.cells.iter().filter(|c| look(c.as_bytes(), &plain) == Look::Text).count();
        texts * 2 > line.filled()
    };
    let fits = |at: &usize| {
        lines[*at].filled() * 2 >= usual.max(2)
            && lines[*at].filled() <= 2 * usual.max(1)
            && !keyed(&lines[*at])
            && worded(&lines[*at])
    };
    let found = above.take(3).take_while(fits).max_by_key(|at| (lines[*at].filled(), usize::MAX - at))?;
    Some((found, lines[found].cells.clone()))
}

/// True where `below` has units for the columns of the rows, and for others a number that stands there once: a setting
/// under its name.
fn are_settings(names_above: &[String], below: &[String], row: &Line, reading: &Reading) -> bool {
    let is_number = |cell: &String| look(cell.as_bytes(), reading) == Look::Number;
    let once = |at: usize| row.cells.get(at).is_none_or(String::is_empty);
    let numbers: Vec<usize> = (0..below.len()).filter(|at| is_number(&below[*at])).collect();
    names_above.len() == below.len()
        && !numbers.is_empty()
        && numbers.iter().all(|at| once(*at))
        && !names_above.iter().any(|name| name.is_empty() || is_number(name))
        && below.first().is_some_and(|cell| !cell.is_empty() && !is_number(cell))
}

/// True where `below` are the units of `names`.
fn are_units(names_above: &[String], below: &[String], upper: &Line, lower: &Line, right_above: bool) -> bool {
    const LONGEST_UNIT: usize = 16;
    let filled = |cells: &[String]| cells.iter().filter(|c| !c.is_empty()).count();
    let timed = |cells: &[String]| cells.iter().any(|c| names::time_rank(c) > 0);
    let short = below.iter().all(|c| c.chars().count() < LONGEST_UNIT);
    let same_kind = upper.kind == lower.kind;
    // A title fills fewer cells than the names below it; a pair of key and value is no pair of names.
    let pairs = names_above.len() == 2 && !timed(names_above);
    same_kind && right_above && short && !pairs && filled(names_above) >= filled(below) && timed(names_above)
}

/// The cells of a line, where there is one for each column: as the rows are parted, with one less, or in another way.
pub(super) fn fitting(
    line: &Line,
    usual: usize,
    of: &Lines<'_>,
    row: Option<&Line>,
    reading: &Reading,
) -> Option<Vec<String>> {
    let comment = line.kind == RecordKind::Comment;
    let texts = |cells: &[String]| {
        let numbers = cells.iter().filter(|c| matches!(look(c.as_bytes(), reading), Look::Number | Look::Time)).count();
        let words = cells.iter().filter(|c| look(c.as_bytes(), reading) == Look::Text).count();
        if kind_of(cells) == Kind::Types {
            return true;
        }
        // Numbers may be names (of depths, of bins) beside others.
        words > 0 && (!comment || numbers == 0)
    };
    let ways: Vec<Vec<String>> =
        std::iter::once(line.cells.clone()).chain(other_ways(line, of)).filter(|c| texts(c)).collect();
    if usual <= 1 {
        return ways.into_iter().next().filter(|c| c.len() == 1 && !comment);
    }
    if let Some(cells) = ways.iter().find(|c| c.len() == usual) {
        return Some(cells.clone());
    }
    let trimmed = |cells: &Vec<String>| {
        let kept = cells.iter().rposition(|c| !c.is_empty()).map_or(0, |at| at + 1);
        cells[..kept].to_vec()
    };
    if let Some(cells) = ways.iter().map(trimmed).find(|c| c.len() == usual) {
        return Some(cells);
    }
    let less = ways.iter().find(|c| c.len() + 1 == usual && usual > 2).map(|cells| widened(cells, row));
    // A header may have a cell more than the rows, which end early.
    let more = || {
        ways.iter()
            .find(|c| (c.len() == usual + 1 || c.len() > usual && !comment && c.len() <= usual + 2) && usual > 2)
            .cloned()
    };
    let timed = |cells: &Vec<String>| cells.iter().any(|c| names::time_rank(c) > 0);
    if comment { less.filter(timed) } else { less.or_else(more) }
}

/// Names of which there is one less than cells: the name of a time stands for date and time of day; rows that end with
/// a delimiter have an empty cell more; else the first column, that of labels, has no name.
fn widened(cells: &[String], row: Option<&Line>) -> Vec<String> {
    let mut cells = cells.to_vec();
    let told = |at: usize| {
        let text = row?.cells.get(at)?.as_bytes();
        fields(text, DateOrder::YearFirst).or_else(|| fields(text, DateOrder::DayFirst))?.told(text)
    };
    // GPS week and seconds of the week.
    let number = |at: usize| row.and_then(|r| r.cells.get(at)?.parse::<f64>().ok());
    let week = number(0).is_some_and(|w| (500.0..5000.0).contains(&w) && w.fract() == 0.0)
        && number(1).is_some_and(|s| (0.0..=604_800.0).contains(&s))
        && names::time_rank(&cells[0]) > 0;
    let apart =
        week || told(0).is_some_and(|t| t.days.is_some() && !t.clock) && told(1).is_some_and(|t| t.days.is_none());
    let ends_empty = row.and_then(|r| r.cells.last()).is_none_or(String::is_empty);
    let index = row.and_then(|r| r.cells.first()).is_some_and(|c| c.trim_matches('"').parse::<u64>().is_ok());
    if apart {
        cells.insert(1, String::new());
    } else if !ends_empty && index && (names::time_rank(&cells[0]) == 0 || told(1).is_some_and(|t| t.days.is_some())) {
        cells.insert(0, String::new());
    }
    cells
}

/// The cells of a line between other delimiters than those of the rows, and after a word with a colon.
fn other_ways<'a>(line: &'a Line, of: &'a Lines<'_>) -> impl Iterator<Item = Vec<String>> + 'a {
    let delimiters = [b',', b';', b'\t', b'|'].map(Delimiter::Byte).into_iter().chain([Delimiter::Blanks]);
    let rest = line
        .text
        .split_once(':')
        .filter(|(before, _)| !before.contains('='))
        .map(|(_, rest)| Line { text: rest.trim().to_owned(), ..line.clone() });
    let layout = of.layout;
    let ways = delimiters
        .filter(move |d| *d != layout.delimiter)
        .map(move |d| of.parted(line, Layout { delimiter: d, ..layout }));
    let wide = wide_parts(&line.text);
    ways.chain([wide]).chain(rest.map(|line| of.parted(&line, layout)))
}

/// Parts between two blanks and more: names may hold single ones.
fn wide_parts(text: &str) -> Vec<String> {
    text.split("  ").flat_map(|p| p.split('\t')).map(str::trim).filter(|p| !p.is_empty()).map(str::to_owned).collect()
}
