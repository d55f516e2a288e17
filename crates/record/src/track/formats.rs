//! Formats that are known by name: what their files say of themselves in other places than a line of names.
//!
//! A format is one row of [`FORMATS`]. Of a delimited table it completes what the user told; a text of records of several
//! kinds it makes a table of, with [`Format::sheet`].

use super::columnar::with_layout;
use super::facts::{ColumnFacts, Facts};
use super::view::{Field, Sheet, View, Want};
use super::{Aside, Delimiter, LoadOptions, Rules, Zero, windows_1252};
use crate::error::Result;

mod ardupilot;
mod betaflight;
mod cnv;
mod crd;
mod dino;
mod diver;
mod dwd;
mod eddypro;
mod exo;
mod fluxnet;
mod gnss_logger;
mod hobo;
mod iaga;
mod kiwis;
mod knmi;
mod lvm;
mod ndbc;
mod nmea;
mod oem;
mod orekit;
mod pbo;
mod rdb;
mod rtklib;
mod sbs1;
mod solinst;
mod sp3;
mod stk;
mod surfrad;
mod tdm;
mod tenv3;
mod tlog;
mod tmy3;
mod toa5;
mod zrxp;

/// A format, one row for each.
pub struct Format {
    /// Its name.
    pub name: &'static str,
    /// What its files are.
    pub about: &'static str,
    /// How its files are known, in words.
    pub known_by: &'static str,
    /// What becomes the time, what channels, and what is no value, in words.
    pub maps: &'static str,
    /// True for the first lines of such a file.
    known: fn(&str) -> bool,
    /// Completes what the user told by what such files are known to have.
    complete: fn(&str, &mut Known),
    /// What is known of a column by its name, from the first lines of the file.
    label: fn(&str, &str) -> Label,
    /// True where the columns of a file are those that the format has, and no others.
    closed: bool,
    /// True where its clocks are those of UTC, or of a scale that is written like it (GPS time).
    pub(crate) utc: bool,
    /// Makes a table of the records of the whole text, where its lines are no rows of one.
    pub(crate) sheet: Option<MakeSheet>,
}

/// Makes a table of the records of a text.
pub(crate) type MakeSheet = fn(&[u8], Want) -> Result<Sheet>;

/// What a format adds to nothing: a row of the registry names what is different.
const PLAIN: Format = Format {
    name: "",
    about: "",
    known_by: "",
    maps: "",
    known: |_| false,
    complete: |_, _| {},
    label: |_, _| Label::default(),
    closed: false,
    utc: false,
    sheet: None,
};

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Format {}

impl std::fmt::Debug for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

/// What is known of a file before its table is looked for.
#[derive(Debug, Default)]
pub(crate) struct Known {
    /// What the user told, completed by the format.
    pub(crate) options: LoadOptions,
    /// What was assumed, in a line each.
    pub(crate) said: Vec<String>,
    /// The columns of the time, with commas between them.
    time: Option<String>,
    /// What its numbers count, in nanoseconds, and from when.
    pub(crate) counted: Option<(i64, Zero)>,
    /// True where the format names the columns.
    named: bool,
    /// The format, with the first lines of the file.
    format: Option<(&'static Format, String)>,
}

/// What a format knows of a column.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Label {
    /// Its unit, where the format tells it.
    pub(crate) unit: Option<String>,
    /// Why it is not a channel, where it is none.
    pub(crate) aside: Option<Aside>,
}

/// All of them, in the order in which they are tried.
pub static FORMATS: [Format; 34] = [
    cnv::FORMAT,
    oem::FORMAT,
    stk::FORMAT,
    iaga::FORMAT,
    sbs1::FORMAT,
    ndbc::FORMAT,
    dwd::FORMAT,
    toa5::FORMAT,
    hobo::FORMAT,
    solinst::FORMAT,
    diver::FORMAT,
    exo::FORMAT,
    rdb::FORMAT,
    knmi::FORMAT,
    eddypro::FORMAT,
    fluxnet::FORMAT,
    kiwis::FORMAT,
    dino::FORMAT,
    pbo::FORMAT,
    tenv3::FORMAT,
    rtklib::FORMAT,
    betaflight::FORMAT,
    surfrad::FORMAT,
    lvm::FORMAT,
    zrxp::FORMAT,
    tmy3::FORMAT,
    gnss_logger::FORMAT,
    nmea::FORMAT,
    crd::FORMAT,
    tdm::FORMAT,
    orekit::FORMAT,
    sp3::FORMAT,
    ardupilot::FORMAT,
    tlog::FORMAT,
];

/// How much of a file is looked at.
const LOOKED_AT: usize = 64 << 10;

/// The first part of a text, as UTF-8 or else as Windows-1252.
fn beginning(body: &[u8]) -> String {
    let part = &body[..body.len().min(LOOKED_AT)];
    match std::str::from_utf8(part) {
        Ok(text) => text.to_owned(),
        // A character may be cut at the end.
        Err(e) if e.error_len().is_none() => String::from_utf8_lossy(&part[..e.valid_up_to()]).into_owned(),
        Err(_) => windows_1252::decode(part),
    }
}

/// True where `text` holds `key`: asked before its lines are.
fn has(text: &str, key: &str) -> bool {
    memchr::memmem::find(text.as_bytes(), key.as_bytes()).is_some()
}

/// The format of a file, by the first bytes of its text.
#[must_use]
pub fn format_of(body: &[u8]) -> Option<(&'static Format, String)> {
    let text = beginning(body);
    FORMATS.iter().find(|format| (format.known)(&text)).map(|format| (format, text))
}

/// The format of a file that is read by the rules of `options`, where the format makes a table of it.
pub(crate) fn viewed(body: &[u8], options: &LoadOptions) -> Option<&'static Format> {
    let asked = options.rules == Rules::Second;
    format_of(body).filter(|_| asked).map(|(format, _)| format).filter(|format| format.sheet.is_some())
}

impl Known {
    /// What the user told of a text, completed by what its format is known to have.
    pub(crate) fn of(body: &[u8], options: &LoadOptions) -> Self {
        let mut known = Self { options: options.clone(), ..Self::default() };
        if options.rules == Rules::First {
            return known;
        }
        let Some((format, text)) = format_of(body) else { return known };
        (format.complete)(&text, &mut known);
        known.said.insert(0, format.words());
        known.format = Some((format, text));
        known
    }

    /// What the user told of a file that stores columns.
    pub(crate) fn of_columns(options: &LoadOptions, facts: Option<&Facts>) -> Self {
        Self {
            options: with_layout(options),
            time: facts.and_then(|facts| facts.time.clone()),
            said: facts.map_or_else(Vec::new, |facts| facts.said.clone()),
            ..Self::default()
        }
    }

    /// What the user told of a view, completed by what the view has.
    pub(crate) fn of_view(view: &View, options: &LoadOptions) -> Self {
        let sheet = &view.sheet;
        let mut known = Self { options: options.clone(), ..Self::default() };
        let own = &mut known.options;
        (own.delimiter, own.quotes, own.header) = (Some(Delimiter::Byte(b'\t')), Some(false), None);
        (own.header_line, own.skip, own.units_line) = (Some(1), None, None);
        (own.comment, own.table) = (None, None);
        own.decimal_comma = Some(sheet.decimal_comma);
        if !sheet.timed {
            own.time.get_or_insert_with(|| "sample".to_owned());
        }
        if let Some(field) = sheet.track.and_then(|track| sheet.fields.get(track)) {
            own.track.get_or_insert_with(|| field.name.clone());
        }
        known.time = sheet.fields.first().map(|field| field.name.clone());
        known.said.push(view.format.words());
        known.said.extend(sheet.said.iter().cloned());
        known
    }

    /// The format of a file, where one is known.
    pub(crate) fn format(&self) -> Option<&'static Format> {
        self.format.as_ref().map(|(format, _)| *format)
    }

    /// The format of a file that has no place for columns beside its own: they are those of the format, or it tells them in
    /// another place than a line of names.
    pub(crate) fn closed(&self, names_in_line: bool) -> Option<&'static Format> {
        let (format, _) = self.format.as_ref()?;
        (format.closed || self.named && !names_in_line).then_some(*format)
    }

    /// What is known of the column of this name.
    pub(crate) fn label(&self, name: &str) -> Label {
        self.format.as_ref().map(|(format, text)| (format.label)(text, name)).unwrap_or_default()
    }

    /// Names for the columns, unless the user told some.
    fn name<'a>(&mut self, names: impl IntoIterator<Item = &'a str>) {
        if self.options.names.is_empty() && self.options.header_line.is_none() {
            self.options.names = names.into_iter().map(str::to_owned).collect();
            self.named = true;
        }
    }

    /// Markers for "no value" besides those that the user told.
    fn missing<'a>(&mut self, markers: impl IntoIterator<Item = &'a str>) {
        self.options.missing.extend(markers.into_iter().map(str::to_owned));
    }

    /// The line (from 0) that names the columns, unless the user says where it is.
    fn header(&mut self, line: Option<usize>) {
        if self.options.skip.is_none() && self.options.names.is_empty() && self.options.header != Some(false) {
            self.options.header_line = self.options.header_line.or(line.map(|at| at + 1));
        }
    }

    /// The line (from 0) of the units, unless the user says where it is.
    fn units(&mut self, line: usize) {
        if self.options.skip.is_none() && self.options.header != Some(false) {
            self.options.units_line.get_or_insert(line + 1);
        }
    }

    /// The column or columns of the time, where they are there and the user names no other.
    fn time(&mut self, columns: &str) {
        self.time = Some(columns.to_owned());
    }

    /// Takes the columns of the time where these names have them.
    pub(crate) fn settle_time(&mut self, names: &[String]) {
        let there = |columns: &String| {
            names.contains(columns) || columns.split(',').all(|c| names.iter().any(|n| n == c.trim()))
        };
        if let Some(columns) = self.time.take().filter(there) {
            self.options.time.get_or_insert(columns);
        }
    }
}

impl Format {
    /// That a file is one of its files.
    pub(crate) fn words(&self) -> String {
        format!("recognised as {}: {}", self.name, self.about)
    }
}

impl Label {
    /// What a view knows of its column.
    pub(crate) fn of(field: &Field) -> Self {
        Self { unit: Some(field.unit.clone()), aside: field.aside }
    }

    /// What a file that stores columns says of one.
    pub(crate) fn of_column(column: &ColumnFacts) -> Self {
        Self { unit: column.unit.clone(), aside: column.aside }
    }

    fn unit(unit: &str) -> Self {
        Self { unit: Some(unit.to_owned()), aside: None }
    }

    fn aside(aside: Aside) -> Self {
        Self { unit: None, aside: Some(aside) }
    }
}

/// The index of the first line for which this is true.
fn line_where(text: &str, is: impl Fn(&str) -> bool) -> Option<usize> {
    text.lines().position(is)
}

/// The cells of a line of names between any of the usual delimiters, without quotes.
fn names_in(line: &str) -> Vec<&str> {
    let delimiter = [';', '\t', ','].into_iter().max_by_key(|d| line.matches(*d).count()).unwrap_or(',');
    line.split(delimiter).map(|cell| cell.trim().trim_matches('"').trim()).collect()
}

/// Takes the month as first in dates of short numbers, where no line shows that the day is.
fn month_first_unless_shown(text: &str, options: &mut LoadOptions) {
    let day_first = |token: &str| {
        let mut numbers = token.split('/').map(|n| n.parse::<u32>().unwrap_or(0));
        matches!((numbers.next(), numbers.next(), numbers.next()), (Some(13..=31), Some(1..=12), Some(_)))
    };
    if !text.split([' ', ',', '"', ';', '\t', '\n']).any(day_first) {
        options.day_first.get_or_insert(false);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Source, Track, load};
    use super::*;

    fn loaded(text: &str) -> Track {
        load(&Source::BuiltIn { name: "test", bytes: text.as_bytes().into() }, &LoadOptions::default()).unwrap()
    }

    fn channels(track: &Track) -> Vec<&str> {
        track.channels.iter().map(|c| c.name.as_str()).collect()
    }

    #[test]
    fn each_format_names_its_columns() {
        let rows = |row: &dyn Fn(usize) -> String| (0..30).map(row).collect::<String>();
        let cnv = "* Sea-Bird SBE 9 Data File:\n# name 0 = timeS: Time, Elapsed [seconds]\n# name 1 = t090C: Temperature [ITS-90, deg C]\n# bad_flag = -9.990e-29\n*END*\n";
        let cnv = loaded(&format!(
            "{cnv}{}",
            rows(&|i| format!(
                "{:11.3} {:>11}\n",
                i as f64 * 0.25,
                if i == 7 { "-9.990e-29".into() } else { format!("{}.5", i * i % 7) }
            ))
        ));
        assert_eq!((cnv.time.name.as_str(), channels(&cnv)), ("timeS", vec!["t090C"]));
        assert_eq!(cnv.columns[1].missing, 1);
        let oem = loaded(&format!(
            "CCSDS_OEM_VERS = 2.0\nMETA_START\nOBJECT_NAME = S\nMETA_STOP\nCOMMENT words of text\n{}",
            rows(&|i| format!(
                "2021-03-04T10:{i:02}:00 {} {}.5 {} 1.{i} 2.{i} 3.{i}\n",
                7000 + i * i,
                i * 3 % 11,
                i * 7 % 13
            ))
        ));
        assert_eq!((oem.rows, &channels(&oem)[..3]), (30, &["X", "Y", "Z"][..]));
        let sbs = loaded(&rows(&|i| {
            format!(
                "MSG,3,1,1,{},1,2021/03/04,10:00:{i:02}.000,2021/03/04,10:00:{i:02}.010,,{},,,51.{i},-1.{i},,,0,,0,0\n",
                if i % 2 == 0 { "4CA1B2" } else { "3C6444" },
                30_000 + i * i
            )
        }));
        assert!(channels(&sbs).contains(&"Altitude@4CA1B2"), "{:?}", channels(&sbs));
        let ndbc = loaded(&format!(
            "#YY  MM DD hh mm WSPD  TIDE\n#yr  mo dy hr mn m/s    ft\n{}",
            rows(&|i| format!("2021 03 04 10 {i:02} {}.5 MM\n", i * i % 9))
        ));
        assert_eq!((channels(&ndbc), ndbc.columns[6].missing), (vec!["WSPD"], 30));
    }
}
