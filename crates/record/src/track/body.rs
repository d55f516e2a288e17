//! Columns of numbers, of a chunk of rows and of the whole.

use super::number::Reading;
use super::order::UNREADABLE;
use super::timing::Timing;
use super::tokens::Layout;
use super::{Encoding, Fault};

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

impl Body {
    /// Nothing yet, with room for so many rows.
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
pub(crate) struct Whole {
    body: Body,
    /// Lines before the next chunk.
    pub(crate) lines: u64,
}

impl Whole {
    /// Nothing yet, of a text of about so many bytes after so many lines.
    pub(crate) fn new(plan: &Plan<'_>, bytes: u64, lines: u64) -> Self {
        let rows = usize::try_from(bytes).unwrap_or(usize::MAX) / plan.record_bytes;
        Self { body: Body::new(plan, rows + rows / 16), lines }
    }

    /// Adds the next chunks, which are empty then.
    pub(crate) fn add(&mut self, parts: &mut [Body]) {
        for part in parts {
            self.add_one(part);
            part.clear();
        }
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
    use super::super::waves::parse_bytes;
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
