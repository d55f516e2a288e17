//! Commands after `:`.

use std::path::PathBuf;

use super::super::message::{Effect, OutputKind};
use super::super::model::{Model, Tone};
use super::files::default_report;
use super::{
    Action, act, chart_actions, checks, command_line, detectability, dialog, files, jump, record, review, show, tune,
};
use crate::check::CHECKS;
use crate::error::{nearest, one_of};
use crate::method::METHODS;
use crate::repair::REPAIRS;
use crate::session::{Preset, method_of_id};
use crate::track::printable;

/// What a command does with what follows its name.
type Do = fn(&mut Model, &str) -> Result<Vec<Effect>, String>;

/// A command.
#[derive(Debug)]
pub struct Command {
    /// Its name after the colon; `|` separates spellings.
    pub name: &'static str,
    /// What follows it.
    pub takes: &'static str,
    /// What it does, in a few words.
    pub help: &'static str,
    run: Do,
}

const fn command(name: &'static str, takes: &'static str, help: &'static str, run: Do) -> Command {
    Command { name, takes, help, run }
}

/// Every command, in the order of the help.
pub static COMMANDS: &[Command] = &[
    command("w", "[NAME]", "save the session", |m, a| Ok(files::save(m, path(a), false, false))),
    command("w!", "[NAME]", "save the session over an existing file", |m, a| Ok(files::save(m, path(a), true, false))),
    command("wq|x", "[NAME]", "save the session and quit", |m, a| Ok(files::save(m, path(a), false, true))),
    command("q", "", "quit; asks if there are unsaved changes", |m, _| Ok(act(m, Action::Quit))),
    command("q!", "", "quit and discard unsaved changes", |_, _| Ok(vec![Effect::Quit])),
    command("saveas", "", "save the session under another name", |m, _| Ok(act(m, Action::SaveAs))),
    command("open", "[PATH]", "open a record or a session; without a path, from a list", |m, a| {
        Ok(match path(a) {
            Some(path) => dialog::open(m, path),
            None => act(m, Action::Open),
        })
    }),
    command("loader", "", "correct how the record is loaded: columns, units, track ids, delimiter", |m, _| {
        Ok(dialog::correct(m))
    }),
    command("tune", "", "search settings of the method that find more on this record, 20 s at most", |m, _| {
        Ok(detectability::tune(m))
    }),
    command("reload", "", "load rows that were added to the record; all decisions stay", |m, _| Ok(record::take_in(m))),
    command("decisions", "[NAME]", "write the decisions as a table, even if the record is gone", |m, a| {
        let name = path(a).unwrap_or_else(|| files::beside(&m.track.source, OutputKind::Decisions.ending()));
        Ok(dialog::export_one(m, OutputKind::Decisions, name, false))
    }),
    command("export", "[NAME]", "write the cleaned file; without a name, choose what is written", |m, a| {
        Ok(export(m, a, OutputKind::Cleaned, false))
    }),
    command("export!", "NAME", "write the cleaned file over an existing one", |m, a| {
        Ok(export(m, a, OutputKind::Cleaned, true))
    }),
    command("report", "[NAME]", "write the report: .html or .md", |m, a| {
        let name = default_report(&m.track.source);
        let name = if a.is_empty() { name.to_string_lossy().into_owned() } else { a.to_owned() };
        Ok(export(m, &name, OutputKind::Report, false))
    }),
    command("set", "KEY VALUE", "set a parameter of the method or of repair", set),
    command("method", "ID", "choose the method", |m, a| {
        let method = method_of_id(a).map_err(|e| e.to_string())?;
        Ok(tune::use_method(m, method))
    }),
    command("repair", "ID", "choose the repair", tune::set_repair),
    command("preset", "default|paper", "all parameters to the defaults, or to the paper's values", |m, a| match a {
        "default" => Ok(tune::use_preset(m, Preset::Default)),
        "paper" => Ok(tune::use_preset(m, Preset::Paper)),
        other => Err(format!("{other}: presets are default and paper")),
    }),
    command("check", "ID[:KEY=VALUE,...]", "add a check before the method", checks::add),
    command("uncheck", "ID|all", "remove a check", checks::take_away),
    command("period", "P|off", "period of a circular channel: 360, 24, 2pi", checks::set_period),
    command("position", "LAT,LON[,HEIGHT]", "check the speed of a position (two or three channels)", checks::position),
    command("channel", "NAME", "show another channel", channel),
    command("goto", "TIME|#ROW|...", "move the cursor to a time, a row, or anything / accepts", |m, a| {
        jump::jump(m, a).map(|()| Vec::new())
    }),
    command("auto-advance", "[on|off]", "go to the next flag after a decision", |m, a| match a {
        "" => Ok(act(m, Action::AutoAdvance)),
        "on" | "off" => {
            review::set_auto_advance(m, a == "on");
            Ok(Vec::new())
        }
        other => Err(format!("{}: on or off", printable(other))),
    }),
    command("y", "kept|all|robust|fixed|LOW HIGH", "choose the vertical range", chart_actions::y_command),
    command(
        "layers",
        "[+-]NAME ...",
        "show these layers: raw, expected, band, repaired, filtered",
        chart_actions::layers_command,
    ),
    command("command-line", "[CLEANED]", "copy the equivalent command", |m, a| Ok(command_line::show(m, path(a)))),
    command("help", "", "keys and commands", |m, _| Ok(act(m, Action::Help))),
];

/// Runs what was typed after the colon.
pub(super) fn run(model: &mut Model, line: &str) -> Result<Vec<Effect>, String> {
    let line = line.trim().trim_start_matches(':');
    let (name, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    if name.is_empty() {
        return Ok(Vec::new());
    }
    if let Some(command) = find(name) {
        return (command.run)(model, rest.trim());
    }
    let actions: Vec<(String, Action)> =
        model.keys.rows().iter().map(|b| (b.row.action.name(), b.row.action)).collect();
    if let Some((_, action)) = actions.iter().find(|(known, _)| known == line) {
        return Ok(act(model, *action));
    }
    let names = COMMANDS.iter().flat_map(|c| c.name.split('|')).chain(actions.iter().map(|(name, _)| name.as_str()));
    let hint = nearest(name, names).map_or("? lists the commands".into(), |n| format!("did you mean {n}?"));
    Err(format!("{}: no such command; {hint}", printable(name)))
}

/// The command of this name.
pub(super) fn find(name: &str) -> Option<&'static Command> {
    COMMANDS.iter().find(|c| c.name.split('|').any(|n| n == name))
}

/// The line completed as far as it is clear; none when nothing fits.
pub(super) fn complete(model: &Model, line: &str) -> Option<String> {
    let (name, rest) = match line.split_once(' ') {
        None => {
            let names = COMMANDS.iter().flat_map(|c| c.name.split('|')).map(str::to_owned);
            return common(names.collect(), line);
        }
        Some(parts) => parts,
    };
    let setup = &model.plan().setup;
    let candidates: Vec<String> = match name {
        "set" => setup.settings.iter().chain(setup.repair.iter().skip(1)).map(|(p, _)| p.key.to_owned()).collect(),
        "method" => METHODS.iter().map(|m| m.about().id.to_owned()).collect(),
        "repair" => REPAIRS.iter().map(|r| r.id.to_owned()).collect(),
        "y" => ["kept", "all", "robust", "fixed"].map(String::from).to_vec(),
        "preset" => vec!["default".into(), "paper".into()],
        "check" => CHECKS.iter().map(|c| c.about().id.to_owned()).collect(),
        "uncheck" => setup.preparation.checks.iter().map(|c| c.id().to_owned()).chain(["all".into()]).collect(),
        "channel" => model.session.plans.iter().map(|p| p.channel.clone()).collect(),
        _ => return None,
    };
    common(candidates, rest).map(|end| format!("{name} {end}"))
}

/// The longest beginning that all candidates share which start with `start`.
fn common(candidates: Vec<String>, start: &str) -> Option<String> {
    let mut fitting = candidates.into_iter().filter(|c| c.starts_with(start));
    let first = fitting.next()?;
    Some(fitting.fold(first, |a, b| a.chars().zip(b.chars()).take_while(|(x, y)| x == y).map(|(x, _)| x).collect()))
}

fn export(model: &mut Model, name: &str, kind: OutputKind, overwrite: bool) -> Vec<Effect> {
    match path(name) {
        Some(path) => dialog::export_one(model, kind, path, overwrite),
        None => dialog::export_dialog(model),
    }
}

fn path(text: &str) -> Option<PathBuf> {
    (!text.is_empty()).then(|| PathBuf::from(text))
}

fn set(model: &mut Model, rest: &str) -> Result<Vec<Effect>, String> {
    let Some((key, value)) = rest.split_once(['=', ' ']) else {
        return Err(":set KEY VALUE, for example :set k 4.5".into());
    };
    let effects = tune::set_key(model, key.trim(), value.trim())?;
    model.say(Tone::Done, format!("{} {} · {} undo", key.trim(), value.trim(), model.key(Action::Undo)));
    Ok(effects)
}

fn channel(model: &mut Model, name: &str) -> Result<Vec<Effect>, String> {
    let plans = &model.session.plans;
    match plans.iter().position(|p| p.channel == name) {
        Some(plan) => Ok(show(model, plan)),
        None => {
            let names: Vec<&str> = plans.iter().map(|p| p.channel.as_str()).collect();
            Err(format!("{}: no such channel; {}", printable(name), printable(&one_of("channels", name, &names))))
        }
    }
}
