//! An archive on this machine: a folder of files, in which the rows of a track may be spread over several.
//!
//! One file is in memory, then one track for each thread: in between, the rows lie in temporary files, those of a track
//! in the same one.

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::partition::{Partition, columns_of};
use super::spill::Spill;
use super::{Summary, Template};
use crate::error::{Error, Result};
use crate::track::unpacked_name;

/// How far the work is.
#[derive(Debug, Clone, Copy)]
pub enum Step {
    /// This many files will be read.
    Files(usize),
    /// One of them was read.
    Read,
}

/// Endings of files that are read.
const ENDINGS: [&str; 4] = ["parquet", "csv", "tsv", "txt"];

/// Applies a session to every track of the files below `folder`, and gives a summary for each track and channel.
///
/// # Errors
/// [`Error::Input`] when there is no file; what reading the files and [`Template::judge`] give.
pub fn replay_folder(template: &Template, folder: &Path, told: impl Fn(Step)) -> Result<Vec<Summary>> {
    let files = files_below(folder)?;
    if files.is_empty() {
        let help = "name a folder with .parquet or .csv files; names that begin with _ or . are left out";
        return Err(Error::input(folder, "no file of an archive", help));
    }
    told(Step::Files(files.len()));
    let columns = columns_of(template);
    let mut spill = Spill::new(total(&files), columns.len(), template.unit_of(template.time().unwrap_or_default()))?;
    for file in &files {
        Partition { folder, file, template, columns: &columns }.rows(|row| spill.add(row))?;
        told(Step::Read);
    }
    let mut summaries = Vec::new();
    for bucket in 0..spill.buckets() {
        let tracks = spill.tracks(bucket, &columns)?;
        let judged = tracks.into_par_iter().map(|rows| {
            let judged = template.judge(rows)?;
            Ok((0..judged.channels().len()).map(|channel| judged.summary(channel)).collect::<Vec<_>>())
        });
        summaries.extend(judged.collect::<Result<Vec<_>>>()?.into_iter().flatten());
    }
    summaries.sort_by(|a, b| (&a.track, &a.channel).cmp(&(&b.track, &b.channel)));
    Ok(summaries)
}

fn total(files: &[PathBuf]) -> u64 {
    files.iter().filter_map(|file| file.metadata().ok()).map(|about| about.len()).sum()
}

/// The files of an archive, by their paths. What engines write beside them (`_SUCCESS`, `.crc`) is left out.
fn files_below(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(&folder).map_err(Error::io("read", &folder))? {
            let path = entry.map_err(Error::io("read", &folder))?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
            let (unpacked, _) = unpacked_name(&name);
            let ending = unpacked.rsplit_once('.').map_or("", |(_, ending)| ending);
            if name.starts_with(['_', '.']) {
                continue;
            } else if path.is_dir() {
                open.push(path);
            } else if ENDINGS.contains(&ending) {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}
