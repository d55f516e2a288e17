//! A record of text as a Parquet file.

use parquet::basic::Compression;

use super::super::rewrite::{cell_text, new_row_cells};
use super::super::text::path_of;
use super::super::{Changes, Track, for_each_row};
use super::errors::{broken, of_file};
use super::write::Flags;
use crate::error::{Error, Result};
use crate::memory::Share;
use cells::CellReader;
use form::{Stored, forms};
use out::Out;

mod cells;
mod form;
mod out;

/// Rows of a group.
const GROUP: usize = 1 << 17;
/// The usual way to pack: quick, and read by everything.
const COMPRESSION: Compression = Compression::SNAPPY;
const WRITER: &str = concat!("wildpoint version ", env!("CARGO_PKG_VERSION"));

/// The record of `track` with `changes` and columns of flags.
///
/// # Errors
/// When the source can no longer be read, or is no longer the one that was loaded; [`Error::Memory`].
pub(super) fn table(track: &Track, changes: &Changes, flags: Option<&Flags>) -> Result<Vec<u8>> {
    let path = path_of(&track.source);
    // The text of a group, and the file.
    let _share = Share::of(2 * track.bytes).map_err(Error::memory(&path))?;
    // Records of several lines have no place for a new row.
    let new_rows = if track.dialect.view.is_some() { &[][..] } else { changes.rows.as_slice() };
    let forms = forms(track)?;
    let new_cells = new_row_cells(track, new_rows)?;
    let of_path = of_file(&path);
    let mut out = Out::of(track, &forms, flags).map_err(|e| of_path(broken(&e)))?;
    let reader = CellReader::of(track, &forms);
    let (mut cells, mut next_new) = (changes.cells.as_slice(), 0);
    for_each_row(track, |row, texts| {
        let mine = cells.iter().take_while(|c| c.row as usize == row).count();
        let (now, later) = cells.split_at(mine);
        cells = later;
        for (place, form) in forms.iter().enumerate() {
            let change = now.iter().find(|c| c.column == place);
            let value = match change {
                Some(change) => {
                    let text = change.value.map(|v| cell_text(track, place, &texts.text(place), Some(v)));
                    text.map_or(Stored::Nothing, |text| form.value(&text, &reader.reading))
                }
                None => reader.value(place, row, texts),
            };
            out.columns[place].push(value);
        }
        out.end_row(|flags| flags.of_row(row));
        while new_rows.get(next_new).is_some_and(|new| new.after_row as usize == row) {
            reader.new_row(&new_rows[next_new], &new_cells[next_new], &mut out);
            out.end_row(|flags| flags.of_new(next_new));
            next_new += 1;
        }
        if out.rows >= GROUP { out.end_group().map_err(|e| of_path(broken(&e))) } else { Ok(()) }
    })?;
    out.finish().map_err(|e| of_path(broken(&e)))
}
