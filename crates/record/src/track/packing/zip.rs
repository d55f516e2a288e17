//! A zip archive of one file.

use std::io::{self, Read, Write};

use flate2::Crc;
use flate2::read::DeflateDecoder;
use zip::write::{SimpleFileOptions, StreamWriter};
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use super::super::view::Want;
use super::{Form, Look, Opened, Packer, Packing, Stream, Unpackable, buffered};

pub(super) const PACKING: Packing = Packing {
    name: "zip",
    ending: ".zip",
    // A file, or nothing at all.
    known: |start| start.starts_with(b"PK\x03\x04") || start.starts_with(b"PK\x05\x06"),
    tool: "unzip",
    joins: false,
    unpack,
    form: Form::Text(pack),
};

/// How many names of an archive are told.
const TOLD: usize = 8;

/// Where the one file of an archive stands, and how it is packed.
struct Member {
    /// Offset of its bytes.
    start: u64,
    /// How many they are.
    length: u64,
    method: CompressionMethod,
    crc: u32,
}

fn unpack<'a>(file: Box<dyn Look + 'a>, mut stream: Stream<'a>, _: Want) -> Result<Opened<'a>, Unpackable> {
    let broken = |e: io::Error| PACKING.broken(&e);
    let member = the_one(file)?;
    io::copy(&mut (&mut stream).take(member.start), &mut io::sink()).map_err(broken)?;
    let packed = buffered(Box::new(stream.take(member.length)));
    let text: Stream<'a> = match member.method {
        CompressionMethod::Stored => Box::new(packed),
        CompressionMethod::Deflated => Box::new(DeflateDecoder::new(packed)),
        other => {
            let what = format!("a zip archive whose file is packed by {other:?}, which is not read");
            return Err(Unpackable::new(what, "unpack it and name the file in it: unzip FILE"));
        }
    };
    Ok(Opened::text(Checked { text, sum: Crc::new(), crc: member.crc }))
}

/// The one file of an archive.
fn the_one(file: Box<dyn Look + '_>) -> Result<Member, Unpackable> {
    let broken = |e: zip::result::ZipError| PACKING.broken(&io::Error::other(e));
    let mut archive = ZipArchive::new(file).map_err(broken)?;
    let mut names = Vec::new();
    let mut found = None;
    for index in 0..archive.len() {
        let entry = archive.by_index_raw(index).map_err(broken)?;
        let name = String::from_utf8_lossy(entry.name_raw()).into_owned();
        if entry.is_dir() || is_aside(&name) {
            continue;
        }
        if entry.encrypted() {
            let what = format!("a zip archive with a password: {}", super::super::printable(&name));
            return Err(Unpackable::new(what, "unpack it and name the file in it: unzip FILE"));
        }
        let start = entry.data_start().unwrap_or_default();
        let member = Member { start, length: entry.compressed_size(), method: entry.compression(), crc: entry.crc32() };
        found = Some(member);
        names.push(name);
    }
    match (found, names.len()) {
        (Some(member), 1) => Ok(member),
        (None, _) => {
            Err(Unpackable::new("a zip archive without a file", "name a file with a header and rows of numbers"))
        }
        (Some(_), _) => Err(several(&names)),
    }
}

/// What the Finder puts beside the files of an archive.
fn is_aside(name: &str) -> bool {
    name.starts_with("__MACOSX/") || name.rsplit('/').next() == Some(".DS_Store")
}

/// Names of an archive of several files, or what that is.
fn several(names: &[String]) -> Unpackable {
    let has = |wanted: &str| names.iter().any(|name| name == wanted);
    if has("[Content_Types].xml") || has("mimetype") {
        return Unpackable::new(
            "a spreadsheet or a document (xlsx, ods), not a table of text",
            "export the sheet as CSV: soffice --convert-to csv FILE",
        );
    }
    let told: Vec<String> = names.iter().take(TOLD).map(|name| super::super::printable(name)).collect();
    let more = if names.len() > TOLD { ", …" } else { "" };
    Unpackable::new(
        format!("a zip archive of {} files: {}{more}", names.len(), told.join(", ")),
        "unpack it (unzip FILE) and name one of them, or each of them for `clean`",
    )
}

/// A text whose sum is compared when it ends.
struct Checked<'a> {
    text: Stream<'a>,
    sum: Crc,
    crc: u32,
}

impl Read for Checked<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let n = self.text.read(buffer)?;
        self.sum.update(&buffer[..n]);
        if n == 0 && !buffer.is_empty() && self.sum.sum() != self.crc {
            return Err(io::Error::other("the checksum does not fit"));
        }
        Ok(n)
    }
}

/// Packs a file of this name; without an ending, it is a table.
fn pack<'a>(out: &'a mut dyn Write, name: &str) -> io::Result<Box<dyn Packer + 'a>> {
    let mut archive = ZipWriter::new_stream(out);
    let name = if name.contains('.') { name.to_owned() } else { format!("{name}.csv") };
    // No time stamp: the same content makes the same file.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(zip::DateTime::default())
        .large_file(true);
    archive.start_file(name, options).map_err(io::Error::from)?;
    Ok(Box::new(archive))
}

impl Packer for ZipWriter<StreamWriter<&mut dyn Write>> {
    fn finish(self: Box<Self>) -> io::Result<()> {
        Self::finish(*self).map(|_| ()).map_err(io::Error::from)
    }
}
