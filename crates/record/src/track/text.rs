//! From a source to text: reading, unpacking, hashing, and telling the encoding.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use memchr::{memchr, memchr_iter};
use sha2::{Digest, Sha256};

use super::facts::Facts;
use super::packing::Packing;
use super::unsupported::refuse_binaries;
use super::view::{View, Want};
use super::{Encoding, Extent, Format, Source, Wanted, windows_1252};
use crate::error::{Error, Result};
use crate::memory::{Full, Share, limit};

/// A small packed file can unpack to a thousand times its size: more than this is not a record that was packed by
/// mistake or by somebody who means harm, but one to be unpacked on purpose.
const MOST_UNPACKED: u64 = 4 << 30;

/// The text of a source as the tokeniser takes it: ASCII-compatible bytes, unpacked, without byte order mark.
#[derive(Debug)]
pub(crate) struct Text<'a> {
    bytes: Cow<'a, [u8]>,
    start: usize,
    /// What of it is not borrowed.
    share: Share,
    /// How the source encodes it.
    pub(crate) encoding: Encoding,
    /// How the source is packed.
    pub(crate) packing: Option<&'static Packing>,
    /// The table that the format of the text makes of it.
    pub(crate) view: Option<Box<View>>,
    /// What the file says of its columns, where it stores such.
    pub(crate) facts: Option<Arc<Facts>>,
}

/// The name of a source in messages.
pub(crate) fn path_of(source: &Source) -> PathBuf {
    match source {
        Source::File(path) => path.clone(),
        Source::BuiltIn { name, .. } => PathBuf::from(name),
        Source::Input(_) => PathBuf::from(source.name()),
    }
}

/// The bytes of a source as they are stored.
#[derive(Debug)]
pub(crate) struct Stored<'a> {
    bytes: Cow<'a, [u8]>,
    _share: Share,
}

impl std::ops::Deref for Stored<'_> {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        &self.bytes
    }
}

/// The bytes of a source as they are stored, this many of them.
///
/// # Errors
/// [`Error::Io`] when the file cannot be read, [`Error::Input`] for a folder, [`Error::Memory`].
pub(crate) fn stored(source: &Source, extent: Extent) -> Result<Stored<'_>> {
    match source {
        Source::BuiltIn { bytes, .. } => {
            let end = usize::try_from(extent.most()).unwrap_or(usize::MAX).min(bytes.len());
            Ok(Stored { bytes: Cow::Borrowed(&bytes[..end]), _share: Share::default() })
        }
        Source::File(path) if path.is_dir() => {
            Err(Error::input(path, "this is a folder", "name one of the files in it"))
        }
        // A pipe or a device could give bytes without an end, and never the same ones twice.
        Source::File(path) if std::fs::metadata(path).is_ok_and(|m| !m.is_file()) => Err(Error::input(
            path,
            "this is a pipe or a device, not a file",
            "save the record as a file first; samples that keep arriving are for `wildpoint stream`",
        )),
        Source::File(path) => read(path, extent),
        Source::Input(spool) => read(spool.path(), extent),
    }
}

fn read(path: &Path, extent: Extent) -> Result<Stored<'static>> {
    let unreadable = || Error::io("read", path);
    let file = File::open(path).map_err(unreadable())?;
    let size = file.metadata().map_err(unreadable())?.len().min(extent.most());
    let mut share = Share::of(size).map_err(Error::memory(path))?;
    let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or_default());
    file.take(extent.most()).read_to_end(&mut bytes).map_err(unreadable())?;
    // It may have had no length until it was read.
    share.set(bytes.len() as u64).map_err(Error::memory(path))?;
    Ok(Stored { bytes: Cow::Owned(bytes), _share: share })
}

/// SHA-256 in lower-case hexadecimal; that of a part when it is no longer wanted.
pub(crate) fn sha256(bytes: &[u8], wanted: Wanted<'_>) -> String {
    let mut hash = Sha256::new();
    bytes.chunks(1 << 20).take_while(|_| wanted.still()).for_each(|piece| hash.update(piece));
    hex(&hash.finalize())
}

/// Bytes in lower-case hexadecimal.
#[must_use]
pub fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

impl<'a> Text<'a> {
    /// The first part of a text, in the encoding that the whole was taken for.
    pub(crate) fn part(
        bytes: &'a [u8],
        encoding: Encoding,
        packing: Option<&'static Packing>,
        facts: Option<Arc<Facts>>,
    ) -> Self {
        let start = if encoding == (Encoding::Utf8 { bom: true }) { 3 } else { 0 };
        Self { bytes: Cow::Borrowed(bytes), start, share: Share::default(), encoding, packing, view: None, facts }
    }

    /// The text in `stored`, in the `wanted` encoding or in the one its bytes show.
    ///
    /// # Errors
    /// [`Error::Input`] for a file that cannot be unpacked, for bytes that are not in the wanted encoding, and for NUL bytes.
    pub(crate) fn of(stored: &'a [u8], path: &Path, wanted: Option<Encoding>) -> Result<Self> {
        Self::of_table(stored, path, wanted, Want::default())
    }

    /// The same, of several tables that `stored` holds the one that `want` says.
    ///
    /// # Errors
    /// As [`Text::of`].
    pub(crate) fn of_table(stored: &'a [u8], path: &Path, wanted: Option<Encoding>, want: Want) -> Result<Self> {
        let Unpacked { bytes, packing, facts, mut share } = unpacked(stored, path, want)?;
        if let [0xff, 0xfe, ..] | [0xfe, 0xff, ..] = bytes.as_ref() {
            // Three bytes for two at most.
            share.add(bytes.len() as u64 / 2 * 3).map_err(Error::memory(path))?;
        }
        let (bytes, start, encoding) = match bytes.as_ref() {
            [0xff, 0xfe, ..] => (Cow::Owned(from_utf16(&bytes[2..], false, path)?), 0, utf16(false)),
            [0xfe, 0xff, ..] => (Cow::Owned(from_utf16(&bytes[2..], true, path)?), 0, utf16(true)),
            [0xef, 0xbb, 0xbf, ..] => (bytes, 3, Encoding::Utf8 { bom: true }),
            _ => (bytes, 0, Encoding::Utf8 { bom: false }),
        };
        if let Some(at) = memchr(0, &bytes[start..]) {
            return Err(Error::Input {
                path: path.to_path_buf(),
                line: Some(line_at(&bytes, start + at)),
                what: "a NUL byte: not a text file, or UTF-16 without a byte order mark".into(),
                help: "export the record as text; if it is UTF-16: iconv -f UTF-16LE -t UTF-8 OLD > NEW".into(),
            });
        }
        let encoding = match encoding {
            Encoding::Utf8 { bom } => eight_bit(&bytes[start..], bom, wanted, path)?,
            other => other,
        };
        Ok(Self { bytes, start, share, encoding, packing, view: None, facts })
    }

    /// True for the text of a file that stores columns.
    pub(crate) fn is_columnar(&self) -> bool {
        self.packing.is_some_and(Packing::is_columnar)
    }

    /// The bytes that hold rows: those of the source, or of the table that its format makes of them.
    pub(crate) fn body(&self) -> &[u8] {
        self.view.as_ref().map_or_else(|| self.source(), |view| &view.table)
    }

    /// The bytes of the source.
    pub(crate) fn source(&self) -> &[u8] {
        &self.bytes[self.start..]
    }

    /// The same with the table that `format` makes of it.
    ///
    /// # Errors
    /// As [`View::of`]; [`Error::Memory`].
    pub(crate) fn viewed(mut self, format: &'static Format, want: Want, path: &Path) -> Result<Self> {
        if let Some(view) = View::of(format, self.source(), self.encoding, want).map_err(|e| of_file(e, path))? {
            self.share.add(view.bytes()).map_err(Error::memory(path))?;
            self.view = Some(Box::new(view));
        }
        Ok(self)
    }

    /// What the source starts with before its first record, to be written again.
    pub(crate) fn mark(&self) -> &[u8] {
        match self.encoding {
            Encoding::Utf16 { big_endian: false } => b"\xff\xfe",
            Encoding::Utf16 { big_endian: true } => b"\xfe\xff",
            Encoding::Utf8 { .. } | Encoding::Latin1 => &self.bytes[..self.start],
        }
    }
}

/// An error of a format, which does not know the name of the file.
fn of_file(e: Error, path: &Path) -> Error {
    match e {
        Error::Input { line, what, help, .. } => Error::Input { path: path.to_path_buf(), line, what, help },
        other => other,
    }
}

/// Bytes of the tokeniser's text as characters.
pub(crate) fn decoded(bytes: &[u8], encoding: Encoding) -> Cow<'_, str> {
    match encoding {
        Encoding::Latin1 => Cow::Owned(windows_1252::decode(bytes)),
        Encoding::Utf8 { .. } | Encoding::Utf16 { .. } => String::from_utf8_lossy(bytes),
    }
}

fn utf16(big_endian: bool) -> Encoding {
    Encoding::Utf16 { big_endian }
}

/// The text in `stored`, unpacked if it is packed.
struct Unpacked<'a> {
    bytes: Cow<'a, [u8]>,
    packing: Option<&'static Packing>,
    facts: Option<Arc<Facts>>,
    share: Share,
}

fn unpacked<'a>(stored: &'a [u8], path: &Path, want: Want) -> Result<Unpacked<'a>> {
    let mut share = Share::default();
    let Some(packing) = Packing::of(stored) else {
        return Ok(Unpacked { bytes: Cow::Borrowed(stored), packing: None, facts: None, share });
    };
    let mut bytes = Vec::new();
    let opened = packing.unpack(Box::new(Cursor::new(stored)), Box::new(stored), want);
    let opened = opened.map_err(|e| e.of_file(path))?;
    let (mut packed, facts) = (opened.text, opened.facts);
    loop {
        share.add(PIECE).map_err(Error::memory(path))?;
        let read = (&mut packed).take(PIECE).read_to_end(&mut bytes).map_err(|e| match e.kind() {
            io::ErrorKind::OutOfMemory => Error::memory(path)(Full { limit: limit() }),
            _ => packing.broken(&e).of_file(path),
        })?;
        if bytes.len() as u64 > MOST_UNPACKED {
            let help = if packing.is_columnar() {
                "write a file with fewer columns or rows".to_owned()
            } else {
                format!("unpack it ({} FILE) if that is what it is", packing.tool)
            };
            return Err(Error::input(path, "it unpacks to more than 4 GiB", help));
        }
        if read == 0 {
            break;
        }
    }
    if packing.is_columnar() {
        return Ok(Unpacked { bytes: Cow::Owned(bytes), packing: Some(packing), facts, share });
    }
    if let Some(inner) = Packing::of(&bytes) {
        let what = format!("it is packed twice: {} in {}", inner.name, packing.name);
        return Err(Error::input(path, what, format!("unpack it once: {} FILE", packing.tool)));
    }
    refuse_binaries(&bytes, path)?;
    Ok(Unpacked { bytes: Cow::Owned(bytes), packing: Some(packing), facts, share })
}

/// So much is unpacked at a time.
const PIECE: u64 = 4 << 20;

fn from_utf16(bytes: &[u8], big_endian: bool, path: &Path) -> Result<Vec<u8>> {
    let broken = || {
        Error::input(
            path,
            "it starts as UTF-16 and is not: half a character, or an odd number of bytes",
            "save it again as UTF-8",
        )
    };
    let (units, []) = bytes.as_chunks::<2>() else { return Err(broken()) };
    let unit = if big_endian { u16::from_be_bytes } else { u16::from_le_bytes };
    let text: std::result::Result<String, _> = char::decode_utf16(units.iter().map(|&two| unit(two))).collect();
    text.map(String::into_bytes).map_err(|_| broken())
}

fn eight_bit(bytes: &[u8], bom: bool, wanted: Option<Encoding>, path: &Path) -> Result<Encoding> {
    let utf8 = Encoding::Utf8 { bom };
    match (wanted, std::str::from_utf8(bytes)) {
        (Some(Encoding::Latin1), _) => Ok(Encoding::Latin1),
        (Some(Encoding::Utf16 { .. }), _) => {
            Err(Error::input(path, "not UTF-16: the byte order mark is missing", "leave out --encoding"))
        }
        (_, Ok(_)) => Ok(utf8),
        (None, Err(_)) => Ok(Encoding::Latin1),
        (Some(Encoding::Utf8 { .. }), Err(e)) => Err(Error::Input {
            path: path.to_path_buf(),
            line: Some(line_at(bytes, e.valid_up_to())),
            what: "a byte that is not UTF-8".into(),
            help: "read it as Latin-1 (--encoding latin-1), or leave out --encoding".into(),
        }),
    }
}

fn line_at(bytes: &[u8], offset: usize) -> u64 {
    1 + memchr_iter(b'\n', &bytes[..offset]).count() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(stored: &[u8]) -> Result<Text<'_>> {
        Text::of(stored, Path::new("x.csv"), None)
    }

    #[test]
    fn the_hash_is_that_of_the_standard() {
        // FIPS 180-2, appendix B.1.
        assert_eq!(
            sha256(b"abc", Wanted::always()),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }

    #[test]
    fn byte_order_marks_tell_the_encoding_and_are_no_text() {
        for (stored, encoding) in [
            (&b"\xef\xbb\xbfa"[..], Encoding::Utf8 { bom: true }),
            (b"\xff\xfea\0", utf16(false)),
            (b"\xfe\xff\0a", utf16(true)),
            (b"a", Encoding::Utf8 { bom: false }),
        ] {
            let text = text(stored).unwrap();
            assert_eq!((text.body(), text.encoding), (&b"a"[..], encoding));
            assert_eq!(text.mark(), &stored[..stored.iter().position(|b| b"a\0".contains(b)).unwrap()]);
        }
        // A mark of one encoding before bytes of another is kept all the same.
        assert_eq!(text(b"\xef\xbb\xbf\xb0").unwrap().mark(), b"\xef\xbb\xbf");
    }

    #[test]
    fn bytes_that_are_not_utf8_are_windows_1252() {
        let text = text(b"\xb0C \x80").unwrap();
        assert_eq!(text.encoding, Encoding::Latin1);
        assert_eq!(decoded(text.body(), text.encoding), "°C €");
    }

    #[test]
    fn what_is_no_text_is_refused_with_its_line() {
        let e = text(b"a,b\n1,\0").unwrap_err().to_string();
        assert!(e.starts_with("x.csv:2: a NUL byte"), "{e}");
        assert!(text(b"\xff\xfea").unwrap_err().to_string().contains("odd number of bytes"));
        assert!(text(b"\x1f\x8b\x08rest").unwrap_err().to_string().contains("gzip"));
        let wanted = Some(Encoding::Utf8 { bom: false });
        let e = Text::of(b"a\n\xb0", Path::new("x"), wanted).unwrap_err().to_string();
        assert!(e.starts_with("x:2: "), "{e}");
    }
}
