//! LabVIEW LVM: segments, each with a header of its own; times as a column, as one for each channel, or as a step.

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::calendar::{DAY, SECOND};
use crate::track::time::{DateOrder, fields, part_clock};
use crate::track::view::{Cell, Field, Nothing, Piece, Row, Sheet, SourceLine, Want, lines, stamp};

pub(super) const FORMAT: Format = Format {
    name: "LabVIEW LVM",
    about: "measurement files of LabVIEW",
    known_by: "`LabVIEW Measurement` at the start",
    maps: "time from `X_Value`, or from `X0` and `Delta_X`; in several segments that begin again at 0 with the `Date` and \
           `Time` of each; units from `Y_Unit_Label`; `Separator` and `Decimal_Separator` as the header gives them",
    known: |text| text.trim_start_matches('\u{feff}').starts_with("LabVIEW Measurement"),
    sheet: Some(sheet),
    ..PLAIN
};

const END: &str = "***End_of_Header***";

/// Where the times of a segment stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Times {
    /// In the first cell.
    #[default]
    First,
    /// Before the value of each channel.
    Each,
    /// Nowhere: the first, and the step, are told.
    Told,
}

/// What the headers say.
#[derive(Debug, Clone, Default)]
struct Header {
    times: Times,
    separator: u8,
    decimal_comma: bool,
    /// Days since 1970 and nanoseconds of the day at which the segment begins.
    days: Option<i64>,
    of_day: i64,
    start: f64,
    step: f64,
    units: Vec<String>,
}

/// A row before its time is known.
struct Sample {
    segment: usize,
    /// The cell of its time, where it has one.
    x: Option<std::ops::Range<usize>>,
    value: f64,
    row: Row,
}

#[derive(Default)]
struct Reader {
    header: Header,
    segments: Vec<Header>,
    /// True while the lines of a header follow.
    in_header: bool,
    /// True where the next line names the columns.
    names_next: bool,
    /// The field of each cell of a row.
    places: Vec<Option<usize>>,
    fields: Vec<Field>,
    samples: Vec<Sample>,
    /// Rows of this segment so far.
    passed: usize,
}

fn sheet(body: &[u8], _: Want) -> Result<Sheet> {
    let mut reader = Reader { in_header: true, fields: vec![Field::new("X_Value", "s")], ..Reader::default() };
    reader.header.separator = b'\t';
    lines(body).for_each(|line| reader.take(line));
    Ok(reader.finished())
}

impl Reader {
    fn take(&mut self, line: SourceLine<'_>) {
        let cells = line.all.split(self.header.separator);
        let first = cells.first().map_or("", |c| c.text());
        if first == END {
            (self.in_header, self.names_next) = (false, true);
        } else if self.in_header || is_key(first) {
            self.in_header = true;
            self.header.take(line.all, &cells);
        } else if cells.iter().all(|c| c.bytes.is_empty()) {
        } else if is_names(&cells) {
            self.segments.push(self.header.clone());
            self.name(&cells);
        } else if !self.segments.is_empty() {
            self.row(line, &cells);
        } else if self.names_next && cells.len() > 1 {
            // A file may be without names.
            self.segments.push(self.header.clone());
            self.name(&[]);
            self.row(line, &cells);
        }
    }

    /// The fields of the cells, by the names above them.
    fn name(&mut self, cells: &[Piece<'_>]) {
        (self.names_next, self.passed) = (false, 0);
        let mut channel = 0;
        self.places = Vec::new();
        for (at, cell) in cells.iter().enumerate() {
            let name = cell.decoded();
            let time = at == 0 || name == "X_Value";
            if time || name.is_empty() || name == "Comment" {
                self.places.push(None);
                continue;
            }
            let unit = self.header.units.get(channel).cloned().unwrap_or_default();
            channel += 1;
            let field = self.field(&name, &unit);
            self.places.push(Some(field));
        }
    }

    fn field(&mut self, name: &str, unit: &str) -> usize {
        self.fields.iter().position(|f| f.name == name).unwrap_or_else(|| {
            self.fields.push(Field::new(name, unit).nothing(Nothing::text("NaN")));
            self.fields.len() - 1
        })
    }

    fn row(&mut self, line: SourceLine<'_>, cells: &[Piece<'_>]) {
        if self.places.is_empty() {
            let width = cells.len();
            self.places = (0..width).map(|at| (at > 0).then(|| self.field(&format!("Y{at}"), ""))).collect();
        }
        let segment = self.segments.len() - 1;
        let of_segment = self.passed;
        self.passed += 1;
        let header = &self.segments[segment];
        let comma = header.decimal_comma;
        let x = cells.first().filter(|c| header.times != Times::Told && !c.bytes.is_empty());
        #[expect(clippy::cast_precision_loss, reason = "fewer than 2^32 rows")]
        let told = header.start + header.step * of_segment as f64;
        let value = x.map_or(Some(told), |x| number(*x, comma)).unwrap_or(f64::NAN);
        let values = cells.iter().zip(&self.places).filter_map(|(cell, place)| Some((cell, (*place)?)));
        let cells = values
            .map(|(c, place)| (place, if c.bytes.is_empty() { Cell::Missing(c.range()) } else { Cell::At(c.range()) }));
        let row = Row { line: line.number, cells: cells.collect() };
        self.samples.push(Sample { segment, x: x.map(|x| x.range()), value, row });
    }

    fn finished(self) -> Sheet {
        let comma = self.header.decimal_comma;
        let mut sheet = Sheet { fields: self.fields, timed: true, decimal_comma: comma, ..Sheet::default() };
        // The times of later segments may go on, or begin again.
        let goes_on = self.samples.windows(2).all(|w| w[0].segment == w[1].segment || w[1].value > w[0].value);
        let dated = self.segments.iter().all(|s| s.days.is_some());
        let again = !goes_on && dated;
        if again {
            sheet.fields[0].unit = String::new();
            sheet.said.push(format!(
                "{} segments, whose times count from the `Date` and `Time` of each",
                self.segments.len()
            ));
        }
        for mut sample in self.samples {
            let header = &self.segments[sample.segment];
            let time = match (again, sample.x, header.days) {
                (true, _, Some(days)) => {
                    #[expect(clippy::cast_possible_truncation, reason = "seconds of a measurement, saturates")]
                    let ns = (sample.value * 1e9).round() as i64;
                    Cell::Made(stamp(days + (header.of_day + ns).div_euclid(DAY), (header.of_day + ns).rem_euclid(DAY)))
                }
                (_, Some(x), _) => Cell::At(x),
                _ => {
                    let text = format!("{:.9}", sample.value);
                    Cell::Made(if comma { text.replace('.', ",") } else { text })
                }
            };
            sample.row.cells.push((0, time));
            sheet.rows.push(sample.row);
        }
        sheet
    }
}

impl Header {
    fn take(&mut self, line: Piece<'_>, cells: &[Piece<'_>]) {
        let value = |at: usize| cells.get(at).map_or_else(String::new, |c| c.decoded());
        let seconds = || number(*cells.get(1)?, self.decimal_comma);
        match cells.first().map_or("", |c| c.text()) {
            "X_Columns" => {
                self.times = match value(1).as_str() {
                    "No" => Times::Told,
                    "Multi" => Times::Each,
                    _ => Times::First,
                }
            }
            "Decimal_Separator" => self.decimal_comma = value(1) == ",",
            "X0" => self.start = seconds().unwrap_or(0.0),
            "Delta_X" => self.step = seconds().unwrap_or(0.0),
            "Y_Unit_Label" => self.units = (1..cells.len()).map(value).collect(),
            "Date" => {
                let text = value(1);
                let told = fields(text.as_bytes(), DateOrder::YearFirst).and_then(|f| f.told(text.as_bytes()));
                self.days = told.and_then(|t| t.days).or(self.days);
            }
            "Time" => self.of_day = clock(&value(1)).unwrap_or(self.of_day),
            // Before the separator is known, the line is not parted by it.
            _ if line.bytes.starts_with(b"Separator") && line.decoded().contains("Comma") => self.separator = b',',
            _ => {}
        }
    }
}

/// `10:00:00.1234567890123456`, with more decimals than nanoseconds have.
fn clock(text: &str) -> Option<i64> {
    let text = text.replace(',', ".");
    let (whole, fraction) = text.split_once('.').unwrap_or((&text, ""));
    let digits: String = fraction.chars().chain("000000000".chars()).take(9).collect();
    Some(part_clock(whole.as_bytes())? / SECOND * SECOND + digits.parse::<i64>().ok()?)
}

fn number(cell: Piece<'_>, comma: bool) -> Option<f64> {
    if comma { cell.text().replace(',', ".").parse().ok() } else { cell.number() }
}

/// Keys with which the header of a segment begins.
fn is_key(first: &str) -> bool {
    ["Channels", "Samples", "Date", "Time", "X_Dimension", "X0", "Delta_X", "Y_Unit_Label"].contains(&first)
}

/// A line of names: `X_Value`, or texts above an empty first cell.
fn is_names(cells: &[Piece<'_>]) -> bool {
    let text = |c: &Piece<'_>| c.bytes.first().is_some_and(u8::is_ascii_alphabetic) && c.number().is_none();
    cells.first().is_some_and(|c| c.text() == "X_Value") || cells.len() > 1 && cells.iter().skip(1).take(2).all(text)
}
