//! The rows of a file to columns of numbers, wave by wave: while one wave is parsed in parallel over chunks of lines,
//! the next is read and the one before it is added to the columns of the whole.

use std::ops::Range;

use memchr::memchr;
use rayon::prelude::*;

use super::body::{Body, Plan, Whole};
use super::chunk::{Broken, Chunk};
use super::feed::{Feed, Unfit};
use super::tokens::OpenQuote;
use crate::memory::Full;

/// Bytes of a chunk: its text and its numbers fit into the cache of a core.
const CHUNK: usize = 256 << 10;
/// Chunks of a wave for each thread.
const WAVE: usize = 4;

/// Why rows could not be parsed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Failure {
    /// A quoted cell does not end.
    Open(OpenQuote),
    /// The text cannot be read piece by piece.
    Unfit(Unfit),
    /// The rows take more memory than there is.
    Full(Full),
}

/// Parses what `feed` gives, the body of a file from its first data row on, which is on line `first_line`; the body
/// has about `bytes` bytes.
///
/// Memory holds every number once, and of the text no more than two waves, besides a record that is longer.
///
/// # Errors
/// [`Failure`]; lines count from the start of the file.
pub(crate) fn parse(feed: &mut Feed<'_>, bytes: u64, first_line: u64, plan: &Plan<'_>) -> Result<Body, Failure> {
    parse_by(feed, Whole::new(plan, bytes, first_line - 1), plan, CHUNK)
}

/// [`parse`] by chunks of at least this many bytes.
fn parse_by(feed: &mut Feed<'_>, mut whole: Whole, plan: &Plan<'_>, chunk: usize) -> Result<Body, Failure> {
    let (mut before, mut bodies): (Vec<Body>, Vec<Body>) = (Vec::new(), Vec::new());
    let (mut wave, mut ahead) = (Vec::new(), Vec::new());
    let size = chunk * WAVE * rayon::current_num_threads();
    let mut last = feed.next(&mut wave, size).map_err(Failure::Unfit)?;
    loop {
        let (read, (added, parsed)) = rayon::join(
            || if last { Ok(true) } else { feed.next(&mut ahead, size) },
            || rayon::join(|| whole.add(&mut before), || parse_wave(&wave, plan, chunk, &mut bodies)),
        );
        added.map_err(Failure::Full)?;
        let end_ahead = read.map_err(Failure::Unfit)?;
        let done = match parsed {
            Ok(()) => wave.len(),
            // What does not end here may end in the next wave.
            Err(broken) if !last => broken.start,
            Err(broken) => {
                // The quote's line counts from the start of the last chunk.
                let chunks = bodies.len().saturating_sub(1);
                let before: u64 = bodies[..chunks].iter().map(|b| b.lines).sum();
                return Err(Failure::Open(OpenQuote { line: broken.quote.line + before + whole.lines }));
            }
        };
        std::mem::swap(&mut before, &mut bodies);
        if last {
            break;
        }
        if done < wave.len() {
            ahead.splice(0..0, wave.drain(done..));
        }
        std::mem::swap(&mut wave, &mut ahead);
        last = end_ahead;
    }
    whole.add(&mut before).map_err(Failure::Full)?;
    Ok(whole.finished())
}

/// Parses a wave into `bodies`, one for each chunk; those of the chunks before the broken record, where there is one.
///
/// A chunk is taken to begin with a record. Where it does not, because a quoted cell of the chunk before it holds the
/// line end between them, it is parsed again from where that record ends. What comes out is so what one pass gives.
fn parse_wave(wave: &[u8], plan: &Plan<'_>, chunk: usize, bodies: &mut Vec<Body>) -> Result<(), Broken> {
    let chunks = chunks(wave, chunk, plan.layout.line_end);
    bodies.resize_with(chunks.len(), || Body::new(plan, 0));
    let parse = |(body, range): (&mut Body, &Range<usize>)| Chunk::new(plan, body).parse(wave, range.clone());
    let ends: Vec<Result<usize, Broken>> = bodies.par_iter_mut().zip(&chunks).map(parse).collect();
    let mut next = 0;
    for (i, (range, mut end)) in chunks.into_iter().zip(ends).enumerate() {
        if next != range.start {
            end = Chunk::new(plan, &mut bodies[i]).parse(wave, next..range.end.max(next));
        }
        match end {
            Ok(end) => next = end,
            Err(broken) => {
                bodies.truncate(i + 1);
                return Err(broken);
            }
        }
    }
    Ok(())
}

/// Cuts at line ends.
fn chunks(wave: &[u8], chunk: usize, line_end: u8) -> Vec<Range<usize>> {
    let mut chunks = Vec::new();
    let mut start = 0;
    while wave.len() - start > chunk {
        let Some(end) = memchr(line_end, &wave[start + chunk..]) else { break };
        let end = start + chunk + end + 1;
        chunks.push(start..end);
        start = end;
    }
    chunks.push(start..wave.len());
    chunks
}

/// [`parse`] of rows in memory.
#[cfg(test)]
pub(super) fn parse_bytes(rows: &[u8], first_line: u64, plan: &Plan<'_>) -> Result<Body, Failure> {
    parse(&mut Feed::of(rows, plan.layout.line_end), rows.len() as u64, first_line, plan)
}

#[cfg(test)]
mod tests {
    use super::super::number::Reading;
    use super::super::timing::Timing;
    use super::super::tokens::Layout;
    use super::super::{Delimiter, Encoding, Fault, TimeFormat};
    use super::*;
    use proptest::prelude::*;

    fn plan(reading: &Reading) -> Plan<'_> {
        Plan {
            layout: Layout { delimiter: Delimiter::Byte(b','), quote: Some(b'"'), line_end: b'\n', mark: None },
            encoding: Encoding::Utf8 { bom: false },
            reading,
            slots: vec![None, Some(0), None],
            counts: [3, 3],
            timing: Some(Timing::of(0, None, TimeFormat::Seconds)),
            record_bytes: 8,
            repeats: &[],
            oddities: &[],
            truths: Vec::new(),
            late: &[],
            footer: true,
        }
    }

    /// All that a body holds; values as their bits.
    type All = (usize, Option<Vec<i64>>, Vec<u64>, Vec<usize>, [Fault; 3], usize);

    fn all(body: Body) -> All {
        let [numbers] = body.numbers.try_into().unwrap();
        let bits = numbers.values.iter().map(|v| v.to_bits()).collect();
        let faults = [body.ragged, numbers.unreadable, numbers.infinite];
        (body.rows, body.moments, bits, body.missing, faults, numbers.present)
    }

    /// What the tokeniser gives in one pass over `text`.
    fn sequential(text: &str, plan: &Plan<'_>) -> Result<All, u64> {
        let mut body = Body::new(plan, 0);
        let done = Chunk::new(plan, &mut body).parse(text.as_bytes(), 0..text.len());
        done.map(|_| all(body)).map_err(|broken| broken.quote.line)
    }

    fn in_waves(text: &str, plan: &Plan<'_>, chunk: usize) -> Result<All, u64> {
        let mut feed = Feed::of(text.as_bytes(), b'\n');
        parse_by(&mut feed, Whole::new(plan, 0, 0), plan, chunk).map(all).map_err(|failure| match failure {
            Failure::Open(quote) => quote.line,
            Failure::Unfit(_) | Failure::Full(_) => u64::MAX,
        })
    }

    proptest! {
        /// Quotes hold delimiters, line ends and quotes; some do not close, some open nothing.
        #[test]
        fn chunks_of_any_length_give_what_one_pass_gives(
            cells in proptest::collection::vec(
                "[0-9]{1,3}|\"[0-9]{1,3}\"|\"\"|\"a,b\"|\"1\n\n2\"|\"\n# \"|\"a\"\"\n\"|5\"|\"|\"1\"x|#| |\n|,\n,,", 0..60),
            chunk in 1..40_usize,
        ) {
            let text: String = cells.chunks(3).map(|row| row.join(",") + "\n").collect();
            let reading = Reading::new(false, &[]);
            let plan = plan(&reading);
            prop_assert_eq!(in_waves(&text, &plan, chunk), sequential(&text, &plan));
            let bare = text.trim_end();
            prop_assert_eq!(in_waves(bare, &plan, chunk), sequential(bare, &plan));
        }
    }

    #[test]
    fn a_quote_over_many_waves_is_followed_to_its_end_or_named() {
        let reading = Reading::new(false, &[]);
        let plan = plan(&reading);
        let text = |end: &str| format!("0,1,\n1,2,\"{}{end}\n3,4,\n", "x,\n".repeat(500));
        let closed = in_waves(&text("\""), &plan, 8).unwrap();
        assert_eq!((closed.0, closed.1), (3, Some(vec![0, 1_000_000_000, 3_000_000_000])));
        assert_eq!(in_waves(&text(""), &plan, 8), Err(2));
    }

    #[test]
    fn waves_together_give_what_one_pass_gives() {
        let reading = Reading::new(false, &[]);
        let plan = plan(&reading);
        let mut text = String::new();
        for i in 0..500_000 {
            match i % 1000 {
                7 => text.push_str("# note\n"),
                8 => text.push_str(",,\n"),
                9 => text.push_str(&format!("{i},x,y\n")),
                10 => text.push_str(&format!("{i},\"1\",\"y\n\"\n")),
                _ => text.push_str(&format!("{i},{}.5,\n", i % 97)),
            }
        }
        let many = all(parse_bytes(text.as_bytes(), 1, &plan).unwrap());
        assert!(chunks(text.as_bytes(), CHUNK, b'\n').len() > 2 * WAVE);
        assert_eq!(many, sequential(&text, &plan).unwrap());
        assert_eq!(many.4[1].first[1].0, 1011);
    }

    #[test]
    fn a_chunk_border_inside_empty_rows_loses_none() {
        let reading = Reading::new(false, &[]);
        let plan = plan(&reading);
        let text = format!("0,1,\n{}5,2,\n{}", ",,\n".repeat(200_000), ",,\n".repeat(100_000));
        let body = parse_bytes(text.as_bytes(), 1, &plan).unwrap();
        assert_eq!(
            (body.rows, body.moments.map(|m| m.len()), body.numbers[0].values.len()),
            (200_002, Some(200_002), 200_002)
        );
        assert_eq!(body.missing, [200_000, 200_000, 200_002]);
    }
}
