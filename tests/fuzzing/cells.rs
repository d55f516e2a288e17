//! Cells of arbitrary text in a column of numbers: read or not, and a repaired one is read back.

use std::sync::Arc;

use wildpoint::track::{CellChange, Changes, LoadOptions, Source, load, rewrite};

use super::bytes::Bytes;
use super::laws;

/// Rows of numbers around the cells.
const ROWS: usize = 12;

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let decimal_comma = bytes.below(3) == 0;
    let value = bytes.double();
    let text = String::from_utf8_lossy(bytes.0);
    let cells: Vec<String> = text
        .split('\n')
        .map(|c| c.chars().filter(|c| !matches!(c, ';' | '"' | '\r' | '\0')).take(40).collect())
        .take(ROWS)
        .collect();
    let mut file = String::from("time;x\n");
    for row in 0..ROWS {
        let cell = cells.get(row % cells.len().max(1)).filter(|_| row % 3 == 1 || cells.len() == ROWS);
        let plain = format!("{row}.25").replace('.', if decimal_comma { "," } else { "." });
        file += &format!("{row};{}\n", cell.unwrap_or(&plain));
    }
    let options = LoadOptions { decimal_comma: Some(decimal_comma), ..LoadOptions::default() };
    let Some(track) = laws::loaded(file.as_bytes(), &options) else { return };
    laws::changed(&track, file.as_bytes(), Some(value).filter(|v| v.is_finite()));
    let Some(channel) = track.channels.iter().find(|c| c.name == "x" && c.target.is_none()) else { return };
    let Some(row) = (0..channel.values.len()).find(|r| channel.values[*r].is_finite()) else { return };
    // A value of the column itself keeps its meaning, whatever stands around it.
    let own = channel.values[(row + 3) % channel.values.len()];
    #[allow(clippy::cast_possible_truncation, reason = "a fuzzed file is short")]
    let change = CellChange { row: row as u32, column: channel.column, value: Some(own).filter(|v| v.is_finite()) };
    let mut out = Vec::new();
    rewrite(&track, &Changes { cells: vec![change], rows: Vec::new() }, &mut out).unwrap();
    let source = Source::BuiltIn { name: "fuzz-changed.csv", bytes: Arc::from(out.as_slice()) };
    let Ok(again) = load(&source, &options) else { return };
    let Some(same) = again.channels.iter().find(|c| c.name == "x" && c.values.len() == channel.values.len()) else {
        return;
    };
    if own.is_finite() && again.dialect.styles == track.dialect.styles && again.dialect.missing == track.dialect.missing
    {
        assert!(same.values[row].is_finite(), "{own} is no number any more: {}", String::from_utf8_lossy(&out));
    }
}
