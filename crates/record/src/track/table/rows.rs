//! The runs of lines of one shape: each is the rows of a table.

use super::{Line, Reading, cast, typed_columns, usual_width};

/// The rows of a table among the lines: indices of the first of them and of the line after the last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Table {
    pub(crate) first: usize,
    pub(crate) after: usize,
    /// How many lines of it can be rows.
    pub(crate) rows: usize,
}

/// Fewer rows of another shape are odd rows of the table around them.
const LEAST: usize = 3;

/// The tables among `lines`, in their order.
pub(crate) fn tables(lines: &[Line], reading: &Reading) -> Vec<Table> {
    let mut tables = Vec::new();
    for run in runs(lines, reading) {
        let part = &lines[run.clone()];
        let data: Vec<&Line> = part.iter().filter(|l| l.is_data()).collect();
        let typed = typed_columns(&data, reading);
        if let Some(first) = first_row(part, &typed, reading) {
            let rows = part[first..].iter().filter(|l| l.is_data()).count();
            tables.push(Table { first: run.start + first, after: run.end, rows });
        }
    }
    // Keys with their values, above the rows of a table, are none.
    let keys = |t: &Table| {
        let rows = lines[t.first..t.after].iter().filter(|l| l.is_data());
        let text = |l: &Line| l.cells.first().is_some_and(|c| super::look(c.as_bytes(), reading) == super::Look::Text);
        rows.clone().all(|l| l.cells.len() <= 3 && text(l)) && t.rows < 200
    };
    if tables.iter().any(|t| !keys(t)) {
        tables.retain(|t| !keys(t));
    }
    tables
}

/// Stretches of lines that are cut where a line that is not a row separates rows of two shapes.
fn runs(lines: &[Line], reading: &Reading) -> Vec<std::ops::Range<usize>> {
    let shape = |line: &Line| {
        let all = vec![true; line.cells.len()];
        let cast = cast(line, &all, reading);
        (line.is_data() && cast.read > 0 && !cast.names_time).then_some((line.cells.len(), cast.read))
    };
    let shapes: Vec<Option<(usize, usize)>> = lines.iter().map(shape).collect();
    // What stands around a line: the widths of the next rows before it and after it, where they agree.
    let agreed = |mut rows: Box<dyn Iterator<Item = &Option<(usize, usize)>> + '_>| -> Option<(usize, usize)> {
        let first = rows.next().copied().flatten()?;
        let same = rows.take(LEAST - 1).filter(|s| s.is_some_and(|s| s.0 == first.0)).count();
        (same == LEAST - 1).then_some(first)
    };
    let mut cuts = vec![0];
    for at in 1..lines.len() {
        // Only a line without numbers, or a blank one, parts tables; a cut lies before the first of several.
        if shapes[at].is_some()
            || lines[at - 1].is_data() && shapes[at - 1].is_none() && *cuts.last().unwrap_or(&0) == at - 1
        {
            continue;
        }
        if shapes[at - 1].is_none() {
            continue;
        }
        let before = agreed(Box::new(shapes[*cuts.last().unwrap_or(&0)..at].iter().rev()));
        let next = shapes[at..].iter().position(Option::is_some).map(|n| at + n);
        let Some(next) = next else { continue };
        let after = agreed(Box::new(shapes[next..].iter()));
        let headed = lines[at..next].iter().any(|l| l.is_data() || l.kind == super::RecordKind::Blank);
        if let (Some(before), Some(after)) = (before, after)
            && before.0 != after.0
            && headed
        {
            cuts.push(at);
        } else if let (Some(_), Some(after)) = (before, after)
            && another_header(lines, at, next, after.0, reading)
        {
            cuts.push(at);
        }
    }
    let ends = cuts.iter().skip(1).copied().chain([lines.len()]);
    cuts.iter().copied().zip(ends).map(|(a, b)| a..b).collect()
}

/// Do the lines from `at` to `next` have a header of `width` names that differs from the one of the rows before?
fn another_header(lines: &[Line], at: usize, next: usize, width: usize, reading: &Reading) -> bool {
    let names = |line: &&Line| {
        let all = vec![true; line.cells.len()];
        line.is_data()
            && line.cells.len() == width
            && width > 1
            && line.filled() == width
            && cast(line, &all, reading).read == 0
    };
    let distinct = |line: &Line| {
        let mut cells = line.cells.clone();
        cells.sort();
        cells.dedup();
        cells.len() == line.cells.len()
    };
    let Some(header) = lines[at..next].iter().rev().find(names) else { return false };
    let before = lines[..at].iter().find(names);
    distinct(header)
        && before.is_some_and(|b| b.cells != header.cells)
        && lines[at..next].iter().filter(|l| l.kind != super::RecordKind::Comment).count() > 1
}

/// The first row among `lines`: the first without text where the columns hold numbers, and what stands right above it
/// and is a row too but for a few texts.
fn first_row(lines: &[Line], typed: &[bool], reading: &Reading) -> Option<usize> {
    let is_data = |line: &&Line| line.is_data();
    let casts = |line: &Line| cast(line, typed, reading);
    let loose = lines.iter().position(|l| is_data(&l) && casts(l).is_row())?;
    let usual = usual_width(lines[loose..].iter().filter(|l| l.is_data()));
    let wide = |line: &Line| line.cells.len().abs_diff(usual) <= 1;
    let strict = lines.iter().position(|l| is_data(&l) && wide(l) && casts(l).is_clean() && followed(lines, l, usual));
    let Some(mut first) = strict else { return Some(loose) };
    // A row with an odd text in it stays a row.
    for at in (0..first).rev() {
        let line = &lines[at];
        if !line.is_data() {
            continue;
        }
        let cast = casts(line);
        let first_cell = line
            .cells
            .first()
            .is_some_and(|c| typed.first() != Some(&true) || super::look(c.as_bytes(), reading) != super::Look::Text);
        if wide(line) && cast.is_row() && first_cell && cast.text * 3 <= cast.read + cast.text {
            first = at;
        } else {
            break;
        }
    }
    // Types of columns (`5s 15s 20d`) are no numbers with units.
    while lines[first].cells.len() > 1 && super::units::are_types(&lines[first].cells) {
        first += 1 + lines[first + 1..].iter().position(|l| is_data(&l))?;
    }
    Some(first)
}

/// A row of another width than usual is the first one only if no line of names stands right below it.
fn followed(lines: &[Line], line: &Line, usual: usize) -> bool {
    line.cells.len() == usual || {
        let later = lines.iter().filter(|l| l.is_data() && l.number > line.number).take(3);
        later.filter(|l| l.cells.len() == usual).count() < 2
    }
}
