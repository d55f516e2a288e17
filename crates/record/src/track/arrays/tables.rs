//! Tables: arrays along the same axis.

use std::collections::BTreeSet;

use super::super::names::time_rank;
use super::super::printable;
use super::super::view::Want;
use super::array::{Array, Axis, Store};
use super::columns::{Column, Meaning, NoMoments};
use super::errors::Trouble;

/// Columns that an array of two axes may become.
const FEW: u64 = 32;
/// Names that a note lists.
const TOLD: usize = 12;

/// What makes values stand in the same rows.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Key {
    /// The file stores them as a table of this name.
    Table(String),
    /// They stand along this dimension.
    Dimension(String),
    /// There are this many, and the file names no dimensions.
    Length(u64),
}

impl Key {
    fn of(axis: &Axis) -> Self {
        axis.dimension.clone().map_or(Self::Length(axis.length), Self::Dimension)
    }
}

/// An array with the axis that its rows stand along.
struct Placed<'s> {
    array: &'s Array,
    /// The axis of the rows.
    rows: usize,
    key: Key,
}

impl Placed<'_> {
    /// True for what is a time by its units or its name.
    fn is_time(&self) -> bool {
        self.array.axes.len() == 1 && (self.has_moments() || time_rank(self.array.base()) > 0)
    }

    fn has_moments(&self) -> bool {
        let one = Column::of(self.array, (String::new(), 0), (0, 0), super::array::Fills::Nothing).0;
        matches!(one.meaning, Meaning::Moment { .. })
    }

    fn length(&self) -> u64 {
        self.array.axes[self.rows].length
    }
}

/// A table.
pub(super) struct Table {
    /// What it is called: a dimension, a group, or a stored table.
    name: String,
    pub(super) rows: u64,
    pub(super) columns: Vec<Column>,
    /// The name of the column of the time, where the file tells it.
    pub(super) time: Option<String>,
    /// Columns of groups that are called times within their groups, the likeliest first.
    pub(super) called_times: Vec<String>,
    /// True where a column is a time by its units or its name.
    timed: bool,
    no_moments: Vec<NoMoments>,
    long_names: Vec<(String, String)>,
}

/// The table that is read, and what is said about it and others.
pub(super) struct Chosen {
    pub(super) table: Table,
    pub(super) said: Vec<String>,
}

/// All tables of a file.
pub(super) struct Tables {
    tables: Vec<Table>,
    unread: Vec<(String, String)>,
}

impl Tables {
    /// The tables that the arrays of a file make.
    ///
    /// # Errors
    /// [`Trouble::NoTable`] where they make none.
    pub(super) fn of(store: &Store) -> Result<Self, Trouble> {
        let mut unread = store.unread.clone();
        let placed = placed(store, &mut unread);
        let mut tables: Vec<Table> = Vec::new();
        let mut keys: Vec<Key> = Vec::new();
        for one in &placed {
            if !keys.contains(&one.key) {
                keys.push(one.key.clone());
            }
        }
        for key in keys {
            let of_key: Vec<&Placed<'_>> = placed.iter().filter(|one| one.key == key).collect();
            tables.extend(by_group(&of_key).into_iter().map(|members| Table::of(&key, &members, store)));
        }
        if tables.is_empty() {
            let listed = listed(&unread);
            return Err(Trouble::NoTable(if listed.is_empty() { listed } else { format!(": {listed}") }));
        }
        Ok(Self { tables, unread })
    }

    /// The wanted table; else the longest of those with a time, or of all.
    ///
    /// # Errors
    /// [`Trouble::NoSuchTable`].
    pub(super) fn chosen(mut self, want: Want) -> Result<Chosen, Trouble> {
        let count = self.tables.len();
        let at = match want.table {
            Some(wanted) => {
                let found = wanted.checked_sub(1).filter(|at| *at < count);
                found.ok_or_else(|| Trouble::NoSuchTable { wanted, count, listed: self.names() })?
            }
            None => {
                let worth = |at: &usize| {
                    let table = &self.tables[*at];
                    (table.has_numbers(), table.timed, table.rows, usize::MAX - at)
                };
                (0..count).max_by_key(worth).unwrap_or(0)
            }
        };
        let mut said = Vec::new();
        if count > 1 && want.table.is_none() {
            said.push(format!(
                "{count} tables in the file: {}; table {} is read (--table reads another)",
                self.names(),
                at + 1
            ));
        }
        if !self.unread.is_empty() {
            said.push(format!("not read: {}", listed(&self.unread)));
        }
        let table = self.tables.swap_remove(at);
        said.extend(table.no_moments.iter().map(|NoMoments { name, units }| {
            format!(
                "`{}`: `{}` are no dates of the usual calendar, and are read as numbers",
                printable(name),
                printable(units)
            )
        }));
        if !table.long_names.is_empty() {
            let one = |(name, long): &(String, String)| format!("`{}` is {}", printable(name), printable(long));
            said.push(table.long_names.iter().take(TOLD).map(one).collect::<Vec<_>>().join(", "));
        }
        Ok(Chosen { table, said })
    }

    fn names(&self) -> String {
        let one = |(i, table): (usize, &Table)| format!("{} {} ({} rows)", i + 1, printable(&table.name), table.rows);
        let list = self.tables.iter().enumerate().take(TOLD).map(one).collect::<Vec<_>>().join(", ");
        if self.tables.len() > TOLD { list + ", …" } else { list }
    }
}

fn listed(unread: &[(String, String)]) -> String {
    let one = |(name, why): &(String, String)| format!("`{}` ({})", printable(name), printable(why));
    let list = unread.iter().take(TOLD).map(one).collect::<Vec<_>>().join(", ");
    if unread.len() > TOLD { list + ", …" } else { list }
}

/// The arrays that can stand in rows; of the others, names and reasons go to `unread`.
fn placed<'s>(store: &'s Store, unread: &mut Vec<(String, String)>) -> Vec<Placed<'s>> {
    let key = |array: &Array, axis: usize| array.table.clone().map_or_else(|| Key::of(&array.axes[axis]), Key::Table);
    let alone: Vec<Placed<'_>> = store
        .arrays
        .iter()
        .filter(|array| array.axes.len() == 1)
        .map(|array| Placed { array, rows: 0, key: key(array, 0) })
        .collect();
    let timed: Vec<&Key> = alone.iter().filter(|one| one.is_time()).map(|one| &one.key).collect();
    let known: Vec<&Key> = alone.iter().map(|one| &one.key).collect();
    let mut found = Vec::new();
    for array in &store.arrays {
        let rows = match array.axes.as_slice() {
            [] => continue,
            [_] => Some(0),
            [first, second] => {
                let order = if store.is_matlab { [1, 0] } else { [0, 1] };
                let like = |keys: &[&Key]| order.into_iter().find(|axis| keys.contains(&&key(array, *axis)));
                let longer =
                    if first.length == second.length { order[0] } else { usize::from(second.length > first.length) };
                let rows = if array.table.is_some() { Some(0) } else { like(&timed).or_else(|| like(&known)) };
                let rows = rows.unwrap_or(longer);
                Some(rows).filter(|rows| array.axes[1 - rows].length <= FEW)
            }
            _ => None,
        };
        match rows {
            Some(rows) if array.axes[rows].length > 0 => found.push(Placed { array, rows, key: key(array, rows) }),
            Some(_) => {}
            None => {
                let lengths: Vec<String> = array.axes.iter().map(|axis| axis.length.to_string()).collect();
                unread.push((array.name.clone(), format!("{} values", lengths.join(" × "))));
            }
        }
    }
    found
}

/// Arrays of one length that stand in groups with times of their own are tables of their own.
fn by_group<'p, 's>(members: &[&'p Placed<'s>]) -> Vec<Vec<&'p Placed<'s>>> {
    let timed: BTreeSet<&str> =
        members.iter().filter(|one| one.is_time()).map(|one| one.array.group.as_str()).collect();
    if timed.len() < 2 {
        return vec![members.to_vec()];
    }
    // The nearest group around an array that has a time.
    let home = |group: &str| {
        let mut group = group.to_owned();
        while !timed.contains(group.as_str()) && !group.is_empty() {
            group.truncate(group.rfind('/').unwrap_or(0));
        }
        group
    };
    let mut tables: Vec<(String, Vec<&Placed<'_>>)> = Vec::new();
    for one in members {
        let home = home(&one.array.group);
        match tables.iter_mut().find(|(group, _)| *group == home) {
            Some((_, members)) => members.push(one),
            None => tables.push((home, vec![one])),
        }
    }
    tables.into_iter().map(|(_, members)| members).collect()
}

impl Table {
    fn of(key: &Key, members: &[&Placed<'_>], store: &Store) -> Self {
        let mut table = Self {
            name: name_of(key, members),
            rows: members.iter().map(|one| one.length()).max().unwrap_or(0),
            columns: Vec::new(),
            time: time_of(key, members),
            called_times: called_times(members),
            timed: members.iter().any(|one| one.is_time()),
            no_moments: Vec::new(),
            long_names: Vec::new(),
        };
        for one in members {
            table.add(one, store);
        }
        table
    }

    /// Adds the columns of an array.
    fn add(&mut self, one: &Placed<'_>, store: &Store) {
        let array = one.array;
        let axis = &array.axes[one.rows];
        let beside = array.axes.iter().enumerate().find(|(at, _)| *at != one.rows).map(|(_, axis)| axis);
        let count = beside.map_or(1, |axis| axis.length);
        for index in 0..usize::try_from(count).unwrap_or(0) {
            let name = if beside.is_some() { format!("{}[{index}]", array.name) } else { array.name.clone() };
            let offset = array.offset + index * beside.map_or(0, |axis| axis.stride);
            let (column, no_moments) = Column::of(array, (name, offset), (axis.stride, axis.length), store.fills);
            self.columns.push(column);
            self.no_moments.extend(no_moments);
        }
        let says_more =
            |long: &&str| !long.is_empty() && !long.eq_ignore_ascii_case(array.base()) && !one.has_moments();
        if let Some(long) = array.attributes.text("long_name").filter(says_more) {
            self.long_names.push((array.name.clone(), long.to_owned()));
        }
    }

    fn has_numbers(&self) -> bool {
        let is_channel = |column: &Column| column.kind.is_number() && !matches!(column.meaning, Meaning::Moment { .. });
        self.columns.iter().any(is_channel)
    }
}

fn name_of(key: &Key, members: &[&Placed<'_>]) -> String {
    let own = match key {
        Key::Table(name) | Key::Dimension(name) => name.clone(),
        Key::Length(_) => {
            let mut groups = members.iter().map(|one| one.array.group.as_str());
            let first = groups.next().unwrap_or("");
            groups.fold(first.to_owned(), |common, group| {
                let is_shared = |(a, b): &(&str, &str)| a == b;
                let parts: Vec<&str> =
                    common.split('/').zip(group.split('/')).take_while(is_shared).map(|(part, _)| part).collect();
                parts.join("/")
            })
        }
    };
    if own.is_empty() { "/".to_owned() } else { own }
}

/// Names of groups stand before those of times, which are known by their own.
fn called_times(members: &[&Placed<'_>]) -> Vec<String> {
    let named = |one: &&&Placed<'_>| one.array.axes.len() == 1 && one.array.name.contains('/');
    let mut times: Vec<&Placed<'_>> = members.iter().filter(named).filter(|one| one.is_time()).copied().collect();
    times.sort_by_key(|one| std::cmp::Reverse(time_rank(one.array.base())));
    times.iter().map(|one| one.array.name.clone()).collect()
}

/// The column of the time, as far as the file says: of several the coordinate of the dimension, or what is called so.
fn time_of(key: &Key, members: &[&Placed<'_>]) -> Option<String> {
    let rank = |one: &&Placed<'_>| {
        let about = &one.array.attributes;
        let named = about.text("standard_name") == Some("time") || about.text("axis") == Some("T");
        let coordinate = matches!(key, Key::Dimension(name) if *name == one.array.name);
        let moments = one.has_moments();
        (moments || named).then_some((moments, coordinate, named, time_rank(one.array.base())))
    };
    let ranked = members.iter().enumerate().filter(|(_, one)| one.array.axes.len() == 1);
    let ranked = ranked.filter_map(|(at, one)| Some(((rank(one)?, usize::MAX - at), one)));
    ranked.max_by_key(|(rank, _)| *rank).map(|(_, one)| one.array.name.clone())
}
