//! How a file is packed, known from its first bytes: packed text is read like any other, and an output whose name ends
//! like that of a packed file is packed. A file that stores a table by columns is one more packing of its text.

use std::fmt;
use std::io::{self, BufReader, Read, Seek, Write};
use std::path::Path;
use std::sync::Arc;

use super::facts::Facts;
use super::view::Want;
use crate::error::Error;
use crate::memory::Full;

#[cfg(feature = "hdf5")]
mod arrays;
mod bzip2;
mod gzip;
mod parquet;
mod xz;
mod zip;
mod zstd;

/// A way to pack a file.
pub struct Packing {
    /// Its name.
    pub name: &'static str,
    /// How the names of such files end.
    pub ending: &'static str,
    /// True for the first bytes of such a file.
    known: fn(&[u8]) -> bool,
    /// The command that unpacks such a file.
    pub(crate) tool: &'static str,
    /// True when packed files one after the other are one packed file, to which can be appended.
    pub(crate) joins: bool,
    unpack: Unpack,
    form: Form,
}

/// What a packed file is.
enum Form {
    /// Text, and what packs it.
    Text(Pack),
    /// A table stored by columns, whose copy is stored so, too.
    Columns,
    /// Tables of arrays, which are read and not written.
    #[cfg(feature = "hdf5")]
    Arrays,
}

/// All of them.
pub static PACKINGS: &[Packing] = &[
    gzip::PACKING,
    zstd::PACKING,
    xz::PACKING,
    bzip2::PACKING,
    zip::PACKING,
    parquet::PACKING,
    #[cfg(feature = "hdf5")]
    arrays::HDF5,
    #[cfg(feature = "hdf5")]
    arrays::MATLAB,
    #[cfg(feature = "hdf5")]
    arrays::NETCDF,
];

#[cfg(feature = "hdf5")]
pub(super) use arrays::{HDF5, MATLAB, NETCDF};

/// A stream of text from a packed one. What stands in the packed file can be looked up in the first.
type Unpack = for<'a> fn(Box<dyn Look + 'a>, Stream<'a>, Want) -> Result<Opened<'a>, Unpackable>;
/// What packs all that is written to it, for a file of this name.
type Pack = for<'a> fn(&'a mut dyn Write, &str) -> io::Result<Box<dyn Packer + 'a>>;

/// Bytes one after the other.
pub(crate) type Stream<'a> = Box<dyn Read + Send + 'a>;

/// The text of a packed file.
pub(crate) struct Opened<'a> {
    pub(crate) text: Stream<'a>,
    /// What the file says of its columns, where it stores such.
    pub(crate) facts: Option<Arc<Facts>>,
}

impl<'a> Opened<'a> {
    fn text(text: impl Read + Send + 'a) -> Self {
        Self { text: Box::new(text), facts: None }
    }
}

/// A file that can be looked into at any place.
pub(crate) trait Look: Read + Seek + Send {}
impl<T: Read + Seek + Send> Look for T {}

/// A packed stream that is being written.
pub(crate) trait Packer: Write {
    /// Writes its end.
    fn finish(self: Box<Self>) -> io::Result<()>;
}

/// Why a packed file cannot be read, and the way out.
#[derive(Debug)]
pub(crate) struct Unpackable {
    pub(crate) what: String,
    pub(crate) help: String,
    /// The memory that is there, where it needs more.
    pub(crate) full: Option<Full>,
}

impl Unpackable {
    pub(crate) fn new(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self { what: what.into(), help: help.into(), full: None }
    }

    /// A file that needs more memory than there is.
    #[cfg(feature = "hdf5")]
    pub(crate) fn full(full: Full) -> Self {
        Self { full: Some(full), ..Self::new("", "") }
    }

    /// The error about the file at `path`.
    pub(crate) fn of_file(self, path: &Path) -> Error {
        match self.full {
            Some(full) => Error::memory(path)(full),
            None => Error::input(path, self.what, self.help),
        }
    }
}

impl Packing {
    /// The packing of a file that begins with these bytes.
    #[must_use]
    pub(crate) fn of(start: &[u8]) -> Option<&'static Self> {
        PACKINGS.iter().find(|packing| (packing.known)(start))
    }

    /// The packing of a file that begins with what `file` gives next; `file` is back where it was then.
    pub(crate) fn of_file(file: &mut dyn Look) -> io::Result<Option<&'static Self>> {
        let at = file.stream_position()?;
        let mut start = Vec::with_capacity(LOOKED_AT as usize);
        file.take(LOOKED_AT).read_to_end(&mut start)?;
        file.seek(io::SeekFrom::Start(at))?;
        Ok(Self::of(&start))
    }

    /// The text in `packed`, which is the stream of all bytes of `file`; of several tables the wanted one.
    pub(crate) fn unpack<'a>(
        &self,
        file: Box<dyn Look + 'a>,
        packed: Stream<'a>,
        want: Want,
    ) -> Result<Opened<'a>, Unpackable> {
        (self.unpack)(file, packed, want)
    }

    /// What packs all that is written to it into `out`, under this name where that is kept.
    pub(crate) fn pack<'a>(&self, out: &'a mut dyn Write, name: &str) -> io::Result<Box<dyn Packer + 'a>> {
        match self.form {
            Form::Text(pack) => pack(out, name),
            _ => Err(io::Error::other(format!("no text is packed as {}", self.name))),
        }
    }

    /// True for files that store columns: how their text is laid out is no question.
    #[must_use]
    pub fn is_columnar(&self) -> bool {
        !matches!(self.form, Form::Text(_))
    }

    /// True for files that store columns and are written, too.
    #[must_use]
    pub fn is_written(&self) -> bool {
        matches!(self.form, Form::Text(_) | Form::Columns)
    }

    /// True for files that store several tables.
    pub(crate) fn holds_tables(&self) -> bool {
        !self.is_written()
    }

    /// Such a file, with its article.
    pub(crate) fn a_file(&self) -> String {
        format!("{} {} file", if self.name.starts_with('H') { "an" } else { "a" }, self.name)
    }

    /// What is wrong with a stream that gives `error`.
    pub(crate) fn broken(&self, error: &io::Error) -> Unpackable {
        if self.is_columnar() {
            return Unpackable::new(error.to_string(), "copy or fetch the file again");
        }
        Unpackable::new(format!("the {} stream is broken: {error}", self.name), "copy or fetch the file again")
    }

    /// A name without this ending, where it has it.
    fn cut<'n>(&self, name: &'n str) -> Option<&'n str> {
        let at = name.len().checked_sub(self.ending.len()).filter(|at| *at > 0)?;
        name.get(at..).filter(|ending| ending.eq_ignore_ascii_case(self.ending)).map(|_| &name[..at])
    }
}

/// A name without the ending of packed files, and the packing that it stands for: `a.csv` and gzip of `a.csv.gz`.
#[must_use]
pub fn unpacked_name(name: &str) -> (&str, Option<&'static Packing>) {
    let cut = |packing: &'static Packing| packing.cut(name).map(|rest| (rest, Some(packing)));
    PACKINGS.iter().filter(|packing| !packing.is_columnar()).find_map(cut).unwrap_or((name, None))
}

pub(crate) use zstd::{packed as zstd_packed, unpacked as zstd_unpacked};

/// Bytes that tell how a file is packed.
const LOOKED_AT: u64 = 16;

/// Decoders read in small pieces.
fn buffered(stream: Stream<'_>) -> BufReader<Stream<'_>> {
    BufReader::with_capacity(64 << 10, stream)
}

impl PartialEq for Packing {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Packing {}

impl fmt::Debug for Packing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

#[cfg(test)]
mod tests;
