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

/// Find, review and repair wild points (outliers) in tracking records.
///
/// Without a command: opens the workbench on FILE, on a saved SESSION, or on the built-in demonstration record.
/// Without a terminal, prints one still frame and a summary.
#[derive(Debug, Parser)]
#[command(name = "wildpoint", version, args_conflicts_with_subcommands = true, max_term_width = 100)]
#[command(disable_help_subcommand = true, before_help = "Example: wildpoint data/demo.csv")]
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
    /// Leave the mouse to the terminal, which then selects text (M toggles it).
    #[arg(long)]
    pub no_mouse: bool,
    /// Which configuration to take.
    #[command(flatten)]
    pub config: ConfigArgs,
    /// Memory limit for records and results, for example 500M or 4G [default: half of the machine's memory].
    #[arg(long, value_name = "SIZE", global = true, value_parser = memory_size)]
    pub memory: Option<u64>,
    /// Name of the analyst, for reports [default: `analyst` in the configuration].
    #[arg(long, value_name = "NAME")]
    pub analyst: Option<String>,
    /// Do not keep a journal: unsaved work is lost if the workbench is killed.
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
    /// Print the key map in effect, in the form of a configuration file.
    #[command(before_help = "Example: wildpoint keys > keys.toml")]
    Keys(ConfigArgs),
    /// Show a page of the manual, or the help of a command or a method.
    #[command(before_help = "Example: wildpoint help tutorial")]
    Help {
        /// The topic; none lists them.
        topic: Option<String>,
    },
}

/// The commands that need no screen.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Print how a file is read: columns, times, gaps, noise, bad rows.
    #[command(before_help = "Example: wildpoint inspect data/demo.csv")]
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
    /// Detect and repair outliers in one file or many.
    ///
    /// With several files the outputs are folders (`-o DIR/`, `--flags DIR/`, ...): the cleaned file keeps its name,
    /// the others are NAME.changed.csv, NAME.flags.csv, NAME.diagnostics.csv, NAME.html and NAME.toml. A file that fails does not stop the
    /// others; the exit status is 2 then.
    #[command(before_help = "Example: wildpoint clean data/demo.csv -o clean.csv --flags flags.csv")]
    Clean {
        /// The records.
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
        /// How to load and judge it.
        #[command(flatten)]
        shared: Shared,
        /// Use the threshold (k or c) that `wildpoint sweep` suggests for each channel; where it suggests none, keep the
        /// current one. The session records it.
        #[arg(long)]
        suggest: bool,
        /// What to write.
        #[command(flatten)]
        outputs: OutputArgs,
        /// Write the session, which reproduces this result.
        #[arg(long, value_name = "SESSION")]
        save_session: Option<PathBuf>,
    },
    /// Run saved sessions again.
    ///
    /// With several sessions the outputs are folders (`-o DIR/`, `--flags DIR/`, ...), in which files are named after
    /// the sessions. A session that fails does not stop the others; the exit status is 2 then, and 1 when only
    /// comparisons failed.
    #[command(before_help = "Example: wildpoint replay demo.toml --check")]
    Replay {
        /// Session files.
        #[arg(required = true, value_name = "SESSION")]
        sessions: Vec<PathBuf>,
        /// Compare with the result that each session recorded; write nothing. Exit status 1 when one differs.
        #[arg(long, conflicts_with_all = ["output", "flag_columns", "changed", "flags", "diagnostics", "report"])]
        check: bool,
        /// Continue even if the data are not those of the session.
        #[arg(long)]
        accept_changed_data: bool,
        /// Also judge rows that were added to the end of the record since the session was saved; all decisions stay. With
        /// --check they are left out, because the recorded result does not include them.
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
    #[command(before_help = "Example: wildpoint sweep data/demo.csv --channel vx_mps")]
    Sweep(SweepArgs),
    /// Run every method on one channel and compare the results.
    #[command(long_about = tools::COMPARE, mut_arg("channel", one_channel))]
    #[command(before_help = "Example: wildpoint compare data/demo.csv --channel vx_mps")]
    Compare(CompareArgs),
    /// Which method finds most on this record, measured on the record itself.
    #[command(before_help = "Example: wildpoint advise data/demo.csv --channel vx_mps")]
    #[command(long_about = advise::ADVISE, mut_arg("channel", one_channel))]
    Advise(AdviseArgs),
    /// Judge samples from standard input as they arrive.
    #[command(long_about = tools::STREAM, mut_arg("channel", one_channel))]
    #[command(before_help = "Example: wildpoint stream --method five-point --set sigma=2.5 < data/demo.csv")]
    Stream(StreamArgs),
    /// List the methods, or explain one with its parameters.
    #[command(before_help = "Example: wildpoint methods hampel")]
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
    #[command(before_help = "Example: wildpoint simulate jiang -o jiang.csv")]
    Simulate(SimulateArgs),
    /// Run the published experiments and print their tables beside ours.
    #[command(before_help = "Example: wildpoint reproduce jiang")]
    Reproduce(ReproduceArgs),
    /// Add known outliers to a record, with a truth column.
    #[command(mut_arg("channel", one_channel))]
    #[command(before_help = "Example: wildpoint inject data/demo.csv -o test.csv --isolated 2%")]
    Inject(InjectArgs),
    /// Print shell completions.
    #[command(before_help = "Example: wildpoint completions bash > wildpoint.bash")]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page.
    #[command(before_help = "Example: wildpoint man > wildpoint.1")]
    Man,
}

impl Command {
    /// Puts the analyst of the configuration into a report that names none.
    ///
    /// # Errors
    /// What `configured` gives; it is asked only where a report is written.
    pub fn sign(&mut self, configured: impl FnOnce() -> Result<Option<String>>) -> Result<()> {
        let outputs = match self {
            Self::Clean { outputs, .. } | Self::Replay { outputs, .. } => outputs,
            Self::Compare(args) => &mut args.outputs,
            _ => return Ok(()),
        };
        if outputs.report.is_some() && outputs.analyst.is_none() {
            outputs.analyst = configured()?;
        }
        Ok(())
    }

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
    /// Channel with the rate of change of the judged one, for methods that need it.
    #[arg(long, value_name = "COLUMN")]
    pub rate: Option<String>,
    /// Column with the outlier-free values; it is not judged. `clean` then reports the final error of the first channel:
    /// sqrt(mean((clean - reference)^2)) over the samples that have a value in the output.
    #[arg(long, value_name = "COLUMN")]
    pub reference: Option<String>,
    /// Method (see `wildpoint methods`); `clean` takes auto, too: for each channel the one that `wildpoint advise`
    /// recommends.
    #[arg(long, value_name = "ID", default_value = DEFAULT_METHOD)]
    pub method: String,
    /// Parameter values to start from: those that work on real tracks, or those of the source documents.
    #[arg(long, value_enum, default_value_t = PresetArg::Default)]
    pub preset: PresetArg,
    /// A parameter of the method or the repair; repeatable (see `wildpoint methods ID`).
    #[arg(long, value_name = "KEY=VALUE", value_parser = pair)]
    pub set: Vec<(String, String)>,
    /// Checks before the method.
    #[command(flatten)]
    pub prepare: PrepareArgs,
    /// Replacement of an outlier: own (the method's own), remove, linear, spline, polynomial, expected.
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
    /// Write the cleaned file: the input with outliers repaired or removed, all other bytes unchanged. A name that ends in
    /// .parquet writes Parquet.
    #[arg(short, long, value_name = "CLEANED")]
    pub output: Option<PathBuf>,
    /// Columns of flags in the cleaned file.
    #[arg(long, value_name = "SCHEME", requires = "output", value_parser = scheme(), help = scheme_help())]
    pub flag_columns: Option<&'static Scheme>,
    /// Write only the changed cells: row, time, channel, old and new text, verdict, and what flagged it (CSV).
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
    /// Name of the analyst, for the report [default: `analyst` in the configuration].
    #[arg(long, value_name = "NAME", requires = "report")]
    pub analyst: Option<String>,
    /// Do all the work and report what would be written, but write nothing.
    #[arg(long)]
    pub dry_run: bool,
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
            _ => Err(Error::usage("only one output can be `-` (standard output)", "give the others file names")),
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

    #[test]
    fn every_help_opens_with_an_example_that_can_be_typed() {
        use clap::CommandFactory;
        let all = Cli::command();
        for command in all.get_subcommands().chain([&all]) {
            let example = command.get_before_help().map(ToString::to_string).unwrap_or_default();
            let words = example.strip_prefix("Example: ").expect("an example");
            let words = words.split(['<', '>']).next().unwrap_or_default();
            let parsed = Cli::try_parse_from(words.split_whitespace());
            assert!(parsed.is_ok(), "{example}: {}", parsed.unwrap_err());
        }
    }
}
