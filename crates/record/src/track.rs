//! A tracking record: times, channels, and what the loader understood of the file they came from.
//!
//! A [`Track`] keeps numbers only. Text of the file (a time as it was written, a cell byte for byte) is read again
//! from the [`Source`] when an output needs it, through the same tokeniser, so that memory holds a record once.

use std::path::PathBuf;
use std::sync::Arc;

use crate::memory::Share;

mod add_columns;
#[cfg(feature = "hdf5")]
mod arrays;
mod axis;
mod body;
mod built_in;
mod calendar;
mod cells;
mod checks;
mod chunk;
mod column_roles;
mod columnar;
mod csv_injection;
mod extent;
mod facts;
mod feed;
mod formats;
mod head;
mod in_memory;
mod keywords;
mod lines;
mod load;
mod mend;
mod multi_track;
mod names;
mod notes;
mod number;
mod odd;
mod options;
mod order;
mod outputs;
mod packing;
mod parallel_parse;
mod preview;
mod printable;
mod quick;
mod rewrite;
mod rows;
mod samples;
mod sniff;
mod spool;
mod standing;
mod streaming_load;
mod style;
mod table;
mod text;
mod time;
mod timestamp;
mod timing;
mod tokens;
mod unsupported;
mod view;
mod wanted;
mod windows_1252;

pub use add_columns::{NewColumn, rewrite_beside, widen};
pub use calendar::{DAY as NANOSECONDS_PER_DAY, SECONDS_PER_DAY};
pub use cells::Cells;
pub use checks::RowChecks;
pub use columnar::{CopyForm, FlagForm, copy_form, names_arrays, names_columns, write_columns};
pub use csv_injection::escape_formula;
pub use extent::Extent;
pub use formats::{FORMATS, Format, format_of};
pub use in_memory::{ChannelValues, NO_MOMENT, moment_of, number_of, unit_in_name};
pub use keywords::{TimeUnit, Worded};
pub use lines::{FileLine, LinePart, first_lines};
pub use load::{load, load_extent, load_while};
pub use multi_track::Target;
pub use names::{is_id, is_spread};
pub use number::{Cell, Reading, number_text, without_signed_zero};
pub use options::{LoadOptions, Rules};
#[cfg(any(test, feature = "faults"))]
pub use outputs::faults;
pub use outputs::{Outputs, take_unfinished_away};
pub use packing::{PACKINGS, Packing, unpacked_name};
pub use preview::Preview;
pub use printable::{is_hidden, is_shown, printable, printable_json, printable_lines};
pub use rewrite::{CellChange, Changes, NewRow, cell_text, rewrite};
pub use rows::for_each_row;
pub use samples::Samples;
pub use spool::{DASH, Spool};
pub use standing::{Lost, Standing, covered};
pub use style::Style;
pub use text::hex;
pub use time::{DateOrder, Part, Pattern, Zero, Zone};
pub use unsupported::refused;
pub use wanted::Wanted;
pub use wildpoint_core::series::{Series, lost_samples};

/// Where the bytes of a record come from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Source {
    /// A file.
    File(PathBuf),
    /// Bytes that the program makes itself, under a name like `wildpoint:demo`.
    BuiltIn {
        /// The name that a session file gives as its data.
        name: &'static str,
        /// The bytes, in the form of a CSV file.
        bytes: Arc<[u8]>,
    },
    /// Standard input, in a file that is there as long as this.
    Input(Spool),
}

/// A record as it was loaded.
#[derive(Debug, Clone)]
pub struct Track {
    /// Where it came from.
    pub source: Source,
    /// SHA-256 of the bytes of the source as they are stored (compressed, if it is), in lower-case hexadecimal.
    pub sha256: String,
    /// How many bytes those are: a file may have been appended to since.
    pub bytes: u64,
    /// How the text is laid out.
    pub dialect: Dialect,
    /// Data rows, whatever they hold.
    pub rows: usize,
    /// Every column of the file, in order.
    pub columns: Vec<Column>,
    /// The time of each row.
    pub time: TimeAxis,
    /// The numeric columns that were loaded, in the order of the file (or of the user's list).
    pub channels: Vec<Channel>,
    /// The truth column, where there is one: true marks a real outlier.
    pub truth: Option<Vec<bool>>,
    /// True when the user named the truth column, false when it was recognised.
    pub truth_told: bool,
    /// What could not be used, with line numbers.
    pub faults: Faults,
    /// What the user should know before trusting the record, in plain words.
    pub notes: Vec<String>,
    /// The memory that it takes.
    pub share: Arc<Share>,
}

/// How a text file lays out its cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dialect {
    /// The field separator.
    pub delimiter: Delimiter,
    /// The quote character, where cells may be quoted.
    pub quote: Option<u8>,
    /// True when a comma is the decimal sign.
    pub decimal_comma: bool,
    /// How the bytes encode text.
    pub encoding: Encoding,
    /// How the bytes are packed.
    pub packing: Option<&'static Packing>,
    /// True when the first line that is not a comment names the columns.
    pub header: bool,
    /// True when a line of units follows the header.
    pub units_row: bool,
    /// Cells that mean "no value", besides the empty cell and the usual markers (NaN, NA, N/A, null, none, -, --).
    pub missing: Vec<String>,
    /// Lines before the first data row that are neither comments nor blank: titles, header, units.
    pub preamble: usize,
    /// Where the rows stand, and what stands among them without being one.
    pub rows: RowsAt,
    /// For each column, how its numbers are written; none where they are written as shortly as they can be.
    pub styles: Vec<Option<Style>>,
    /// True where every row has the same length, and cells stand below each other.
    pub fixed_width: bool,
    /// The format that makes a table of the text, where its lines are no rows of one.
    pub view: Option<Viewed>,
}

/// A table that a format makes of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Viewed {
    /// The format.
    pub format: &'static Format,
    /// Which of several tables, from 1. None: that with the most rows.
    pub table: Option<usize>,
}

/// Where the rows of a table stand in the text.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct RowsAt {
    /// Offset of the first row in the text after its byte order mark.
    pub(crate) start: usize,
    /// Its line, from 1.
    pub(crate) line: u64,
    /// Offset and length of the line of names, where there is one.
    pub(crate) header: Option<(usize, usize)>,
    /// Offset and length of the line of units.
    pub(crate) units: Option<(usize, usize)>,
    /// Offset of what follows the last row, where another table does.
    pub(crate) end: Option<usize>,
    /// Lines of text below the last row.
    pub(crate) footer: usize,
    /// Lines that come again among the rows and are none: header and units.
    pub(crate) repeats: Vec<Vec<u8>>,
    /// What comments begin with, besides `#`, `%` and `//`.
    pub(crate) mark: Option<tokens::Mark>,
    /// The format of the file, where one is known.
    pub(crate) format: Option<&'static Format>,
    /// The format of the file, where it has no place for columns beside its own.
    pub(crate) closed: Option<&'static Format>,
    /// In a table that a format makes of a text: the lines of the text where its first rows begin.
    pub(crate) made_of: Vec<u64>,
    /// Which of the tables that the file stores, from 1, where it stores some and the user says.
    pub(crate) table: Option<usize>,
}

impl RowsAt {
    /// True where a line names the columns.
    #[must_use]
    pub fn names_columns(&self) -> bool {
        self.header.is_some()
    }

    /// The line of the first row, from 1.
    #[must_use]
    pub fn first_line(&self) -> u64 {
        self.made_of.first().copied().unwrap_or(self.line)
    }

    /// Lines of text below the last row.
    #[must_use]
    pub fn lines_below(&self) -> usize {
        self.footer
    }

    /// What comments begin with, besides `#`, `%` and `//`.
    #[must_use]
    pub fn comment(&self) -> Option<String> {
        self.mark.map(|mark| String::from_utf8_lossy(mark.bytes()).into_owned())
    }

    /// The format of the file, where one is known by its name.
    #[must_use]
    pub fn format(&self) -> Option<&'static Format> {
        self.format
    }
}

/// The field separator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Delimiter {
    /// One byte: comma, semicolon, tab or pipe.
    Byte(u8),
    /// A run of blanks and tabs.
    Blanks,
}

/// How the bytes of a file encode text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// UTF-8, of which ASCII is a part; `bom` when it starts with a byte order mark.
    Utf8 {
        /// True when the file starts with a byte order mark.
        bom: bool,
    },
    /// UTF-16, with its byte order mark.
    Utf16 {
        /// True for big-endian.
        big_endian: bool,
    },
    /// Bytes above 127 that are not UTF-8: read as Windows-1252, of which Latin-1 is a part.
    Latin1,
}

/// A column of the file.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name as it is in the header (made unique), or `column_3` where there is none.
    pub name: String,
    /// Its unit, as far as name or units row tell; empty when they do not.
    pub unit: String,
    /// What the loader takes it for.
    pub kind: ColumnKind,
    /// How many cells hold no value.
    pub missing: usize,
}

/// What the loader takes a column for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// The time of the row.
    Time,
    /// Numbers.
    Number,
    /// 0 and 1, where 1 marks a real outlier.
    Truth,
    /// The id of the track that the row belongs to.
    Track,
    /// Numbers that are no measurement: an index, an id, a flag. A channel only if it is asked for.
    Aside(Aside),
    /// Something else, kept in the output and otherwise left alone.
    Text,
    /// No cell holds a value.
    Empty,
}

impl ColumnKind {
    /// Its word for people.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Number => "number",
            Self::Truth => "truth",
            Self::Track => "track",
            Self::Aside(aside) => aside.word(),
            Self::Text => "text",
            Self::Empty => "empty",
        }
    }
}

/// Why a column of numbers is not a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aside {
    /// Another time than that of the rows, or a part of it.
    Time,
    /// The number of the row.
    Index,
    /// A number that counts up.
    Counter,
    /// It tells what the row is about.
    Id,
    /// Two values.
    Flag,
    /// Few whole values, under a name of quality.
    Quality,
    /// One value.
    Constant,
    /// It tells how an instrument was set, beside the first rows.
    Setting,
}

impl Aside {
    /// Its word for people.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Index => "index",
            Self::Counter => "counter",
            Self::Id => "id",
            Self::Flag => "flag",
            Self::Quality => "quality",
            Self::Constant => "constant",
            Self::Setting => "setting",
        }
    }

    /// Why it is not a channel, in words.
    #[must_use]
    pub fn why(self) -> &'static str {
        match self {
            Self::Time => "a time, or a part of one",
            Self::Index => "it counts the rows",
            Self::Counter => "it counts up",
            Self::Id => "it tells what a row is about",
            Self::Flag => "it holds two values",
            Self::Quality => "it holds few values, under a name of quality",
            Self::Constant => "it holds one value",
            Self::Setting => "settings beside the first rows",
        }
    }
}

/// One measured quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Name of its column.
    pub name: String,
    /// Unit, or empty.
    pub unit: String,
    /// Index of its column in [`Track::columns`].
    pub column: usize,
    /// Its target, in a table of several tracks; none where all rows are one track.
    pub target: Option<Target>,
    /// One value per row (of its target, where it has one); NaN where there is none.
    pub values: Vec<f64>,
}

impl Channel {
    /// The unit, where the name does not end with it in brackets.
    #[must_use]
    pub fn unit_beside_name(&self) -> &str {
        let within = |open: char, close: char| {
            self.name
                .strip_suffix(close)
                .and_then(|rest| rest.rsplit_once(open))
                .is_some_and(|(_, unit)| unit == self.unit)
        };
        if within('[', ']') || within('(', ')') { "" } else { &self.unit }
    }
}

/// The times of a record.
#[derive(Debug, Clone, PartialEq)]
pub struct TimeAxis {
    /// Name of the column, or `sample` for the sample number.
    pub name: String,
    /// Index of the column; none for the sample number.
    pub column: Option<usize>,
    /// Index of the column of the date, where date and time of day stand apart; `column` is then the time of day.
    pub date_column: Option<usize>,
    /// Indices of the columns of [`TimeFormat::Parts`], in their order; `column` is then the finest.
    pub part_columns: Vec<usize>,
    /// The zone of clocks that write none; UTC without one.
    pub zone: Option<Zone>,
    /// Whether anything tells the zone of the clocks.
    pub clocks: Clocks,
    /// True when the newest row stands first.
    pub newest_first: bool,
    /// How the file writes times.
    pub format: TimeFormat,
    /// The time that is 0 in [`TimeAxis::seconds`], in nanoseconds: since 1970 for calendar formats, since the
    /// file's own zero for others.
    pub origin_ns: i128,
    /// One time per row in seconds after the origin, strictly increasing (in a table of several tracks: over the rows
    /// of each); NaN where the row has no usable time (none, unreadable, repeated, or before an earlier row).
    pub seconds: Vec<f64>,
}

/// Whether anything tells the zone of the clocks of a file.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Clocks {
    /// The cells, the name of the column, the format of the file or the user; or the times are those of no clock.
    #[default]
    Stated,
    /// Nothing does: they are taken as those of UTC, and not called so.
    Unstated,
}

/// How a file writes times.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TimeFormat {
    /// No time column: the row number, counted from 0 at one a second.
    SampleNumber,
    /// A number of seconds from a zero of the file's own.
    Seconds,
    /// A number from a zero of the file's own, in units of this many nanoseconds (milliseconds, days, …).
    Elapsed {
        /// Nanoseconds in one unit.
        unit_ns: i64,
    },
    /// A number since 1970, in units of this many nanoseconds (1 000 000 000, 1 000 000, 1 000 or 1).
    Epoch {
        /// Nanoseconds in one unit.
        unit_ns: i64,
    },
    /// A date and time in ISO order: `2019-11-11T17:57:05Z`, `2019-01-01 00:00`.
    Iso,
    /// A date with the year last, and perhaps a time: `3/23/2005 17:00`, `23.03.2005`.
    YearLast {
        /// True when the day stands before the month.
        day_first: bool,
    },
    /// A time of day: `17:57:05.25`. A step back of more than half a day is the next day.
    Clock,
    /// A number of units of this many nanoseconds since a known moment: days of a spreadsheet, GPS seconds.
    Since {
        /// Nanoseconds in one unit.
        unit_ns: i64,
        /// The moment.
        zero: Zero,
    },
    /// A year with decimals: `2010.0027`.
    DecimalYear,
    /// A date and time in another spelling: `04 Mar 2021 10:00`, `20210304T1000Z`.
    Stamp {
        /// How dates of short numbers are meant.
        order: DateOrder,
    },
    /// As the user says.
    Pattern(Pattern),
    /// Time elapsed, with colons: `26:03:00`, `03:07.5`.
    Duration,
    /// Several columns together.
    Parts(Vec<Part>),
}

/// Rows and cells that could not be used, counted, the first few with their line numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Faults {
    /// Rows whose time is the same as that of an earlier row.
    pub repeated_times: Fault,
    /// Rows whose time lies before that of an earlier row.
    pub backward_times: Fault,
    /// Rows without a readable time.
    pub unreadable_times: Fault,
    /// Cells of numeric columns that hold something else than a number or a missing marker.
    pub unreadable_cells: Fault,
    /// Rows with fewer or more cells than the header (one empty cell more, made by a delimiter at the end of every
    /// row, is none).
    pub ragged_rows: Fault,
    /// Numbers too large for a double, taken as missing.
    pub infinite_cells: Fault,
    /// Rows whose time lies far from those around it, which go on without it.
    pub wild_times: Fault,
}

impl Faults {
    /// Takes each line for the one that `of` gives for it.
    pub(crate) fn move_lines(&mut self, of: impl Fn(u64) -> u64) {
        let faults = [
            &mut self.repeated_times,
            &mut self.backward_times,
            &mut self.unreadable_times,
            &mut self.unreadable_cells,
            &mut self.ragged_rows,
            &mut self.infinite_cells,
            &mut self.wild_times,
        ];
        for (line, _) in faults.into_iter().flat_map(|fault| &mut fault.first) {
            *line = of(*line);
        }
    }

    /// The kinds of which there are any.
    pub fn kinds(&self) -> impl Iterator<Item = (FaultKind, &Fault)> {
        let faults = [
            &self.repeated_times,
            &self.backward_times,
            &self.unreadable_times,
            &self.unreadable_cells,
            &self.ragged_rows,
            &self.infinite_cells,
            &self.wild_times,
        ];
        FAULT_KINDS.into_iter().zip(faults).filter(|(_, fault)| fault.count > 0)
    }
}

/// A kind of fault, in words.
#[derive(Debug, Clone, Copy)]
pub struct FaultKind {
    /// Its name in JSON.
    pub name: &'static str,
    one: &'static str,
    many: &'static str,
}

/// In the order of the fields of [`Faults`].
const FAULT_KINDS: [FaultKind; 7] = [
    FaultKind { name: "repeated times", one: "repeated time", many: "repeated times" },
    FaultKind { name: "backward times", one: "time that goes back", many: "times that go back" },
    FaultKind { name: "unreadable times", one: "unreadable time", many: "unreadable times" },
    FaultKind { name: "unreadable cells", one: "unreadable cell", many: "unreadable cells" },
    FaultKind {
        name: "rows with fewer or more cells than columns",
        one: "row with fewer or more cells than columns",
        many: "rows with fewer or more cells than columns",
    },
    FaultKind {
        name: "numbers too large for a double",
        one: "number too large for a double",
        many: "numbers too large for a double",
    },
    FaultKind { name: "wild times", one: "wild time", many: "wild times" },
];

impl FaultKind {
    /// What goes with a count: `repeated time` with 1, else `repeated times`.
    #[must_use]
    pub fn words(self, count: usize) -> &'static str {
        if count == 1 { self.one } else { self.many }
    }
}

/// One kind of fault.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fault {
    /// How many.
    pub count: usize,
    /// The first few: line in the file (from 1) and what stands there.
    pub first: Vec<(u64, String)>,
}

impl Fault {
    /// How many faults of a kind are kept with their line.
    pub const KEPT: usize = 5;

    /// Counts one more.
    pub fn add(&mut self, line: u64, what: &str) {
        self.count += 1;
        if self.first.len() < Self::KEPT {
            self.first.push((line, what.chars().take(60).collect()));
        }
    }
}

impl TimeFormat {
    /// How times are written, in words.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::SampleNumber => "sample number".into(),
            Self::Seconds => "seconds".into(),
            Self::Epoch { unit_ns } => format!("{} since 1970", TimeUnit { ns: *unit_ns }.name()),
            Self::Elapsed { unit_ns } => TimeUnit { ns: *unit_ns }.name(),
            Self::YearLast { day_first: true } => "day/month/year".into(),
            Self::YearLast { day_first: false } => "month/day/year".into(),
            Self::Iso => "ISO 8601".into(),
            Self::Clock => "time of day".into(),
            Self::Since { unit_ns, zero } => format!("{} {}", TimeUnit { ns: *unit_ns }.name(), zero.words()),
            Self::DecimalYear => "years with decimals".into(),
            Self::Stamp { order: DateOrder::YearFirst } => "date and time".into(),
            Self::Stamp { order: DateOrder::DayFirst } => "date and time, day first".into(),
            Self::Stamp { order: DateOrder::MonthFirst } => "date and time, month first".into(),
            Self::Pattern(pattern) => pattern.text().to_owned(),
            Self::Duration => "time elapsed".into(),
            Self::Parts(parts) if parts.len() > 1 => format!("{} columns together", parts.len()),
            Self::Parts(_) => "time of day, in digits".into(),
        }
    }
}

impl Track {
    /// A value as a cell of a channel has it: with the decimals of its column.
    #[must_use]
    pub fn rounded(&self, channel: &Channel, value: f64) -> f64 {
        match self.dialect.styles.get(channel.column) {
            Some(Some(style)) if value.is_finite() => style.rounded(value),
            _ => value,
        }
    }

    /// The truth about a channel: the truth column that the user named; one that was recognised only where its name
    /// fits, so that `vx_truth_outlier` is about `vx_mps` and not about `alt_m`.
    #[must_use]
    pub fn truth_for(&self, channel: &str) -> Option<&[bool]> {
        let truth = self.truth.as_deref()?;
        let mut columns = self.columns.iter().filter(|c| c.kind == ColumnKind::Truth);
        let about = match (&self.truth_told, columns.next()) {
            (false, Some(column)) => column.name.split("truth").next().unwrap_or("").trim_end_matches('_'),
            _ => "",
        };
        let is_about = |name: &str| name.starts_with(about);
        let numbers = self.columns.iter().filter(|c| c.kind == ColumnKind::Number || c.kind == ColumnKind::Text);
        (is_about(channel) || !numbers.into_iter().any(|c| is_about(&c.name))).then_some(truth)
    }

    /// The channel of this name.
    #[must_use]
    pub fn channel(&self, name: &str) -> Option<&Channel> {
        self.channels.iter().find(|c| c.name == name)
    }
}
