//! The rows of a chunk of lines to numbers.

use std::ops::Range;

use super::Fault;
use super::body::{Body, Plan};
use super::number::Cell;
use super::order::UNREADABLE;
use super::quick::{Quick, QuickRow};
use super::text::decoded;
use super::timestamp::Count;
use super::timing::{Timing, nanoseconds};
use super::tokens::{Layout, OpenQuote, RecordKind, Records, Span, inner, is_empty, split};

/// A chunk of lines, and the buffers that its rows go to.
pub(crate) struct Chunk<'a> {
    plan: &'a Plan<'a>,
    /// That of the plan, but without a quote that does not occur.
    layout: Layout,
    body: &'a mut Body,
}

/// A record that does not end: where it starts, and the line of its open quote from the start of the chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Broken {
    /// Offset of its first byte in the text.
    pub(crate) start: usize,
    /// The quote.
    pub(crate) quote: OpenQuote,
}

impl<'a> Chunk<'a> {
    /// Into `body`, whatever it holds.
    pub(crate) fn new(plan: &'a Plan<'a>, body: &'a mut Body) -> Self {
        body.clear();
        Self { plan, layout: plan.layout, body }
    }

    /// Parses the records of `text` that begin in `range`; gives where the last of them ends.
    ///
    /// # Errors
    /// [`Broken`] where a quoted cell does not end.
    pub(crate) fn parse(mut self, text: &[u8], range: Range<usize>) -> Result<usize, Broken> {
        let plan = self.plan;
        self.layout = plan.layout.without_idle_quote(&text[range.clone()]);
        let quick = Quick::new(self.layout, plan.reading, plan.timing.as_ref(), &plan.slots, plan.counts);
        let mut quick_row = QuickRow { values: vec![f64::NAN; self.body.numbers.len()], ..QuickRow::default() };
        // A header of numbers that comes again is not a row, and is not seen by a quick look.
        let quick = quick.filter(|quick| {
            let mut lines = plan.repeats.iter().map(|line| [line.as_slice(), &[self.layout.line_end]].concat());
            !lines.any(|line| quick.read(&line, &mut quick_row).is_some())
        });
        let mut spans = Vec::new();
        let mut at = range.start;
        while at < range.end {
            let rest = &text[at..];
            if let Some(quick) = &quick
                && let Some(length) = quick.read(rest, &mut quick_row)
            {
                self.quick_row(&quick_row);
                at += length;
                continue;
            }
            at += self.record(rest, &mut spans).map_err(|quote| Broken { start: at, quote })?;
        }
        Ok(at)
    }

    fn quick_row(&mut self, row: &QuickRow) {
        self.body.fill_tail();
        self.body.lines += 1;
        self.body.rows += 1;
        if let Some(moments) = &mut self.body.moments {
            moments.push(row.moment);
        }
        for (numbers, value) in self.body.numbers.iter_mut().zip(&row.values) {
            numbers.present += usize::from(!value.is_nan());
            numbers.values.push(*value);
        }
        row.missing.iter().for_each(|column| self.body.missing[*column] += 1);
    }

    /// Takes the record at the start of `rest`; gives its length.
    fn record(&mut self, rest: &[u8], spans: &mut Vec<Span>) -> Result<usize, OpenQuote> {
        let mut records = Records::new(rest, self.layout);
        let line = self.body.lines + 1;
        let Some(record) = records.next() else { return Ok(rest.len()) };
        let record = record.map_err(|q| OpenQuote { line: q.line + self.body.lines })?;
        self.body.lines += records.lines();
        if record.kind == RecordKind::Data {
            split(record.bytes, self.layout, spans);
            if is_empty(record.bytes, spans, self.layout) {
                self.body.empty_row();
            } else if !self.plan.repeats.is_empty() && self.plan.repeats.iter().any(|r| r == record.bytes.trim_ascii())
            {
                self.body.repeats += 1;
            } else if self.plan.footer && self.is_text(record.bytes, spans) {
                self.text_row(line, record.bytes, spans);
            } else {
                self.body.fill_tail();
                self.row(line, record.bytes, spans);
            }
        }
        Ok(record.bytes.len() + record.end.len())
    }

    /// True for a line of text where other rows have a time and numbers.
    fn is_text(&self, record: &[u8], spans: &[Span]) -> bool {
        let cell = |column: usize| {
            spans.get(column).map_or(&[][..], |s| &s.of(record)[inner(s.of(record), self.layout.quote)])
        };
        if let Some(timing) = &self.plan.timing
            && timing.read(cell, self.plan.reading.decimal_comma).is_some()
        {
            return false;
        }
        let mut times = self.plan.timing.iter().flat_map(Timing::all_columns);
        let mut text = times.any(|column| !self.plan.reading.is_marker(cell(column)));
        for (column, _) in self.plan.slots.iter().enumerate().filter(|(_, slot)| slot.is_some()) {
            match self.plan.reading.cell(cell(column)) {
                Cell::Number(_) | Cell::Infinite => return false,
                Cell::Text if self.plan.is_late(column, cell(column)) => {}
                Cell::Text if self.plan.other_number(column, cell(column)).is_some() => return false,
                Cell::Text => text = true,
                Cell::Missing => {}
            }
        }
        text
    }

    /// Keeps such a line in mind: it is a row if another follows.
    fn text_row(&mut self, line: u64, record: &[u8], spans: &[Span]) {
        let (plan, quote) = (self.plan, self.layout.quote);
        let tail = &mut self.body.tail;
        tail.rows += 1;
        tail.texts += 1;
        if !plan.counts.contains(&spans.len()) {
            tail.ragged.add(line, &format!("{} cells", spans.len()));
        }
        tail.missing.resize(plan.slots.len(), 0);
        tail.unreadable.resize_with(self.body.numbers.len(), Fault::default);
        for (column, slot) in plan.slots.iter().enumerate() {
            let cell = spans.get(column).map_or(&[][..], |s| &s.of(record)[inner(s.of(record), quote)]);
            let marker = plan.reading.is_marker(cell);
            tail.missing[column] += usize::from(slot.is_some() || marker);
            if let (Some(slot), Cell::Text, false) = (slot, plan.reading.cell(cell), plan.is_late(column, cell)) {
                tail.unreadable[*slot].add(line, &decoded(cell, plan.encoding));
            }
        }
    }

    fn row(&mut self, line: u64, record: &[u8], spans: &[Span]) {
        self.body.rows += 1;
        if !self.plan.counts.contains(&spans.len()) {
            self.body.ragged.add(line, &format!("{} cells", spans.len()));
        }
        let quote = self.layout.quote;
        let cell = |column: usize| {
            let raw = spans.get(column).map_or(&[][..], |s| s.of(record));
            // Most cells are bare: no padding, no quote.
            match raw {
                [first, .., last] | [first @ last] if first.is_ascii_digit() && last.is_ascii_digit() => raw,
                _ => &raw[inner(raw, quote)],
            }
        };
        if let Some(timing) = &self.plan.timing {
            let moment = timing.read(cell, self.plan.reading.decimal_comma);
            let ns = match moment {
                Some(Count::Exact(ns)) => ns,
                Some(Count::Inexact(seconds)) => {
                    self.body.rounded += 1;
                    match nanoseconds(seconds * 1e9) {
                        Some(Count::Exact(ns)) => ns,
                        _ => UNREADABLE,
                    }
                }
                None => UNREADABLE,
            };
            self.body.moments.iter_mut().for_each(|m| m.push(ns));
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
                        Cell::Text if self.plan.is_late(column, cell) => numbers.late += 1,
                        Cell::Text => match self.plan.other_number(column, cell) {
                            Some((value, oddity)) => {
                                self.body.missing[column] -= 1;
                                numbers.present += 1;
                                if let Some(oddity) = oddity {
                                    numbers.odd[oddity as usize] += 1;
                                }
                                numbers.values.push(value);
                                continue;
                            }
                            None => numbers.unreadable.add(line, &decoded(cell, self.plan.encoding)),
                        },
                        Cell::Missing | Cell::Number(_) => {}
                    }
                    f64::NAN
                }
            };
            numbers.values.push(value);
        }
    }
}
