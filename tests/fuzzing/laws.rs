//! What must hold of any record that was loaded.

use std::sync::Arc;

use wildpoint::track::{CellChange, Changes, ColumnKind, LoadOptions, Source, Track, for_each_row, load, rewrite};

/// Loads these bytes: refused in words, or a record of which all holds.
pub(super) fn loaded(bytes: &[u8], options: &LoadOptions) -> Option<Track> {
    let source = Source::BuiltIn { name: "fuzz.csv", bytes: Arc::from(bytes) };
    let track = match load(&source, options) {
        Ok(track) => track,
        Err(e) => {
            assert!(!e.to_string().is_empty());
            return None;
        }
    };
    hold(&track, bytes, options);
    Some(track)
}

fn hold(track: &Track, bytes: &[u8], options: &LoadOptions) {
    assert!(!track.channels.is_empty() && track.rows > 0);
    let times = &track.time.seconds;
    assert_eq!(times.len(), track.rows);
    for channel in &track.channels {
        assert_eq!(channel.values.len(), channel.rows(track), "{}", channel.name);
        assert!(channel.values.iter().all(|v| !v.is_infinite()), "{}", channel.name);
        let told = !options.channels.is_empty();
        assert!(told || track.columns[channel.column].kind == ColumnKind::Number, "{}", channel.name);
        let of_rows: Vec<f64> = match &channel.target {
            None => times.clone(),
            Some(target) => target.rows.iter().map(|r| times[*r as usize]).collect(),
        };
        let mut known: Vec<f64> = of_rows.into_iter().filter(|t| t.is_finite()).collect();
        if track.time.newest_first {
            known.reverse();
        }
        assert!(known.windows(2).all(|w| w[0] < w[1]), "times of {} go forward", channel.name);
    }
    let named = |c: &wildpoint::track::Column| !c.name.is_empty() && c.missing <= track.rows;
    assert!(track.columns.iter().all(named), "{:?}", track.columns);
    if track.dialect.view.is_none() {
        both_passes_agree(track);
    }
    unchanged(track, bytes);
}

/// The pass that gives rows their cells sees the rows that the first one saw.
pub(super) fn both_passes_agree(track: &Track) {
    let mut rows = 0;
    for_each_row(track, |row, cells| {
        assert_eq!(row, rows);
        rows += 1;
        (0..cells.len()).for_each(|c| drop(cells.text(c)));
        Ok(())
    })
    .unwrap();
    assert_eq!(rows, track.rows, "both passes see the same rows");
}

/// Written again without a change it is the same file.
pub(super) fn unchanged(track: &Track, bytes: &[u8]) {
    let mut again = Vec::new();
    rewrite(track, &Changes::default(), &mut again).unwrap();
    if track.dialect.packing.is_none() {
        assert_eq!(again, bytes, "nothing changed, nothing differs");
    }
}

/// Writes `value` into a cell in the middle of the first channel: refused in words, or all other bytes stay.
pub(super) fn changed(track: &Track, bytes: &[u8], value: Option<f64>) {
    let channel = &track.channels[0];
    let middle = channel.values.len() / 2;
    let Some(at) = (middle..channel.values.len()).find(|at| channel.values[*at].is_finite()) else { return };
    #[allow(clippy::cast_possible_truncation, reason = "a fuzzed file is short")]
    let row = channel.target.as_ref().map_or(at as u32, |target| target.rows[at]);
    let mut out = Vec::new();
    let cells = vec![CellChange { row, column: channel.column, value }];
    if let Err(e) = rewrite(track, &Changes { cells, rows: Vec::new() }, &mut out) {
        return assert!(!e.to_string().is_empty());
    }
    if track.dialect.packing.is_some() {
        return;
    }
    let front = out.iter().zip(bytes).take_while(|(a, b)| a == b).count();
    let left = out.len().min(bytes.len()) - front;
    let back = out.iter().rev().zip(bytes.iter().rev()).take(left).take_while(|(a, b)| a == b).count();
    // A number, the blanks around it, and the checksum or the line end after it.
    let most = 400;
    assert!(out.len() - front - back <= most && bytes.len() - front - back <= most, "one cell changed one cell");
}
