//! How a text is laid out and where its times stand, as facts for programs.

use serde::Serialize;

use crate::track::{Clocks, Delimiter, Encoding, Track};

/// How the text of a record is laid out.
#[derive(Debug, Clone, Serialize)]
pub struct TableFacts {
    /// The format that it is known to be of.
    pub format: Option<&'static str>,
    /// True where several lines, or parts of lines, make a row.
    pub records: bool,
    /// The field separator: `commas`, `semicolons`, `tabs`, `pipes` or `blanks`.
    pub delimiter: &'static str,
    /// True where cells stand in columns of a fixed width.
    pub fixed_width: bool,
    /// The quote, where cells may be quoted.
    pub quote: Option<char>,
    /// True when a comma is the decimal sign.
    pub decimal_comma: bool,
    /// How bytes encode text: `UTF-8`, `UTF-16 (little-endian)`, `UTF-16 (big-endian)` or `Windows-1252`.
    pub encoding: &'static str,
    /// True for UTF-8 with a byte order mark.
    pub byte_order_mark: bool,
    /// How the file is packed.
    pub packing: Option<&'static str>,
    /// Lines before the first row that are neither comments nor blank, header and units among them.
    pub lines_above: usize,
    /// True when a line names the columns.
    pub header: bool,
    /// True when a line tells their units.
    pub units: bool,
    /// The line of the first row, from 1.
    pub first_row_line: u64,
    /// Lines of text below the last row.
    pub lines_below: usize,
    /// What comments begin with, besides `#`, `%` and `//`.
    pub comment: Option<String>,
    /// Cells that mean "no value", besides the usual markers.
    pub missing: Vec<String>,
}

impl TableFacts {
    /// Those of `track`.
    pub(super) fn of(track: &Track) -> Self {
        let d = &track.dialect;
        Self {
            format: d.rows.format().map(|format| format.name),
            records: d.view.is_some(),
            delimiter: delimiter(d.delimiter),
            fixed_width: d.fixed_width,
            quote: d.quote.map(char::from),
            decimal_comma: d.decimal_comma,
            encoding: match d.encoding {
                Encoding::Utf8 { .. } => "UTF-8",
                Encoding::Utf16 { big_endian: false } => "UTF-16 (little-endian)",
                Encoding::Utf16 { big_endian: true } => "UTF-16 (big-endian)",
                Encoding::Latin1 => "Windows-1252",
            },
            byte_order_mark: d.encoding == Encoding::Utf8 { bom: true },
            packing: d.packing.map(|packing| packing.name),
            lines_above: d.preamble,
            header: d.header,
            units: d.units_row,
            first_row_line: d.rows.first_line(),
            lines_below: d.rows.lines_below(),
            comment: d.rows.comment(),
            missing: d.missing.clone(),
        }
    }
}

/// Where the times of a record stand.
#[derive(Debug, Clone, Serialize)]
pub struct TimeFacts {
    /// The columns of the time, the date before the time of day; none for the sample number.
    pub columns: Vec<String>,
    /// The zone of clocks that write none, where one is known.
    pub zone: Option<String>,
    /// False where nothing tells the zone of the clocks.
    pub zone_stated: bool,
    /// True when the newest row stands first.
    pub newest_first: bool,
    /// Rows with a usable time.
    pub usable: usize,
}

impl TimeFacts {
    /// Those of `track`.
    pub(super) fn of(track: &Track) -> Self {
        let time = &track.time;
        let single = || time.date_column.into_iter().chain(time.column).collect();
        let places: Vec<usize> = if time.part_columns.is_empty() { single() } else { time.part_columns.clone() };
        Self {
            columns: places.into_iter().map(|c| track.columns[c].name.clone()).collect(),
            zone: time.zone.as_ref().map(|zone| zone.name().to_owned()),
            zone_stated: time.clocks == Clocks::Stated,
            newest_first: time.newest_first,
            usable: time.seconds.iter().filter(|t| t.is_finite()).count(),
        }
    }
}

/// The field separator, in a word.
pub(super) fn delimiter(delimiter: Delimiter) -> &'static str {
    match delimiter {
        Delimiter::Byte(b',') => "commas",
        Delimiter::Byte(b';') => "semicolons",
        Delimiter::Byte(b'\t') => "tabs",
        Delimiter::Byte(b'|') => "pipes",
        Delimiter::Byte(_) => "one character",
        Delimiter::Blanks => "blanks",
    }
}

#[cfg(test)]
mod tests {
    use super::super::Inspection;
    use crate::track::{LoadOptions, Source, load};

    #[test]
    fn all_that_was_understood_is_a_fact() {
        let mut text = "\u{feff}Station Brook\n; by hand\nDatum;Zeit (UTC+1);Pegel;who\n;;cm;\n".to_owned();
        (0..12).for_each(|i| text += &format!("04.03.2021;{:02}:00;{},5;a\n", 12 - i, 100 + i * i % 7));
        text += "End of the report\n";
        let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
        let options = LoadOptions { missing: vec!["-9".into()], ..LoadOptions::default() };
        let facts = serde_json::to_value(Inspection::of(&load(&source, &options).unwrap())).unwrap();
        let (table, time) = (&facts["table"], &facts["time_facts"]);
        for (fact, value) in [
            (&table["format"], serde_json::Value::Null),
            (&table["delimiter"], "semicolons".into()),
            (&table["encoding"], "UTF-8".into()),
            (&table["byte_order_mark"], true.into()),
            (&table["decimal_comma"], true.into()),
            (&table["header"], true.into()),
            (&table["units"], true.into()),
            (&table["first_row_line"], 5.into()),
            (&table["lines_below"], 1.into()),
            (&table["missing"], serde_json::json!(["-9"])),
            (&time["columns"], serde_json::json!(["Datum", "Zeit (UTC+1)"])),
            (&time["zone"], "+01:00".into()),
            (&time["newest_first"], true.into()),
            (&time["usable"], 12.into()),
            (&facts["track"], serde_json::Value::Null),
            (&facts["columns"][2]["unit"], "cm".into()),
        ] {
            assert_eq!(*fact, value, "{facts:#}");
        }
        let record = "$GPGGA,100000,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,\n";
        let source = Source::BuiltIn { name: "test", bytes: record.repeat(3).into_bytes().into() };
        let facts = Inspection::of(&load(&source, &LoadOptions::default()).unwrap());
        assert_eq!((facts.table.format, facts.table.records), (Some("NMEA 0183"), true));
    }
}
