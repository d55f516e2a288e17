//! The command line: what can be typed, and what it means.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};

use crate::error::{Error, Result, nearest, one_of};
use crate::method::shared::MAX_GAP;
use crate::repair;
use crate::session::{DEFAULT_METHOD, OutputValue, Preset, Setup, method_of_id};

mod advise;
mod archive;
mod candidates;
mod experiments;
mod load;
mod outputs;
mod parse;
mod prepare;
mod screen;
mod tools;

pub use advise::AdviseArgs;
pub use archive::ArchiveArgs;
pub use candidates::CandidateArgs;
pub use experiments::{InjectArgs, ReproduceArgs, SimulateArgs};
use load::worded;
pub use load::{DateOrder, Load};
pub use outputs::OutputArgs;
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
    /// others; the exit status is then 2.
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
        /// Values in the cleaned file: the measured ones, with wild points repaired or removed, or those that the method's
        /// model smooths the track to, for methods that have one (for kalman the state of the filter). The session records
        /// it.
        #[arg(long, value_name = "WHICH", default_value = "clean", value_parser = worded::<OutputValue>())]
        output_value: OutputValue,
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
    /// the sessions. A session that fails does not stop the others; the exit status is then 2, and 1 when only
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
        /// An archive to apply the session to.
        #[command(flatten)]
        archive: ArchiveArgs,
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

/// That the first argument names no command, where it is neither an option nor a file and resembles one.
#[must_use]
pub fn no_such_command(first: Option<&OsStr>) -> Option<Error> {
    let name = first?.to_str().filter(|name| !name.starts_with('-') && !name.contains(['.', '/']))?;
    if Path::new(name).exists() {
        return None;
    }
    let all = Cli::command();
    let names: Vec<&str> = all.get_subcommands().map(clap::Command::get_name).collect();
    nearest(name, names.iter().copied()).filter(|near| *near != name)?;
    Some(Error::usage(format!("{name}: there is no such command, and no such file"), one_of("commands", name, &names)))
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
    /// Method (see `wildpoint methods`); `clean` also takes auto: the method that `wildpoint advise` recommends
    /// for each channel.
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

/// Which values a method starts with.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum PresetArg {
    /// Values that work on real tracks.
    #[default]
    Default,
    /// Values of the source documents.
    Paper,
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
        Cli::command().debug_assert();
    }

    #[test]
    fn every_help_opens_with_an_example_that_can_be_typed() {
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
