//! Columns beside those of a file of a format: the file is read again with them, or it is refused with a clear word.

use wildpoint_record::track::{Changes, LoadOptions, NewColumn, Source, Track, load, rewrite_beside};

use super::case::{Case, bytes_of};

fn loaded(bytes: &[u8], case: &Case) -> Result<Track, String> {
    let options = LoadOptions { table: case.table, ..LoadOptions::default() };
    load(&Source::BuiltIn { name: "test", bytes: bytes.into() }, &options).map_err(|e| e.to_string())
}

fn names(track: &Track) -> Vec<String> {
    track.columns.iter().map(|c| c.name.clone()).collect()
}

/// What is wrong with the file that has a column more; none where it is right, or refused.
pub(crate) fn wrong(case: &Case) -> Option<String> {
    let old = loaded(&bytes_of(case), case).unwrap();
    let column =
        NewColumn { name: "mark_flag".into(), cell: &|row, _| (1 + row % 4).to_string(), new_row: &|_| "9".into() };
    let mut out = Vec::new();
    let written = rewrite_beside(&old, &Changes { cells: Vec::new(), rows: Vec::new() }, &[column], &mut out);
    if let Err(e) = written {
        let e = e.to_string();
        return (!e.contains("has no place for columns beside its own")).then_some(e);
    }
    let new = match loaded(&out, case) {
        Ok(new) => new,
        Err(e) => return Some(format!("it is not read again: {e}")),
    };
    let mut expected = names(&old);
    expected.push("mark_flag".into());
    let same = old.rows == new.rows && old.time.seconds == new.time.seconds && old.time.origin_ns == new.time.origin_ns;
    let units = |t: &Track| t.columns.iter().take(old.columns.len()).map(|c| c.unit.clone()).collect::<Vec<_>>();
    match () {
        () if names(&new) != expected => Some(format!("the columns are {:?}", names(&new))),
        () if !same => Some(format!("{} rows in place of {}", new.rows, old.rows)),
        () if units(&old) != units(&new) => Some(format!("the units are {:?}", units(&new))),
        () if new.faults.ragged_rows.count > old.faults.ragged_rows.count => Some("rows are ragged".into()),
        () => None,
    }
}
