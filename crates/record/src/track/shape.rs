//! Files that are text and no table: refused by name, with the way out.

use std::path::Path;

use super::head::Head;
use crate::error::{Error, Result};

/// Refuses what is clearly another kind of file, from its first bytes.
///
/// # Errors
/// [`Error::Input`] naming what the file seems to be.
pub(crate) fn refuse_other_formats(body: &[u8], path: &Path) -> Result<()> {
    let start = body.trim_ascii_start();
    let line = 1 + body[..body.len() - start.len()].iter().filter(|b| **b == b'\n').count() as u64;
    let refuse = |what: &str, help: &str| {
        Err(Error::Input { path: path.to_path_buf(), line: Some(line), what: what.into(), help: help.into() })
    };
    match start {
        [] => Err(Error::input(path, "the file is empty", "name a file with a header and rows of numbers")),
        [b'$' | b'!', talker @ ..] if is_nmea(talker) => refuse(
            "NMEA sentences, not a table",
            "convert it first, for example: gpsbabel -i nmea -f IN -o unicsv -F OUT.csv",
        ),
        [b'h' | b'H', b'1', b' ' | b'\t', rest @ ..] if rest.trim_ascii_start().starts_with(b"CRD") => refuse(
            "a laser ranging file (CRD), which has records of many kinds, not a table",
            "write the normal points (records 11: seconds of day, time of flight) as a CSV file: awk '$1 == 11 {print $2 \",\" $3}'",
        ),
        [b'<', ..] => refuse("markup (XML or HTML), not a table", "export the record as CSV"),
        [b'{', ..] => refuse("JSON, not a table", "export the record as CSV, one row for each time"),
        [b'P', b'K', 3, 4, ..] => refuse("a zip archive (or a spreadsheet)", "unpack it, or export the sheet as CSV"),
        _ => Ok(()),
    }
}

/// Five letters or digits and a comma: talker and kind of an NMEA 0183 sentence.
fn is_nmea(talker: &[u8]) -> bool {
    talker.len() > 5 && talker[..5].iter().all(u8::is_ascii_alphanumeric) && talker[5] == b','
}

/// Refuses the long form, in which each row names the series that its value belongs to.
///
/// # Errors
/// [`Error::Input`] naming the columns.
pub(crate) fn refuse_long_form(head: &Head, path: &Path) -> Result<()> {
    let place = |wanted: &[&str]| head.names.iter().position(|n| wanted.iter().any(|w| n.eq_ignore_ascii_case(w)));
    let series = place(&["series", "variable", "metric"]);
    let (Some(series), Some(time), Some(value)) = (series, place(&["timestamp", "time"]), place(&["value"])) else {
        return Ok(());
    };
    if head.names.len() > 5 {
        return Ok(());
    }
    let name = |c: usize| super::printable(&head.names[c]);
    Err(Error::Input {
        path: path.to_path_buf(),
        line: Some(head.header_line),
        what: format!("a long table: each row gives one {} of the series in `{}`", name(value), name(series)),
        help: format!(
            "pivot it to one row for each `{}` with a column for each series, for example in pandas: \
             pivot(index='{}', columns='{}', values='{}'); or read each series as a track of its own: --track '{}'",
            name(time),
            name(time),
            name(series),
            name(value),
            name(series)
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_formats_are_named() {
        for (text, name) in [
            ("$GNRMC,021417.00,A,3725.58362,N\n", ":1: NMEA"),
            ("\n\nh1 CRD  1 2016  2 13 14\n", ":3: a laser ranging file"),
            ("<?xml version=\"1.0\"?>", "markup"),
            ("{\"a\": 1}", "JSON"),
            (" \n", "the file is empty"),
        ] {
            let e = refuse_other_formats(text.as_bytes(), Path::new("x")).unwrap_err().to_string();
            assert!(e.contains(name), "{e}");
        }
        for table in ["time,x\n", "$1,2\n", "h1 h2\n", "1,2\n"] {
            assert!(refuse_other_formats(table.as_bytes(), Path::new("x")).is_ok(), "{table}");
        }
    }
}
