//! The rows of a file to columns of numbers, in parallel over chunks of lines.

use memchr::memchr;
use rayon::prelude::*;

use super::number::{Cell, Reading};
use super::order::UNREADABLE;
use super::stamp::Count;
use super::text::decoded;
use super::timing::Timing;
use super::tokens::{Layout, OpenQuote, RecordKind, Records, Span, inner, is_empty, split};
use super::{Encoding, Fault};

/// Chunks are not smaller than this.
const CHUNK: usize = 256 << 10;

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
    /// Nanoseconds; [`UNREADABLE`] where there is no moment. Empty without a time column.
    pub(crate) moments: Vec<i64>,
    /// Rows whose moment has no exact nanoseconds and was rounded.
    pub(crate) rounded: usize,
    /// By slot.
    pub(crate) numbers: Vec<Numbers>,
    /// Cells without a value, by column.
    pub(crate) missing: Vec<usize>,
    pub(crate) ragged: Fault,
    /// Rows of nothing but empty cells at the end: data only if more follows.
    empty_tail: usize,
    /// Lines of the chunk.
    lines: u64,
}

/// Parses `rows`, the body of a file from its first data row on, which is on line `first_line`.
///
/// # Errors
/// [`OpenQuote`] where a quoted cell does not end.
pub(crate) fn parse(rows: &[u8], first_line: u64, plan: &Plan<'_>) -> Result<Body, OpenQuote> {
    let parts: Vec<Body> = chunks(rows, plan.layout)
        .into_par_iter()
        .map(|chunk| Chunk::new(plan, chunk.len()).parse(chunk))
        .collect::<Result<_, _>>()
        .map_err(|q| OpenQuote { line: q.line + first_line - 1 })?;
    Ok(joined(parts, first_line - 1, plan))
}

/// Cuts at line ends; a text with quotes stays whole, because a line end inside one is no end of a row.
fn chunks(rows: &[u8], layout: Layout) -> Vec<&[u8]> {
    let whole = layout.quote.is_some_and(|q| memchr(q, rows).is_some());
    let wanted = if whole { rows.len().max(1) } else { (rows.len() / (4 * rayon::current_num_threads())).max(CHUNK) };
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

struct Chunk<'a> {
    plan: &'a Plan<'a>,
    body: Body,
}

impl<'a> Chunk<'a> {
    fn new(plan: &'a Plan<'a>, bytes: usize) -> Self {
        let rows = bytes / plan.record_bytes + bytes / plan.record_bytes / 16 + 1;
        let slots = plan.slots.iter().flatten().max().map_or(0, |s| s + 1);
        let column = || Numbers { values: Vec::with_capacity(rows), ..Numbers::default() };
        let body = Body {
            moments: if plan.timing.is_some() { Vec::with_capacity(rows) } else { Vec::new() },
            numbers: (0..slots).map(|_| column()).collect(),
            missing: vec![0; plan.slots.len()],
            ..Body::default()
        };
        Self { plan, body }
    }

    fn parse(mut self, chunk: &[u8]) -> Result<Body, OpenQuote> {
        let mut spans = Vec::new();
        let mut records = Records::new(chunk, self.plan.layout);
        for record in &mut records {
            let record = record?;
            if record.kind != RecordKind::Data {
                continue;
            }
            split(record.bytes, self.plan.layout, &mut spans);
            if is_empty(record.bytes, &spans, self.plan.layout) {
                self.body.empty_tail += 1;
                continue;
            }
            self.body.fill_empty_tail();
            self.row(record.line, record.bytes, &spans);
        }
        self.body.lines = records.lines();
        Ok(self.body)
    }

    fn row(&mut self, line: u64, record: &[u8], spans: &[Span]) {
        self.body.rows += 1;
        if !self.plan.counts.contains(&spans.len()) {
            self.body.ragged.add(line, &format!("{} cells", spans.len()));
        }
        let quote = self.plan.layout.quote;
        let cell = |column: usize| {
            let raw = spans.get(column).map_or(&[][..], |s| s.of(record));
            // Most cells are bare: no padding, no quote.
            match raw {
                [first, .., last] | [first @ last] if first.is_ascii_digit() && last.is_ascii_digit() => raw,
                _ => &raw[inner(raw, quote)],
            }
        };
        if let Some(timing) = &self.plan.timing {
            let date = timing.date_column.map_or(&[][..], cell);
            let moment = timing.read(cell(timing.column), date, self.plan.reading.decimal_comma);
            self.body.moments.push(match moment {
                Some(Count::Exact(ns)) => ns,
                Some(Count::Inexact(seconds)) => {
                    self.body.rounded += 1;
                    match super::timing::nanoseconds(seconds * 1e9) {
                        Some(Count::Exact(ns)) => ns,
                        _ => UNREADABLE,
                    }
                }
                None => UNREADABLE,
            });
        }
        for (column, slot) in self.plan.slots.iter().enumerate() {
            let cell = cell(column);
            let Some(slot) = slot else {
                self.body.missing[column] += usize::from(self.plan.reading.is_marker(cell));
                continue;
            };
            let numbers = &mut self.body.numbers[*slot];
            let value = match self.plan.reading.cell(cell) {
                Cell::Number(value) => {
                    numbers.present += 1;
                    value
                }
                other => {
                    self.body.missing[column] += 1;
                    match other {
                        Cell::Infinite => numbers.infinite.add(line, &decoded(cell, self.plan.encoding)),
                        Cell::Text => numbers.unreadable.add(line, &decoded(cell, self.plan.encoding)),
                        Cell::Missing | Cell::Number(_) => {}
                    }
                    f64::NAN
                }
            };
            numbers.values.push(value);
        }
    }
}

impl Body {
    /// The empty rows met so far are rows after all, because another follows.
    fn fill_empty_tail(&mut self) {
        let count = std::mem::take(&mut self.empty_tail);
        if count == 0 {
            return;
        }
        self.rows += count;
        self.missing.iter_mut().for_each(|m| *m += count);
        for numbers in &mut self.numbers {
            numbers.values.resize(numbers.values.len() + count, f64::NAN);
        }
        if self.moments.capacity() > 0 {
            self.moments.resize(self.moments.len() + count, UNREADABLE);
        }
    }
}

/// Adds the faults of a later chunk, whose lines count from its own start.
fn add_fault(to: &mut Fault, from: Fault, lines_before: u64) {
    to.count += from.count;
    let room = Fault::KEPT.saturating_sub(to.first.len());
    to.first.extend(from.first.into_iter().take(room).map(|(line, what)| (line + lines_before, what)));
}

/// One body of the bodies of chunks; `line` lines lie before the first.
fn joined(parts: Vec<Body>, mut line: u64, plan: &Plan<'_>) -> Body {
    let mut whole = Chunk::new(plan, 0).body;
    // Rows that stand before the rows of each chunk: empty rows at the end of the chunks before it.
    let mut gaps = Vec::with_capacity(parts.len());
    let mut columns: Vec<Vec<Numbers>> = whole.numbers.iter().map(|_| Vec::with_capacity(parts.len())).collect();
    let mut moments = Vec::with_capacity(parts.len());
    let mut empty = 0;
    for part in parts {
        let gap = if part.rows > 0 { std::mem::take(&mut empty) } else { 0 };
        gaps.push(gap);
        empty += part.empty_tail;
        whole.rows += gap + part.rows;
        whole.rounded += part.rounded;
        whole.missing.iter_mut().zip(&part.missing).for_each(|(m, p)| *m += p + gap);
        add_fault(&mut whole.ragged, part.ragged, line);
        for (slot, numbers) in part.numbers.into_iter().enumerate() {
            add_fault(&mut whole.numbers[slot].unreadable, numbers.unreadable.clone(), line);
            add_fault(&mut whole.numbers[slot].infinite, numbers.infinite.clone(), line);
            whole.numbers[slot].present += numbers.present;
            columns[slot].push(numbers);
        }
        moments.push(part.moments);
        line += part.lines;
    }
    let rows = whole.rows;
    if plan.timing.is_some() {
        whole.moments = concatenated(moments, &gaps, rows, UNREADABLE);
    }
    whole.numbers.par_iter_mut().zip(columns).for_each(|(numbers, parts)| {
        numbers.values = concatenated(parts.into_iter().map(|p| p.values).collect(), &gaps, rows, f64::NAN);
    });
    whole
}

fn concatenated<T: Copy>(mut parts: Vec<Vec<T>>, gaps: &[usize], rows: usize, filler: T) -> Vec<T> {
    if let [one] = &mut parts[..] {
        return std::mem::take(one);
    }
    let mut all = Vec::with_capacity(rows);
    for (part, gap) in parts.into_iter().zip(gaps) {
        all.resize(all.len() + gap, filler);
        all.extend_from_slice(&part);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::{Delimiter, TimeFormat};
    use super::*;

    fn plan(reading: &Reading) -> Plan<'_> {
        Plan {
            layout: Layout { delimiter: Delimiter::Byte(b','), quote: Some(b'"'), line_end: b'\n' },
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
        assert_eq!(body.moments, [0, UNREADABLE, 2_000_000_000, 3_000_000_000, UNREADABLE]);
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
        let one = Chunk::new(&plan, text.len()).parse(text.as_bytes()).unwrap();
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
        assert_eq!((body.rows, body.moments.len(), body.numbers[0].values.len()), (200_002, 200_002, 200_002));
        assert_eq!(body.missing, [200_000, 200_000, 200_002]);
    }
}
