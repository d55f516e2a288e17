//! The rows of a file to columns of numbers, in parallel over chunks of lines.

use memchr::memchr;
use rayon::prelude::*;

use super::chunk::Chunk;
use super::number::Reading;
use super::order::UNREADABLE;
use super::timing::Timing;
use super::tokens::{Layout, OpenQuote};
use super::{Encoding, Fault};

/// Bytes of a chunk: its text and its numbers fit into the cache of a core.
const CHUNK: usize = 256 << 10;
/// Chunks of a wave for each thread.
const WAVE: usize = 4;

/// What is wanted of each row.
#[derive(Debug)]
pub(crate) struct Plan<'a> {
    pub(crate) layout: Layout,
    pub(crate) encoding: Encoding,
    pub(crate) reading: &'a Reading,
    /// For each column, where its numbers go; none for a column that is only looked at for missing cells.
    pub(crate) slots: Vec<Option<usize>>,
    /// Numbers of cells that a row may have without being ragged.
    pub(crate) counts: [usize; 2],
    pub(crate) timing: Option<Timing>,
    /// Mean length of a record in bytes, for the size of buffers.
    pub(crate) record_bytes: usize,
}

/// The numbers of one column.
#[derive(Debug, Clone, Default)]
pub(crate) struct Numbers {
    pub(crate) values: Vec<f64>,
    /// How many of them are numbers.
    pub(crate) present: usize,
    pub(crate) unreadable: Fault,
    pub(crate) infinite: Fault,
}

/// Rows of a file, or of a chunk of it.
#[derive(Debug, Default)]
pub(crate) struct Body {
    pub(crate) rows: usize,
    /// Nanoseconds; [`UNREADABLE`] where there is no moment. None without a time column.
    pub(crate) moments: Option<Vec<i64>>,
    /// Rows whose moment has no exact nanoseconds and was rounded.
    pub(crate) rounded: usize,
    /// By slot.
    pub(crate) numbers: Vec<Numbers>,
    /// Cells without a value, by column.
    pub(crate) missing: Vec<usize>,
    pub(crate) ragged: Fault,
    /// Rows of nothing but empty cells at the end: data only if more follows.
    pub(crate) empty_tail: usize,
    /// Lines of the chunk.
    pub(crate) lines: u64,
}

/// Parses `rows`, the body of a file from its first data row on, which is on line `first_line`.
///
/// Chunks are parsed in waves into buffers that are used again; while a wave is parsed, the one before it is added to
/// the columns of the whole. Memory holds every number once.
///
/// # Errors
/// [`OpenQuote`] where a quoted cell does not end.
pub(crate) fn parse(rows: &[u8], first_line: u64, plan: &Plan<'_>) -> Result<Body, OpenQuote> {
    let chunks = chunks(rows, plan.layout);
    let mut whole = Whole::new(plan, rows.len() / plan.record_bytes, first_line - 1);
    let (mut parsed, mut buffers): (Vec<Body>, Vec<Body>) = (Vec::new(), Vec::new());
    for wave in chunks.chunks(WAVE * rayon::current_num_threads()) {
        buffers.resize_with(wave.len(), || Body::new(plan, 0));
        let parse = |(body, chunk): (&mut Body, &&[u8])| {
            body.clear();
            Chunk::new(plan, body).parse(chunk)
        };
        let ((), done) = rayon::join(
            || whole.add(&mut parsed),
            || buffers.par_iter_mut().zip(wave).map(parse).collect::<Result<(), OpenQuote>>(),
        );
        // Quotes make one chunk, so its lines count from the first.
        done.map_err(|q| OpenQuote { line: q.line + first_line - 1 })?;
        std::mem::swap(&mut parsed, &mut buffers);
    }
    whole.add(&mut parsed);
    Ok(whole.finished())
}

/// Cuts at line ends; a text with quotes stays whole, because a line end inside one is no end of a row.
fn chunks(rows: &[u8], layout: Layout) -> Vec<&[u8]> {
    let whole = layout.quote.is_some();
    let wanted = if whole { rows.len().max(1) } else { CHUNK };
    let mut chunks = Vec::new();
    let mut rest = rows;
    while rest.len() > wanted {
        let Some(end) = memchr(layout.line_end, &rest[wanted..]) else { break };
        let (chunk, after) = rest.split_at(wanted + end + 1);
        chunks.push(chunk);
        rest = after;
    }
    chunks.push(rest);
    chunks
}

impl Body {
    fn new(plan: &Plan<'_>, rows: usize) -> Self {
        let slots = plan.slots.iter().flatten().max().map_or(0, |s| s + 1);
        let column = || Numbers { values: Vec::with_capacity(rows), ..Numbers::default() };
        Self {
            moments: plan.timing.as_ref().map(|_| Vec::with_capacity(rows)),
            numbers: (0..slots).map(|_| column()).collect(),
            missing: vec![0; plan.slots.len()],
            ..Self::default()
        }
    }

    /// Empty again, with its buffers.
    fn clear(&mut self) {
        let clear = |numbers: &mut Numbers| {
            numbers.values.clear();
            *numbers = Numbers { values: std::mem::take(&mut numbers.values), ..Numbers::default() };
        };
        self.numbers.iter_mut().for_each(clear);
        self.moments.iter_mut().for_each(Vec::clear);
        self.missing.fill(0);
        *self = Self {
            moments: self.moments.take(),
            numbers: std::mem::take(&mut self.numbers),
            missing: std::mem::take(&mut self.missing),
            ..Self::default()
        };
    }

    /// The empty rows met so far are rows after all, because another follows.
    pub(crate) fn fill_empty_tail(&mut self) {
        let count = std::mem::take(&mut self.empty_tail);
        if count > 0 {
            self.rows += count;
            self.missing.iter_mut().for_each(|m| *m += count);
            self.numbers.iter_mut().for_each(|n| n.values.resize(n.values.len() + count, f64::NAN));
            self.moments.iter_mut().for_each(|m| m.resize(m.len() + count, UNREADABLE));
        }
    }
}

/// The chunks that were parsed so far, as one.
struct Whole {
    body: Body,
    /// Lines before the next chunk.
    lines: u64,
}

impl Whole {
    fn new(plan: &Plan<'_>, rows: usize, lines: u64) -> Self {
        Self { body: Body::new(plan, rows + rows / 16), lines }
    }

    fn add(&mut self, parts: &mut [Body]) {
        parts.iter_mut().for_each(|part| self.add_one(part));
    }

    fn add_one(&mut self, part: &mut Body) {
        let body = &mut self.body;
        if part.rows > 0 {
            body.fill_empty_tail();
        }
        body.rows += part.rows;
        body.rounded += part.rounded;
        body.empty_tail += part.empty_tail;
        body.missing.iter_mut().zip(&part.missing).for_each(|(whole, part)| *whole += part);
        add_fault(&mut body.ragged, &part.ragged, self.lines);
        for (whole, part) in body.numbers.iter_mut().zip(&part.numbers) {
            whole.values.extend_from_slice(&part.values);
            whole.present += part.present;
            add_fault(&mut whole.unreadable, &part.unreadable, self.lines);
            add_fault(&mut whole.infinite, &part.infinite, self.lines);
        }
        if let (Some(whole), Some(part)) = (&mut body.moments, &part.moments) {
            whole.extend_from_slice(part);
        }
        self.lines += part.lines;
    }

    fn finished(mut self) -> Body {
        self.body.numbers.iter_mut().for_each(|n| n.values.shrink_to_fit());
        self.body.moments.iter_mut().for_each(Vec::shrink_to_fit);
        self.body
    }
}

/// Adds the faults of a later chunk, whose lines count from its own start.
fn add_fault(to: &mut Fault, from: &Fault, lines_before: u64) {
    to.count += from.count;
    let room = Fault::KEPT.saturating_sub(to.first.len());
    to.first.extend(from.first.iter().take(room).map(|(line, what)| (line + lines_before, what.clone())));
}

#[cfg(test)]
mod tests {
    use super::super::{Delimiter, TimeFormat};
    use super::*;

    fn plan(reading: &Reading) -> Plan<'_> {
        Plan {
            layout: Layout { delimiter: Delimiter::Byte(b','), quote: None, line_end: b'\n' },
            encoding: Encoding::Utf8 { bom: false },
            reading,
            slots: vec![None, Some(0), None],
            counts: [3, 3],
            timing: Some(Timing { column: 0, date_column: None, format: TimeFormat::Seconds }),
            record_bytes: 8,
        }
    }

    fn bits(values: &[f64]) -> Vec<u64> {
        values.iter().map(|v| v.to_bits()).collect()
    }

    #[test]
    fn cells_faults_and_empty_rows_are_told_apart() {
        let reading = Reading::new(false, &[]);
        let text = "0,1.5,a\n,,\n# no row\n2,x,\n3,1e400\nq,2,b,c\n,,\n,,\n";
        let body = parse(text.as_bytes(), 11, &plan(&reading)).unwrap();
        assert_eq!((body.rows, &body.missing[..]), (5, &[1, 3, 3][..]));
        assert_eq!(body.moments.as_deref(), Some(&[0, UNREADABLE, 2_000_000_000, 3_000_000_000, UNREADABLE][..]));
        let n = &body.numbers[0];
        assert_eq!(bits(&n.values), bits(&[1.5, f64::NAN, f64::NAN, f64::NAN, 2.0]));
        assert_eq!((n.present, &n.unreadable.first[..]), (2, &[(14, "x".to_owned())][..]));
        assert_eq!(n.infinite.first, [(15, "1e400".to_owned())]);
        assert_eq!(body.ragged.first, [(15, "2 cells".to_owned()), (16, "4 cells".to_owned())]);
    }

    #[test]
    fn chunks_together_give_what_one_pass_gives() {
        let reading = Reading::new(false, &[]);
        let plan = plan(&reading);
        let mut text = String::new();
        for i in 0..200_000 {
            match i % 1000 {
                7 => text.push_str("# note\n"),
                8 => text.push_str(",,\n"),
                9 => text.push_str(&format!("{i},x,y\n")),
                _ => text.push_str(&format!("{i},{}.5,\n", i % 97)),
            }
        }
        let many = parse(text.as_bytes(), 1, &plan).unwrap();
        let mut one = Body::new(&plan, 0);
        Chunk::new(&plan, &mut one).parse(text.as_bytes()).unwrap();
        assert!(chunks(text.as_bytes(), plan.layout).len() > 1);
        assert_eq!((many.rows, &many.moments, &many.missing), (one.rows, &one.moments, &one.missing));
        assert_eq!(bits(&many.numbers[0].values), bits(&one.numbers[0].values));
        assert_eq!(many.numbers[0].unreadable, one.numbers[0].unreadable);
        assert_eq!(many.numbers[0].unreadable.first[1].0, 1010);
    }

    #[test]
    fn a_chunk_border_inside_empty_rows_loses_none() {
        let reading = Reading::new(false, &[]);
        let plan = plan(&reading);
        let text = format!("0,1,\n{}5,2,\n{}", ",,\n".repeat(200_000), ",,\n".repeat(100_000));
        assert!(chunks(text.as_bytes(), plan.layout).len() > 2);
        let body = parse(text.as_bytes(), 1, &plan).unwrap();
        assert_eq!(
            (body.rows, body.moments.map(|m| m.len()), body.numbers[0].values.len()),
            (200_002, Some(200_002), 200_002)
        );
        assert_eq!(body.missing, [200_000, 200_000, 200_002]);
    }
}
