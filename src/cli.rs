//! The command line: what can be typed, and what it means.

use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::error::{Error, Result};
use crate::method::shared::MAX_GAP;
use crate::repair;
use crate::session::{DEFAULT_METHOD, Preset, SCHEMES, Scheme, Setup, method_of_id};
use crate::track::{DASH, Delimiter, Encoding, LoadOptions, Pattern, Rules, TimeUnit, Worded};

mod advise;
mod experiments;
mod parse;
mod prepare;
mod screen;
mod tools;

pub use advise::AdviseArgs;
pub use experiments::{InjectArgs, ReproduceArgs, SimulateArgs};
use parse::{memory_size, pair, size};
pub use prepare::PrepareArgs;
pub use screen::{Color, ConfigArgs, Glyphs};
pub use tools::{CompareArgs, FormatArg, JudgeArgs, StreamArgs, SweepArgs};

/// Find, review and repair wild points of tracking records.
///
/// Without a command: opens the workbench on FILE, on a SESSION saved before, or on the built-in demonstration
/// record. Where there is no terminal, prints one still frame and a summary.
#[derive(Debug, Parser)]
#[command(name = "wildpoint", version, args_conflicts_with_subcommands = true, max_term_width = 100)]
pub struct Cli {
    /// What to do without a screen.
    #[command(subcommand)]
    pub command: Option<Task>,
    /// A record (CSV and relatives), or a session (.toml).
    pub file: Option<PathBuf>,
    /// Size of the still frame that is printed where there is no terminal: WIDTHxHEIGHT.
    #[arg(long, value_name = "WxH", default_value = "80x24", value_parser = size)]
    pub size: (u16, u16),
    /// Colours of the screen.
    #[arg(long, value_enum, default_value_t = Color::Auto)]
    pub color: Color,
    /// Glyphs of the screen.
    #[arg(long, value_enum, default_value_t = Glyphs::Auto)]
    pub glyphs: Glyphs,
    /// Colours for a light background.
    #[arg(long)]
    pub light: bool,
    /// Leave the mouse to the terminal, which then selects text with it (M changes it).
    #[arg(long)]
    pub no_mouse: bool,
    /// Which configuration to take.
    #[command(flatten)]
    pub config: ConfigArgs,
    /// Memory that records and results may take, as in 500M and 4G [default: half of what the machine has].
    #[arg(long, value_name = "SIZE", global = true, value_parser = memory_size)]
    pub memory: Option<u64>,
    /// Keep no journal: what is not saved is lost when the workbench is killed.
    #[arg(long)]
    pub no_journal: bool,
    /// How to load and judge.
    #[command(flatten)]
    pub shared: Shared,
}

/// The word of `--method` for the one that is recommended.
pub const AUTO: &str = "auto";

/// Everything that is named by a word.
#[expect(clippy::large_enum_variant, reason = "there is one, and it is taken apart at once")]
#[derive(Debug, Subcommand)]
pub enum Task {
    /// What needs no screen.
    #[command(flatten)]
    Batch(Command),
    /// Print the keys of the workbench that are in force, as a configuration.
    Keys(ConfigArgs),
}

/// The commands that need no screen.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Print what the loader understands of a file: columns, times, gaps, noise, bad rows.
    Inspect {
        /// The record.
        file: PathBuf,
        /// How to load it.
        #[command(flatten)]
        load: Load,
        /// Print JSON.
        #[arg(long)]
        json: bool,
    },
    /// Detect and repair wild points of one file or many.
    ///
    /// With several files the outputs are folders (`-o DIR/`, `--flags DIR/`, ...): the cleaned file keeps its name,
    /// the others are NAME.changed.csv, NAME.flags.csv, NAME.diagnostics.csv, NAME.html and NAME.toml. A file that fails does not stop the
    /// others; the exit status is 2 then.
    Clean {
        /// The records.
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
        /// How to load and judge it.
        #[command(flatten)]
        shared: Shared,
        /// Take the multiplier (k or c) that `wildpoint sweep` suggests for each channel; where it suggests none, the
        /// one that is set stays. The session says so.
        #[arg(long)]
        suggest: bool,
        /// What to write.
        #[command(flatten)]
        outputs: OutputArgs,
        /// Write the session that would reproduce this.
        #[arg(long, value_name = "SESSION")]
        save_session: Option<PathBuf>,
    },
    /// Run saved sessions again.
    ///
    /// With several sessions the outputs are folders (`-o DIR/`, `--flags DIR/`, ...), in which files are named after
    /// the sessions. A session that fails does not stop the others; the exit status is 2 then, and 1 when only
    /// comparisons failed.
    Replay {
        /// Session files.
        #[arg(required = true, value_name = "SESSION")]
        sessions: Vec<PathBuf>,
        /// Compare with the result that each session recorded; write nothing. Exit status 1 when one differs.
        #[arg(long, conflicts_with_all = ["output", "flag_columns", "changed", "flags", "diagnostics", "report"])]
        check: bool,
        /// Go on although the data are not those of the session.
        #[arg(long)]
        accept_changed_data: bool,
        /// Judge rows too that were added to the end of a record since its session was saved; every decision stays. With
        /// --check they are left out, since the recorded result has none of them.
        #[arg(long)]
        accept_appended: bool,
        /// What to write.
        #[command(flatten)]
        outputs: OutputArgs,
        /// Threads to use; all cores by default.
        #[arg(long, value_name = "N")]
        threads: Option<usize>,
    },
    /// Count outliers along a parameter, and suggest a threshold.
    #[command(long_about = tools::SWEEP, mut_arg("channel", one_channel))]
    Sweep(SweepArgs),
    /// Every method on one channel, side by side.
    #[command(long_about = tools::COMPARE, mut_arg("channel", one_channel))]
    Compare(CompareArgs),
    /// Which method finds most on this record, measured on the record itself.
    #[command(long_about = advise::ADVISE, mut_arg("channel", one_channel))]
    Advise(AdviseArgs),
    /// Judge samples from standard input as they arrive.
    #[command(long_about = tools::STREAM, mut_arg("channel", one_channel))]
    Stream(StreamArgs),
    /// List the methods, or explain one with its parameters.
    Methods {
        /// Id of a method.
        id: Option<String>,
        /// Print JSON.
        #[arg(long)]
        json: bool,
        /// Print the table of the README.
        #[arg(long, hide = true)]
        markdown: bool,
    },
    /// Write the data of a published experiment.
    Simulate(SimulateArgs),
    /// Run the published experiments and print their tables beside ours.
    Reproduce(ReproduceArgs),
    /// Add known wild points to a record, with truth.
    #[command(mut_arg("channel", one_channel))]
    Inject(InjectArgs),
    /// Print shell completions.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page.
    Man,
}

impl Command {
    /// True when it prints nothing but errors.
    #[must_use]
    pub fn is_quiet(&self) -> bool {
        match self {
            Self::Clean { outputs, .. } | Self::Replay { outputs, .. } => {
                outputs.quiet && !outputs.json && !outputs.takes_standard_output()
            }
            _ => false,
        }
    }
}

/// How to load a record.
#[derive(Debug, Clone, Default, Args)]
pub struct Load {
    /// Time column, or several with commas between them (`date,time` or `year,month,day,hour`) [default: what looks like
    /// time, else the sample number].
    #[arg(long, value_name = "COLUMN")]
    pub time: Option<String>,
    /// Channel to work on; repeatable [default: every column of measurements; not
    /// times, ids, flags and constants, for which `inspect` says why].
    #[arg(long, value_name = "COLUMN")]
    pub channel: Vec<String>,
    /// Column of an id (satellite, aircraft, station) that tells several tracks in one table apart: each is judged by
    /// itself, with times of its own. Its channels are called CHANNEL@ID; --channel takes that, or CHANNEL for all.
    #[arg(long, value_name = "COLUMN")]
    pub track: Option<String>,
    /// Column of 0 and 1 that marks the real outliers.
    #[arg(long, value_name = "COLUMN")]
    pub truth: Option<String>,
    /// A cell text that means "no value"; repeatable, besides empty, NaN, NA, null and -.
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    pub missing: Vec<String>,
    /// What stands between two cells [default: recognised].
    #[arg(long, value_name = "WHAT", value_parser = worded::<Delimiter>())]
    pub delimiter: Option<Delimiter>,
    /// How the bytes of the text are meant, where no byte order mark says so [default: UTF-8, or Latin-1 (Windows-1252)
    /// where it is none].
    #[arg(long, value_name = "WHICH", value_parser = worded::<Encoding>())]
    pub encoding: Option<Encoding>,
    /// Unit of times that are numbers [default: that in the name of the column, otherwise seconds].
    #[arg(long, value_name = "UNIT", value_parser = worded::<TimeUnit>())]
    pub time_unit: Option<TimeUnit>,
    /// `1,5` means one and a half [default: recognised].
    #[arg(long)]
    pub decimal_comma: bool,
    /// The first line is data, not names [default: recognised].
    #[arg(long)]
    pub no_header: bool,
    /// Quotes are ordinary characters.
    #[arg(long)]
    pub no_quotes: bool,
    /// How dates like 1/2/2005 are meant, where the file does not show it.
    #[arg(long, value_enum, value_name = "ORDER")]
    pub dates: Option<DateOrder>,
    /// How times are written: %d.%m.%Y %H:%M:%S%.f (%j day of the year, %b month, %p AM/PM, %z zone) [default:
    /// recognised].
    #[arg(long, value_name = "PATTERN", value_parser = pattern)]
    pub time_format: Option<Pattern>,
    /// Zone of clocks that write none, like Europe/Berlin or +01:00 [default: UTC].
    #[arg(long, value_name = "ZONE")]
    pub time_zone: Option<String>,
    /// Line (from 1) that names the columns [default: recognised from the rows below it].
    #[arg(long, value_name = "N", value_parser = from_one)]
    pub header_line: Option<usize>,
    /// Lines at the start of the file that are not looked at.
    #[arg(long, value_name = "N")]
    pub skip: Option<usize>,
    /// Line (from 1) of the units of the columns.
    #[arg(long, value_name = "N", value_parser = from_one)]
    pub units_line: Option<usize>,
    /// What comments begin with, besides #, % and //.
    #[arg(long, value_name = "TEXT", value_parser = mark)]
    pub comment: Option<String>,
    /// Names of the columns, with commas between them, in place of those of the file; an empty one stays.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub names: Vec<String>,
    /// Which table of a file that has several (from 1) [default: the longest].
    #[arg(long, value_name = "N", value_parser = from_one)]
    pub table: Option<usize>,
}

fn pattern(text: &str) -> std::result::Result<Pattern, String> {
    Pattern::new(text).map_err(|e| e.to_string())
}

fn from_one(text: &str) -> std::result::Result<usize, String> {
    text.parse().ok().filter(|n| *n > 0).ok_or_else(|| "a whole number from 1 is wanted".into())
}

fn mark(text: &str) -> std::result::Result<String, String> {
    let fits = (1..=16).contains(&text.len());
    if fits { Ok(text.to_owned()) } else { Err("1 to 16 bytes are wanted".into()) }
}

/// One of the words for a value.
fn worded<T: Worded>() -> impl TypedValueParser<Value = T> {
    let words: Vec<&'static str> = T::WORDS.iter().map(|(word, _)| *word).collect();
    PossibleValuesParser::new(words).try_map(|word| T::of_word(&word).ok_or("not one of the words"))
}

/// One of the schemes of flags.
fn scheme() -> impl TypedValueParser<Value = &'static Scheme> {
    PossibleValuesParser::new(SCHEMES.iter().map(|scheme| scheme.id))
        .try_map(|id| Scheme::of(&id).ok_or("not one of the schemes"))
}

fn scheme_help() -> String {
    let schemes: Vec<String> = SCHEMES.iter().map(|scheme| format!("{} ({})", scheme.id, scheme.about())).collect();
    let what = "Add columns of flags at the right of the cleaned file, COLUMN_flag for each judged column";
    format!("{what}: {}", schemes.join("; "))
}

/// How dates with the year last are meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum DateOrder {
    /// 1/2/2005 is in February.
    DayFirst,
    /// 1/2/2005 is in January.
    MonthFirst,
}

/// How to load and judge a record.
#[derive(Debug, Clone, Default, Args)]
pub struct Shared {
    /// How to load it.
    #[command(flatten)]
    pub load: Load,
    /// Channel that measures the rate of the judged one, for methods that need one.
    #[arg(long, value_name = "COLUMN")]
    pub rate: Option<String>,
    /// Column of outlier-free values, which is not judged: the summary of `clean` then has the final error of the
    /// first judged channel, sqrt(mean((clean - reference)^2)) over the samples that have a value in the output.
    #[arg(long, value_name = "COLUMN")]
    pub reference: Option<String>,
    /// Method (see `wildpoint methods`); `clean` takes auto, too: for each channel the one that `wildpoint advise`
    /// recommends.
    #[arg(long, value_name = "ID", default_value = DEFAULT_METHOD)]
    pub method: String,
    /// Values to start from: those that work on real tracks, or those of the source documents.
    #[arg(long, value_enum, default_value_t = PresetArg::Default)]
    pub preset: PresetArg,
    /// A parameter of the method or the repair; repeatable (see `wildpoint methods ID`).
    #[arg(long, value_name = "KEY=VALUE", value_parser = pair)]
    pub set: Vec<(String, String)>,
    /// What is done with the channels before.
    #[command(flatten)]
    pub prepare: PrepareArgs,
    /// What takes the place of an outlier: own, remove, linear, spline, polynomial, expected.
    #[arg(long, value_name = "ID")]
    pub repair: Option<String>,
    /// Cut the record where more than this many samples are lost in a row.
    #[arg(long, value_name = "N|off")]
    pub max_gap: Option<String>,
    /// Longest run of outliers that is repaired (0: no limit).
    #[arg(long, value_name = "N")]
    pub max_fill: Option<String>,
    /// Fill missing samples too: off, cells, rows.
    #[arg(long, value_name = "WHAT")]
    pub fill_gaps: Option<String>,
    /// Threads to use; all cores by default.
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
}

/// What to write, and how.
#[derive(Debug, Clone, Default, Args)]
pub struct OutputArgs {
    /// Write the cleaned file: the input again, only repaired and removed cells differ; as Parquet where the name ends
    /// in .parquet.
    #[arg(short, long, value_name = "CLEANED")]
    pub output: Option<PathBuf>,
    /// Columns of flags in the cleaned file.
    #[arg(long, value_name = "SCHEME", requires = "output", value_parser = scheme(), help = scheme_help())]
    pub flag_columns: Option<&'static Scheme>,
    /// Write the changed cells alone: row, time, channel, old and new text, verdict, and who flagged it (CSV).
    #[arg(long, value_name = "CHANGED")]
    pub changed: Option<PathBuf>,
    /// Write the audit table: every flag with its evidence (CSV).
    #[arg(long, value_name = "FLAGS")]
    pub flags: Option<PathBuf>,
    /// Write a row for every sample (CSV).
    #[arg(long, value_name = "DIAG")]
    pub diagnostics: Option<PathBuf>,
    /// Write a report with pictures: one HTML file (.html) or one Markdown file (.md).
    #[arg(long, value_name = "REPORT")]
    pub report: Option<PathBuf>,
    /// Overwrite existing outputs (never the input).
    #[arg(long)]
    pub force: bool,
    /// Print a summary in JSON.
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(short, long)]
    pub quiet: bool,
}

impl OutputArgs {
    /// True when one of the outputs is standard output.
    #[must_use]
    pub fn takes_standard_output(&self) -> bool {
        self.on_standard_output(None) > 0
    }

    /// That standard output is one thing at most.
    ///
    /// # Errors
    /// [`Error::Usage`] when it is not.
    pub fn check_standard_output(&self, session: Option<&Path>) -> Result<()> {
        match self.on_standard_output(session) + usize::from(self.json) {
            0 | 1 => Ok(()),
            _ => Err(Error::usage("`-` is standard output, which takes one thing", "give the others names")),
        }
    }

    fn on_standard_output(&self, session: Option<&Path>) -> usize {
        let named =
            [&self.output, &self.changed, &self.flags, &self.diagnostics, &self.report].map(|path| path.as_deref());
        named.into_iter().chain([session]).flatten().filter(|path| *path == Path::new(DASH)).count()
    }
}

/// Which values a method starts with.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum PresetArg {
    /// Values that work on real tracks.
    #[default]
    Default,
    /// Values of the source documents.
    Paper,
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

impl Shared {
    /// True when the method is to be chosen for each channel.
    #[must_use]
    pub fn is_auto(&self) -> bool {
        self.method == AUTO
    }

    /// What is done with channels until their method is chosen: the default method, and the repair that was asked for.
    ///
    /// # Errors
    /// As [`Shared::setup`].
    pub fn setup_before_choice(&self) -> Result<Setup> {
        let of_repair = |key: &str| repair::PARAMS.iter().any(|p| p.key == key);
        let set = self.set.iter().filter(|(key, _)| of_repair(key)).cloned().collect();
        Self { method: DEFAULT_METHOD.to_owned(), set, ..self.clone() }.setup()
    }

    /// The settings of `--set` that are not those of the repair.
    #[must_use]
    pub fn method_settings(&self) -> Vec<(String, String)> {
        let of_repair = |key: &str| repair::PARAMS.iter().any(|p| p.key == key);
        self.set.iter().filter(|(key, _)| !of_repair(key)).cloned().collect()
    }

    /// Method, repair and their settings.
    ///
    /// # Errors
    /// [`crate::error::Error::Usage`] for a name or value that does not fit.
    pub fn setup(&self) -> Result<Setup> {
        let preset = match self.preset {
            PresetArg::Default => Preset::Default,
            PresetArg::Paper => Preset::Paper,
        };
        if self.is_auto() {
            let what = format!("--method {AUTO}: this needs the name of a method");
            return Err(Error::usage(
                what,
                "`clean` chooses one; elsewhere take what `wildpoint advise FILE` recommends",
            ));
        }
        let mut setup = Setup::new(method_of_id(&self.method)?, preset);
        setup.rate.clone_from(&self.rate);
        let named = [
            (repair::MAX_FILL.key, &self.max_fill),
            (repair::FILL_GAPS.key, &self.fill_gaps),
            (MAX_GAP.key, &self.max_gap),
        ];
        if let Some(id) = &self.repair {
            setup.repair.set_text("repair", repair::METHOD.key, repair::find(id)?.id)?;
        }
        for (key, value) in named {
            let Some(value) = value else { continue };
            // Of two values for one setting neither is what the user surely means.
            if let Some((_, other)) = self.set.iter().find(|(k, v)| k == key && v != value) {
                let option = key.replace('_', "-");
                let what = format!("--{option} {value} and --set {key}={other} contradict each other");
                return Err(Error::usage(what, "give one of them"));
            }
            setup.set_text(key, value)?;
        }
        for (key, value) in &self.set {
            setup.set_text(key, value)?;
        }
        Ok(setup)
    }
}

/// The help of `--channel` where one channel is worked on.
fn one_channel(channel: clap::Arg) -> clap::Arg {
    channel.help("Channel to work on [default: the first numeric column that is neither time nor truth]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_well_formed() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }
}
