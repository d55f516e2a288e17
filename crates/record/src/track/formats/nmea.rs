//! NMEA 0183: sentences of navigation receivers, those of one epoch joined to a row.

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::calendar::{DAY, Date};
use crate::track::time::part_clock;
use crate::track::view::{Cell, Field, Nothing, Piece, Row, Sheet, SourceLine, Spelling, Want, lines, stamp};

mod sentence;

use sentence::{Quantity, SENTENCES, Sentence};

pub(super) const FORMAT: Format = Format {
    name: "NMEA 0183",
    about: "sentences of navigation receivers, those of one epoch in one row",
    known_by: "lines with `$`, two letters of a talker and GGA, RMC, VTG, GST or GLL",
    maps: "time from the clock of the sentences and the date of RMC or ZDA; positions in degrees; speeds, courses, \
           altitudes and standard deviations as they are; the quality of the fix and the number of satellites are not \
           channels; checksums are made right in changed sentences",
    known: |text| {
        let first: Vec<&str> = text.lines().filter(|l| !l.trim().is_empty()).take(40).collect();
        let sentences = first.iter().filter(|l| l.contains(['$', '!'])).count();
        let read = first.iter().any(|l| {
            let talker = l.find('$').and_then(|at| l.get(at + 3..at + 7));
            talker.is_some_and(|kind| SENTENCES.iter().any(|s| kind.starts_with(s.kind) && kind.ends_with(',')))
        });
        read && sentences * 2 >= first.len()
    },
    sheet: Some(sheet),
    utc: true,
    ..PLAIN
};

/// A sentence as it stands in the text.
struct Read<'a> {
    sentence: &'static Sentence,
    talker: &'a str,
    cells: Vec<Piece<'a>>,
}

/// A column: which quantity of which sentence of which talker.
struct Column {
    sentence: &'static Sentence,
    quantity: &'static Quantity,
    talker: String,
}

/// An epoch: the time of its day, and its date where a sentence tells it.
struct Epoch {
    of_day: i64,
    days: Option<i64>,
    row: Row,
}

#[derive(Default)]
struct Reader {
    columns: Vec<Column>,
    epochs: Vec<Epoch>,
    /// True while sentences without a clock belong to the last epoch.
    open: bool,
    /// Cells of sentences without a clock, before that of their epoch.
    waiting: Vec<(usize, Cell)>,
    /// True where sentences without a clock stand before those with one.
    clock_last: Option<bool>,
    /// Sentences whose checksum is not theirs.
    broken: usize,
}

fn sheet(body: &[u8], _: Want) -> Result<Sheet> {
    let mut reader = Reader::default();
    for line in lines(body) {
        reader.broken += usize::from(checksum(line.all.text()).is_some_and(|c| !c.right));
        if let Some(read) = read(line) {
            reader.take(line, &read);
        }
    }
    Ok(reader.finished())
}

/// The sentence of a line, where it is one that is read.
fn read(line: SourceLine<'_>) -> Option<Read<'_>> {
    let start = line.all.bytes.iter().position(|b| *b == b'$')?;
    let end = line.all.bytes[start..].iter().position(|b| *b == b'*').map_or(line.all.bytes.len(), |at| start + at);
    let cells = line.all.part(start + 1..end).split(b',');
    let name = cells.first()?.text();
    let (talker, kind) = (name.get(..2)?, name.get(2..)?);
    let sentence = SENTENCES.iter().find(|s| s.kind == kind)?;
    Some(Read { sentence, talker, cells })
}

impl Reader {
    fn take(&mut self, line: SourceLine<'_>, read: &Read<'_>) {
        let cells = self.cells(read);
        let Some(clock) = read.sentence.clock else {
            self.clock_last.get_or_insert(true);
            match self.epochs.last_mut().filter(|_| self.clock_last == Some(false)) {
                Some(epoch) if self.open => epoch.row.cells.extend(cells),
                Some(_) => {}
                None => self.waiting = cells,
            }
            return;
        };
        self.clock_last.get_or_insert(false);
        let of_day = read.cells.get(clock).filter(|c| !c.bytes.is_empty()).and_then(|c| part_clock(c.bytes));
        self.open = of_day.is_some();
        let Some(of_day) = of_day else { return };
        let same = |e: &&mut Epoch| e.of_day == of_day && !cells.iter().any(|(field, _)| e.row.has(*field));
        let days = (read.sentence.date)(&read.cells);
        if let Some(epoch) = self.epochs.last_mut().filter(same) {
            epoch.row.cells.extend(cells);
            epoch.days = epoch.days.or(days);
        } else {
            let mut row = Row { line: line.number, cells };
            row.cells.append(&mut self.waiting);
            self.epochs.push(Epoch { of_day, days, row });
        }
    }

    /// The cells of a sentence with their columns (from 1), which are made as they come.
    fn cells(&mut self, read: &Read<'_>) -> Vec<(usize, Cell)> {
        let mut cells = Vec::new();
        for quantity in read.sentence.quantities {
            let Some(piece) = read.cells.get(quantity.cell) else { continue };
            // The letter of the hemisphere stands in the next cell.
            let range = match (quantity.spelling, read.cells.get(quantity.cell + 1)) {
                (Spelling::Number, _) => piece.range(),
                (_, Some(letter)) => piece.range().start..letter.range().end,
                (_, None) => continue,
            };
            let column = self.column(read, quantity);
            let missing = piece.bytes.is_empty();
            cells.push((column + 1, if missing { Cell::Missing(range) } else { Cell::At(range) }));
        }
        cells
    }

    fn column(&mut self, read: &Read<'_>, quantity: &'static Quantity) -> usize {
        let same = |c: &Column| c.sentence == read.sentence && c.quantity == quantity && c.talker == read.talker;
        self.columns.iter().position(same).unwrap_or_else(|| {
            self.columns.push(Column { sentence: read.sentence, quantity, talker: read.talker.to_owned() });
            self.columns.len() - 1
        })
    }

    fn finished(mut self) -> Sheet {
        let dated = self.date();
        let mut sheet = Sheet { timed: true, mend: Some(mended), ..Sheet::default() };
        sheet.fields = vec![Field::new("time", "")];
        sheet.fields.extend(self.columns.iter().map(|column| self.field(column)));
        if !dated {
            sheet.said.push("no sentence tells the date (RMC and ZDA do): times are those of a day".to_owned());
        }
        if self.broken > 0 {
            let (count, have) = (self.broken, if self.broken == 1 { "sentence has" } else { "sentences have" });
            sheet.said.push(format!("{count} {have} a checksum that does not fit; they are read all the same"));
        }
        sheet.rows = std::mem::take(&mut self.epochs).into_iter().map(Epoch::row).collect();
        sheet
    }

    fn field(&self, column: &Column) -> Field {
        let Quantity { name, unit, spelling, aside, .. } = *column.quantity;
        let kind = column.sentence.kind;
        let shared = self.columns.iter().any(|c| c.quantity.name == name && c.sentence.kind != kind);
        let talkers = self
            .columns
            .iter()
            .any(|c| c.quantity == column.quantity && c.sentence.kind == kind && c.talker != column.talker);
        let mut full = name.to_owned();
        if shared {
            full = format!("{full}_{kind}");
        }
        if talkers {
            full = format!("{full}_{}", column.talker);
        }
        let nothing = Nothing::text(if spelling == Spelling::Number { "" } else { "," });
        let field = Field { spelling, nothing, ..Field::new(full, unit) };
        if aside { field.aside(Aside::Quality) } else { field }
    }

    /// Gives every epoch a date by the nearest before it that has one, or else after it; false where none has.
    fn date(&mut self) -> bool {
        let Some(first) = self.epochs.iter().position(|e| e.days.is_some()) else { return false };
        let passes = |from: i64, to: i64| i64::from(to < from - DAY / 2);
        for at in (0..first).rev() {
            let next = &self.epochs[at + 1];
            let days = next.days.map(|d| d - passes(self.epochs[at].of_day, next.of_day));
            self.epochs[at].days = days;
        }
        for at in first + 1..self.epochs.len() {
            let last = &self.epochs[at - 1];
            let days = last.days.map(|d| d + passes(last.of_day, self.epochs[at].of_day));
            self.epochs[at].days = self.epochs[at].days.or(days);
        }
        true
    }
}

impl Epoch {
    fn row(mut self) -> Row {
        let time = match self.days {
            Some(days) => stamp(days, self.of_day),
            None => stamp(0, self.of_day).split_off("1970-01-01T".len()),
        };
        self.row.cells.push((0, Cell::Made(time)));
        self.row
    }
}

/// The date of RMC, `040321`.
fn date_of_six(text: &str) -> Option<i64> {
    let part = |at: usize| text.get(at..at + 2)?.parse::<i64>().ok();
    let year = part(4)?;
    Date { year: if year < 80 { 2000 + year } else { 1900 + year }, month: part(2)?, day: part(0)? }.days()
}

/// The checksum of a sentence.
struct Checksum {
    /// Where its two digits begin.
    at: usize,
    /// What it should be.
    value: u8,
    /// True where it is that.
    right: bool,
    lower: bool,
}

/// The checksum of the sentence in a line: the exclusive or of what is between `$` (or `!`) and `*`.
fn checksum(line: &str) -> Option<Checksum> {
    let start = line.find(['$', '!'])?;
    let star = start + line[start..].find('*')?;
    let digits = line.get(star + 1..star + 3)?;
    let written = u8::from_str_radix(digits, 16).ok()?;
    let value = line.as_bytes()[start + 1..star].iter().fold(0, |sum, byte| sum ^ byte);
    let lower = digits.contains(|c: char| c.is_ascii_lowercase());
    Some(Checksum { at: star + 1, value, right: written == value, lower })
}

/// A changed line with the checksum of what it holds now.
fn mended(line: &str) -> String {
    let Some(sum) = checksum(line) else { return line.to_owned() };
    let digits = if sum.lower { format!("{:02x}", sum.value) } else { format!("{:02X}", sum.value) };
    format!("{}{digits}{}", &line[..sum.at], &line[sum.at + 2..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_those_of_the_standard() {
        // The example of the GGA sentence that is in every manual.
        let line = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47";
        assert!(checksum(line).unwrap().right);
        assert_eq!(mended(&line.replace("*47", "*00")), line);
        assert!(checksum("$GPGGA,123519").is_none());
    }
}
