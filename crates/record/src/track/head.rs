//! The head of a file: titles, header, units, and a sample of the rows under them.

use std::path::Path;

use super::facts::Facts;
use super::formats::{Known, Label};
use super::number::Reading;
use super::odd::{Oddity, odd};
use super::sniff::{SAMPLE_BYTES, sniff};
use super::style::Style;
use super::table::{Heading, Line, Lines, MOST_COLUMNS, NoTable, Table, heading, mark_of, tables, usual_width};
use super::text::Text;
use super::tokens::{Layout, Mark, OpenQuote};
use super::view::View;
use super::{Aside, Format, LoadOptions, Rules, Zero, names, printable};
use crate::error::{Error, Result};

mod earlier;
mod settings;

/// Rows that are looked at.
const SAMPLE: usize = 200;
/// Lines that may stand before the data, besides comments, where the first lines tell enough.
const MOST_PREAMBLE: usize = 20;
/// Lines and bytes that are looked at where the first lines do not tell enough.
const MOST_LINES: usize = 20_000;
const MOST_BYTES: usize = 1 << 20;

/// Offset and length of a line in the body.
pub(crate) type Place = (usize, usize);

/// What the first lines tell.
#[derive(Debug)]
pub(crate) struct Head {
    /// How records and cells are told apart.
    pub(crate) layout: Layout,
    /// How cells are read.
    pub(crate) reading: Reading,
    /// Records before the first data row that are neither comments nor blank.
    pub(crate) preamble: usize,
    /// True when a header names the columns.
    pub(crate) header: bool,
    /// The line of the header, or of the first row.
    pub(crate) header_line: u64,
    /// Where the header stands, where there is one.
    pub(crate) header_at: Option<Place>,
    /// Where the units stand, where there are such.
    pub(crate) units_at: Option<Place>,
    /// The names of the columns, unique.
    pub(crate) names: Vec<String>,
    /// Their units, or empty texts.
    pub(crate) units: Vec<String>,
    /// Numbers of cells that a row may have without being ragged.
    pub(crate) counts: [usize; 2],
    /// Offset of the first data row in the body.
    pub(crate) data_start: usize,
    /// Offset of what follows the last row, where that is known before all is read.
    pub(crate) data_end: Option<usize>,
    /// Line of the first data row, from 1.
    pub(crate) data_line: u64,
    /// Lines that come again among the rows and are none: header and units.
    pub(crate) repeats: Vec<Vec<u8>>,
    /// The cells of the first rows.
    pub(crate) sample: Vec<Vec<String>>,
    /// Mean length of a record of the sample with its line end, in bytes.
    pub(crate) record_bytes: usize,
    /// For each column, which oddities its cells may have.
    pub(crate) oddities: Vec<Vec<Oddity>>,
    /// For each column, how its numbers are written.
    pub(crate) styles: Vec<Option<Style>>,
    /// True where every row has the same length.
    pub(crate) fixed_width: bool,
    /// For each column, why it is not a channel, as far as the format of the file tells.
    pub(crate) asides: Vec<Option<Aside>>,
    /// The format of the file, where one is known.
    pub(crate) format: Option<&'static Format>,
    /// The format of the file, where it has no place for other columns.
    pub(crate) closed: Option<&'static Format>,
    /// What the times of the file are counted in, in nanoseconds, and from when, as far as its format tells.
    pub(crate) counted: Option<(i64, Zero)>,
    /// True where the format of the file says that its clocks are those of UTC, or of a scale that is written like it.
    pub(crate) utc: bool,
    /// What was recognised that a user may want to correct.
    pub(crate) said: Vec<String>,
    /// True when the first lines were enough to tell all.
    complete: bool,
}

/// The error for a quote that is not closed.
pub(crate) fn open_quote(path: &Path, quote: OpenQuote) -> Error {
    Error::Input {
        path: path.to_path_buf(),
        line: Some(quote.line),
        what: "a quoted cell starts here and does not end within 1000 lines or 1 MiB".into(),
        help: "close the quote or remove it; if quotes are ordinary characters, use --no-quotes".into(),
    }
}

fn no_table(path: &Path, e: NoTable) -> Error {
    match e {
        NoTable::Open(quote) => open_quote(path, quote),
        NoTable::Wide { line } => Error::Input {
            path: path.to_path_buf(),
            line: Some(line),
            what: format!("more than {MOST_COLUMNS} cells in a row"),
            help: "name the --delimiter if it was taken for another; a table that wide is to be split by columns"
                .into(),
        },
    }
}

/// The lines that were looked at, and the tables among them.
struct Seen {
    lines: Vec<Line>,
    tables: Vec<Table>,
    /// True when the first lines were enough.
    complete: bool,
}

impl Head {
    /// Reads the head of `text`.
    ///
    /// # Errors
    /// [`Error::Input`] for an open quote, a file without rows, and one without numbers; [`Error::Usage`] for a line or
    /// a table that is not there.
    pub(crate) fn of(text: &Text<'_>, options: &LoadOptions, path: &Path) -> Result<Self> {
        if text.is_columnar() {
            return Self::of_columns(text, options, path);
        }
        let (layout, decimal_comma) = sniff(text.body(), options);
        let reading = Reading::new(decimal_comma, &options.missing).by(options.rules);
        // Sessions by the first rules that say where the table stands are later than those rules.
        if options.rules == Rules::First && !options.tells_table() {
            return earlier::head(text, (layout, reading), options, path);
        }
        let mut of = Lines { body: text.body(), layout, encoding: text.encoding, skip: options.skip.unwrap_or(0) };
        let mut seen = Seen::of(&of, &reading, options).map_err(|e| no_table(path, e))?;
        let Some(first) = seen.chosen(options)?.map(|(_, t)| t.first) else {
            return Err(no_numbers(&seen.lines, path));
        };
        if options.comment.is_none()
            && let Some(mark) = mark_of(&seen.lines, first, layout, options)
        {
            of.layout.mark = Some(mark);
            seen = Seen::of(&of, &reading, options).map_err(|e| no_table(path, e))?;
        }
        let Some((number, table)) = seen.chosen(options)? else { return Err(no_numbers(&seen.lines, path)) };
        Self::of_table(&seen, (number, table), &of, reading, (options, path))
    }

    fn of_table(
        seen: &Seen,
        (number, table): (usize, Table),
        of: &Lines<'_>,
        reading: Reading,
        (options, path): (&LoadOptions, &Path),
    ) -> Result<Self> {
        let lines = &seen.lines[..table.after];
        let (first, heading) = told_heading(lines, table.first, of, &reading, options)?;
        Self::under(seen, (number, table), (first, heading), of, reading, (options, path))
    }

    /// The head of a file that stores columns: the names stand in the first line, and every other line is a row.
    fn of_columns(text: &Text<'_>, options: &LoadOptions, path: &Path) -> Result<Self> {
        let layout = Layout { delimiter: super::Delimiter::Byte(b','), quote: Some(b'"'), line_end: b'\n', mark: None };
        let of = Lines { body: text.body(), layout, encoding: text.encoding, skip: 0 };
        let lines = of.first(SAMPLE + 1, usize::MAX).map_err(|e| no_table(path, e))?;
        let [names, _, ..] = lines.as_slice() else {
            return Err(Error::input(path, "columns, and no rows in them", "name a file with rows of numbers"));
        };
        let count = Some(names.cells.len());
        let heading = Heading { names_at: Some(0), names: names.cells.clone(), cells: count, ..Heading::default() };
        let table = Table { first: 1, after: lines.len(), rows: lines.len() - 1 };
        let seen = Seen { lines, tables: vec![table], complete: true };
        let reading = Reading::new(false, &options.missing);
        let head = Self::under(&seen, (1, table), (1, heading), &of, reading, (options, path))?;
        Ok(Self { repeats: Vec::new(), ..head })
    }

    fn under(
        seen: &Seen,
        (number, table): (usize, Table),
        (first, heading): (usize, Heading),
        of: &Lines<'_>,
        reading: Reading,
        (options, path): (&LoadOptions, &Path),
    ) -> Result<Self> {
        let lines = &seen.lines[..table.after];
        let rows: Vec<&Line> = lines[first.min(lines.len())..].iter().filter(|l| l.is_data()).take(SAMPLE).collect();
        let [row, ..] = rows.as_slice() else { return Err(no_rows(path, lines)) };
        let usual = usual_width(rows.iter().copied());
        let header = heading.names_at.is_some();
        let widest = rows.iter().map(|l| l.cells.len()).max().unwrap_or(0);
        let expected = heading.names_at.map(|_| heading.cells.unwrap_or(heading.names.len()));
        let (names, width) = named(&heading, options, usual, widest);
        let expected =
            expected.filter(|e| e.abs_diff(usual) > 1).unwrap_or(if header { heading.names.len() } else { width });
        let counts = [expected, if usual.abs_diff(expected) == 1 && header { usual } else { expected }];
        let counts = if options.names.is_empty() { counts } else { [usual, usual] };
        let units = (0..width).map(|i| unit(&heading, &names, i)).collect();
        let place = |at: Option<usize>| at.map(|at| (lines[at].start, lines[at].length));
        let repeats = [heading.names_at, heading.units_at].into_iter().flatten().filter(|at| lines[*at].is_data());
        let repeats =
            repeats.map(|at| of.body[lines[at].start..lines[at].start + lines[at].length].trim_ascii().to_vec());
        let last = rows[rows.len() - 1];
        let sample: Vec<Vec<String>> = rows.iter().map(|l| l.cells.clone()).collect();
        let oddities = (0..width).map(|c| oddities_of(&sample, c, &reading, options)).collect();
        let cells = |c: usize| sample.iter().filter_map(move |row| row.get(c)).map(String::as_str);
        let second = options.rules == Rules::Second;
        let style = |c: usize| Style::of(cells(c), &reading).filter(|_| second);
        let styles = (0..width).map(style).collect();
        let fixed_width = second
            && of.layout.delimiter == super::Delimiter::Blanks
            && rows.len() > 2
            && rows.iter().all(|r| r.length == row.length);
        let beside = if second { settings::columns(&sample, &reading) } else { 0 };
        let mut said = seen.said(number, first, of.layout.mark, options);
        if beside > 0 {
            said.push(format!("settings stand beside the first rows, in the first {beside} columns"));
        }
        let end = lines.last().filter(|_| table.after < seen.lines.len()).map(|l| l.next);
        Ok(Self {
            layout: of.layout,
            units,
            preamble: lines[..first].iter().filter(|l| l.is_data()).count(),
            header,
            header_line: heading.names_at.map_or(row.number, |at| lines[at].number),
            header_at: place(heading.names_at),
            units_at: place(heading.units_at),
            names,
            counts,
            data_start: row.start,
            data_end: end,
            data_line: row.number,
            repeats: repeats.collect(),
            record_bytes: ((last.start - row.start) / (rows.len() - 1).max(1)).max(2),
            sample,
            reading,
            oddities,
            styles,
            fixed_width,
            asides: vec![Some(Aside::Setting); beside],
            format: None,
            closed: None,
            counted: None,
            utc: false,
            said,
            complete: seen.complete && end.is_none() && rows.len() == SAMPLE,
        })
    }

    /// Takes what the format of the file tells of its columns.
    pub(crate) fn take(&mut self, known: &Known, view: Option<&View>, facts: Option<&Facts>) {
        let labels: Vec<Label> = match (view, facts) {
            (Some(view), _) => view.sheet.fields.iter().map(Label::of).collect(),
            (None, Some(facts)) => facts.columns.iter().map(Label::of_column).collect(),
            (None, None) => self.names.iter().map(|name| known.label(name)).collect(),
        };
        self.units.iter_mut().zip(&labels).for_each(|(unit, label)| {
            if let Some(told) = &label.unit {
                unit.clone_from(told);
            }
        });
        let beside = std::mem::take(&mut self.asides);
        let own = |column: usize| beside.get(column).copied().flatten();
        self.asides = labels.into_iter().enumerate().map(|(c, label)| label.aside.or_else(|| own(c))).collect();
        self.counted = known.counted;
        self.utc = view.map(|view| view.format).or(known.format()).is_some_and(|format| format.utc);
        self.format = known.format();
        self.closed = known.closed(self.header_at.is_some());
        self.said.extend(known.said.iter().cloned());
    }

    /// True when the head of `part`, the first whole lines of a longer text, is that of the whole text: nothing of what
    /// it was told from lay near the end.
    pub(crate) fn needs_no_more(&self, part: &[u8]) -> bool {
        self.complete && part.len() > self.data_start + SAMPLE_BYTES
    }

    /// The sampled cells of a column; rows with another number of cells than usual are left out while there are
    /// others, for they may be of another kind.
    pub(crate) fn column(&self, column: usize) -> Vec<&str> {
        let whole = |row: &Vec<String>| self.counts.contains(&row.len());
        let any = self.sample.iter().any(whole);
        let rows = self.sample.iter().filter(|r| !any || whole(r));
        rows.filter_map(|r| r.get(column)).map(String::as_str).collect()
    }
}

impl Seen {
    /// The first lines where they tell enough, otherwise more of them.
    fn of(of: &Lines<'_>, reading: &Reading, options: &LoadOptions) -> std::result::Result<Self, NoTable> {
        let told = options.header_line.max(options.units_line).unwrap_or(0);
        let lines = of.first(SAMPLE + MOST_PREAMBLE + told, usize::MAX)?;
        let tables = tables(&lines, reading);
        let all = lines.last().is_none_or(|l| l.next >= of.body.len());
        let plain = |t: &Table| {
            lines[..t.first].iter().filter(|l| l.is_data()).count() <= MOST_PREAMBLE && t.rows >= SAMPLE / 2
        };
        let clean = matches!(tables.as_slice(), [only] if plain(only));
        if all || (clean && options.table.is_none_or(|t| t == 1)) {
            return Ok(Self { complete: clean, lines, tables });
        }
        let lines = of.first(MOST_LINES, MOST_BYTES)?;
        let tables = super::table::tables(&lines, reading);
        Ok(Self { complete: false, lines, tables })
    }

    /// The table that is read, and its number from 1.
    fn chosen(&self, options: &LoadOptions) -> Result<Option<(usize, Table)>> {
        if let Some(wanted) = options.table {
            let found = wanted.checked_sub(1).and_then(|t| self.tables.get(t)).copied();
            return found.map(|t| Some((wanted, t))).ok_or_else(|| {
                let count = self.tables.len();
                let what =
                    format!("there is no table {wanted}: {count} {} found", if count == 1 { "is" } else { "are" });
                Error::usage(what, format!("tables count from 1; {}", self.listed()))
            });
        }
        if let Some(line) = options.header_line {
            let after = |t: &&(usize, Table)| self.lines[t.1.after - 1].number > line as u64;
            return Ok((1..).zip(self.tables.iter().copied()).collect::<Vec<_>>().iter().find(after).copied());
        }
        let numbered = (1..).zip(self.tables.iter().copied());
        Ok(numbered.max_by_key(|(number, t)| (t.rows, usize::MAX - number)))
    }

    fn listed(&self) -> String {
        let one = |(n, t): (usize, &Table)| {
            format!("{n} has its rows in lines {} to {}", self.lines[t.first].number, self.lines[t.after - 1].number)
        };
        (1..).zip(&self.tables).take(6).map(one).collect::<Vec<_>>().join(", ")
    }

    fn said(&self, number: usize, first: usize, mark: Option<Mark>, options: &LoadOptions) -> Vec<String> {
        let mut said = Vec::new();
        if self.tables.len() > 1 && options.table.is_none() {
            said.push(format!(
                "{} tables in one file: {}; table {number} is read (--table reads another)",
                self.tables.len(),
                self.listed()
            ));
        }
        let above = self.lines[..first].iter().filter(|l| l.is_data()).count();
        let marked =
            mark.filter(|_| options.comment.is_none()).map(|m| String::from_utf8_lossy(m.bytes()).into_owned());
        if let Some(mark) = marked {
            said.push(format!("lines that begin with {} are comments", printable(&mark)));
        }
        if above > 3 && options.header_line.is_none() && options.skip.is_none() {
            said.push(format!(
                "the rows begin in line {}, below {above} lines of other text (--header-line names the line of the header)",
                self.lines[first].number
            ));
        }
        said
    }
}

/// The first row, and what the lines above it say: as the options have it, or as it is detected.
fn told_heading(
    lines: &[Line],
    first: usize,
    of: &Lines<'_>,
    reading: &Reading,
    options: &LoadOptions,
) -> Result<(usize, Heading)> {
    let place = |number: usize, option: &str| {
        lines.iter().position(|l| l.number == number as u64).ok_or_else(|| {
            Error::usage(format!("--{option} {number}: there is no such line above the rows"), "lines count from 1")
        })
    };
    let mut first = first;
    let mut found = match (options.header_line, options.header) {
        (Some(number), _) => {
            let at = place(number, "header-line")?;
            let row = (at + 1..lines.len()).find(|i| lines[*i].is_data()).unwrap_or(lines.len());
            first = if at < first { first } else { row };
            let usual = usual_width(lines[first.min(lines.len())..].iter().filter(|l| l.is_data()).take(SAMPLE));
            let cells = super::table::named_cells(&lines[at], usual, of, lines.get(first), reading);
            let count = cells.len();
            Heading {
                names_at: Some(at),
                names: cells,
                cells: Some(count),
                ..heading(lines, first, of, reading).only_units_below(at)
            }
        }
        (None, Some(false)) => {
            first = lines.iter().position(Line::is_data).unwrap_or(first).min(first);
            Heading::default()
        }
        (None, Some(true)) if !lines[..first].iter().any(Line::is_data) => {
            let at = first;
            first = (at + 1..lines.len()).find(|i| lines[*i].is_data()).unwrap_or(lines.len());
            Heading {
                names_at: Some(at),
                names: lines[at].cells.clone(),
                cells: Some(lines[at].cells.len()),
                ..Heading::default()
            }
        }
        _ => heading(lines, first, of, reading),
    };
    if let Some(number) = options.units_line {
        let at = place(number, "units-line")?;
        (found.units_at, found.units) = (Some(at), lines[at].cells.clone());
        if at >= first {
            first = (at + 1..lines.len()).find(|i| lines[*i].is_data()).unwrap_or(lines.len());
        }
        if found.names_at == Some(at) {
            (found.names_at, found.names, found.cells) = (None, Vec::new(), None);
        }
    }
    Ok((first, found))
}

/// The names of the columns, and how many there are.
fn named(heading: &Heading, options: &LoadOptions, usual: usize, widest: usize) -> (Vec<String>, usize) {
    let width = match heading.names_at {
        Some(_) => heading.names.len().max(usual),
        None => widest,
    };
    let mut named = heading.names.clone();
    named.resize(width, String::new());
    for (name, told) in named.iter_mut().zip(&options.names) {
        if !told.is_empty() {
            name.clone_from(told);
        }
    }
    (names::unique(named), width)
}

/// The unit of a column: that of the line of units, or that in its name.
fn unit(heading: &Heading, names: &[String], column: usize) -> String {
    let of_row = heading.units.get(column).map(|u| u.trim_matches(['(', ')', '[', ']']).trim().to_owned());
    of_row.filter(|u| !u.is_empty() && u != "-").unwrap_or_else(|| names::unit_of(&names[column]))
}

/// Which oddities the cells of a column have, where it is one of numbers all the same.
fn oddities_of(sample: &[Vec<String>], column: usize, reading: &Reading, options: &LoadOptions) -> Vec<Oddity> {
    if options.rules == Rules::First {
        return Vec::new();
    }
    // What can be nothing else is read in any column of numbers.
    let mut found = vec![Oddity::DExponent, Oddity::Formula, Oddity::SpacedSign, Oddity::Limit];
    let (mut bare, mut odds, mut texts, mut loose) = (0, 0, 0, 0);
    let mut seen = Vec::new();
    for cell in sample.iter().filter_map(|row| row.get(column)).filter(|c| !reading.is_marker(c.as_bytes())) {
        match (reading.number(cell.as_bytes()), odd(cell.as_bytes(), reading.decimal_comma)) {
            (Some(_), _) => bare += 1,
            (None, Some(odd)) => {
                odds += 1;
                loose += usize::from(odd.oddity == Oddity::Letter && !cell.contains([' ', '.', ',']));
                if !seen.contains(&odd.oddity) {
                    seen.push(odd.oddity);
                }
            }
            (None, None) => texts += 1,
        }
    }
    // A house number (12A) is no measurement.
    let named = loose * 2 > bare + odds || (bare == 0 && seen == [Oddity::Letter] && loose > 0);
    if !named && (bare + odds) * 5 >= (bare + odds + texts) * 4 {
        found.extend(seen.into_iter().filter(|o| !found.contains(o)).collect::<Vec<_>>());
    }
    found
}

fn no_rows(path: &Path, lines: &[Line]) -> Error {
    Error::Input {
        path: path.to_path_buf(),
        line: lines.iter().find(|l| l.is_data()).map(|l| l.number),
        what: "a header, and no rows under it".into(),
        help: "name a file with a header and rows of numbers".into(),
    }
}

fn no_numbers(lines: &[Line], path: &Path) -> Error {
    let data: Vec<&Line> = lines.iter().filter(|l| l.is_data()).collect();
    match data.as_slice() {
        [] => Error::input(path, "no rows: nothing but comments or blank lines", "name a file with rows of numbers"),
        [_] => no_rows(path, lines),
        [first, ..] => Error::Input {
            path: path.to_path_buf(),
            line: Some(first.number),
            what: format!("no column of numbers in the first lines; they start with `{}`", shown(first)),
            help:
                "expected a header and rows of numbers, in columns parted by comma, semicolon, tab, | or blanks; where \
                   they begin can be said (--header-line, --skip)"
                    .into(),
        },
    }
}

fn shown(line: &Line) -> String {
    printable(&line.cells.join(" ").chars().take(60).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head_with(text: &str, options: &LoadOptions) -> Result<Head> {
        let path = Path::new("x.csv");
        Head::of(&Text::of(text.as_bytes(), path, None)?, options, path)
    }

    fn head(text: &str) -> Head {
        head_with(text, &LoadOptions::default()).unwrap()
    }

    #[test]
    fn header_units_and_titles_are_told_apart() {
        let h = head("time,alt\n0,1\n1,2\n");
        assert_eq!((h.header, h.units_at.is_some(), h.preamble, h.data_line), (true, false, 1, 2));
        let h = head("time,alt,state\ns,ft,\n0,1,a\n1,2,b\n");
        assert_eq!((h.header, h.units_at.is_some(), h.preamble), (true, true, 2));
        assert_eq!(h.units, ["s", "ft", ""]);
        let h = head("SpCond,,\nstart,end,gap\n2014-01-24 13:15,2014-02-26 13:30,-20.00\n");
        assert_eq!((h.names.join(" "), h.header_line, h.preamble), ("start end gap".into(), 2, 2));
        let h = head("0,1\n1,2\n");
        assert_eq!((h.header, h.names.join(" "), h.preamble), (false, "column_1 column_2".into(), 0));
        let h = head("time,1,2,3\n0,1,2,3\n1,2,3,4\n");
        assert_eq!((h.header, h.names.join(" ")), (true, "time 1 2 3".into()));
    }

    #[test]
    fn a_comment_with_a_name_for_each_cell_is_a_header() {
        let h = head("# made today, by hand\n#version,time,x\n6,0,1\n6,1,2\n");
        assert_eq!((h.names.join(" "), h.header, h.preamble, h.header_line), ("version time x".into(), true, 0, 2));
        let h = head("# one, two\n1,2,3\n2,3,4\n");
        assert!(!h.header);
    }

    #[test]
    fn options_overrule_what_the_lines_show() {
        let options = |header| LoadOptions { header: Some(header), ..LoadOptions::default() };
        assert_eq!(head_with("1,2\n3,4\n", &options(true)).unwrap().names, ["1", "2"]);
        assert_eq!(head_with("a,b\n3,4\n", &options(false)).unwrap().preamble, 0);
    }

    #[test]
    fn files_without_numbers_are_refused() {
        for (text, what) in [
            ("a,b\n", "a header, and no rows"),
            ("# a\n\n", "no rows"),
            ("a,b\nc,d\ne,f\n", "no column of numbers in the first lines; they start with `a b`"),
            ("a,b\n1,\"2\n3,4\n", "x.csv:2: a quoted cell"),
        ] {
            let e = head_with(text, &LoadOptions::default()).unwrap_err().to_string();
            assert!(e.contains(what), "{e}");
        }
    }
}
