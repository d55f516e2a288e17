//! CRD: laser ranging (ILRS consolidated laser ranging data, versions 1 and 2).

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::calendar::{DAY, Date, SECOND};
use crate::track::view::{Cell, Field, Kinds, Nothing, Piece, Row, Sheet, SourceLine, Want, labels, lines, stamp};

pub(super) const FORMAT: Format = Format {
    name: "CRD",
    about: "laser ranging to satellites (normal points, full rate)",
    known_by: "`H1 CRD` at the start",
    maps: "a table for each kind of record (`--table`): normal points, full rate, weather, pointing, calibration; time from \
           the date of H4 and the seconds of the day; a track for each target, where there are several; `na` is no value",
    known: |text| {
        let mut words = text.split_whitespace();
        words.next().is_some_and(|w| w.eq_ignore_ascii_case("h1"))
            && words.next().is_some_and(|w| w.eq_ignore_ascii_case("crd"))
    },
    sheet: Some(sheet),
    utc: true,
    ..PLAIN
};

/// What stands in a word of a record.
struct Quantity {
    word: usize,
    name: &'static str,
    unit: &'static str,
    /// True for what is no measurement.
    aside: bool,
    /// True where -1 means that it is not known.
    minus_one: bool,
}

const fn quantity(word: usize, name: &'static str, unit: &'static str) -> Quantity {
    Quantity { word, name, unit, aside: false, minus_one: false }
}

const fn perhaps(word: usize, name: &'static str, unit: &'static str) -> Quantity {
    Quantity { word, name, unit, aside: false, minus_one: true }
}

const fn code(word: usize, name: &'static str) -> Quantity {
    Quantity { word, name, unit: "", aside: true, minus_one: false }
}

/// A kind of record.
struct Kind {
    number: &'static str,
    name: &'static str,
    quantities: &'static [Quantity],
}

const KINDS: [Kind; 5] = [
    Kind {
        number: "11",
        name: "normal points",
        quantities: &[
            quantity(2, "time_of_flight", "s"),
            code(4, "epoch_event"),
            quantity(5, "window", "s"),
            quantity(6, "returns", ""),
            quantity(7, "bin_rms", "ps"),
            perhaps(8, "bin_skew", ""),
            perhaps(9, "bin_kurtosis", ""),
            perhaps(10, "bin_peak_mean", "ps"),
            perhaps(11, "return_rate", ""),
            code(12, "detector"),
        ],
    },
    Kind {
        number: "10",
        name: "full rate",
        quantities: &[
            quantity(2, "time_of_flight", "s"),
            code(4, "epoch_event"),
            code(5, "filter"),
            code(6, "detector"),
            code(7, "stop"),
            perhaps(8, "amplitude", ""),
            perhaps(9, "transmit_amplitude", ""),
        ],
    },
    Kind {
        number: "20",
        name: "weather",
        quantities: &[
            quantity(2, "pressure", "mbar"),
            quantity(3, "temperature", "K"),
            quantity(4, "humidity", "%"),
            code(5, "origin"),
        ],
    },
    Kind {
        number: "30",
        name: "pointing",
        quantities: &[
            quantity(2, "azimuth", "deg"),
            quantity(3, "elevation", "deg"),
            code(4, "direction"),
            code(5, "angle_origin"),
            code(6, "refraction_corrected"),
            quantity(7, "azimuth_rate", "deg/s"),
            quantity(8, "elevation_rate", "deg/s"),
        ],
    },
    Kind {
        number: "40",
        name: "calibration",
        quantities: &[
            code(2, "type"),
            perhaps(4, "recorded", ""),
            perhaps(5, "used", ""),
            perhaps(6, "one_way_distance", "m"),
            quantity(7, "system_delay", "ps"),
            quantity(8, "delay_shift", "ps"),
            quantity(9, "rms", "ps"),
        ],
    },
];

fn kind_of(number: &str) -> Option<&'static Kind> {
    KINDS.iter().find(|kind| kind.number == number)
}

/// Where the reader is: the date of the session, its last second of the day, who ranges to whom.
#[derive(Default)]
struct Session {
    station: String,
    target: String,
    days: i64,
    start: f64,
    last: f64,
}

fn sheet(body: &[u8], want: Want) -> Result<Sheet> {
    let mut sheet = Sheet { timed: true, ..Sheet::default() };
    let mut kinds = Kinds::default();
    for line in lines(body) {
        let number = line.all.words().first().map(|w| w.text()).and_then(kind_of);
        number.into_iter().for_each(|kind| kinds.count(kind.name));
    }
    let preferred = ["normal points", "full rate"];
    let chosen = kinds.chosen(want, &preferred, &mut sheet.said)?.map(str::to_owned);
    let Some(kind) = KINDS.iter().find(|k| Some(k.name) == chosen.as_deref()) else { return Ok(sheet) };
    sheet.fields = vec![Field::new("time", ""), Field::new("target", "").aside(Aside::Id)];
    sheet.fields.extend(kind.quantities.iter().map(|q| {
        let field = Field::new(q.name, q.unit).nothing(Nothing::text("na"));
        if q.aside { field.aside(Aside::Quality) } else { field }
    }));
    let mut session = Session::default();
    let mut parties: Vec<Vec<String>> = Vec::new();
    let mut of_row = Vec::new();
    for line in lines(body) {
        let words = line.all.words();
        let first = words.first().map_or("", |w| w.text());
        session.take(&first.to_lowercase(), &words);
        if first != kind.number {
            continue;
        }
        let Some(row) = row(line, &words, kind, &mut session) else { continue };
        let party = vec![session.target.clone(), session.station.clone()];
        let place = parties.iter().position(|p| *p == party).unwrap_or_else(|| {
            parties.push(party);
            parties.len() - 1
        });
        of_row.push(place);
        sheet.rows.push(row);
    }
    if parties.len() > 1 {
        let labels = labels(&parties);
        sheet.track = Some(1);
        for (row, party) in sheet.rows.iter_mut().zip(of_row) {
            row.cells.push((1, Cell::Made(labels[party].clone())));
        }
    }
    sheet.without_unused();
    Ok(sheet)
}

impl Session {
    /// Takes what a header says.
    fn take(&mut self, first: &str, words: &[Piece<'_>]) {
        let text = |at: usize| words.get(at).map_or_else(String::new, |w| w.decoded());
        match first {
            "h2" => self.station = text(1),
            "h3" => self.target = text(1),
            "h4" => {
                let whole = |at: usize| words.get(at)?.text().parse::<i64>().ok();
                let date = || Date { year: whole(2)?, month: whole(3)?, day: whole(4)? }.days();
                let clock = || Some((whole(5)? * 60 + whole(6)?) * 60 + whole(7)?);
                self.days = date().unwrap_or(0);
                #[expect(clippy::cast_precision_loss, reason = "seconds of a day")]
                let start = clock().unwrap_or(0) as f64;
                (self.start, self.last) = (start, start);
            }
            _ => {}
        }
    }

    /// The moment of this second of the day; a step back of more than half a day is midnight.
    fn stamp(&mut self, text: &str) -> Option<String> {
        const HALF: f64 = 43_200.0;
        let second: f64 = text.parse().ok()?;
        if second < self.last - HALF {
            self.days += 1;
        }
        self.last = second;
        // Nanoseconds are read from the digits: a double does not hold those of a day.
        let (whole, fraction) = text.split_once('.').unwrap_or((text, ""));
        let digits: String = fraction.chars().chain("000000000".chars()).take(9).collect();
        let ns = whole.parse::<i64>().ok()?.checked_mul(SECOND)?.checked_add(digits.parse::<i64>().ok()?)?;
        (0..2 * DAY).contains(&ns).then(|| stamp(self.days, ns))
    }
}

fn row(line: SourceLine<'_>, words: &[Piece<'_>], kind: &Kind, session: &mut Session) -> Option<Row> {
    let time = session.stamp(words.get(1)?.text())?;
    let mut cells = vec![(0, Cell::Made(time))];
    for (i, quantity) in kind.quantities.iter().enumerate() {
        let Some(word) = words.get(quantity.word) else { continue };
        let absent = word.text().eq_ignore_ascii_case("na") || quantity.minus_one && word.number() == Some(-1.0);
        cells.push((i + 2, if absent { Cell::Missing(word.range()) } else { Cell::At(word.range()) }));
    }
    Some(Row { line: line.number, cells })
}
