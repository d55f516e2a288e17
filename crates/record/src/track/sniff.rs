//! Recognising delimiter, quote and decimal comma from the first records.

use memchr::memchr;

use super::number::{Cell, Reading};
use super::odd::{Oddity, odd};
use super::time::{DateOrder, fields};
use super::tokens::Mark;
use super::tokens::{Layout, RecordKind, Records, inner, kind_of, line_end_of, split};
use super::{Delimiter, LoadOptions, Rules, timestamp};

mod earlier;

/// How much of a file is looked at.
pub(crate) const SAMPLE_BYTES: usize = 64 << 10;
const SAMPLE_RECORDS: usize = 100;
/// Blanks stand inside cells too (dates with times, padding): they must fit clearly better than any other delimiter.
const BLANKS_HANDICAP: f64 = 0.1;

/// What a cell looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Look {
    /// No value.
    Empty,
    /// A number.
    Number,
    /// A date, a time of day, or both.
    Time,
    /// Anything else.
    Text,
}

/// What `cell`, trimmed and unquoted, looks like.
pub(crate) fn look(cell: &[u8], reading: &Reading) -> Look {
    match reading.cell(cell) {
        Cell::Number(_) | Cell::Infinite => Look::Number,
        Cell::Missing => Look::Empty,
        Cell::Text if reading.rules == Rules::First => earlier::look_of_text(cell),
        Cell::Text if timestamp::iso(cell).is_some() || timestamp::clock(cell).is_some() => Look::Time,
        Cell::Text if [true, false].iter().any(|first| timestamp::year_last(cell, *first).is_some()) => Look::Time,
        Cell::Text if is_stamp(cell) => Look::Time,
        Cell::Text if odd(cell, reading.decimal_comma).is_some() => Look::Number,
        Cell::Text => Look::Text,
    }
}

/// True for a time in any spelling.
fn is_stamp(cell: &[u8]) -> bool {
    let digits = cell.iter().any(u8::is_ascii_digit);
    let told = |o| fields(cell, o).and_then(|p| p.told(cell));
    digits && cell.len() > 4 && DateOrder::ALL.into_iter().any(|o| told(o).is_some())
}

/// How the cells of `body` are laid out, and whether they use a decimal comma. What the options tell is taken.
pub(crate) fn sniff(body: &[u8], options: &LoadOptions) -> (Layout, bool) {
    let line_end = line_end_of(body);
    let mark = options.comment.as_ref().and_then(|text| Mark::new(text.as_bytes()));
    let rules = options.rules;
    let sample = sample_of(body, line_end, mark, rules);
    let quote = options.quotes.unwrap_or(true).then_some(b'"');
    let mut layout = Layout { delimiter: Delimiter::Byte(b','), quote, line_end, mark };
    layout.delimiter = options.delimiter.unwrap_or_else(|| best_delimiter(sample, layout, rules));
    if quote.is_some() && single_quoted(sample, layout) {
        layout.quote = Some(b'\'');
        layout.delimiter = options.delimiter.unwrap_or_else(|| best_delimiter(sample, layout, rules));
    }
    let comma_is_free = layout.delimiter != Delimiter::Byte(b',');
    let decimal_comma = options.decimal_comma.unwrap_or_else(|| {
        comma_is_free
            && match rules {
                Rules::First => earlier::has_decimal_commas(sample, layout),
                Rules::Second => has_decimal_commas(sample, layout),
            }
    });
    (layout, decimal_comma)
}

/// The head of `body` after its comments, cut at a line end; the lines with the most digits, where text of any length
/// stands before them.
fn sample_of(body: &[u8], line_end: u8, mark: Option<Mark>, rules: Rules) -> &[u8] {
    let mut body = body;
    // Some instruments write their whole configuration as comments before the first row.
    while let Some(at) = memchr(line_end, body)
        && kind_of(&body[..at], mark) != RecordKind::Data
    {
        body = &body[at + 1..];
    }
    let start = if rules == Rules::First { 0 } else { digits_start(body, line_end) };
    let body = &body[start..];
    if body.len() <= SAMPLE_BYTES {
        return body;
    }
    let head = &body[..SAMPLE_BYTES];
    head.iter().rposition(|b| *b == line_end).map_or(head, |at| &head[..=at])
}

/// Where the longest run of lines that hold many digits begins, if much text stands before it; else 0.
fn digits_start(body: &[u8], line_end: u8) -> usize {
    const LOOKED_AT: usize = 1 << 20;
    /// Fewer lines are a header, and are looked at with the rows.
    const FEW: usize = 8;
    let (mut best, mut run): ((usize, usize, usize), (usize, usize, usize)) = ((0, 0, 0), (0, 0, 0));
    let mut at = 0;
    for (number, line) in body[..body.len().min(LOOKED_AT)].split(|b| *b == line_end).enumerate() {
        let digits = line.iter().filter(|b| b.is_ascii_digit()).count();
        let filled = line.iter().filter(|b| !b.is_ascii_whitespace()).count();
        if digits * 4 >= filled && digits > 0 {
            run = if run.2 == 0 { (at, number, 1) } else { (run.0, run.1, run.2 + 1) };
            best = if run.2 > best.2 { run } else { best };
        } else if filled > 0 {
            run = (0, 0, 0);
        }
        at += line.len() + 1;
        // A run that began early and goes on is that of the table.
        if best.1 <= FEW && best.2 >= 100 {
            return 0;
        }
    }
    let late = best.1 > FEW || best.1 >= best.2;
    if late && best.2 > 2 { best.0 } else { 0 }
}

/// Calls `f` with the cells of each data record of the sample.
fn for_records(sample: &[u8], layout: Layout, mut f: impl FnMut(&[&[u8]])) {
    let mut spans = Vec::new();
    let records = Records::new(sample, layout).map_while(Result::ok).filter(|r| r.kind == RecordKind::Data);
    for record in records.take(SAMPLE_RECORDS) {
        split(record.bytes, layout, &mut spans);
        let cells: Vec<&[u8]> = spans.iter().map(|s| s.of(record.bytes)).collect();
        f(&cells);
    }
}

fn best_delimiter(sample: &[u8], layout: Layout, rules: Rules) -> Delimiter {
    let mut best = (Delimiter::Byte(b','), 0.0);
    for byte in *b",;\t|" {
        let delimiter = Delimiter::Byte(byte);
        let score = fitness(sample, Layout { delimiter, ..layout }, rules);
        if score > best.1 {
            best = (delimiter, score);
        }
    }
    let blanks = fitness(sample, Layout { delimiter: Delimiter::Blanks, ..layout }, rules);
    if blanks > best.1 + BLANKS_HANDICAP || (best.1 == 0.0 && blanks > 0.0) { Delimiter::Blanks } else { best.0 }
}

/// How well a delimiter fits: the share of records with the usual number of cells, times the share of cells that
/// read as numbers or times; 0 where the usual record has one cell.
fn fitness(sample: &[u8], layout: Layout, rules: Rules) -> f64 {
    let point = Reading::new(false, &[]).by(rules);
    let comma = Reading::new(true, &[]).by(rules);
    let mut counts: Vec<usize> = Vec::new();
    let (mut cells_seen, mut cells_read) = (0.0, 0.0);
    for_records(sample, layout, |cells| {
        counts.push(cells.len());
        for raw in cells {
            let cell = &raw[inner(raw, layout.quote)];
            let comma_fits = layout.delimiter != Delimiter::Byte(b',') && look(cell, &comma) != Look::Text;
            cells_seen += 1.0;
            let unparted = rules == Rules::Second && glued(cell, layout.delimiter);
            cells_read += match look(cell, &point) {
                _ if unparted => 0.0,
                Look::Text if !comma_fits => 0.0,
                // Many empty cells speak for a delimiter less than many numbers do.
                Look::Empty => 0.5,
                _ => 1.0,
            };
        }
    });
    let Some((usual, times)) = most_frequent(&counts) else { return 0.0 };
    if usual < 2 {
        return 0.0;
    }
    #[expect(clippy::cast_precision_loss, reason = "at most 100 records")]
    let consistency = times as f64 / counts.len() as f64;
    // Text columns alone must not make a fit look like none.
    consistency * (0.05 + cells_read / cells_seen)
}

/// A cell that would be parted better: a number of several that commas and blanks part.
fn glued(cell: &[u8], delimiter: Delimiter) -> bool {
    delimiter == Delimiter::Blanks && cell.iter().filter(|b| **b == b',').count() > 1
}

/// The most frequent of `counts`, the larger of two equally frequent ones, and how often it comes.
pub(crate) fn most_frequent(counts: &[usize]) -> Option<(usize, usize)> {
    let mut sorted = counts.to_vec();
    sorted.sort_unstable();
    sorted.chunk_by(|a, b| a == b).map(|same| (same[0], same.len())).max_by_key(|(count, times)| (*times, *count))
}

fn single_quoted(sample: &[u8], layout: Layout) -> bool {
    let (mut single, mut double) = (0, 0);
    for_records(sample, layout, |cells| {
        for cell in cells.iter().map(|c| c.trim_ascii()) {
            match cell {
                [b'\'', .., b'\''] => single += 1,
                [b'"', ..] => double += 1,
                _ => {}
            }
        }
    });
    single >= 2 && double == 0
}

fn has_decimal_commas(sample: &[u8], layout: Layout) -> bool {
    let comma = Reading::new(true, &[]);
    let point = Reading::new(false, &[]);
    let (mut commas, mut points) = (0, 0);
    for_records(sample, layout, |cells| {
        for raw in cells {
            let cell = &raw[inner(raw, layout.quote)];
            if !cell.contains(&b',') && !cell.contains(&b'.') {
                continue;
            }
            let reads = |reading: &Reading, decimal_comma| {
                reading.number(cell).is_some()
                    || odd(cell, decimal_comma).is_some_and(|o| o.oddity != Oddity::Hexadecimal)
            };
            let (comma_fits, point_fits) = (reads(&comma, true), reads(&point, false));
            if comma_fits && (!point_fits || !cell.contains(&b'.')) && cell.contains(&b',') {
                // `1,234` says nothing where points are decimal ones as well.
                commas += 1;
            } else if point_fits && cell.contains(&b'.') {
                points += 1;
            }
        }
    });
    commas > points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sniffed(text: &str) -> (Delimiter, Option<u8>, bool) {
        let (layout, comma) = sniff(text.as_bytes(), &LoadOptions::default());
        (layout.delimiter, layout.quote, comma)
    }

    #[test]
    fn delimiters_are_recognised() {
        let double = Some(b'"');
        for (text, delimiter, comma) in [
            ("t,x\n0,1.5\n1,2.5\n", Delimiter::Byte(b','), false),
            ("t;x;y\n0;1,5;2\n1;2,5;3\n", Delimiter::Byte(b';'), true),
            ("1,5;2,5;3,5\n2,5;3,5;4,5\n", Delimiter::Byte(b';'), true),
            ("t\tx\n0\t1.5\n1\t\n", Delimiter::Byte(b'\t'), false),
            ("a|b\n1|2\n", Delimiter::Byte(b'|'), false),
            ("  0.0   1.5\n  1.0  12.5\n", Delimiter::Blanks, false),
            ("1,5 2,5\n2,5 3,5\n", Delimiter::Blanks, true),
            ("time,x\n2019-01-01 00:00,1\n2019-01-01 00:15,2\n", Delimiter::Byte(b','), false),
            ("6, 6583, 3,VE, -0.30, 3\n6, 6583, 3,VE, -0.29, 3\n", Delimiter::Byte(b','), false),
            (
                "2010-11-02T03:00:13 RANGE Uralla 38014.9\n2010-11-02T03:00:50 AZ Kumsan 211.1 43.4\n",
                Delimiter::Blanks,
                false,
            ),
            ("x\n1.5\n2.5\n", Delimiter::Byte(b','), false),
        ] {
            assert_eq!(sniffed(text), (delimiter, double, comma), "{text}");
        }
    }

    #[test]
    fn long_comments_before_the_rows_hide_nothing() {
        let text = format!("{}t;x\n0;1,5\n1;2,5\n", "# a, b, c\n".repeat(10_000));
        assert_eq!(sniffed(&text), (Delimiter::Byte(b';'), Some(b'"'), true));
    }

    #[test]
    fn single_quotes_are_quotes_where_cells_stand_in_them() {
        let text = "'time PST', salt [psu]\n'2001-08-15 19:06:55', 27.37\n'2001-08-15 19:07:55', 27.03\n";
        assert_eq!(sniffed(text), (Delimiter::Byte(b','), Some(b'\''), false));
        assert_eq!(sniffed("t,note\n1,it's\n2,\n").1, Some(b'"'));
    }
}
