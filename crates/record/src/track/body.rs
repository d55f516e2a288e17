//! Columns of numbers, of a chunk of rows and of the whole.

use super::number::Reading;
use super::odd::Oddity;
use super::order::UNREADABLE;
use super::timing::Timing;
use super::tokens::Layout;
use super::{Encoding, Fault};
use crate::memory::{Full, Share};

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
    /// Lines that come again among the rows and are none.
    pub(crate) repeats: &'a [Vec<u8>],
    /// For each column, which oddities its cells may have.
    pub(crate) oddities: &'a [Vec<Oddity>],
    /// For each column, whether TRUE and FALSE are 1 and 0.
    pub(crate) truths: Vec<bool>,
    /// For each column, texts that stand where its numbers have not begun.
    pub(crate) late: &'a [Vec<String>],
    /// Whether texts below the last row are no rows.
    pub(crate) footer: bool,
}

/// The numbers of one column.
#[derive(Debug, Clone, Default)]
pub(crate) struct Numbers {
    pub(crate) values: Vec<f64>,
    /// How many of them are numbers.
    pub(crate) present: usize,
    pub(crate) unreadable: Fault,
    pub(crate) infinite: Fault,
    /// Cells with a text where the numbers have not begun.
    pub(crate) late: usize,
    /// Numbers in cells that hold more, by oddity.
    pub(crate) odd: [usize; Oddity::ALL.len()],
}

/// Rows at the end that are data only if more follows: of nothing but empty cells, or of text where others have numbers.
#[derive(Debug, Default)]
pub(crate) struct Tail {
    pub(crate) rows: usize,
    /// How many of them hold text.
    pub(crate) texts: usize,
    /// Cells without a value, by column.
    pub(crate) missing: Vec<usize>,
    /// By slot.
    pub(crate) unreadable: Vec<Fault>,
    pub(crate) ragged: Fault,
}

impl Tail {
    /// Adds what comes after it, whose lines count from its own start.
    fn add(&mut self, other: &Self, lines_before: u64) {
        self.rows += other.rows;
        self.texts += other.texts;
        add_counts(&mut self.missing, &other.missing);
        add_faults(&mut self.unreadable, &other.unreadable, lines_before);
        add_fault(&mut self.ragged, &other.ragged, lines_before);
    }
}

fn add_counts(to: &mut Vec<usize>, from: &[usize]) {
    to.resize(to.len().max(from.len()), 0);
    to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
}

fn add_faults(to: &mut Vec<Fault>, from: &[Fault], lines_before: u64) {
    to.resize_with(to.len().max(from.len()), Fault::default);
    to.iter_mut().zip(from).for_each(|(to, from)| add_fault(to, from, lines_before));
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
    /// Rows at the end that may be none.
    pub(crate) tail: Tail,
    /// Header and units that came again.
    pub(crate) repeats: usize,
    /// Lines of the chunk.
    pub(crate) lines: u64,
    /// The memory of the columns.
    pub(crate) share: Share,
}

/// Bytes of each row that are left free for whatever is done with the record next, for example looking at its noise.
const AFTERWARDS: u64 = 32;

impl Plan<'_> {
    /// The number in a cell of `column` that holds more than a bare one, with what it holds (nothing said of a truth).
    pub(crate) fn other_number(&self, column: usize, cell: &[u8]) -> Option<(f64, Option<Oddity>)> {
        if self.truths.get(column) == Some(&true) {
            return truth(cell).map(|t| (f64::from(u8::from(t)), None));
        }
        let allowed = self.oddities.get(column).filter(|o| !o.is_empty())?;
        let odd = super::odd::odd(cell, self.reading.decimal_comma).filter(|odd| allowed.contains(&odd.oddity))?;
        (!self.reading.is_missing(odd.value)).then_some((odd.value, Some(odd.oddity)))
    }
}

impl Plan<'_> {
    /// True for a text that stands where the numbers of the column have not begun.
    pub(crate) fn is_late(&self, column: usize, cell: &[u8]) -> bool {
        self.late.get(column).is_some_and(|texts| texts.iter().any(|t| t.as_bytes() == cell))
    }
}

/// What a word says: TRUE, yes and T, or their opposites.
pub(crate) fn truth(cell: &[u8]) -> Option<bool> {
    match cell.to_ascii_lowercase().as_slice() {
        b"true" | b"t" | b"yes" | b"y" | b"wahr" | b"vrai" => Some(true),
        b"false" | b"f" | b"no" | b"n" | b"falsch" | b"faux" => Some(false),
        _ => None,
    }
}

impl Body {
    /// Nothing yet, with room for this many rows.
    pub(crate) fn new(plan: &Plan<'_>, rows: usize) -> Self {
        let slots = plan.slots.iter().flatten().max().map_or(0, |s| s + 1);
        let column = || Numbers { values: Vec::with_capacity(rows), ..Numbers::default() };
        Self {
            moments: plan.timing.as_ref().map(|_| Vec::with_capacity(rows)),
            numbers: (0..slots).map(|_| column()).collect(),
            missing: vec![0; plan.slots.len()],
            ..Self::default()
        }
    }

    /// The memory that this many rows take, with the times that are made of their moments.
    fn bytes(&self, rows: usize) -> u64 {
        let times = if self.moments.is_some() { 2 } else { 1 };
        (rows as u64).saturating_mul(8 * (self.numbers.len() as u64 + times) + AFTERWARDS)
    }

    /// The memory of the record that it becomes: what was left free is free again.
    pub(crate) fn kept(&mut self) -> Share {
        let mut share = std::mem::take(&mut self.share);
        // Less than before is never refused.
        let _ = share.set(self.bytes(self.rows).saturating_sub(AFTERWARDS * self.rows as u64));
        share
    }

    /// Empty again, with its buffers.
    pub(crate) fn clear(&mut self) {
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

    /// An empty row, which is one if more follows.
    pub(crate) fn empty_row(&mut self) {
        self.tail.rows += 1;
        let columns = self.missing.len();
        self.tail.missing.resize(columns, 0);
        self.tail.missing.iter_mut().for_each(|m| *m += 1);
    }

    /// The doubtful rows met so far are rows after all, because another follows.
    #[inline]
    pub(crate) fn fill_tail(&mut self) {
        if self.tail.rows > 0 {
            self.take_tail();
        }
    }

    #[cold]
    fn take_tail(&mut self) {
        let tail = std::mem::take(&mut self.tail);
        let count = tail.rows;
        self.rows += count;
        add_counts(&mut self.missing, &tail.missing);
        add_fault(&mut self.ragged, &tail.ragged, 0);
        for (numbers, fault) in self.numbers.iter_mut().zip(&tail.unreadable) {
            add_fault(&mut numbers.unreadable, fault, 0);
        }
        self.numbers.iter_mut().for_each(|n| n.values.resize(n.values.len() + count, f64::NAN));
        self.moments.iter_mut().for_each(|m| m.resize(m.len() + count, UNREADABLE));
    }
}

/// The chunks that were parsed so far, as one.
pub(crate) struct Whole {
    body: Body,
    /// Lines before the next chunk.
    pub(crate) lines: u64,
}

impl Whole {
    /// Nothing yet, of a text of about this many bytes after this many lines.
    pub(crate) fn new(plan: &Plan<'_>, bytes: u64, lines: u64) -> Self {
        let rows = usize::try_from(bytes).unwrap_or(usize::MAX) / plan.record_bytes;
        Self { body: Body::new(plan, rows + rows / 16), lines }
    }

    /// Adds the next chunks, which are empty then.
    ///
    /// # Errors
    /// [`Full`] when there is no room for their rows.
    pub(crate) fn add(&mut self, parts: &mut [Body]) -> Result<(), Full> {
        let rows: usize = parts.iter().map(|p| p.rows + p.tail.rows).sum::<usize>() + self.body.tail.rows;
        self.body.share.set(self.body.bytes(self.body.rows + rows))?;
        for part in parts {
            self.add_one(part);
            part.clear();
        }
        Ok(())
    }

    fn add_one(&mut self, part: &mut Body) {
        let body = &mut self.body;
        if part.rows > 0 {
            body.fill_tail();
        }
        body.rows += part.rows;
        body.rounded += part.rounded;
        body.repeats += part.repeats;
        let tail = std::mem::take(&mut part.tail);
        let lines = self.lines;
        body.missing.iter_mut().zip(&part.missing).for_each(|(whole, part)| *whole += part);
        add_fault(&mut body.ragged, &part.ragged, self.lines);
        for (whole, part) in body.numbers.iter_mut().zip(&part.numbers) {
            whole.values.extend_from_slice(&part.values);
            whole.present += part.present;
            whole.late += part.late;
            add_fault(&mut whole.unreadable, &part.unreadable, self.lines);
            add_fault(&mut whole.infinite, &part.infinite, self.lines);
            whole.odd.iter_mut().zip(part.odd).for_each(|(whole, part)| *whole += part);
        }
        body.tail.add(&tail, lines);
        if let (Some(whole), Some(part)) = (&mut body.moments, &part.moments) {
            whole.extend_from_slice(part);
        }
        self.lines += part.lines;
    }

    /// The columns, in no more memory than they need.
    pub(crate) fn finished(mut self) -> Body {
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
    use super::super::parallel_parse::parse_bytes;
    use super::super::{Delimiter, TimeFormat};
    use super::*;

    fn plan(reading: &Reading) -> Plan<'_> {
        Plan {
            layout: Layout { delimiter: Delimiter::Byte(b','), quote: None, line_end: b'\n', mark: None },
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

    fn bits(values: &[f64]) -> Vec<u64> {
        values.iter().map(|v| v.to_bits()).collect()
    }

    #[test]
    fn cells_faults_and_empty_rows_are_told_apart() {
        let reading = Reading::new(false, &[]);
        let text = "0,1.5,a\n,,\n# no row\n2,x,\n3,1e400\nq,2,b,c\n,,\n,,\n";
        let body = parse_bytes(text.as_bytes(), 11, &plan(&reading)).unwrap();
        assert_eq!((body.rows, &body.missing[..]), (5, &[1, 3, 3][..]));
        assert_eq!(body.moments.as_deref(), Some(&[0, UNREADABLE, 2_000_000_000, 3_000_000_000, UNREADABLE][..]));
        let n = &body.numbers[0];
        assert_eq!(bits(&n.values), bits(&[1.5, f64::NAN, f64::NAN, f64::NAN, 2.0]));
        assert_eq!((n.present, &n.unreadable.first[..]), (2, &[(14, "x".to_owned())][..]));
        assert_eq!(n.infinite.first, [(15, "1e400".to_owned())]);
        assert_eq!(body.ragged.first, [(15, "2 cells".to_owned()), (16, "4 cells".to_owned())]);
    }
}
