//! The program: dispatch and exit status.

use std::ffi::OsString;
use std::io::{IsTerminal, Write};
use std::path::Path;

use crate::batch::{self, Ending};
use crate::cli::{Cli, Color, ConfigArgs, Glyphs as GlyphChoice, Task, no_such_command};
use crate::error::{Error, Result};
use crate::manual;
use crate::memory;
use crate::report::Summary;
use crate::session::{Analysed, Session, open_all};
use crate::stop::Stop;
use crate::track::{DASH, LoadOptions, Source, Wanted, load, printable_lines, take_unfinished_away};
use crate::tui::config::{self, Config};
use crate::tui::files::is_session;
use crate::tui::journal::folder;
use crate::tui::plot::Glyphs;
use crate::tui::theme::{ColorDepth, Theme};
use crate::tui::{self, Ended, Look, Misread, Opening, still};
use clap::Parser;

/// Runs the program with its arguments, of which the first is its name, and gives its exit status.
pub fn run(args: impl IntoIterator<Item = OsString>) -> u8 {
    bear_the_limit_of_files();
    let args: Vec<OsString> = args.into_iter().collect();
    let first = args.get(1).cloned();
    let mut cli = match Cli::try_parse_from(args) {
        Ok(cli) => cli,
        Err(help) if !help.use_stderr() => {
            let _ = help.print();
            return 0;
        }
        // Without its colours, since an argument (for example a file's name) is in it.
        Err(wrong) => {
            let mistyped = no_such_command(first.as_deref()).map(|error| format!("wildpoint: {error}\n"));
            let told = mistyped.unwrap_or_else(|| wrong.to_string());
            let _ = write!(std::io::stderr(), "{}", printable_lines(&told));
            return 2;
        }
    };
    if let Some(bytes) = cli.memory {
        memory::set_limit(bytes);
    }
    let stdout = std::io::stdout();
    let ended = match cli.command.take() {
        Some(Task::Keys(args)) => configured(&args).and_then(|config| {
            let listing = config::listing(&config.keys);
            let written = stdout.lock().write_all(listing.as_bytes()).map(|()| Ending::Done);
            written.map_err(Error::io("write", "standard output"))
        }),
        Some(Task::Help { topic }) => manual::show(topic.as_deref()).map(|()| Ending::Done),
        Some(Task::Batch(command)) if output_is_closed() && !command.is_quiet() => {
            let what = "standard output is closed: the output of the command would be lost";
            Err(Error::usage(what, "redirect it to a file, or to /dev/null to discard it"))
        }
        Some(Task::Batch(mut command)) => {
            batch::end_tidily();
            let mut out = std::io::BufWriter::new(stdout.lock());
            let signed = command.sign(|| Config::find(None).map(|config| config.analyst));
            let ended = signed.and_then(|()| batch::run(command, &mut out));
            let flushed = out.flush().map_err(Error::io("write", "standard output"));
            ended.and_then(|ending| flushed.map(|()| ending))
        }
        None => {
            let ended = no_such_command(first.as_deref()).map_or_else(|| workbench(&cli), Err);
            // What is still being written when the workbench has ended, however it did, goes nowhere.
            take_unfinished_away();
            match ended {
                Ok(Ended { signal: Some(signal), words }) => {
                    let _ = writeln!(std::io::stderr(), "wildpoint: {}", printable_lines(&words));
                    // As shells have it for programs that a signal ended.
                    return 128 | u8::try_from(signal).unwrap_or(0);
                }
                other => other.map(|_| Ending::Done),
            }
        }
    };
    match ended {
        Ok(Ending::Done) => 0,
        Ok(Ending::Differs) => 1,
        Ok(Ending::Failed) => 2,
        // A reader that has seen enough (`| head`) is no failure.
        Err(Error::Io { source, .. }) if source.kind() == std::io::ErrorKind::BrokenPipe => 0,
        Err(e) => {
            let _ = writeln!(std::io::stderr(), "wildpoint: {}", printable_lines(&e.to_string()));
            2
        }
    }
}

/// Whether standard output was closed before the program began. Its runtime then opens `/dev/null` in its place for
/// reading and writing, as no shell does, so that writing to it fails no more.
fn output_is_closed() -> bool {
    let null = std::fs::read_link("/proc/self/fd/1").is_ok_and(|to| to == Path::new("/dev/null"));
    let about = std::fs::read_to_string("/proc/self/fdinfo/1").unwrap_or_default();
    let flags = about.lines().find_map(|line| line.strip_prefix("flags:"));
    // The last octal digit: 0 reads, 1 writes, 2 does both.
    null && flags.is_some_and(|flags| flags.trim().ends_with('2'))
}

/// A file that may grow no further (`ulimit -f`) is an error of the write that is told, not an end without a word that
/// leaves files behind: the signal is caught, and nobody looks whether it came.
fn bear_the_limit_of_files() {
    #[cfg(unix)]
    // Where it cannot be caught, the program ends as any other.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}

/// Opens the workbench, or prints one frame of it where there is no terminal.
fn workbench(cli: &Cli) -> Result<Ended> {
    batch::set_threads(cli.shared.threads)?;
    let mut config = configured(&cli.config)?;
    config.screen.mouse &= !cli.no_mouse;
    config.analyst = cli.analyst.clone().or(config.analyst);
    let stdout = std::io::stdout();
    let dumb = std::env::var("TERM").is_ok_and(|t| t == "dumb");
    let screen = stdout.is_terminal() && !dumb;
    let (opening, misread) = match opening(cli) {
        // Where there is a screen, the file is shown with what can be said about it.
        Err(e @ (Error::Input { .. } | Error::Usage { .. })) if screen => {
            let (opening, misread) = misread(cli, e)?;
            (opening, Some(misread))
        }
        opening => (opening?, None),
    };
    if screen {
        let journal = if cli.no_journal { None } else { folder() };
        let look = Look { theme: theme(cli, &config), glyphs: glyphs(cli, &config) };
        return tui::run(opening, look, config, journal, misread);
    }
    let analysed = {
        let mut first = opening.session.clone();
        // Of the channel that the frame shows.
        first.plans.drain(..opening.own.iter().position(|own| *own).unwrap_or(0));
        first.plans.truncate(1);
        let analysed = Analysed::of(&first, &opening.track, &Stop::never())?;
        Summary::of(&opening.track, &first, &analysed).text()
    };
    let frame = still(opening, Look { theme: Theme::mono(), glyphs: glyphs(cli, &config) }, cli.size)?;
    let mut out = stdout.lock();
    writeln!(out, "{frame}\n{}", printable_lines(&analysed)).map_err(Error::io("write", "standard output"))?;
    Ok(Ended::default())
}

fn opening(cli: &Cli) -> Result<Opening> {
    let source = match &cli.file {
        None => Source::demo(),
        Some(path) if is_session(path) => {
            return Ok(Opening::from((open_all(path, Wanted::always())?, path.clone())));
        }
        Some(path) if path == Path::new(DASH) => {
            let what = "the workbench needs a file, not standard input";
            return Err(Error::usage(what, "save standard input to a file and open that"));
        }
        Some(path) => Source::File(path.clone()),
    };
    let setup = cli.shared.setup()?;
    let rate = cli.shared.rate.as_deref();
    let track = load(&source, &cli.shared.load.options(rate))?;
    let mut options = cli.shared.load.options(None);
    options.channels.clear();
    let mut session = Session::new(&track, options, &setup);
    cli.shared.prepare.prepare(&mut session, &track, cli.shared.preset)?;
    Ok(Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() })
}

/// The demonstration record, with what is to be opened over it: a file that could not be understood; the error itself,
/// where no other way of loading helps.
fn misread(cli: &Cli, e: Error) -> Result<(Opening, Misread)> {
    let path = cli.file.clone().filter(|path| path.is_file() && !is_session(path));
    let Some(path) = path else { return Err(e) };
    let source = Source::demo();
    let setup = cli.shared.setup()?;
    let track = load(&source, &LoadOptions::default())?;
    let session = Session::new(&track, LoadOptions::default(), &setup);
    let mut options = cli.shared.load.options(None);
    options.channels.clear();
    let opening = Opening { track, session, file: None, notes: Vec::new(), own: Vec::new() };
    Ok((opening, Misread { source: Source::File(path), options }))
}

/// The configuration that the command line asks for.
fn configured(args: &ConfigArgs) -> Result<Config> {
    if args.no_config { Ok(Config::default()) } else { Config::find(args.config.as_deref()) }
}

/// What the command line says holds; then the environment's NO_COLOR, the configuration, and what the terminal says.
fn theme(cli: &Cli, config: &Config) -> Theme {
    let variable = |name: &str| std::env::var(name).unwrap_or_default();
    let depth = match cli.color {
        Color::Never => ColorDepth::Never,
        Color::Sixteen => ColorDepth::Ansi16,
        Color::Indexed => ColorDepth::Indexed256,
        Color::True => ColorDepth::True,
        Color::Auto if !variable("NO_COLOR").is_empty() => ColorDepth::Never,
        Color::Auto => config.screen.color.unwrap_or_else(|| {
            let term = variable("TERM");
            if matches!(variable("COLORTERM").as_str(), "truecolor" | "24bit") {
                ColorDepth::True
            } else if term.contains("256") || term.starts_with("xterm") {
                ColorDepth::Indexed256
            } else {
                ColorDepth::Ansi16
            }
        }),
    };
    config.paints.theme(depth, cli.light)
}

fn glyphs(cli: &Cli, config: &Config) -> Glyphs {
    match cli.glyphs {
        GlyphChoice::Unicode => Glyphs::Unicode,
        GlyphChoice::Braille => Glyphs::Braille,
        GlyphChoice::Ascii => Glyphs::Ascii,
        GlyphChoice::Auto => config.screen.glyphs.unwrap_or_else(|| {
            let locale =
                ["LC_ALL", "LC_CTYPE", "LANG"].iter().find_map(|n| std::env::var(n).ok().filter(|v| !v.is_empty()));
            // A console without a locale is most often a bare container: its terminal is what the user sits at.
            let utf8 = locale.is_none_or(|l| l.to_lowercase().replace('-', "").contains("utf8"));
            let console = std::env::var("TERM").is_ok_and(|t| t == "linux");
            if utf8 && !console { Glyphs::Unicode } else { Glyphs::Ascii }
        }),
    }
}
