//! Loading a file without ever holding its text.

use std::path::Path;

use memchr::memrchr;

use super::feed::{Check, Feed, Supply, Unfit};
use super::load::Understood;
use super::text::Text;
use super::waves::Failure;
use super::{Encoding, LoadOptions, Source, Track, Wanted};
use crate::error::Error;

/// A file smaller than this is read whole.
const SMALLEST: u64 = 1 << 20;
/// First so much is looked at for the head, then so much.
const HEADS: [usize; 2] = [256 << 10, 16 << 20];

/// What is wrong, or unusual, is left to reading the file whole.
const UNFIT: Failure = Failure::Unfit(Unfit::Unreadable);

/// Loads the file at `path`. None where its head does not tell how the rest is to be read, and for whatever is wrong
/// with it: reading it whole says what. A track is the one that reading the file whole gives.
pub(super) fn streamed(path: &Path, options: &LoadOptions, wanted: Wanted<'_>) -> Option<Track> {
    if std::fs::metadata(path).ok().is_none_or(|m| !m.is_file() || m.len() < SMALLEST) {
        return None;
    }
    match options.encoding {
        None | Some(Encoding::Utf8 { .. }) => match checked(path, Check::Utf8, options, wanted) {
            // The first byte that is not UTF-8 may stand in the last row.
            Err(Failure::Unfit(Unfit::NotUtf8)) if options.encoding.is_none() => {
                checked(path, Check::Bytes, options, wanted).ok()
            }
            track => track.ok(),
        },
        Some(Encoding::Latin1) => checked(path, Check::Bytes, options, wanted).ok(),
        Some(Encoding::Utf16 { .. }) => None,
    }
}

/// The file as a text that passes `check`.
fn checked(path: &Path, check: Check, options: &LoadOptions, wanted: Wanted<'_>) -> Result<Track, Failure> {
    let (understood, [mark, before]) = understood(path, check, options)?;
    let rows = || {
        let (supply, bytes) = Supply::open(path)?;
        let mut feed = Feed::new(supply, check).while_wanted(wanted);
        feed.peek(mark + before)?;
        feed.skip(mark + before);
        Ok((feed, bytes))
    };
    let (parsed, feed) = understood.parse(rows)?;
    let sha256 = feed.into_supply().sha256().map_err(|_| UNFIT)?;
    let again = || {
        let (supply, _) = Supply::open(path).map_err(Error::io("read", path))?;
        let mut feed = Feed::new(supply, check).while_wanted(wanted);
        let unreadable = |_| Error::input(path, "the file changed while it was loaded", "load it again");
        feed.peek(mark).map_err(unreadable)?;
        feed.skip(mark);
        Ok(feed)
    };
    let source = Source::File(path.to_path_buf());
    understood.track(&source, sha256, parsed, wanted, &again).map_err(|_| UNFIT)
}

/// What the head tells, and the bytes of the byte order mark and of what stands before the rows.
fn understood(path: &Path, check: Check, options: &LoadOptions) -> Result<(Understood, [usize; 2]), Failure> {
    let (supply, _) = Supply::open(path).map_err(|_| UNFIT)?;
    let gzip = supply.is_gzip();
    let mut feed = Feed::new(supply, check);
    for size in HEADS {
        let part = feed.peek(size).map_err(Failure::Unfit)?;
        let encoding = match (part, check) {
            ([0xff, 0xfe, ..] | [0xfe, 0xff, ..], _) | ([0xef, 0xbb, 0xbf, ..], Check::Bytes) => return Err(UNFIT),
            ([0xef, 0xbb, 0xbf, ..], Check::Utf8) => Encoding::Utf8 { bom: true },
            (_, Check::Utf8) => Encoding::Utf8 { bom: false },
            (_, Check::Bytes) => Encoding::Latin1,
        };
        let Some(end) = memrchr(b'\n', part) else { continue };
        let lines = &part[..=end];
        check.of(lines).map_err(Failure::Unfit)?;
        let text = Text::part(lines, encoding, gzip);
        let understood = Understood::of(&text, options, path).map_err(|_| UNFIT)?;
        if understood.head.data_end.is_none() && understood.head.needs_no_more(text.body()) {
            let before = understood.head.data_start;
            return Ok((understood, [lines.len() - text.body().len(), before]));
        }
    }
    Err(UNFIT)
}
