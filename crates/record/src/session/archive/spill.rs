//! Temporary files that bring the rows of a track together.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Seek, Write};

use super::Rows;
use super::partition::Row;
use crate::error::{Error, Result};
use crate::track::ChannelValues;

/// Bytes of the archive for which there is one temporary file.
const OF_BUCKET: u64 = 64 << 20;
/// The system lets a program open some hundreds.
const MOST: u64 = 200;

/// The rows of an archive, those of a track in one file.
pub(super) struct Spill {
    files: Vec<BufWriter<File>>,
    /// For each track its number, in the order in which they are met.
    ids: HashMap<String, u32>,
    columns: usize,
    unit_ns: i64,
}

impl Spill {
    pub(super) fn new(bytes: u64, columns: usize, unit_ns: i64) -> Result<Self> {
        let count = bytes.div_ceil(OF_BUCKET).clamp(1, MOST);
        let file = |_| tempfile::tempfile().map(BufWriter::new).map_err(Error::io("write to", std::env::temp_dir()));
        Ok(Self { files: (0..count).map(file).collect::<Result<_>>()?, ids: HashMap::new(), columns, unit_ns })
    }

    pub(super) fn buckets(&self) -> usize {
        self.files.len()
    }

    pub(super) fn add(&mut self, row: &Row<'_>) -> Result<()> {
        let id = match self.ids.get(row.track) {
            Some(id) => *id,
            None => {
                let next = u32::try_from(self.ids.len())
                    .map_err(|_| Error::usage("the archive has 2^32 tracks or more", "replay a part of it"))?;
                self.ids.insert(row.track.to_owned(), next);
                next
            }
        };
        let bucket = id as usize % self.files.len();
        let file = &mut self.files[bucket];
        let mut write = || {
            file.write_all(&id.to_le_bytes())?;
            file.write_all(&row.moment.to_le_bytes())?;
            row.values.iter().try_for_each(|value| file.write_all(&value.to_bits().to_le_bytes()))
        };
        write().map_err(Error::io("write to", std::env::temp_dir()))
    }

    /// The tracks of a file, which is empty then.
    pub(super) fn tracks(&mut self, bucket: usize, columns: &[String]) -> Result<Vec<Rows>> {
        let failed = |e| Error::io("read", std::env::temp_dir())(e);
        let writer = &mut self.files[bucket];
        writer.flush().map_err(failed)?;
        let file = writer.get_mut();
        file.rewind().map_err(failed)?;
        let mut tracks: HashMap<u32, Rows> = HashMap::new();
        let channel = |name: &String| ChannelValues { name: name.clone(), values: Vec::new() };
        let mut reader = BufReader::with_capacity(1 << 20, &mut *file);
        let mut record = vec![0; 12 + 8 * self.columns];
        while filled(&mut reader, &mut record).map_err(failed)? {
            let (id, rest) = record.split_at(4);
            let id = u32::from_le_bytes(id.try_into().unwrap_or_default());
            let mut words = rest.chunks_exact(8).map(|word| u64::from_le_bytes(word.try_into().unwrap_or_default()));
            let rows = tracks.entry(id).or_insert_with(|| Rows {
                channels: columns.iter().map(channel).collect(),
                unit_ns: self.unit_ns,
                ..Rows::default()
            });
            rows.moments.push(words.next().unwrap_or_default().cast_signed());
            rows.channels.iter_mut().zip(words).for_each(|(c, word)| c.values.push(f64::from_bits(word)));
        }
        drop(reader);
        file.set_len(0).map_err(failed)?;
        for (name, id) in &self.ids {
            if let Some(rows) = tracks.get_mut(id) {
                rows.track.clone_from(name);
            }
        }
        Ok(tracks.into_values().collect())
    }
}

/// Reads a record; false at the end.
fn filled(from: &mut impl Read, record: &mut [u8]) -> std::io::Result<bool> {
    let first = from.read(record)?;
    if first == 0 {
        return Ok(false);
    }
    from.read_exact(&mut record[first..]).map(|()| true)
}
