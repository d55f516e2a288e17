//! Tables among other lines: text, comments, headers, units, rows of several widths, footers, in any order.

use wildpoint::track::{LoadOptions, first_lines};

use super::bytes::Bytes;
use super::laws;

const DELIMITERS: [&str; 5] = [",", ";", "\t", "  ", " | "];
const ENDS: [&str; 3] = ["\n", "\r\n", "\r"];

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let (delimiter, end) = (DELIMITERS[bytes.below(5)], ENDS[bytes.below(3)]);
    let table = [None, None, Some(1), Some(2), Some(9)][bytes.below(5)];
    let mut text = if bytes.below(8) == 0 { "\u{feff}".to_owned() } else { String::new() };
    for _ in 0..40 {
        if bytes.is_empty() {
            break;
        }
        for line in lines(&mut bytes, delimiter) {
            text.push_str(&line);
            text.push_str(end);
        }
    }
    let options = LoadOptions { table, ..LoadOptions::default() };
    let Some(track) = laws::loaded(text.as_bytes(), &options) else { return };
    laws::changed(&track, text.as_bytes(), Some(-2.0));
    let shown = first_lines(&track.source, Some(&track.dialect.rows), 30);
    assert!(!shown.is_empty() && shown.len() <= 30, "{} lines are shown", shown.len());
}

/// One line, or a run of rows of one shape.
fn lines(bytes: &mut Bytes<'_>, delimiter: &str) -> Vec<String> {
    let width = 1 + bytes.below(6);
    let cells = |of: &dyn Fn(usize) -> String| (0..width).map(of).collect::<Vec<_>>().join(delimiter);
    match bytes.byte() % 10 {
        0 => vec!["Station Brook, 12 m above the sea: all is well.".to_owned()],
        1 => vec![format!("# {}", cells(&|c| format!("name{c}")))],
        2 => vec![cells(&|c| ["time", "x", "y (m)", "flag", "T", "12"][c].to_owned())],
        3 => vec![cells(&|c| ["s", "m", "degC", "", "hPa", "-"][c].to_owned())],
        4 => vec![String::new()],
        5 => vec!["-----".repeat(width)],
        6 => vec![cells(&|c| if c == 0 { "Mean".to_owned() } else { "1.5".to_owned() })],
        _ => {
            let (count, start) = (usize::from(bytes.byte()) % 50, usize::from(bytes.byte()));
            let step = 1 + bytes.below(4);
            let row = |i: usize| {
                cells(&|c| match c {
                    0 => (start + i * step).to_string(),
                    3 => (i % 2).to_string(),
                    _ => format!("{}.{}", (i * 31 + c) % 17, i % 10),
                })
            };
            (0..count).map(row).collect()
        }
    }
}
