//! How a file is packed, known from its first bytes: packed text is read like any other, and an output whose name ends
//! like that of a packed file is packed. A file that stores a table by columns is one more packing of its text.

use std::fmt;
use std::io::{self, BufReader, Read, Seek, Write};

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
    /// None where the packed file is no text packed, but a table stored by columns.
    pack: Option<Pack>,
}

/// All of them.
pub static PACKINGS: [Packing; 6] =
    [gzip::PACKING, zstd::PACKING, xz::PACKING, bzip2::PACKING, zip::PACKING, parquet::PACKING];

/// A stream of text from a packed one. What stands in the packed file can be looked up in the first.
type Unpack = for<'a> fn(Box<dyn Look + 'a>, Stream<'a>) -> Result<Stream<'a>, Unpackable>;
/// What packs all that is written to it, for a file of this name.
type Pack = for<'a> fn(&'a mut dyn Write, &str) -> io::Result<Box<dyn Packer + 'a>>;

/// Bytes one after the other.
pub(crate) type Stream<'a> = Box<dyn Read + Send + 'a>;

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

    /// The text in `packed`, which is the stream of all bytes of `file`.
    pub(crate) fn unpack<'a>(&self, file: Box<dyn Look + 'a>, packed: Stream<'a>) -> Result<Stream<'a>, Unpackable> {
        (self.unpack)(file, packed)
    }

    /// What packs all that is written to it into `out`, under this name where that is kept.
    pub(crate) fn pack<'a>(&self, out: &'a mut dyn Write, name: &str) -> io::Result<Box<dyn Packer + 'a>> {
        let pack = self.pack.ok_or_else(|| io::Error::other(format!("no text is packed as {}", self.name)))?;
        pack(out, name)
    }

    /// True for files that store a table by columns: how its text is laid out is no question.
    #[must_use]
    pub fn is_columnar(&self) -> bool {
        self.pack.is_none()
    }

    /// What is wrong with a stream that gives `error`.
    pub(crate) fn broken(&self, error: &io::Error) -> Unpackable {
        if self.is_columnar() {
            let help =
                "copy or fetch the file again; if columns of it are encrypted, write it again without encryption";
            return Unpackable { what: error.to_string(), help: help.into() };
        }
        let what = format!("the {} stream is broken: {error}", self.name);
        Unpackable { what, help: "copy or fetch the file again".into() }
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
