//! A file of arbitrary text of which the user says where its header, units and rows are: refused in words, or so it is.

use wildpoint::track::{LinePart, LoadOptions, first_lines};

use super::bytes::Bytes;
use super::laws;

pub(super) fn body(data: &[u8]) {
    let mut bytes = Bytes(data);
    let line = |bytes: &mut Bytes<'_>| match bytes.byte() {
        n @ 0..=99 => Some(usize::from(n % 12)),
        _ => None,
    };
    let names: &[&str] = [&[][..], &["a", "b", "c"], &["time"], &["", "x"]][bytes.below(4)];
    let options = LoadOptions {
        header_line: line(&mut bytes),
        skip: line(&mut bytes),
        units_line: line(&mut bytes),
        table: line(&mut bytes),
        comment: [None, None, Some(";".into()), Some("REM".into())][bytes.below(4)].clone(),
        names: names.iter().map(|n| (*n).to_owned()).collect(),
        ..LoadOptions::default()
    };
    let text = bytes.0;
    let Some(track) = laws::loaded(text, &options) else { return };
    if options.names.is_empty()
        && options.header_line.is_some()
        && options.skip.is_none()
        && options.units_line.is_none()
    {
        assert!(track.dialect.header, "the header that was told is one");
    }
    for (column, told) in track.columns.iter().zip(&options.names) {
        assert!(told.is_empty() || column.name.starts_with(told.as_str()), "{} is called {}", told, column.name);
    }
    let shown = first_lines(&track.source, Some(&track.dialect.rows), 20);
    let headers = shown.iter().filter(|l| l.part == LinePart::Header).count();
    assert!(headers <= 1, "one line names the columns");
}
