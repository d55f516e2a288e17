//! Loading a record.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::body::{Body, Numbers, Plan};
use super::column_roles::{Roles, assign, release};
use super::columnar;
use super::facts::Facts;
use super::feed::{Feed, Unfit};
use super::formats::{self, Known};
use super::head::{Head, open_quote};
use super::mend::{About, Mended};
use super::multi_track::{self, Targets};
use super::odd::Oddity;
use super::order::{Moments, Ordered, Rows, order, sample_numbers};
use super::packing::Packing;
use super::parallel_parse::{Failure, parse};
use super::streaming_load::streamed;
use super::text::{Text, path_of, sha256, stored};
use super::timing::{Timing, choose};
use super::tokens::inner;
use super::unsupported::{refuse_binaries, refuse_long_form, refuse_other_formats};
use super::view::Want;
use super::{
    Channel, Clocks, Column, ColumnKind, Delimiter, Dialect, Encoding, Extent, Fault, Faults, LoadOptions, RowsAt,
    Rules, Source, TimeAxis, TimeFormat, Track, Viewed, Wanted, notes, printable, rows,
};
use crate::error::{Error, Result};

/// Loads a record.
///
/// # Errors
/// [`Error::Io`] when the source cannot be read; [`Error::Input`] when it is no table of numbers, with the line and
/// the way out; [`Error::Usage`] when a column of the options is not there.
pub fn load(source: &Source, options: &LoadOptions) -> Result<Track> {
    load_extent(source, options, Extent::All, Wanted::always())
}

/// [`load()`] that ends as soon as nobody waits for the record any more.
///
/// # Errors
/// As [`load()`]; [`Error::Stopped`] when the record is no longer wanted.
pub fn load_while(source: &Source, options: &LoadOptions, wanted: Wanted<'_>) -> Result<Track> {
    load_extent(source, options, Extent::All, wanted)
}

/// [`load_while`] of a part of the source.
///
/// # Errors
/// As [`load_while`].
pub fn load_extent(source: &Source, options: &LoadOptions, extent: Extent, wanted: Wanted<'_>) -> Result<Track> {
    let extent = extent.settled(source);
    let still = || if wanted.still() { Ok(()) } else { Err(Error::Stopped) };
    if let Some(path) = source.file()
        && let Some(track) = streamed((source, path), options, extent, wanted)
    {
        still()?;
        return track;
    }
    still()?;
    let path = path_of(source);
    let stored = stored(source, extent)?;
    still()?;
    refuse_binaries(&stored, &path)?;
    let want = Want { table: options.table };
    let mut text = Text::of_table(&stored, &path, options.encoding, want)?;
    if !text.is_columnar()
        && let Some(format) = formats::viewed(text.body(), options)
    {
        text = text.viewed(format, want, &path)?;
    }
    still()?;
    let understood = Understood::of(&text, options, &path)?;
    let line_end = understood.head.layout.line_end;
    let feed = |rows| Feed::of(rows, line_end).while_wanted(wanted);
    let (sha256, parsed) = rayon::join(
        || sha256(&stored, wanted),
        || {
            let head = &understood.head;
            let rows = &text.body()[head.data_start..head.data_end.unwrap_or(text.body().len())];
            understood.parse(|| Ok((feed(rows), rows.len() as u64)))
        },
    );
    still()?;
    let (parsed, _) = parsed.map_err(|failure| match failure {
        Failure::Open(quote) => open_quote(&path, quote),
        Failure::Full(full) | Failure::Unfit(Unfit::Full(full)) => Error::memory(&path)(full),
        Failure::Unfit(_) => Error::input(&path, "it cannot be read", "copy or fetch the file again"),
    })?;
    let track = understood.track(source, (sha256, stored.len() as u64), parsed, wanted, &|| Ok(feed(text.body())));
    still()?;
    let mut track = track?;
    if let Some(view) = &text.view {
        track.faults.move_lines(|line| view.line(line));
    }
    Ok(track)
}

/// What the head of a file tells of the whole.
pub(super) struct Understood {
    pub(super) head: Head,
    timing: Option<Timing>,
    roles: Roles,
    encoding: Encoding,
    packing: Option<&'static Packing>,
    facts: Option<Arc<Facts>>,
    path: PathBuf,
    rules: Rules,
    /// What the user told, completed by the format.
    options: LoadOptions,
    /// The format that makes the table, if one does.
    viewed: Option<Viewed>,
    /// The lines of the text where the first rows of that table begin.
    made_of: Vec<u64>,
    /// Which of the tables that the file stores it is, where the user says so.
    stored_table: Option<usize>,
}

/// This many lines of rows are kept to be shown.
const LINES_KEPT: usize = 4096;

/// A number that is written with a decimal comma between commas would be two cells.
fn refuse_torn_decimals(head: &Head) -> Result<()> {
    let commas = head.layout.delimiter == Delimiter::Byte(b',') && head.reading.decimal_comma;
    if commas && head.layout.quote.is_none() {
        return Err(Error::usage(
            "a comma cannot be both the field separator and the decimal comma where cells are not quoted",
            "leave one of --decimal-comma and --no-quotes out, or name another --delimiter",
        ));
    }
    Ok(())
}

/// The rows, and the moments of the time column where there is one.
type Parsed = (Body, Option<Moments>);

/// Reads a text again, from its start.
pub(super) type Again<'a> = &'a dyn Fn() -> Result<Feed<'a>>;

impl Understood {
    /// From the text, or from so much of it that [`Head::needs_no_more`].
    pub(super) fn of(text: &Text<'_>, options: &LoadOptions, path: &Path) -> Result<Self> {
        let view = text.view.as_deref();
        let columnar = text.packing.filter(|packing| packing.is_columnar());
        if let Some(packing) = columnar {
            columnar::refuse_layout(options, packing, path)?;
        } else if view.is_none() {
            refuse_other_formats(text.body(), path)?;
        }
        let mut known = match view {
            _ if text.is_columnar() => Known::of_columns(options, text.facts.as_deref()),
            Some(view) => Known::of_view(view, options),
            None => Known::of(text.body(), options),
        };
        let mut head = Head::of(text, &known.options, path)?;
        known.settle_time(&head.names);
        head.take(&known, view, text.facts.as_deref());
        let viewed = view.map(|view| Viewed { format: view.format, table: options.table });
        let made_of = view.map(|v| v.lines.iter().copied().take(LINES_KEPT).collect()).unwrap_or_default();
        let table = options.table;
        let completed = known.options;
        let options = &completed;
        refuse_torn_decimals(&head)?;
        if options.track.is_none() {
            refuse_long_form(&head, path)?;
        }
        let by_sample = options.time.as_deref() == Some("sample") && !head.names.iter().any(|n| n == "sample");
        let timing = if by_sample { None } else { choose(&head, options, path)? };
        let roles = assign(&head, timing.as_ref(), options)?;
        let (encoding, packing, facts) = (text.encoding, text.packing, text.facts.clone());
        let stored_table = columnar.and(table);
        let rules = options.rules;
        let path = path.to_path_buf();
        let options = completed;
        Ok(Self { head, timing, roles, encoding, packing, facts, path, rules, options, viewed, made_of, stored_table })
    }

    /// Parses the rows of a feed that begins with the first of them and has about this many bytes; gives the feed of
    /// the first pass too.
    pub(super) fn parse<'a>(
        &self,
        rows: impl Fn() -> std::result::Result<(Feed<'a>, u64), Unfit>,
    ) -> std::result::Result<(Parsed, Feed<'a>), Failure> {
        let slots = &self.roles.slots;
        let mut plan = Plan {
            layout: self.head.layout,
            encoding: self.encoding,
            reading: &self.head.reading,
            slots: slots.clone(),
            counts: self.head.counts,
            timing: self.timing.clone(),
            record_bytes: self.head.record_bytes,
            repeats: &self.head.repeats,
            oddities: &self.head.oddities,
            truths: self.roles.truths.clone(),
            late: &self.roles.late,
            footer: self.rules == Rules::Second && !self.packing.is_some_and(Packing::is_columnar),
        };
        let (mut feed, bytes) = rows().map_err(Failure::Unfit)?;
        let mut body = parse(&mut feed, bytes, self.head.data_line, &plan)?;
        let Some(timing) = &self.timing else { return Ok(((body, None), feed)) };
        if body.rounded == 0 || timing.format != TimeFormat::Seconds {
            let moments = body.moments.take().map(Moments::Exact);
            return Ok(((body, moments), feed));
        }
        // Times with more decimals than nanoseconds are doubles that were written out in full: take them as such.
        drop(body);
        let slot = slots.iter().flatten().max().map_or(0, |s| s + 1);
        plan.timing = None;
        plan.slots[timing.column] = Some(slot);
        let (mut again, bytes) = rows().map_err(Failure::Unfit)?;
        let mut body = parse(&mut again, bytes, self.head.data_line, &plan)?;
        let seconds = body.numbers.pop().map(|n| n.values).unwrap_or_default();
        Ok(((body, Some(Moments::Float(seconds))), feed))
    }

    /// The track of these rows.
    pub(super) fn track(
        &self,
        source: &Source,
        (sha256, bytes): (String, u64),
        (mut body, moments): Parsed,
        wanted: Wanted<'_>,
        again: Again<'_>,
    ) -> Result<Track> {
        let options = &self.options;
        let Self { head, timing, roles, path, .. } = self;
        let timing = timing.as_ref();
        if u32::try_from(body.rows).is_err() {
            let what = format!("{} rows are too many", body.rows);
            return Err(Error::input(path, what, "split the file below 2^32 rows"));
        }
        let share = body.kept();
        let columns = columns_of(head, timing, roles, &body, options)?;
        let mut track = Track {
            source: source.clone(),
            sha256,
            bytes,
            dialect: self.dialect(options, body.tail.texts),
            rows: body.rows,
            time: time_axis(head, timing, body.rows),
            truth: truth_of(&columns, roles, &body, path)?,
            truth_told: roles.truth.is_some(),
            channels: channels_of(&columns, roles, &mut body, (head, path))?,
            faults: cell_faults(&columns, roles, &body),
            columns,
            notes: self.said(&body),
            share: Arc::new(share),
        };
        if self.rules == Rules::Second {
            lost(&track, path)?;
        }
        let track_column = match roles.track {
            Some(told) => Some(told),
            None if self.rules == Rules::Second => multi_track::recognised(&mut track, moments.as_ref(), again, head)?,
            None => None,
        };
        let targets = match track_column {
            Some(column) => Some(Targets::divide(&mut track, column, again, (head, options))?),
            None => None,
        };
        let of_row = targets.as_ref().map(|t| t.of_row.as_slice());
        match (moments, of_row) {
            (Some(moments), _) => self.take_times(&mut track, moments, (of_row, wanted), again)?,
            (None, Some(of_row)) => track.time.seconds = sample_numbers(of_row),
            (None, None) => {}
        }
        track.notes.extend(notes::about_shape(&track, head, options.time.is_some()));
        if self.rules == Rules::Second {
            lost_times(&track, path)?;
        }
        if let Some(facts) = &self.facts {
            facts.settle(&mut track);
        }
        Ok(track)
    }

    /// What was recognised in the head and in the rows, in a line each.
    fn said(&self, body: &Body) -> Vec<String> {
        let mut said = self.head.said.clone();
        said.extend(self.timing.iter().flat_map(|t| t.said.iter().cloned()));
        for (column, slot) in self.roles.slots.iter().enumerate() {
            let Some(numbers) = slot.map(|slot| &body.numbers[slot]) else { continue };
            if numbers.late > 0 && numbers.present > 0 {
                let texts: Vec<String> = self.roles.late[column].iter().map(|t| printable(t)).collect();
                let name = printable(&self.head.names[column]);
                said.push(format!("`{name}`: {} cells hold {}, taken as missing", numbers.late, texts.join(" or ")));
            }
            for oddity in Oddity::ALL {
                let count = numbers.odd[oddity as usize];
                if count > 0 {
                    let name = printable(&self.head.names[column]);
                    let cells = if count == 1 { "1 cell has".to_owned() } else { format!("{count} cells have") };
                    said.push(format!("`{name}`: {cells} {}", oddity.words()));
                }
            }
        }
        if body.tail.texts > 0 {
            let (lines, are) = if body.tail.texts == 1 { ("line", "is") } else { ("lines", "are") };
            said.push(format!("{} {lines} of text below the rows {are} not data", body.tail.texts));
        }
        if body.repeats > 0 {
            said.push(format!("the header is repeated among the rows ({} lines are not data)", body.repeats));
        }
        said
    }

    /// Takes the times of the rows, mended where they do not go forward, and finds the lines of those that are of no use.
    fn take_times(
        &self,
        track: &mut Track,
        moments: Moments,
        (of_row, wanted): (Option<&[u32]>, Wanted<'_>),
        again: Again<'_>,
    ) -> Result<()> {
        let Some(timing) = &self.timing else { return Ok(()) };
        let clock = timing.is_of_day();
        let mut moments = moments;
        let mut mended = Mended::default();
        if self.rules == Rules::Second {
            let about = About { clock, wrap: timing.wraps_after(), zone: timing.zone.as_ref(), of_row };
            mended = moments.mended(about);
        }
        track.time.newest_first = mended.newest_first;
        if mended.set_back > 0 && !mended.newest_first && track.time.is_calendar() {
            track.notes.push(format!(
                "times begin again an hour earlier ({}), as clocks do that are set back: --time-zone tells both hours apart",
                times(mended.set_back)
            ));
        }
        if mended.newest_first {
            track.notes.push("the newest row is first: the record is read from its end".into());
        }
        if mended.wraps > 0 {
            track.notes.push(format!("the counter of the time began again {}", times(mended.wraps)));
        }
        if mended.repeated_hour > 0 {
            track.notes.push(format!("{} rows are of an hour that clocks showed twice", mended.repeated_hour));
        }
        let reversed: Option<Vec<u32>> =
            of_row.filter(|_| mended.newest_first).map(|o| o.iter().rev().copied().collect());
        if mended.newest_first {
            moments.reverse();
        }
        let mut ordered = order(moments, clock, reversed.as_deref().or(of_row), wanted);
        if mended.newest_first {
            ordered.reverse();
        }
        ordered.unreadable.without(&mended.wild);
        take_times(track, ordered, &mended.wild, again)
    }

    fn dialect(&self, options: &LoadOptions, footer: usize) -> Dialect {
        let head = &self.head;
        let rows = RowsAt {
            start: head.data_start,
            line: head.data_line,
            header: head.header_at,
            units: head.units_at,
            end: head.data_end,
            footer,
            repeats: head.repeats.clone(),
            mark: head.layout.mark,
            format: self.viewed.as_ref().map(|viewed| viewed.format).or(head.format),
            closed: head.closed,
            made_of: self.made_of.clone(),
            table: self.stored_table,
        };
        Dialect {
            rows,
            view: self.viewed.clone(),
            styles: head.styles.clone(),
            fixed_width: head.fixed_width,
            delimiter: head.layout.delimiter,
            quote: head.layout.quote,
            decimal_comma: head.reading.decimal_comma,
            encoding: self.encoding,
            packing: self.packing,
            header: head.header,
            units_row: head.units_at.is_some(),
            missing: options.missing.clone(),
            preamble: head.preamble,
        }
    }
}

/// The columns, with their kinds by what was found in them.
fn columns_of(
    head: &Head,
    timing: Option<&Timing>,
    roles: &Roles,
    body: &Body,
    options: &LoadOptions,
) -> Result<Vec<Column>> {
    let column = |index: usize| -> Result<Column> {
        let name = &head.names[index];
        let numbers = roles.slots[index].map(|slot| &body.numbers[slot]);
        let kind = match numbers {
            _ if timing.is_some_and(|t| t.has(index)) => ColumnKind::Time,
            _ if roles.track == Some(index) => ColumnKind::Track,
            Some(numbers) if roles.truth == Some(index) => {
                check_truth(name, numbers)?;
                ColumnKind::Truth
            }
            Some(numbers) => roles.kind(index, name, numbers),
            None => roles.unread[index],
        };
        if kind != ColumnKind::Number && roles.channels.as_ref().is_some_and(|c| c.contains(&index)) {
            let example = numbers.and_then(|n| n.unreadable.first.first()).map_or("nothing", |(_, what)| what);
            return Err(Error::usage(
                format!("`{}` is not numeric: it holds `{}`", printable(name), printable(example)),
                "choose another channel, or name the missing markers with --missing",
            ));
        }
        // Texts that could have stood where numbers had not begun are values of a column of texts.
        let texts = numbers.filter(|_| kind == ColumnKind::Text).map_or(0, |n| n.late + n.unreadable.count);
        let missing = body.missing[index] - texts.min(body.missing[index]);
        Ok(Column { name: name.clone(), unit: head.units[index].clone(), kind, missing })
    };
    let mut columns = (0..head.names.len()).map(column).collect::<Result<Vec<_>>>()?;
    if options.channels.is_empty() {
        let mut kinds: Vec<ColumnKind> = columns.iter().map(|c| c.kind).collect();
        release(&mut kinds, &roles.slots);
        columns.iter_mut().zip(kinds).for_each(|(column, kind)| column.kind = kind);
    }
    if options.channels.is_empty() && !columns.iter().any(|c| c.kind == ColumnKind::Number) {
        // A lone column that looks like truth is all there is to look at.
        columns.iter_mut().filter(|c| c.kind == ColumnKind::Truth).for_each(|c| c.kind = ColumnKind::Number);
    }
    Ok(columns)
}

fn check_truth(name: &str, numbers: &Numbers) -> Result<()> {
    let odd = numbers.values.iter().find(|v| !(v.is_nan() || **v == 0.0 || **v == 1.0)).map(f64::to_string);
    match odd.or_else(|| numbers.unreadable.first.first().map(|(_, what)| what.clone())) {
        None => Ok(()),
        Some(odd) => Err(Error::usage(
            format!("`{}` is not a truth column: it holds {}", printable(name), printable(&odd)),
            "a truth column holds 1 for a real outlier and 0 for any other sample",
        )),
    }
}

fn truth_of(columns: &[Column], roles: &Roles, body: &Body, path: &Path) -> Result<Option<Vec<bool>>> {
    let mut found = columns.iter().enumerate().filter(|(_, c)| c.kind == ColumnKind::Truth).map(|(i, _)| i);
    let index = match (roles.truth, found.next(), found.next()) {
        (Some(told), _, _) => told,
        (None, Some(only), None) => only,
        _ => return Ok(None),
    };
    let slot =
        roles.slots[index].ok_or_else(|| Error::input(path, "the truth column was not read", "load it again"))?;
    Ok(Some(body.numbers[slot].values.iter().map(|v| *v == 1.0).collect()))
}

fn channels_of(
    columns: &[Column],
    roles: &Roles,
    body: &mut Body,
    (head, path): (&Head, &Path),
) -> Result<Vec<Channel>> {
    let by_kind = || (0..columns.len()).filter(|c| columns[*c].kind == ColumnKind::Number).collect();
    let wanted: Vec<usize> = roles.channels.clone().unwrap_or_else(by_kind);
    let channel = |index: usize| {
        let values = roles.slots[index].map(|slot| std::mem::take(&mut body.numbers[slot].values)).unwrap_or_default();
        let Column { name, unit, .. } = &columns[index];
        Channel { name: name.clone(), unit: unit.clone(), column: index, target: None, values }
    };
    let channels: Vec<Channel> = wanted.into_iter().map(channel).collect();
    if channels.is_empty() {
        let names: Vec<String> = columns.iter().take(30).map(|c| printable(&c.name)).collect();
        return Err(Error::input(
            path,
            format!("no column of numbers besides the time; the columns are {}", names.join(", ")),
            notes::column_of_commas(columns, head).map_or_else(
                || "choose another time column with --time (`sample` for the sample number), or name a file with numbers".into(),
                |column| notes::about_commas(&columns[column].name),
            ),
        ));
    }
    Ok(channels)
}

/// Faults of cells in columns of numbers, in the order of their lines.
fn cell_faults(columns: &[Column], roles: &Roles, body: &Body) -> Faults {
    let gather = |of: fn(&Numbers) -> &Fault| {
        let mut all = Fault::default();
        for (column, slot) in columns.iter().zip(&roles.slots) {
            let Some(slot) = slot.filter(|_| matches!(column.kind, ColumnKind::Number | ColumnKind::Truth)) else {
                continue;
            };
            let fault = of(&body.numbers[slot]);
            all.count += fault.count;
            all.first.extend(fault.first.iter().map(|(line, what)| (*line, format!("{what} ({})", column.name))));
        }
        all.first.sort_by_key(|(line, _)| *line);
        all.first.truncate(Fault::KEPT);
        all
    };
    Faults {
        unreadable_cells: gather(|n| &n.unreadable),
        infinite_cells: gather(|n| &n.infinite),
        ragged_rows: body.ragged.clone(),
        ..Faults::default()
    }
}

/// `once`, or how often.
fn times(count: usize) -> String {
    if count == 1 { "once".into() } else { format!("{count} times") }
}

/// Refuses a table most of whose cells could not be read.
///
/// # Errors
/// [`Error::Input`] with the first of them and the way out.
fn lost(track: &Track, path: &Path) -> Result<()> {
    let ragged = &track.faults.ragged_rows;
    let cells = &track.faults.unreadable_cells;
    let numbers = track.channels.len().max(1);
    let most = |count: usize, of: usize| of >= LEAST_LOST && count * 2 > of;
    if most(ragged.count, track.rows) && most(cells.count, track.rows.saturating_mul(numbers)) {
        return Err(mostly_lost(path, cells, "cells hold no numbers", track.rows));
    }
    Ok(())
}

/// Rows of a record below which nothing is said of losing most of them.
const LEAST_LOST: usize = 8;

/// Refuses a record most of whose rows have no usable time.
///
/// # Errors
/// [`Error::Input`] with the first of them and the way out.
fn lost_times(track: &Track, path: &Path) -> Result<()> {
    let unreadable = &track.faults.unreadable_times;
    if track.rows >= LEAST_LOST && unreadable.count * 2 > track.rows {
        return Err(mostly_lost(path, unreadable, "rows have no time that can be read", track.rows));
    }
    Ok(())
}

fn mostly_lost(path: &Path, fault: &Fault, what: &str, rows: usize) -> Error {
    let (line, text) = fault.first.first().cloned().unwrap_or_default();
    Error::Input {
        path: path.to_path_buf(),
        line: Some(line).filter(|l| *l > 0),
        what: format!("most of its {rows} rows are lost: {} {what}, like {}", fault.count, printable(&text)),
        help: "say where the header is (--header-line), how times are written (--time-format), or which column is the time \
               (--time; `sample` for the sample number)"
            .into(),
    }
}

/// The axis of the file; the sample number until the times are taken.
fn time_axis(head: &Head, timing: Option<&Timing>, rows: usize) -> TimeAxis {
    match timing {
        Some(timing) => TimeAxis {
            name: head.names[timing.column].clone(),
            column: Some(timing.column),
            date_column: timing.date_column,
            part_columns: timing.columns.clone(),
            zone: timing.zone.clone(),
            clocks: timing.clocks,
            newest_first: false,
            format: timing.format.clone(),
            origin_ns: 0,
            seconds: Vec::new(),
        },
        None => TimeAxis {
            name: "sample".into(),
            column: None,
            date_column: None,
            part_columns: Vec::new(),
            zone: None,
            clocks: Clocks::Stated,
            newest_first: false,
            format: TimeFormat::SampleNumber,
            origin_ns: 0,
            #[expect(clippy::cast_precision_loss, reason = "fewer than 2^32 rows")]
            seconds: (0..rows).map(|row| row as f64).collect(),
        },
    }
}

/// Takes the times of the rows, and finds the lines of those that are of no use.
fn take_times(track: &mut Track, ordered: Ordered, wild: &[usize], again: Again<'_>) -> Result<()> {
    let Ordered { origin_ns, seconds, repeated, backward, unreadable } = ordered;
    let wild = Rows { count: wild.len(), first: wild.iter().copied().take(Fault::KEPT).collect() };
    let last = [&repeated, &backward, &unreadable, &wild].iter().filter_map(|r| r.first.iter().max().copied()).max();
    track.time.origin_ns = origin_ns;
    track.time.seconds = seconds;
    let mut faults = [repeated, backward, unreadable, wild].map(|rows| (rows, Fault::default()));
    let column = track.time.column.unwrap_or_default();
    if let Some(last) = last {
        rows::walk_feed(track, &mut again()?, |row, record, splitter| {
            for (_, fault) in faults.iter_mut().filter(|(r, _)| r.first.contains(&row)) {
                let spans = splitter.cells(record);
                let raw = spans.get(column).map_or(&[][..], |s| s.of(record.bytes));
                let cell = &raw[inner(raw, track.dialect.quote)];
                fault.add(record.line, &super::text::decoded(cell, track.dialect.encoding));
            }
            Ok(row < last)
        })?;
    }
    let first_backward = faults[1].0.first.first().copied();
    let counted = |(rows, fault): (Rows, Fault)| Fault { count: rows.count, ..fault };
    let [repeated, backward, unreadable, wild] = faults.map(counted);
    if let Some(row) = first_backward
        && backward.count * 10 > track.rows
    {
        track.notes.push(notes::about_backward_times(track, &mut again()?, row, &backward)?);
    }
    track.faults.repeated_times = repeated;
    track.faults.backward_times = backward;
    track.faults.unreadable_times = unreadable;
    track.faults.wild_times = wild;
    Ok(())
}
