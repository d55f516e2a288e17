//! CCSDS TDM: tracking data messages, a keyword, an epoch and a value in each line (CCSDS 503.0-B).

use std::collections::HashMap;

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::calendar::DAY;
use crate::track::time::{DateOrder, fields};
use crate::track::view::{Cell, Field, Nothing, Row, Sheet, SourceLine, Want, labels, lines};

pub(super) const FORMAT: Format = Format {
    name: "CCSDS TDM",
    about: "tracking data messages, with a keyword, an epoch and a value in each line",
    known_by: "`CCSDS_TDM_VERS` at the start",
    maps: "a channel for each keyword, values of one epoch in one row; a track for each path of participants, where there \
           are several; a removed value leaves out its line",
    known: |text| text.trim_start().starts_with("CCSDS_TDM_VERS"),
    sheet: Some(sheet),
    utc: true,
    ..PLAIN
};

/// Units of the keywords, as the standard has them.
const UNITS: [(&str, &str); 24] = [
    ("RANGE", "km"),
    ("DOPPLER_INSTANTANEOUS", "km/s"),
    ("DOPPLER_INTEGRATED", "km/s"),
    ("DOPPLER_COUNT", ""),
    ("RECEIVE_FREQ", "Hz"),
    ("TRANSMIT_FREQ_RATE", "Hz/s"),
    ("TRANSMIT_FREQ", "Hz"),
    ("RECEIVE_PHASE_CT", ""),
    ("TRANSMIT_PHASE_CT", ""),
    ("ANGLE", "deg"),
    ("CARRIER_POWER", "dBW"),
    ("PC_N0", "dBHz"),
    ("PR_N0", "dBHz"),
    ("MAG", ""),
    ("RCS", "m2"),
    ("DOR", "s"),
    ("VLBI_DELAY", "s"),
    ("CLOCK_BIAS", "s"),
    ("CLOCK_DRIFT", "s/s"),
    ("STEC", "TECU"),
    ("TROPO", "m"),
    ("PRESSURE", "hPa"),
    ("RHUMIDITY", "%"),
    ("TEMPERATURE", "K"),
];

/// Keys of the metadata that part series besides the participants.
const PARTING: [&str; 5] = ["TRANSMIT_BAND", "RECEIVE_BAND", "MODE", "ANGLE_TYPE", "RANGE_UNITS"];

/// Column of the label of the participants.
const PARTICIPANTS: usize = 1;

#[derive(Default)]
struct Reader {
    sheet: Sheet,
    in_data: bool,
    /// Metadata of the segment.
    meta: Vec<(String, String)>,
    /// The participants (and bands) of the segments, each once.
    parties: Vec<Vec<String>>,
    /// Those of this segment.
    party: usize,
    /// The party of each row, and its moment.
    of_row: Vec<(usize, i64)>,
    /// The row of a party and an epoch.
    known: HashMap<(usize, String), usize>,
}

fn sheet(body: &[u8], _: Want) -> Result<Sheet> {
    let mut reader = Reader::default();
    reader.sheet.timed = true;
    reader.sheet.fields = vec![Field::new("EPOCH", ""), Field::new("participants", "").aside(Aside::Id)];
    lines(body).for_each(|line| reader.take(line));
    Ok(reader.finished())
}

impl Reader {
    fn take(&mut self, line: SourceLine<'_>) {
        let text = line.all.text().trim();
        match text {
            "META_START" => (self.meta, self.in_data) = (Vec::new(), false),
            "DATA_START" => {
                self.in_data = true;
                self.party = self.party();
            }
            "DATA_STOP" => self.in_data = false,
            _ if text.starts_with("COMMENT") => {}
            _ if self.in_data => self.observation(line),
            _ => {
                if let Some((key, value)) = text.split_once('=') {
                    self.meta.push((key.trim().to_owned(), value.trim().to_owned()));
                }
            }
        }
    }

    fn said(&self, key: &str) -> Option<&str> {
        self.meta.iter().find(|(k, _)| k == key).map(|(_, value)| value.as_str())
    }

    /// The participants of the segment in the order of the path.
    fn party(&mut self) -> usize {
        let one = |n: usize| self.said(&format!("PARTICIPANT_{n}")).map(str::to_owned);
        let path: Vec<usize> = ["PATH", "PATH_1", "PATH_2"]
            .iter()
            .filter_map(|key| self.said(key))
            .flat_map(|path| path.split(',').filter_map(|n| n.trim().parse().ok()))
            .collect();
        let path = if path.is_empty() { (1..=5).collect() } else { path };
        let mut party: Vec<String> = path.into_iter().filter_map(one).collect();
        party.extend(PARTING.iter().filter_map(|key| self.said(key)).map(str::to_owned));
        if let Some(system) = self.said("TIME_SYSTEM").filter(|s| *s != "UTC") {
            let words = format!("times are those of {system}, as the file writes them");
            if !self.sheet.said.contains(&words) {
                self.sheet.said.push(words);
            }
        }
        self.parties.iter().position(|p| *p == party).unwrap_or_else(|| {
            self.parties.push(party);
            self.parties.len() - 1
        })
    }

    fn observation(&mut self, line: SourceLine<'_>) {
        let Some(equals) = line.all.bytes.iter().position(|b| *b == b'=') else { return };
        let key = line.all.part(0..equals).text().trim();
        let words = line.all.after(equals + 1).words();
        let [epoch, value, ..] = words.as_slice() else { return };
        let field = self.field(key);
        let of = (self.party, epoch.text().to_owned());
        // A second value of one keyword at one epoch makes a row of its own.
        let row = self.known.get(&of).copied().filter(|row| !self.sheet.rows[*row].has(field));
        let row = row.unwrap_or_else(|| {
            let cells = vec![(0, Cell::At(epoch.range()))];
            self.sheet.rows.push(Row { line: line.number, cells });
            self.of_row.push((self.party, moment(epoch.bytes)));
            self.sheet.rows.len() - 1
        });
        self.known.insert(of, row);
        self.sheet.rows[row].cells.push((field, Cell::At(value.range())));
    }

    fn field(&mut self, key: &str) -> usize {
        self.sheet.fields.iter().position(|f| f.name == key).unwrap_or_else(|| {
            let unit = UNITS.iter().find(|(start, _)| key.starts_with(start)).map_or("", |(_, unit)| unit);
            let told = self.said("RANGE_UNITS").filter(|_| key == "RANGE");
            self.sheet.fields.push(Field::new(key, told.unwrap_or(unit)).nothing(Nothing::NoLine));
            self.sheet.fields.len() - 1
        })
    }

    /// The rows in the order of time, with the labels of the participants where there are several.
    fn finished(mut self) -> Sheet {
        let labels = labels(&self.parties);
        if labels.len() > 1 {
            self.sheet.track = Some(PARTICIPANTS);
            for (row, (party, _)) in self.sheet.rows.iter_mut().zip(&self.of_row) {
                row.cells.push((PARTICIPANTS, Cell::Made(labels[*party].clone())));
            }
        }
        let mut rows: Vec<(i64, Row)> =
            self.of_row.iter().map(|(_, moment)| *moment).zip(std::mem::take(&mut self.sheet.rows)).collect();
        rows.sort_by_key(|(moment, _)| *moment);
        self.sheet.rows = rows.into_iter().map(|(_, row)| row).collect();
        self.sheet.without_unused();
        self.sheet
    }
}

/// Nanoseconds since 1970; the end of time for what is no epoch.
fn moment(epoch: &[u8]) -> i64 {
    let told = fields(epoch, DateOrder::YearFirst).and_then(|f| f.told(epoch));
    told.and_then(|t| t.days?.checked_mul(DAY)?.checked_add(t.of_day)).unwrap_or(i64::MAX)
}
