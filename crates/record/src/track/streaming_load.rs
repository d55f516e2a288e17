//! Loading a file without ever holding its text.

use std::path::Path;

use memchr::memrchr;

use super::feed::{Check, Feed, Supply, Unfit};
use super::formats::viewed;
use super::load::Understood;
use super::parallel_parse::Failure;
use super::text::{Text, path_of};
use super::view::Want;
use super::{Encoding, Extent, LoadOptions, Source, Track, Wanted};
use crate::error::Error;

/// A file smaller than this is read whole.
const SMALLEST: u64 = 1 << 20;
/// First so much is looked at for the head, then so much.
const HEADS: [usize; 2] = [256 << 10, 16 << 20];

/// What is wrong, or unusual, is left to reading the file whole.
const UNFIT: Failure = Failure::Unfit(Unfit::Unreadable);

/// Loads so much of the file at `path`, which is that of `source`. None where its head does not tell how the rest is to be read, and for whatever is
/// wrong with it: reading it whole says what. A track is the one that reading the file whole gives; what takes too much
/// memory does so all the more when it is read whole.
pub(super) fn streamed(
    (source, path): (&Source, &Path),
    options: &LoadOptions,
    extent: Extent,
    wanted: Wanted<'_>,
) -> Option<Result<Track, Error>> {
    if std::fs::metadata(path).ok().is_none_or(|m| !m.is_file() || m.len().min(extent.most()) < SMALLEST) {
        return None;
    }
    let checked = |check| checked((source, path, extent), check, options, wanted);
    let track = match options.encoding {
        None | Some(Encoding::Utf8 { .. }) => match checked(Check::Utf8) {
            // The first byte that is not UTF-8 may stand in the last row.
            Err(Failure::Unfit(Unfit::NotUtf8)) if options.encoding.is_none() => checked(Check::Bytes),
            track => track,
        },
        Some(Encoding::Latin1) => checked(Check::Bytes),
        Some(Encoding::Utf16 { .. }) => return None,
    };
    match track {
        Ok(track) => Some(Ok(track)),
        Err(Failure::Full(full) | Failure::Unfit(Unfit::Full(full))) => Some(Err(Error::memory(path_of(source))(full))),
        Err(Failure::Open(_) | Failure::Unfit(_)) => None,
    }
}

/// The file as a text that passes `check`.
fn checked(
    (source, path, extent): (&Source, &Path, Extent),
    check: Check,
    options: &LoadOptions,
    wanted: Wanted<'_>,
) -> Result<Track, Failure> {
    let (understood, [mark, before]) = understood((path, extent), check, options)?;
    let want = Want { table: options.table };
    let rows = || {
        let (supply, bytes) = Supply::open(path, extent, want).map_err(|_| Unfit::Unreadable)?;
        let mut feed = Feed::new(supply, check).while_wanted(wanted);
        feed.peek(mark + before)?;
        feed.skip(mark + before);
        Ok((feed, bytes))
    };
    let (parsed, feed) = understood.parse(rows)?;
    let stored = feed.into_supply().sha256().map_err(|_| UNFIT)?;
    let again = || {
        let (supply, _) = Supply::open(path, extent, want)?;
        let mut feed = Feed::new(supply, check).while_wanted(wanted);
        let unreadable = |_| Error::input(path, "the file changed while it was loaded", "load it again");
        feed.peek(mark).map_err(unreadable)?;
        feed.skip(mark);
        Ok(feed)
    };
    understood.track(source, stored, parsed, wanted, &again).map_err(|_| UNFIT)
}

/// What the head tells, and the bytes of the byte order mark and of what stands before the rows.
fn understood(
    (path, extent): (&Path, Extent),
    check: Check,
    options: &LoadOptions,
) -> Result<(Understood, [usize; 2]), Failure> {
    let (supply, _) = Supply::open(path, extent, Want { table: options.table }).map_err(|_| UNFIT)?;
    let (packing, facts) = (supply.packing(), supply.facts());
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
        let text = Text::part(lines, encoding, packing, facts.clone());
        // A table that is made of the records needs all of them.
        if !text.is_columnar() && viewed(text.body(), options).is_some() {
            return Err(UNFIT);
        }
        let understood = Understood::of(&text, options, path).map_err(|_| UNFIT)?;
        if understood.head.data_end.is_none() && understood.head.needs_no_more(text.body()) {
            let before = understood.head.data_start;
            return Ok((understood, [lines.len() - text.body().len(), before]));
        }
    }
    Err(UNFIT)
}
