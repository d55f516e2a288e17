//! Laws of reading and writing, over generated files.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

use std::sync::Arc;

use proptest::collection::vec;
use proptest::prelude::*;
use wildpoint::track::{
    CellChange, Changes, LoadOptions, NewRow, RowChecks, Rules, Source, Track, for_each_row, load, rewrite,
};

/// How a generated file is laid out.
#[derive(Debug, Clone)]
struct Form {
    delimiter: &'static str,
    decimal_comma: bool,
    quoted: bool,
    padding: &'static str,
    line_ends: [&'static str; 2],
    last_line_end: bool,
    comments: bool,
    mark: &'static [u8],
}

fn forms() -> impl Strategy<Value = Form> {
    let delimiter = prop_oneof![Just(","), Just(";"), Just("\t"), Just("|"), Just("  ")];
    let padding = prop_oneof![Just(""), Just(" "), Just("   ")];
    let line_ends = prop_oneof![Just(["\n", "\n"]), Just(["\r\n", "\r\n"]), Just(["\r\n", "\n"])];
    let mark = prop_oneof![Just(&b""[..]), Just(&b"\xef\xbb\xbf"[..])];
    (delimiter, any::<bool>(), any::<bool>(), padding, line_ends, any::<bool>(), any::<bool>(), mark).prop_map(
        |(delimiter, comma, quoted, padding, line_ends, last_line_end, comments, mark)| Form {
            delimiter,
            decimal_comma: comma && delimiter != ",",
            quoted,
            padding,
            line_ends,
            last_line_end,
            comments,
            mark,
        },
    )
}

fn numbers() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        6 => (-1_000_000_i32..1_000_000).prop_map(|n| Some(f64::from(n) / 100.0)),
        1 => any::<f64>().prop_filter("finite", |v| v.is_finite()).prop_map(Some),
        1 => Just(None),
    ]
}

/// The file: a time, two channels and a text column.
fn written(form: &Form, rows: &[Row]) -> Vec<u8> {
    let mut text = String::from_utf8(form.mark.to_vec()).unwrap();
    let line = |text: &mut String, cells: [String; 4], n: usize| {
        text.push_str(&cells.join(form.delimiter));
        text.push_str(form.line_ends[n % 2]);
    };
    line(&mut text, ["time_s", "x", "y", "note"].map(String::from), 0);
    for (n, (x, y)) in rows.iter().enumerate() {
        if form.comments && n % 3 == 1 {
            text.push_str("# a comment, with \"one quote\r\n");
        }
        let number = |value: &Option<f64>| {
            let bare =
                value.map_or(if form.delimiter == "  " { "NaN".into() } else { String::new() }, |v| format!("{v}"));
            let bare = if form.decimal_comma { bare.replace('.', ",") } else { bare };
            let quoted = if form.quoted && n % 2 == 0 { format!("\"{bare}\"") } else { bare };
            format!("{}{quoted}", form.padding)
        };
        let note = if form.quoted { format!("\"a {} \"\"b\"\"\nc\"", form.delimiter) } else { "ok".into() };
        line(&mut text, [n.to_string(), number(x), number(y), note], n);
    }
    if !form.last_line_end {
        text.truncate(text.trim_end_matches(['\r', '\n']).len());
    }
    text.into_bytes()
}

fn track(bytes: Vec<u8>, form: &Form) -> Track {
    // A column of whole numbers does not show its decimal sign. By the first rules a changed cell has every digit.
    let options =
        LoadOptions { decimal_comma: Some(form.decimal_comma), rules: Rules::First, ..LoadOptions::default() };
    let source = Source::BuiltIn { name: "wildpoint:generated", bytes: Arc::from(bytes) };
    load(&source, &options).unwrap()
}

type Row = (Option<f64>, Option<f64>);

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| if v.is_nan() { u64::MAX } else { v.to_bits() }).collect()
}

fn rows() -> impl Strategy<Value = Vec<Row>> {
    // The first rows have numbers, so that the columns are columns of numbers.
    let some = || numbers().prop_map(|n| n.or(Some(0.5)));
    (vec((some(), some()), 3), vec((numbers(), numbers()), 0..12)).prop_map(|(first, rest)| [first, rest].concat())
}

proptest! {
    #[test]
    fn a_file_is_read_and_written_back_byte_for_byte(form in forms(), rows in rows()) {
        let bytes = written(&form, &rows);
        let track = track(bytes.clone(), &form);
        let expected = |of: fn(&Row) -> Option<f64>| -> Vec<f64> {
            rows.iter().map(|r| of(r).unwrap_or(f64::NAN)).collect()
        };
        prop_assert_eq!(bits(&track.channels[0].values), bits(&expected(|r| r.0)));
        prop_assert_eq!(bits(&track.channels[1].values), bits(&expected(|r| r.1)));
        let mut again = Vec::new();
        rewrite(&track, &Changes::default(), &mut again).unwrap();
        prop_assert_eq!(String::from_utf8(again).unwrap(), String::from_utf8(bytes).unwrap());
    }

    #[test]
    fn changed_cells_are_read_back_and_all_others_stay(
        form in forms(),
        rows in rows(),
        changes in vec((any::<prop::sample::Index>(), 0..2_usize, numbers()), 0..6),
        new in vec((any::<prop::sample::Index>(), numbers()), 0..3),
    ) {
        let before = track(written(&form, &rows), &form);
        let mut expected = [0, 1].map(|c| before.channels[c].values.clone());
        let mut cells: Vec<CellChange> = Vec::new();
        for (row, channel, value) in changes {
            let row = row.index(rows.len());
            expected[channel][row] = value.unwrap_or(f64::NAN);
            cells.retain(|c| c.row as usize != row || c.column != channel + 1);
            cells.push(CellChange { row: u32::try_from(row).unwrap(), column: channel + 1, value });
        }
        cells.sort_by_key(|c| (c.row, c.column));
        let mut added: Vec<NewRow> = Vec::new();
        for (row, value) in new {
            let after_row = u32::try_from(row.index(rows.len())).unwrap();
            if let Some(value) = value.filter(|_| added.iter().all(|a| a.after_row != after_row)) {
                // Times of the file are whole seconds.
                added.push(NewRow { after_row, seconds: f64::from(after_row), cells: vec![(1, value)] });
            }
        }
        added.sort_by_key(|r| r.after_row);
        for row in added.iter().rev() {
            expected[0].insert(row.after_row as usize + 1, row.cells[0].1);
            expected[1].insert(row.after_row as usize + 1, f64::NAN);
        }
        let changes = Changes { cells, rows: added };
        let mut bytes = Vec::new();
        rewrite(&before, &changes, &mut bytes).unwrap();
        let after = track(bytes, &form);
        for (channel, expected) in after.channels.iter().zip(&expected) {
            prop_assert_eq!(bits(&channel.values), bits(expected), "{}", channel.name);
        }
        prop_assert_eq!(after.faults.repeated_times.count, changes.rows.len());

        // Where cells of one row are all that changed, the fingerprint names the row.
        let touched: Vec<u32> = changes.cells.iter().map(|c| c.row).collect();
        let (old, now) = (RowChecks::of(&before).unwrap(), RowChecks::of(&after).unwrap());
        if old != now && changes.rows.is_empty() && touched.windows(2).all(|w| w[0] == w[1]) {
            let difference = old.first_difference(&now, before.rows, after.rows);
            prop_assert_eq!(difference, format!("row {} differs, and no other", touched[0] + 1));
        }
    }

    /// Whatever the bytes, loading ends with a track or an error; and what was loaded is written back as it was, and
    /// read again by rows.
    #[test]
    fn no_text_is_too_odd(text in "([-0-9.,;:|TZe \t/#%\"'a\u{e9}\u{feff}]{0,12}(\n|\r\n|\r)){0,12}", header: bool, tail: Vec<u8>) {
        // Between plain rows, so that most of what is odd is met in a file that is a table.
        let rows = |from: u32| -> String { (from..from + 12).map(|i| format!("{i},{}.5,2\n", i * 7 % 5)).collect() };
        let (start, end) = if header { (format!("time,x,y\n{}", rows(0)), rows(20)) } else { Default::default() };
        for bytes in [format!("{start}{text}{end}").into_bytes(), [start.as_bytes(), &tail, end.as_bytes()].concat()] {
            let source = Source::BuiltIn { name: "wildpoint:generated", bytes: Arc::from(bytes.clone()) };
            let Ok(track) = load(&source, &LoadOptions::default()) else { continue };
            prop_assert!(track.channels.iter().all(|c| c.values.len() == track.rows));
            prop_assert_eq!(track.time.seconds.len(), track.rows);
            let usable: Vec<f64> = track.time.seconds.iter().copied().filter(|s| !s.is_nan()).collect();
            prop_assert!(usable.windows(2).all(|w| w[0] < w[1]));
            if track.dialect.packing.is_none() {
                let mut again = Vec::new();
                rewrite(&track, &Changes::default(), &mut again).unwrap();
                prop_assert_eq!(again, bytes);
            }
            let mut rows = 0;
            for_each_row(&track, |row, cells| {
                for channel in &track.channels {
                    let text = cells.text(channel.column);
                    let number = text.parse().ok().filter(|v: &f64| v.is_finite());
                    if let (Some(number), false) = (number, track.dialect.decimal_comma) {
                        assert_eq!(channel.values[row].to_bits(), number.to_bits(), "row {row}: {text}");
                    }
                }
                rows += 1;
                Ok(())
            })
            .unwrap();
            prop_assert_eq!(rows, track.rows);
        }
    }
}
