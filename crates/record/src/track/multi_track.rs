//! Several tracks in one table: a column tells which target the row is about, each target has times of its own.
//!
//! A channel of such a record is one column of one target, `alt_ft@4CA1B2`: it holds the values of the target's rows
//! alone, so that no segment, scale or repair ever reaches from one target to another, and memory does not grow
//! with their number.

use std::collections::HashMap;
use std::sync::Arc;

use super::head::Head;
use super::load::Again;
use super::order::{Moments, UNREADABLE, increasing};
use super::text::{decoded, path_of};
use super::tokens::inner;
use super::{Channel, ColumnKind, LoadOptions, Rules, Track, names, printable, rows};
use crate::error::{Error, Result, nearest};

/// More targets than this are no targets: a time or a measurement was named.
const MOST: usize = 10_000;
/// Stands for a row that names no target.
pub(crate) const NOBODY: u32 = u32::MAX;
/// Between the name of a column and the id of a target.
const AT: char = '@';

/// The target of a channel, in a table of several tracks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Target {
    /// Its id, as the file writes it.
    pub id: String,
    /// Its rows (from 0), ascending; [`Channel::values`] has one value for each.
    pub rows: Arc<[u32]>,
}

/// Which rows belong to which target, in the order in which they first appear.
#[derive(Debug, Default)]
pub(crate) struct Targets {
    /// For each row the index of its target, or [`NOBODY`].
    pub(crate) of_row: Vec<u32>,
    pub(crate) ids: Vec<String>,
}

/// The index of the column that tells tracks apart, if one was named.
///
/// # Errors
/// [`Error::Usage`] for a name that is not there.
pub(crate) fn column(head: &Head, options: &LoadOptions) -> Result<Option<usize>> {
    options.track.as_ref().map(|name| names::find(head.names.iter().map(String::as_str), name)).transpose()
}

/// The column that a user means by the name of a channel: that of the name itself or, where tracks are told apart,
/// of what stands before an `@`.
///
/// # Errors
/// [`Error::Usage`] for a name that is not there.
pub(crate) fn base(head: &Head, options: &LoadOptions, name: &str) -> Result<usize> {
    let found = names::find(head.names.iter().map(String::as_str), name);
    if found.is_ok() || (options.track.is_none() && options.rules == Rules::First) {
        return found;
    }
    let parts = name.char_indices().filter(|(_, c)| *c == AT).map(|(at, _)| &name[..at]);
    parts.filter_map(|part| head.names.iter().position(|n| n == part)).next_back().map_or(found, Ok)
}

/// The column that tells tracks apart, where times go forward under it and do not without it. Its kind is that of a
/// track column then, and the record says so.
///
/// # Errors
/// What a walk over the rows gives.
pub(super) fn recognised(
    track: &mut Track,
    moments: Option<&Moments>,
    again: Again<'_>,
    head: &Head,
) -> Result<Option<usize>> {
    let Some(Moments::Exact(moments)) = moments else { return Ok(None) };
    let few = |lost: usize| lost * 20 <= moments.len();
    let lost = if increasing(moments) { 0 } else { behind(moments.iter()) };
    // Nearly every record goes forward, and is not looked at from its end.
    let lost = if few(lost) { lost } else { lost.min(behind(moments.iter().rev())) };
    if moments.len() < 8 {
        return Ok(None);
    }
    if few(lost) {
        return interleaved(track, again, head);
    }
    let most = lost * 5 > moments.len() * 2;
    for column in candidates(track, head, most) {
        let Ok(targets) = Targets::read(track, column, again, head) else { continue };
        let count = targets.ids.len();
        if track.channels.iter().all(|c| c.column == column) {
            continue;
        }
        // Hardly a row is alone under its id.
        if count < 2 || count * 3 > moments.len() || targets.in_small_ones(3) * 20 > moments.len() {
            continue;
        }
        let forward = targets.in_order(moments, false).max(targets.in_order(moments, true));
        if forward * 20 >= (moments.len() - count) * 19 {
            let name = printable(&head.names[column]);
            track.columns[column].kind = ColumnKind::Track;
            track.channels.retain(|c| c.column != column);
            track.notes.push(format!(
                "`{name}` tells {count} tracks apart, under which times go forward: each is judged by itself (--track names \
                 another column)"
            ));
            return Ok(Some(column));
        }
    }
    Ok(None)
}

/// The column that tells tracks apart whose rows alternate and times go forward all the same: one with the name of an id,
/// under which a channel is far smoother than from row to row. Its kind is that of a track column then, and the record
/// says so.
fn interleaved(track: &mut Track, again: Again<'_>, head: &Head) -> Result<Option<usize>> {
    let named = (0..track.columns.len()).filter(|c| super::column_roles::is_id_column(&head.names[*c]));
    for column in named.filter(|c| alternates(&head.column(*c))).collect::<Vec<_>>() {
        let Ok(targets) = Targets::read(track, column, again, head) else { continue };
        let (count, rows) = (targets.ids.len(), targets.of_row.len());
        let smoother = track.channels.iter().filter(|c| c.column != column && targets.smooth(&c.values)).count();
        if count < 2 || targets.in_small_ones(8) * 20 > rows || smoother == 0 {
            continue;
        }
        track.columns[column].kind = ColumnKind::Track;
        track.channels.retain(|c| c.column != column);
        track.notes.push(format!(
            "`{}` tells {count} tracks apart, whose rows alternate: each is judged by itself (--track names another column)",
            printable(&head.names[column])
        ));
        return Ok(Some(column));
    }
    Ok(None)
}

/// True where the cells come back to earlier ones again and again.
fn alternates(cells: &[&str]) -> bool {
    let changes = cells.windows(2).filter(|w| w[0] != w[1]).count();
    let mut distinct = cells.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    distinct.len() > 1 && changes >= 4 * distinct.len()
}

/// Rows that tell whether tracks are smoother than the table.
const MOST_COMPARED: usize = 10_000;

/// Rows whose moment is not after all before it.
fn behind<'a>(moments: impl Iterator<Item = &'a i64>) -> usize {
    let mut last = i64::MIN;
    let mut lost = 0;
    for moment in moments.filter(|m| **m != UNREADABLE) {
        if *moment > last {
            last = *moment;
        } else {
            lost += 1;
        }
    }
    lost
}

/// Columns that may tell tracks apart: those with the name of an id, then texts and whole numbers of which there are few.
/// Numbers that are no ids by their names only where `most` of the rows would be lost otherwise.
fn candidates(track: &Track, head: &Head, most: bool) -> Vec<usize> {
    let few = |c: usize| {
        let mut cells = head.column(c);
        let rows = cells.len();
        let short = cells.iter().all(|cell| cell.len() <= 40 && !cell.contains('.'));
        cells.sort_unstable();
        cells.dedup();
        short && cells.len() * 3 <= rows.max(3)
    };
    let named = |c: &usize| super::column_roles::is_id_column(&head.names[*c]);
    let fits = |c: &usize| {
        let kind = track.columns[*c].kind;
        named(c) && !matches!(kind, ColumnKind::Time | ColumnKind::Empty)
            || (kind == ColumnKind::Text || (most && kind == ColumnKind::Number)) && few(*c)
    };
    let mut found: Vec<usize> = (0..track.columns.len()).filter(fits).collect();
    found.sort_by_key(|c| (!named(c), *c));
    found.truncate(8);
    found
}

impl Targets {
    /// How many rows have a moment after that of the row before of the same target; `back` reads from the end.
    fn in_order(&self, moments: &[i64], back: bool) -> usize {
        let mut lasts: Vec<Option<i64>> = vec![None; self.ids.len()];
        let mut count = 0;
        let rows: Box<dyn Iterator<Item = usize>> =
            if back { Box::new((0..moments.len()).rev()) } else { Box::new(0..moments.len()) };
        for row in rows {
            let moment = moments[row];
            let Some(last) = self.of_row.get(row).and_then(|t| lasts.get_mut(*t as usize)) else { continue };
            if moment == UNREADABLE {
                continue;
            }
            count += usize::from(last.is_some_and(|last| moment > last));
            *last = Some(moment);
        }
        count
    }

    /// True where the values of each target follow each other in far smaller steps than those of all rows.
    fn smooth(&self, values: &[f64]) -> bool {
        const FAR: f64 = 10.0;
        let mut lasts: Vec<f64> = vec![f64::NAN; self.ids.len()];
        let (mut of_rows, mut of_targets) = (Vec::new(), Vec::new());
        let mut before = f64::NAN;
        for (target, value) in self.of_row.iter().zip(values).filter(|(_, v)| !v.is_nan()).take(MOST_COMPARED) {
            let Some(last) = lasts.get_mut(*target as usize) else { continue };
            of_rows.push((value - before).abs());
            of_targets.push((value - *last).abs());
            (before, *last) = (*value, *value);
        }
        let middle = |mut steps: Vec<f64>| {
            steps.retain(|s| s.is_finite());
            steps.sort_by(f64::total_cmp);
            steps.get(steps.len() / 2).copied().unwrap_or(0.0)
        };
        middle(of_rows) > FAR * middle(of_targets)
    }

    /// Rows of targets that have fewer than `least`.
    fn in_small_ones(&self, least: usize) -> usize {
        let mut counts = vec![0; self.ids.len()];
        for target in &self.of_row {
            if let Some(count) = counts.get_mut(*target as usize) {
                *count += 1;
            }
        }
        counts.into_iter().filter(|c| *c < least).sum()
    }

    /// Divides the channels of `track` among the targets that `column` tells apart, and says what a user should know
    /// of them.
    ///
    /// # Errors
    /// [`Error::Usage`] where they are too many to be targets, where there is none, and where a channel was named of a
    /// target that is not there.
    pub(super) fn divide(
        track: &mut Track,
        column: usize,
        again: Again<'_>,
        (head, options): (&Head, &LoadOptions),
    ) -> Result<Self> {
        let targets = Self::read(track, column, again, head)?;
        track.channels = targets.channels(std::mem::take(&mut track.channels), head, options)?;
        let notes = targets.notes(track);
        track.notes.extend(notes);
        Ok(targets)
    }

    /// Reads the ids in `column` of every row of `track`.
    fn read(track: &Track, column: usize, again: Again<'_>, head: &Head) -> Result<Self> {
        let mut targets = Self { of_row: Vec::with_capacity(track.rows), ids: Vec::new() };
        let mut known: HashMap<Vec<u8>, u32> = HashMap::new();
        rows::walk_feed(track, &mut again()?, |_, record, splitter| {
            let raw = splitter.cells(record).get(column).map_or(&[][..], |s| s.of(record.bytes));
            let cell = &raw[inner(raw, track.dialect.quote)];
            let index = match known.get(cell) {
                Some(index) => *index,
                None if head.reading.is_marker(cell) => NOBODY,
                None => {
                    let index = u32::try_from(targets.ids.len()).unwrap_or(NOBODY);
                    known.insert(cell.to_vec(), index);
                    targets.ids.push(decoded(cell, track.dialect.encoding).into_owned());
                    index
                }
            };
            targets.of_row.push(index);
            Ok(targets.ids.len() <= MOST)
        })?;
        let name = printable(&head.names[column]);
        match targets.ids.len() {
            0 => Err(Error::input(
                path_of(&track.source),
                format!("no row has a `{name}`"),
                "name another column with --track",
            )),
            n if n > MOST => Err(Error::usage(
                format!("`{name}` tells more than {MOST} tracks apart"),
                "--track names the column of an id (a satellite, an aircraft, a station), not of a time or a value",
            )),
            _ => Ok(targets),
        }
    }

    /// The channels of each target in place of those of the whole table.
    fn channels(&self, channels: Vec<Channel>, head: &Head, options: &LoadOptions) -> Result<Vec<Channel>> {
        let named = options.channels.iter().map(|name| self.named(name, head, options)).collect::<Result<Vec<_>>>()?;
        let wanted = |column: usize, target: usize| {
            named.is_empty() || named.iter().any(|(c, t)| *c == column && t.is_none_or(|t| t == target))
        };
        let mut rows: Vec<Vec<u32>> = vec![Vec::new(); self.ids.len()];
        for (row, &target) in (0..).zip(&self.of_row) {
            if let Some(rows) = rows.get_mut(target as usize) {
                rows.push(row);
            }
        }
        let rows: Vec<Arc<[u32]>> = rows.into_iter().map(Arc::from).collect();
        let mut divided = Vec::new();
        // Column by column, so that no more than one of them is in memory twice.
        for (place, channel) in channels.into_iter().enumerate() {
            for (target, rows) in rows.iter().enumerate().filter(|(target, _)| wanted(channel.column, *target)) {
                let values = rows.iter().map(|&row| channel.values[row as usize]).collect();
                let id = self.ids[target].clone();
                let name = format!("{}{AT}{id}", channel.name);
                let target_of = Some(Target { id, rows: Arc::clone(rows) });
                let part =
                    Channel { name, unit: channel.unit.clone(), column: channel.column, target: target_of, values };
                divided.push(((target, place), part));
            }
        }
        divided.sort_by_key(|(key, _)| *key);
        Ok(divided.into_iter().map(|(_, channel)| channel).collect())
    }

    /// The column and, where one is named, the target of the name of a channel.
    fn named(&self, name: &str, head: &Head, options: &LoadOptions) -> Result<(usize, Option<usize>)> {
        let column = base(head, options, name)?;
        let Some(id) = name.strip_prefix(&head.names[column]).and_then(|rest| rest.strip_prefix(AT)) else {
            return Ok((column, None));
        };
        let found = self.ids.iter().position(|i| i == id);
        found.map(|target| (column, Some(target))).ok_or_else(|| {
            let hint = nearest(id, self.ids.iter().map(String::as_str));
            let hint = hint.map_or(String::new(), |near| format!("did you mean {}? ", printable(near)));
            let ids: Vec<String> = self.ids.iter().take(20).map(|i| printable(i)).collect();
            let more = if self.ids.len() > 20 { ", …" } else { "" };
            Error::usage(
                format!("`{}`: there is no track `{}`", printable(name), printable(id)),
                format!("{hint}tracks: {}{more}", ids.join(", ")),
            )
        })
    }

    fn notes(&self, track: &Track) -> Vec<String> {
        let nobody = self.of_row.iter().filter(|t| **t == NOBODY).count();
        let column = track.track_column().map_or("", |c| &track.columns[c].name);
        let mut notes = Vec::new();
        if nobody > 0 {
            let column = printable(column);
            notes.push(format!("{nobody} of {} rows have no `{column}`: they are left as they are", track.rows));
        }
        notes
    }
}

impl Channel {
    /// The value of `row` (from 0): NaN where there is none, and for rows of other targets.
    #[must_use]
    pub fn value(&self, row: usize) -> f64 {
        self.place(row).and_then(|place| self.values.get(place).copied()).unwrap_or(f64::NAN)
    }

    /// How many rows of the file are its own.
    #[must_use]
    pub fn rows(&self, track: &Track) -> usize {
        self.target.as_ref().map_or(track.rows, |t| t.rows.len())
    }

    /// True when `row` (from 0) is one of the channel's own: all are, but in a table of several tracks.
    #[must_use]
    pub fn owns(&self, row: usize) -> bool {
        self.place(row).is_some()
    }

    /// True when both are of the same target, or of a record without targets.
    #[must_use]
    pub fn same_target(&self, other: &Self) -> bool {
        self.target.as_ref().map(|t| &t.id) == other.target.as_ref().map(|t| &t.id)
    }

    fn place(&self, row: usize) -> Option<usize> {
        match &self.target {
            None => Some(row),
            Some(target) => target.rows.binary_search(&u32::try_from(row).ok()?).ok(),
        }
    }
}

impl Track {
    /// The column that tells tracks apart, if one was named.
    #[must_use]
    pub fn track_column(&self) -> Option<usize> {
        self.columns.iter().position(|c| c.kind == ColumnKind::Track)
    }

    /// True when a user who says `name` means `channel`: its own name, or the name or number of its column.
    #[must_use]
    pub fn means(&self, name: &str, channel: &Channel) -> bool {
        let column = || names::place(self.columns.iter().map(|c| c.name.as_str()), name);
        channel.name == name || column() == Some(channel.column)
    }

    /// The channel that goes with `channel` under this name: in a table of several tracks the column of that name, or
    /// of the channel of that name, for the same target. (A rate that was chosen for one satellite and copied to
    /// all is each one's own.)
    #[must_use]
    pub fn beside(&self, channel: &Channel, name: &str) -> Option<&Channel> {
        let column = self.channel(name).map(|c| c.column);
        let fits = |c: &&Channel| column.map_or_else(|| self.means(name, c), |column| c.column == column);
        self.channels.iter().filter(|c| c.same_target(channel)).find(fits)
    }
}
