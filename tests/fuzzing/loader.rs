//! A file of arbitrary bytes under arbitrary options: refused in words, or loaded so that all of it can be read and
//! written again.

use std::sync::Arc;

use wildpoint::track::{CellChange, Changes, Delimiter, Encoding, LoadOptions, Source, for_each_row, load, rewrite};

use super::bytes::Bytes;
use super::laws;

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let options = options(&mut bytes);
    let source = Source::BuiltIn { name: "fuzz.csv", bytes: Arc::from(bytes.0) };
    let track = match load(&source, &options) {
        Ok(track) => track,
        Err(e) => return assert!(!e.to_string().is_empty()),
    };
    assert!(!track.channels.is_empty() && track.rows > 0);
    for channel in &track.channels {
        assert_eq!(channel.values.len(), track.rows, "{}", channel.name);
        assert!(channel.values.iter().all(|v| !v.is_infinite()), "{}", channel.name);
    }
    assert!(track.truth.as_ref().is_none_or(|t| t.len() == track.rows));
    assert_eq!(track.time.seconds.len(), track.rows);
    let mut times: Vec<f64> = track.time.seconds.iter().copied().filter(|t| t.is_finite()).collect();
    if track.time.newest_first {
        times.reverse();
    }
    assert!(times.windows(2).all(|w| w[0] < w[1]), "times go forward");
    laws::both_passes_agree(&track);
    laws::unchanged(&track, bytes.0);
    changed(&track, &options);
}

/// One cell changed is one cell changed.
fn changed(track: &wildpoint::track::Track, options: &LoadOptions) {
    let (row, channel) = (track.rows / 2, &track.channels[0]);
    // What stands around a number stays, and may be no unit beside another number.
    let mut old = String::new();
    for_each_row(track, |at, cells| {
        if at == row {
            old = cells.text(channel.column).into_owned();
        }
        Ok(())
    })
    .unwrap();
    if old.trim().parse::<f64>().is_err() {
        return;
    }
    let value = Some(-2.0);
    #[allow(clippy::cast_possible_truncation, reason = "a fuzzed file is short")]
    let cells = vec![CellChange { row: row as u32, column: channel.column, value }];
    let mut out = Vec::new();
    rewrite(track, &Changes { cells, rows: Vec::new() }, &mut out).unwrap();
    let source = Source::BuiltIn { name: "fuzz-changed.csv", bytes: out.into() };
    // With so few rows one cell can change what the file is taken for; as it was understood it reads back.
    // A column may itself be called `#2`, and a name goes before a number.
    let names = |index: usize| track.columns[index].name.clone();
    let options = LoadOptions {
        time: track.time.column.map(names).or(Some("sample".into())),
        channels: vec![names(channel.column)],
        truth: None,
        delimiter: Some(track.dialect.delimiter),
        decimal_comma: Some(track.dialect.decimal_comma),
        header: Some(track.dialect.header),
        ..options.clone()
    };
    let Ok(again) = load(&source, &options) else { return };
    if again.rows != track.rows || again.dialect != track.dialect {
        return;
    }
    for (i, (a, b)) in again.channels[0].values.iter().zip(&channel.values).enumerate() {
        if i == row {
            assert!(*a == -2.0 || track.dialect.missing.iter().any(|m| m.contains('2')), "row {i}: {a}");
        } else {
            assert!(a == b || (a.is_nan() && b.is_nan()), "row {i}: {a} was {b}");
        }
    }
}

fn options(bytes: &mut Bytes<'_>) -> LoadOptions {
    let (first, second) = (bytes.byte(), bytes.byte());
    let some = |bits: u8| match bits % 4 {
        0 => Some(true),
        1 => Some(false),
        _ => None,
    };
    LoadOptions {
        beside: Vec::new(),
        time: [None, None, Some("#1".into()), Some("sample".into())][usize::from(first & 3)].clone(),
        delimiter: [
            None,
            None,
            None,
            Some(Delimiter::Byte(b',')),
            Some(Delimiter::Byte(b';')),
            Some(Delimiter::Byte(b'\t')),
            Some(Delimiter::Blanks),
            Some(Delimiter::Byte(b'|')),
        ][usize::from(first >> 2 & 7)],
        decimal_comma: some(first >> 5).filter(|_| first & 128 == 0),
        header: some(second),
        quotes: some(second >> 2),
        day_first: some(second >> 4),
        encoding: (second >> 6 == 3).then_some(Encoding::Latin1),
        missing: if second >> 6 == 2 { vec!["-9999".into(), "x".into()] } else { Vec::new() },
        ..LoadOptions::default()
    }
}
