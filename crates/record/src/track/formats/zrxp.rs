//! ZRXP: time series of WISKI and other KISTERS systems, a header of keys before each.

use super::{Format, PLAIN};
use crate::error::Result;
use crate::track::Aside;
use crate::track::view::{Cell, Field, Nothing, Piece, Row, Sheet, SourceLine, Want, labels, lines};

pub(super) const FORMAT: Format = Format {
    name: "WISKI (ZRXP)",
    about: "time series of WISKI and other KISTERS systems",
    known_by: "lines that begin with `#` and hold keys between `|*|`",
    maps: "columns as `LAYOUT` has them, else timestamp and value; unit `CUNIT`; `RINVAL` means missing; states are not \
           channels; a track for each series, where there are several",
    known: |text| {
        let first = text.lines().find(|l| !l.trim().is_empty() && !l.starts_with("##")).unwrap_or("");
        let own = ["ZRXPVERSION", "REXCHANGE", "SANR"];
        first.strip_prefix('#').is_some_and(|rest| rest.contains("|*|") || own.iter().any(|key| rest.starts_with(key)))
    },
    sheet: Some(sheet),
    ..PLAIN
};

/// The keys that are read; one that begins another stands after it.
const KEYS: [&str; 10] =
    ["REXCHANGE", "SANR", "SNAME", "SWATER", "CNAME", "CUNIT", "RINVAL", "LAYOUT", "ZRXPVERSION", "TZ"];

/// The key at the start of a text, with its value.
fn key(text: &str) -> Option<(&'static str, &str)> {
    KEYS.iter().find_map(|key| Some((*key, text.strip_prefix(key)?)))
}

#[derive(Default)]
struct Reader {
    sheet: Sheet,
    /// What the header of the series says.
    keys: Vec<(&'static str, String)>,
    /// True where rows stood since.
    rows: bool,
    series: Vec<Vec<String>>,
    of_row: Vec<usize>,
}

fn sheet(body: &[u8], _: Want) -> Result<Sheet> {
    let mut reader = Reader::default();
    reader.sheet.timed = true;
    reader.sheet.fields = vec![Field::new("timestamp", ""), Field::new("series", "").aside(Aside::Id)];
    for line in lines(body) {
        match line.all.bytes.first() {
            Some(b'#') => reader.header(line),
            Some(_) => reader.row(line),
            None => {}
        }
    }
    Ok(reader.finished())
}

impl Reader {
    fn header(&mut self, line: SourceLine<'_>) {
        if std::mem::take(&mut self.rows) {
            self.keys.clear();
        }
        let text = line.all.decoded();
        for part in text.trim_start_matches('#').split("|*|").map(|p| p.trim_matches(['|', ';', ' '])) {
            if let Some((key, value)) = key(part) {
                self.keys.push((key, value.to_owned()));
            }
        }
    }

    fn said(&self, key: &str) -> Option<&str> {
        self.keys.iter().find(|(k, _)| *k == key).map(|(_, value)| value.as_str())
    }

    fn row(&mut self, line: SourceLine<'_>) {
        let layout = self.said("LAYOUT").unwrap_or("(timestamp,value,status)").to_owned();
        let names: Vec<&str> = layout.trim_matches(['(', ')']).split(',').map(str::trim).collect();
        self.rows = true;
        let series: Vec<String> = ["SANR", "REXCHANGE", "SNAME", "CNAME"]
            .iter()
            .filter_map(|key| self.said(key))
            .map(str::to_owned)
            .collect();
        let place = self.series.iter().position(|s| *s == series).unwrap_or_else(|| {
            self.series.push(series);
            self.series.len() - 1
        });
        let words = line.all.words();
        let mut cells = Vec::new();
        for (name, word) in names.iter().zip(words) {
            let field = if *name == "timestamp" { 0 } else { self.field(name) };
            let missing = *name == "value" && self.is_invalid(word);
            cells.push((field, if missing { Cell::Missing(word.range()) } else { Cell::At(word.range()) }));
        }
        self.sheet.rows.push(Row { line: line.number, cells });
        self.of_row.push(place);
    }

    fn is_invalid(&self, word: Piece<'_>) -> bool {
        let invalid = self.said("RINVAL").and_then(|v| v.parse::<f64>().ok()).unwrap_or(-777.0);
        word.number() == Some(invalid)
    }

    fn field(&mut self, name: &str) -> usize {
        self.sheet.fields.iter().position(|f| f.name == name).unwrap_or_else(|| {
            let invalid = self.said("RINVAL").unwrap_or("-777").to_owned();
            let unit = self.said("CUNIT").filter(|u| name == "value" && *u != "---").unwrap_or("").to_owned();
            let field = Field::new(name, &unit).nothing(Nothing::Text(invalid.into()));
            self.sheet.fields.push(if name == "value" { field } else { field.aside(Aside::Quality) });
            self.sheet.fields.len() - 1
        })
    }

    fn finished(mut self) -> Sheet {
        if let Some(zone) = self.said("TZ").filter(|z| !z.is_empty()) {
            self.sheet.said.push(format!("times are those of {zone}, as the file writes them"));
        }
        if self.series.len() > 1 {
            let labels = labels(&self.series);
            self.sheet.track = Some(1);
            for (row, series) in self.sheet.rows.iter_mut().zip(&self.of_row) {
                row.cells.push((1, Cell::Made(labels[*series].clone())));
            }
        }
        self.sheet.without_unused();
        self.sheet
    }
}
