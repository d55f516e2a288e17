//! Orekit: the text files of measurements of its orbit determination, a time, a kind, a station and values in each line.

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::view::{Cell, Field, Nothing, Row, Sheet, SourceLine, Want, labels, lines};

pub(super) const FORMAT: Format = Format {
    name: "Orekit measurements",
    about: "tracking of satellites: a time, a kind of measurement, a station and values in each line (`.aer`)",
    known_by: "a first line, below comments with `#`, of a time, one of the kinds (`RANGE`, `RANGE_RATE`, `AZ_EL`, `PV`), a \
               station and as many numbers as the kind has",
    maps: "a channel for each value of a kind; a row for each line; a track for each station, where there are several",
    known: |text| {
        let text = text.trim_start_matches('\u{feff}');
        let first = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'));
        first.is_some_and(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let [time, kind, _, values @ ..] = words.as_slice() else { return false };
            let is_time = time.starts_with(|c: char| c.is_ascii_digit()) && time.contains('T') && time.contains(':');
            let is_kind = |kind: &&Kind| kind.fields.len() == values.len();
            is_time
                && kind_of(kind).as_ref().is_some_and(is_kind)
                && values.iter().all(|value| value.parse::<f64>().is_ok())
        })
    },
    sheet: Some(sheet),
    utc: true,
    ..PLAIN
};

/// What one value of a measurement is.
struct Quantity {
    name: &'static str,
    unit: &'static str,
}

const fn quantity(name: &'static str, unit: &'static str) -> Quantity {
    Quantity { name, unit }
}

/// A kind of measurement, with the values of its lines.
struct Kind {
    word: &'static str,
    fields: &'static [Quantity],
}

impl Kind {
    /// The columns of its values. A line with one value is left out without it; in others a number that is none stands in
    /// its place, so that the values beside it stay.
    fn columns(&self) -> impl Iterator<Item = Field> + use<> {
        let nothing = if self.fields.len() == 1 { Nothing::NoLine } else { Nothing::text("NaN") };
        self.fields.iter().map(move |value| Field::new(value.name, value.unit).nothing(nothing.clone()))
    }
}

const KINDS: [Kind; 4] = [
    Kind { word: "RANGE", fields: &[quantity("range", "km")] },
    Kind { word: "RANGE_RATE", fields: &[quantity("range_rate", "km/s")] },
    Kind { word: "AZ_EL", fields: &[quantity("azimuth", "deg"), quantity("elevation", "deg")] },
    Kind {
        word: "PV",
        fields: &[
            quantity("x", "km"),
            quantity("y", "km"),
            quantity("z", "km"),
            quantity("vx", "km/s"),
            quantity("vy", "km/s"),
            quantity("vz", "km/s"),
        ],
    },
];

fn kind_of(word: &str) -> Option<&'static Kind> {
    KINDS.iter().find(|kind| kind.word == word)
}

/// Columns before those of the values.
const BEFORE: [&str; 2] = ["time", "station"];
const STATION: usize = 1;

#[derive(Default)]
struct Reader {
    sheet: Sheet,
    /// The stations, each once.
    stations: Vec<Vec<String>>,
    /// The station of each row.
    of_row: Vec<usize>,
}

fn sheet(body: &[u8], _: Want) -> Result<Sheet> {
    let mut reader = Reader::default();
    reader.sheet.timed = true;
    let [time, station] = BEFORE.map(|name| Field::new(name, ""));
    reader.sheet.fields = vec![time, station.aside(Aside::Id)];
    reader.sheet.fields.extend(KINDS.iter().flat_map(Kind::columns));
    lines(body).for_each(|line| reader.take(line));
    Ok(reader.finished())
}

impl Reader {
    fn take(&mut self, line: SourceLine<'_>) {
        let words = line.all.words();
        let [time, kind, station, values @ ..] = words.as_slice() else { return };
        if time.text().starts_with('#') {
            return;
        }
        let Some(index) = KINDS.iter().position(|known| known.word == kind.text()) else { return };
        let first = BEFORE.len() + KINDS[..index].iter().map(|kind| kind.fields.len()).sum::<usize>();
        let mut cells = vec![(0, Cell::At(time.range()))];
        let of_kind = values.iter().take(KINDS[index].fields.len()).enumerate();
        cells.extend(of_kind.map(|(i, value)| (first + i, Cell::At(value.range()))));
        let station = vec![station.text().to_owned()];
        let place = self.stations.iter().position(|known| *known == station).unwrap_or_else(|| {
            self.stations.push(station);
            self.stations.len() - 1
        });
        self.of_row.push(place);
        self.sheet.rows.push(Row { line: line.number, cells });
    }

    /// The rows with the names of the stations, where there are several.
    fn finished(mut self) -> Sheet {
        let labels = labels(&self.stations);
        if labels.len() > 1 {
            self.sheet.track = Some(STATION);
            for (row, station) in self.sheet.rows.iter_mut().zip(&self.of_row) {
                row.cells.push((STATION, Cell::Made(labels[*station].clone())));
            }
        }
        self.sheet.without_unused();
        self.sheet
    }
}
