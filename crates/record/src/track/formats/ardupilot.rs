//! ArduPilot: flight logs as text, each message a line, described by `FMT` messages. Mission Planner writes them.

use std::collections::HashMap;

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::view::{Cell, Field, Kinds, Piece, Row, Sheet, SourceLine, Want, lines};

pub(super) const FORMAT: Format = Format {
    name: "ArduPilot log (text)",
    about: "flight logs of ArduPilot as text, a table for each kind of message",
    known_by: "lines `FMT, 128,` or other `FMT` messages at the start",
    maps: "a table for each message (`--table`), by default the one with the most rows; names from `FMT`, units from `FMTU` and \
           `UNIT`; time `TimeUS` or `TimeMS`; a track for each instance (`I`); states are not channels",
    known: |text| {
        let mut first = text.lines().filter(|l| !l.trim().is_empty()).take(10);
        first.any(|l| l.split(',').map(str::trim).take(2).eq(["FMT", "128"]))
            || text.lines().take(10).filter(|l| l.starts_with("FMT,") && l.matches(',').count() > 4).count() > 3
    },
    sheet: Some(sheet),
    ..PLAIN
};

/// Messages about messages and settings, which are no measurements.
const NO_TABLES: [&str; 9] = ["FMT", "FMTU", "UNIT", "MULT", "PARM", "MSG", "VER", "FILE", "ISBD"];

/// Names of columns that tell states, times and counts.
const STATES: [(&str, Aside); 7] = [
    ("GMS", Aside::Time),
    ("GWk", Aside::Time),
    ("Status", Aside::Quality),
    ("NSats", Aside::Quality),
    ("U", Aside::Flag),
    ("Delta", Aside::Time),
    ("SampleMS", Aside::Time),
];

/// What `FMT` and `FMTU` say of a message.
#[derive(Debug, Default, Clone)]
struct Message {
    columns: Vec<String>,
    /// A letter for the type of each column.
    letters: String,
    /// A letter for the unit of each column, and for the factor that it is to be multiplied by.
    units: String,
    factors: String,
}

/// What the log says of its messages.
#[derive(Debug, Default)]
struct Book {
    messages: HashMap<String, Message>,
    /// Names of messages by their number.
    numbers: HashMap<String, String>,
    /// Units by their letter.
    units: HashMap<char, String>,
}

impl Book {
    fn take(&mut self, cells: &[Piece<'_>]) {
        let text = |at: usize| cells.get(at).map_or("", |c| c.text());
        match text(0) {
            "FMT" if cells.len() > 4 => {
                let columns = cells[5..].iter().map(|c| c.decoded()).filter(|c| !c.is_empty()).collect();
                let message = Message { columns, letters: text(4).to_owned(), ..Message::default() };
                self.numbers.insert(text(1).to_owned(), text(3).to_owned());
                self.messages.insert(text(3).to_owned(), message);
            }
            "FMTU" => {
                let message = self.numbers.get(text(2)).and_then(|name| self.messages.get_mut(name));
                if let Some(message) = message {
                    (message.units, message.factors) = (text(3).to_owned(), text(4).to_owned());
                }
            }
            "UNIT" => {
                let letter = text(2).parse::<u8>().ok().filter(|n| *n > 31).map(char::from).or(text(2).chars().next());
                if let Some(letter) = letter {
                    self.units.insert(letter, text(3).to_owned());
                }
            }
            _ => {}
        }
    }

    /// The unit of a column. Values of the types c, C, e, E and L stand in the text multiplied already.
    fn unit(&self, message: &Message, column: usize) -> String {
        let letter = |text: &str| text.chars().nth(column);
        let unit = letter(&message.units).and_then(|l| self.units.get(&l)).cloned().unwrap_or_default();
        let multiplied = letter(&message.letters).is_some_and(|l| "cCeEL".contains(l));
        match (letter(&message.factors), unit.as_str()) {
            (None | Some('-' | '0' | '?'), _) => unit,
            (Some('B' | 'G'), _) if multiplied => unit,
            (Some('F'), "s") => "us".to_owned(),
            (Some('C'), "s" | "m" | "V" | "A") => format!("m{unit}"),
            _ => String::new(),
        }
    }
}

fn sheet(body: &[u8], want: Want) -> Result<Sheet> {
    let mut sheet = Sheet::default();
    let (mut book, mut kinds) = (Book::default(), Kinds::default());
    for line in lines(body) {
        let cells = line.all.split(b',');
        book.take(&cells);
        let name = cells.first().map_or("", |c| c.text());
        if cells.len() > 2 && !NO_TABLES.contains(&name) && book.messages.contains_key(name) {
            kinds.count(name);
        }
    }
    let Some(chosen) = kinds.chosen(want, &[], &mut sheet.said)?.map(str::to_owned) else { return Ok(sheet) };
    let message = book.messages.get(&chosen).cloned().unwrap_or_default();
    sheet.fields = fields(&book, &message);
    sheet.timed = message.columns.first().is_some_and(|c| is_time(c));
    let instance = message.columns.iter().position(|c| matches!(c.as_str(), "I" | "Instance"));
    let mut instances: Vec<String> = Vec::new();
    for line in lines(body) {
        let cells = line.all.split(b',');
        if cells.first().is_none_or(|c| c.text() != chosen) {
            continue;
        }
        if let Some(cell) =
            instance.and_then(|at| cells.get(at + 1)).map(|c| c.decoded()).filter(|c| !instances.contains(c))
        {
            instances.push(cell);
        }
        sheet.rows.push(row(line, &cells, sheet.fields.len()));
    }
    sheet.track = instance.filter(|_| instances.len() > 1);
    Ok(sheet)
}

fn is_time(column: &str) -> bool {
    matches!(column, "TimeUS" | "TimeMS")
}

fn fields(book: &Book, message: &Message) -> Vec<Field> {
    let field = |(at, name): (usize, &String)| {
        let unit = match name.as_str() {
            "TimeUS" => "us".to_owned(),
            "TimeMS" => "ms".to_owned(),
            _ => book.unit(message, at),
        };
        let field = Field::new(name.as_str(), &unit);
        let state = STATES.iter().find(|(n, _)| n == name).map(|(_, aside)| *aside);
        match state.or(matches!(name.as_str(), "I" | "Instance").then_some(Aside::Id)) {
            Some(aside) if !is_time(name) && at > 0 => field.aside(aside),
            _ => field,
        }
    };
    message.columns.iter().enumerate().map(field).collect()
}

fn row(line: SourceLine<'_>, cells: &[Piece<'_>], width: usize) -> Row {
    let values = cells.iter().skip(1).take(width).enumerate();
    let cell = |c: &Piece<'_>| if c.bytes.is_empty() { Cell::Missing(c.range()) } else { Cell::At(c.range()) };
    Row { line: line.number, cells: values.map(|(at, c)| (at, cell(c))).collect() }
}
