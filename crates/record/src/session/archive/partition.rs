//! The rows of one file of an archive, in whatever order they are.

use std::path::Path;

use super::Template;
use crate::error::{Error, Result};
use crate::track::{LoadOptions, Source, Track, for_each_row, load};

/// A file of an archive.
pub(super) struct Partition<'a> {
    pub(super) folder: &'a Path,
    pub(super) file: &'a Path,
    pub(super) template: &'a Template,
    /// The columns of numbers that are needed.
    pub(super) columns: &'a [String],
}

/// A row of an archive.
#[derive(Debug)]
pub(super) struct Row<'a> {
    pub(super) track: &'a str,
    pub(super) moment: i64,
    pub(super) values: &'a [f64],
}

pub(super) fn columns_of(template: &Template) -> Vec<String> {
    template.columns().into_iter().map(str::to_owned).collect()
}

impl Partition<'_> {
    /// Calls `each` with every row of the file.
    ///
    /// # Errors
    /// What loading gives; [`Error::Input`] for a file without a column of time, and for a row that names no track.
    pub(super) fn rows(&self, mut each: impl FnMut(&Row<'_>) -> Result<()>) -> Result<()> {
        let of_path = self.track_of_path();
        let options = LoadOptions {
            track: self.template.track().filter(|_| of_path.is_none()).map(str::to_owned),
            channels: self.columns.to_vec(),
            ..self.template.loading()
        };
        let track = load(&Source::of(self.file)?, &options)?;
        let time = self.column_of_time(&track)?;
        let ids = track.columns.iter().position(|c| Some(&c.name) == options.track.as_ref());
        let values = self.values(&track);
        let unit_ns = self.template.unit_of(&track.time.name);
        let mut own = vec![f64::NAN; values.len()];
        for_each_row(&track, |row, cells| {
            let id = match (ids, &of_path) {
                (Some(column), _) => cells.text(column),
                (None, Some(id)) => id.as_str().into(),
                (None, None) => self.name().into(),
            };
            if id.is_empty() {
                let what = format!("row {} names no track", row + 1);
                return Err(Error::input(self.file, what, "leave such rows out, or give them an id"));
            }
            own.iter_mut().zip(&values).for_each(|(own, values)| *own = values[row]);
            let moment = track.moment(&cells.text(time), unit_ns);
            each(&Row { track: &id, moment, values: &own })
        })
    }

    fn column_of_time(&self, track: &Track) -> Result<usize> {
        let time = &track.time;
        let single = time.date_column.is_none() && time.part_columns.len() < 2;
        time.column.filter(|_| single).ok_or_else(|| {
            let help = "name a column that has the whole time with --time";
            Error::input(self.file, "no single column tells the time of its rows", help)
        })
    }

    /// The values of each column that is needed, one for each row of the file.
    fn values(&self, track: &Track) -> Vec<Vec<f64>> {
        let of_column = |name: &String| {
            let mut values = vec![f64::NAN; track.rows];
            let column = track.columns.iter().position(|c| c.name == *name);
            for channel in track.channels.iter().filter(|c| Some(c.column) == column) {
                match &channel.target {
                    None => values.copy_from_slice(&channel.values),
                    Some(target) => {
                        target.rows.iter().zip(&channel.values).for_each(|(row, v)| values[*row as usize] = *v);
                    }
                }
            }
            values
        };
        self.columns.iter().map(of_column).collect()
    }

    /// The id in a folder `COLUMN=ID`, as engines partition by a column.
    fn track_of_path(&self) -> Option<String> {
        let column = self.template.track()?;
        let below = self.file.strip_prefix(self.folder).ok()?;
        let id = |part: &str| part.split_once('=').filter(|(name, _)| *name == column).map(|(_, id)| decoded(id));
        below.components().find_map(|part| id(&part.as_os_str().to_string_lossy()))
    }

    /// The track of a file in an archive without a column of tracks: its path in the folder.
    fn name(&self) -> String {
        self.file.strip_prefix(self.folder).unwrap_or(self.file).to_string_lossy().into_owned()
    }
}

/// The text behind `%3A` and the like.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        let digits = after.get(..2).filter(|_| *first == b'%').and_then(|two| std::str::from_utf8(two).ok());
        match digits.and_then(|two| u8::from_str_radix(two, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(*first);
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    #[test]
    fn an_id_in_the_name_of_a_folder_is_decoded() {
        assert_eq!(super::decoded("a%3Ab%2fc"), "a:b/c");
        assert_eq!(super::decoded("50%"), "50%");
        assert_eq!(super::decoded("%zz%E4"), "%zz\u{fffd}");
    }
}
