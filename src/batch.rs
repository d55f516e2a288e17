//! The commands that need no screen.

use std::io::Write;
use std::path::Path;

use clap::CommandFactory;

use crate::cli::{Cli, Command, Load, OutputArgs};
use crate::error::{Error, Result};
use crate::report::Inspection;
use crate::session::{Accepted, Appended};
use crate::track::{Channel, Source, Track, load, printable_json, printable_lines};

mod advise;
mod archive;
mod candidates;
mod clean;
mod compare;
mod comparison;
mod consensus;
mod experiments;
mod inject;
mod interrupted;
mod methods;
mod progress;
mod replay;
mod set;
mod suggest;
mod sweep;
mod table;
mod targets;

pub use interrupted::end_tidily;
pub use methods::{
    choices as choices_table, explained as methods_page, is_explained, json as methods_json, markdown as methods_table,
};

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// All went well.
    Done,
    /// A comparison failed.
    Differs,
    /// Some of several inputs failed, which has been told; the others are done.
    Failed,
}

/// Runs a command; what it prints goes to `out`.
///
/// # Errors
/// Whatever the command cannot do; nothing has been written then.
pub fn run(command: Command, out: &mut dyn Write) -> Result<Ending> {
    match command {
        Command::Inspect { file, load, json } => inspect(&file, &load, json, out),
        Command::Clean { files, shared, suggest, output_value, outputs, save_session } => {
            let asked = clean::Asked { shared: &shared, suggested: suggest, value: output_value };
            clean::run(&files, &asked, &outputs, save_session.as_deref(), out)
        }
        Command::Replay { sessions, check, accept_changed_data, accept_appended, outputs, threads, archive } => {
            set_threads(threads)?;
            if let Some(folder) = &archive.archive {
                return archive::run(&sessions, (folder, &archive, check), &outputs, out);
            }
            let appended = if accept_appended { Appended::TakenIn } else { Appended::Refused };
            let accepted = Accepted { changed: accept_changed_data, appended };
            if check {
                replay::check_all(&sessions, accepted, &outputs, out)
            } else {
                replay::run_all(&sessions, accepted, &outputs, out)
            }
        }
        Command::Sweep(args) => sweep::run(&args, out),
        Command::Compare(args) => compare::run(&args, out),
        Command::Advise(args) => advise::run(&args, out),
        Command::Stream(args) => {
            crate::stream::run(&args, std::io::stdin().lock(), out, &mut std::io::stderr()).map(|()| Ending::Done)
        }
        Command::Methods { id, json, markdown } => methods::run(id.as_deref(), json, markdown, out),
        Command::Simulate(args) => experiments::simulate(&args, out),
        Command::Reproduce(args) => experiments::reproduce(&args, out),
        Command::Inject(args) => inject::run(&args, out),
        Command::Completions { shell } => {
            // Generated first and printed then: the generator panics where it cannot write, at a closed pipe say.
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "wildpoint", &mut script);
            out.write_all(&script).map_err(Error::io("write", "standard output"))?;
            Ok(Ending::Done)
        }
        Command::Man => {
            clap_mangen::Man::new(Cli::command()).render(out).map_err(Error::io("write", "standard output"))?;
            Ok(Ending::Done)
        }
    }
}

/// Threads a core at most: more do no work sooner.
const THREADS_PER_CORE: usize = 4;

/// Limits the worker threads to `threads`.
///
/// # Errors
/// [`Error::Usage`] for 0.
pub fn set_threads(threads: Option<usize>) -> Result<()> {
    let Some(threads) = threads else { return Ok(()) };
    if threads == 0 {
        return Err(Error::usage(
            "--threads 0: at least one thread is needed",
            "give 1 or more, or leave it out for all cores",
        ));
    }
    let most = std::thread::available_parallelism().map_or(1, usize::from) * THREADS_PER_CORE;
    if threads > most {
        // Thousands of threads take minutes to start, and then wait for each other.
        let _ =
            writeln!(std::io::stderr(), "wildpoint: --threads {threads}: {most} are used, {THREADS_PER_CORE} a core");
    }
    // It can only have been set before by an earlier call in the same process, which keeps its setting.
    let _ = rayon::ThreadPoolBuilder::new().num_threads(threads.min(most)).build_global();
    Ok(())
}

/// Words for people. Names and cells in them come from files, and are made harmless here once more.
fn print(out: &mut dyn Write, text: &str) -> Result<Ending> {
    let text = printable_lines(text);
    out.write_all(text.as_bytes()).map(|()| Ending::Done).map_err(Error::io("write", "standard output"))
}

fn print_json(out: &mut dyn Write, value: &impl serde::Serialize) -> Result<Ending> {
    let text = serde_json::to_string_pretty(value)
        .map_err(|e| Error::io("write", "standard output")(std::io::Error::other(e)))?;
    let text = printable_json(&text) + "\n";
    out.write_all(text.as_bytes()).map(|()| Ending::Done).map_err(Error::io("write", "standard output"))
}

fn inspect(file: &Path, options: &Load, json: bool, out: &mut dyn Write) -> Result<Ending> {
    let track = load(&Source::of(file)?, &options.options(None))?;
    let inspection = Inspection::of(&track);
    if json { print_json(out, &inspection) } else { print(out, &inspection.text()) }
}

/// The record with the index of the one channel to work on, and a remark where nobody named it.
fn one_channel(file: &Path, options: &Load, rate: Option<&str>) -> Result<(Track, usize, String)> {
    if options.channel.len() > 1 {
        return Err(Error::usage("several channels were named", "name one with --channel"));
    }
    let track = load(&Source::of(file)?, &options.options(rate))?;
    let wanted = |c: &Channel| match options.channel.first() {
        Some(name) => track.means(name, c),
        None => !rate.is_some_and(|rate| track.means(rate, c)),
    };
    let Some(index) = track.channels.iter().position(wanted) else {
        return Err(Error::input(file, "no column of numbers but the rate", "name another --channel or --rate"));
    };
    let others = track.channels.len() - 1;
    let note = if options.channel.is_empty() && others > 0 {
        format!("; --channel names one of the {others} others")
    } else {
        String::new()
    };
    Ok((track, index, note))
}

/// Tells on standard output what came out, as the options want it.
fn tell(outputs: &OutputArgs, summary: &crate::report::Summary, out: &mut dyn Write) -> Result<Ending> {
    if outputs.json {
        print_json(out, summary)
    } else if outputs.quiet {
        Ok(Ending::Done)
    } else if outputs.takes_standard_output() {
        print(&mut std::io::stderr(), &summary.text())
    } else {
        print(out, &summary.text())
    }
}
