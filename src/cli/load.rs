//! The options of how a record is loaded.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use crate::track::{Delimiter, Encoding, LoadOptions, Pattern, Rules, TimeUnit, Worded};

/// How to load a record.
#[derive(Debug, Clone, Default, Args)]
pub struct Load {
    /// Time column, or several separated by commas (`date,time` or `year,month,day,hour`) [default: the column that looks
    /// like time, otherwise the sample number].
    #[arg(long, value_name = "COLUMN")]
    pub time: Option<String>,
    /// Channel to process; repeatable [default: every column of measurements; `inspect` says why a column is not one].
    #[arg(long, value_name = "COLUMN")]
    pub channel: Vec<String>,
    /// Column with the track id (satellite, aircraft, station), if the table holds several tracks. Each track is judged
    /// separately, with its own times. Its channels are named CHANNEL@ID; --channel CHANNEL takes those of all tracks.
    #[arg(long, value_name = "COLUMN")]
    pub track: Option<String>,
    /// Column in which 1 marks a true outlier, and 0 any other sample.
    #[arg(long, value_name = "COLUMN")]
    pub truth: Option<String>,
    /// Cell text for a missing value; repeatable, besides empty, NaN, NA, null and -.
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    pub missing: Vec<String>,
    /// Field separator [default: detected].
    #[arg(long, value_name = "WHAT", value_parser = worded::<Delimiter>())]
    pub delimiter: Option<Delimiter>,
    /// Text encoding, where no byte order mark gives it [default: UTF-8, or Latin-1 (Windows-1252) where the text is
    /// not UTF-8].
    #[arg(long, value_name = "WHICH", value_parser = worded::<Encoding>())]
    pub encoding: Option<Encoding>,
    /// Unit of numeric times [default: the one in the column name, otherwise seconds].
    #[arg(long, value_name = "UNIT", value_parser = worded::<TimeUnit>())]
    pub time_unit: Option<TimeUnit>,
    /// Numbers have a decimal comma [default: detected].
    #[arg(long)]
    pub decimal_comma: bool,
    /// The first line is data, not column names [default: detected].
    #[arg(long)]
    pub no_header: bool,
    /// Quotes are ordinary characters.
    #[arg(long)]
    pub no_quotes: bool,
    /// Order of dates like 1/2/2005, where the file does not show it.
    #[arg(long, value_enum, value_name = "ORDER")]
    pub dates: Option<DateOrder>,
    /// Time format: %d.%m.%Y %H:%M:%S%.f (%j day of the year, %b month, %p AM/PM, %z zone) [default: detected].
    #[arg(long, value_name = "PATTERN", value_parser = pattern)]
    pub time_format: Option<Pattern>,
    /// Time zone of times without one, like Europe/Berlin or +01:00 [default: UTC].
    #[arg(long, value_name = "ZONE")]
    pub time_zone: Option<String>,
    /// Line (from 1) with the column names [default: detected from the rows below it].
    #[arg(long, value_name = "N", value_parser = from_one)]
    pub header_line: Option<usize>,
    /// Lines to skip at the start of the file.
    #[arg(long, value_name = "N")]
    pub skip: Option<usize>,
    /// Line (from 1) with the units of the columns.
    #[arg(long, value_name = "N", value_parser = from_one)]
    pub units_line: Option<usize>,
    /// Prefix of comment lines, besides #, % and //.
    #[arg(long, value_name = "TEXT", value_parser = mark)]
    pub comment: Option<String>,
    /// Column names, separated by commas, replacing those of the file; an empty one keeps the name.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub names: Vec<String>,
    /// Which table to read, if the file has several (from 1) [default: the longest].
    #[arg(long, value_name = "N", value_parser = from_one)]
    pub table: Option<usize>,
}

fn pattern(text: &str) -> std::result::Result<Pattern, String> {
    Pattern::new(text).map_err(|e| e.to_string())
}

fn from_one(text: &str) -> std::result::Result<usize, String> {
    text.parse().ok().filter(|n| *n > 0).ok_or_else(|| "expected a whole number from 1".into())
}

fn mark(text: &str) -> std::result::Result<String, String> {
    let fits = (1..=16).contains(&text.len());
    if fits { Ok(text.to_owned()) } else { Err("expected 1 to 16 bytes".into()) }
}

/// One of the words for a value.
pub(super) fn worded<T: Worded>() -> impl TypedValueParser<Value = T> {
    let words: Vec<&'static str> = T::WORDS.iter().map(|(word, _)| *word).collect();
    PossibleValuesParser::new(words).try_map(|word| T::of_word(&word).ok_or("not one of the words"))
}

/// How dates with the year last are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DateOrder {
    /// 1/2/2005 is in February.
    DayFirst,
    /// 1/2/2005 is in January.
    MonthFirst,
}

impl Load {
    /// What the loader needs; the rate channel is loaded beside the channels that were named.
    #[must_use]
    pub fn options(&self, rate: Option<&str>) -> LoadOptions {
        LoadOptions {
            time: self.time.clone(),
            channels: self.channel.clone(),
            beside: rate.map(str::to_owned).into_iter().collect(),
            truth: self.truth.clone(),
            track: self.track.clone(),
            missing: self.missing.clone(),
            delimiter: self.delimiter,
            encoding: self.encoding,
            time_unit: self.time_unit,
            decimal_comma: self.decimal_comma.then_some(true),
            header: self.no_header.then_some(false),
            quotes: self.no_quotes.then_some(false),
            day_first: self.dates.map(|d| d == DateOrder::DayFirst),
            time_format: self.time_format.clone(),
            time_zone: self.time_zone.clone(),
            header_line: self.header_line,
            skip: self.skip,
            units_line: self.units_line,
            comment: self.comment.clone(),
            names: self.names.clone(),
            table: self.table,
            rules: Rules::default(),
        }
    }
}
