//! Commands after `:`, and jumps after `/`.

use std::path::PathBuf;

use super::super::message::Effect;
use super::super::model::{Model, Tone};
use super::{Action, act, files, navigate, pictures, review, show, tune};
use crate::error::nearest;
use crate::method::METHODS;
use crate::repair::REPAIRS;
use crate::session::{Preset, method_of_id};
use crate::track::printable;

/// What a command does with what follows its name.
type Do = fn(&mut Model, &str) -> Result<Vec<Effect>, String>;

/// A command.
#[derive(Debug)]
pub struct Command {
    /// Its name after the colon; `|` stands between spellings.
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
    command("q", "", "quit; asks when something is not saved", |m, _| Ok(act(m, Action::Quit))),
    command("q!", "", "quit and drop what is not saved", |_, _| Ok(vec![Effect::Quit])),
    command("export", "[NAME]", "write the cleaned file", |m, a| Ok(files::export(m, path(a), false))),
    command("export!", "[NAME]", "write the cleaned file over an existing one", |m, a| {
        Ok(files::export(m, path(a), true))
    }),
    command("set", "KEY VALUE", "set a parameter of the method or of repair", set),
    command("method", "ID", "choose the method", |m, a| {
        let method = method_of_id(a).map_err(|e| e.to_string())?;
        Ok(tune::use_method(m, method))
    }),
    command("repair", "ID", "choose the repair", tune::set_repair),
    command("preset", "default|paper", "all parameters to their defaults, or to the paper's values", |m, a| match a {
        "default" => Ok(tune::use_preset(m, Preset::Default)),
        "paper" => Ok(tune::use_preset(m, Preset::Paper)),
        other => Err(format!("{other}: presets are default and paper")),
    }),
    command("channel", "NAME", "show another channel", channel),
    command("goto", "TIME|#ROW", "put the cursor on a time or a row", |m, a| jump(m, a).map(|()| Vec::new())),
    command("auto-advance", "[on|off]", "whether a decision goes on to the next flag", |m, a| match a {
        "" => Ok(act(m, Action::AutoAdvance)),
        "on" | "off" => {
            review::set_auto_advance(m, a == "on");
            Ok(Vec::new())
        }
        other => Err(format!("{}: on or off", printable(other))),
    }),
    command("y", "kept|all|robust|fixed|LOW HIGH", "choose the vertical range", pictures::y_command),
    command("layers", "[+-]NAME ...", "show these layers: raw, expected, band, repaired", pictures::layers_command),
    command("help", "", "keys and commands", |m, _| Ok(act(m, Action::Help))),
];

/// Runs what was typed after the colon.
pub(super) fn run(model: &mut Model, line: &str) -> Result<Vec<Effect>, String> {
    let line = line.trim().trim_start_matches(':');
    let (name, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    if name.is_empty() {
        return Ok(Vec::new());
    }
    let found = COMMANDS.iter().find(|c| c.name.split('|').any(|n| n == name));
    match found {
        Some(command) => (command.run)(model, rest.trim()),
        None => {
            let names = COMMANDS.iter().flat_map(|c| c.name.split('|'));
            let hint = nearest(name, names).map_or("? lists the commands".into(), |n| format!("did you mean {n}?"));
            Err(format!("{}: no such command; {hint}", printable(name)))
        }
    }
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

fn path(text: &str) -> Option<PathBuf> {
    (!text.is_empty()).then(|| PathBuf::from(text))
}

fn set(model: &mut Model, rest: &str) -> Result<Vec<Effect>, String> {
    let Some((key, value)) = rest.split_once(['=', ' ']) else {
        return Err(":set KEY VALUE, :set k 4.5 say".into());
    };
    let effects = tune::set_key(model, key.trim(), value.trim())?;
    model.say(Tone::Done, format!("{} {} · u undo", key.trim(), value.trim()));
    Ok(effects)
}

fn channel(model: &mut Model, name: &str) -> Result<Vec<Effect>, String> {
    let plans = &model.session.plans;
    match plans.iter().position(|p| p.channel == name) {
        Some(plan) => Ok(show(model, plan)),
        None => {
            let names: Vec<&str> = plans.iter().map(|p| p.channel.as_str()).collect();
            Err(format!("{}: no such channel; channels: {}", printable(name), printable(&names.join(", "))))
        }
    }
}

/// Puts the cursor on a row (`#1240`), on a time as the file writes it, or so many seconds on (`+5`, `-60s`).
pub(super) fn jump(model: &mut Model, text: &str) -> Result<(), String> {
    let text = text.trim();
    let series = model.series();
    let position = if let Some(row) = text.strip_prefix('#') {
        let row: usize = row.trim().parse().map_err(|_| format!("{}: a row is a whole number", printable(text)))?;
        let (row, rows) = (row.wrapping_sub(1), model.track.rows);
        if row >= rows {
            return Err(format!("#{}: rows go from 1 to {rows}", row.wrapping_add(1)));
        }
        let found = series.position(row);
        found.ok_or_else(|| format!("row {} has no value or no usable time", row + 1))?
    } else {
        let here = series.t.get(model.state().cursor).copied().unwrap_or(0.0);
        let offset = text.strip_prefix('+').map(|s| (1.0, s)).or_else(|| text.strip_prefix('-').map(|s| (-1.0, s)));
        let relative =
            offset.and_then(|(sign, s)| s.trim_end_matches('s').trim().parse::<f64>().ok().map(|s| here + sign * s));
        // `-5` may also be a time of a record that counts down to its start.
        let absolute = model.track.time.parse(text).filter(|_| !text.starts_with('+') && !text.ends_with('s'));
        let t = absolute
            .or(relative)
            .filter(|t| t.is_finite())
            .ok_or_else(|| format!("{}: neither a time of this record nor #ROW nor +SECONDS", printable(text)))?;
        let after = series.before(t);
        let before = after.saturating_sub(1);
        let nearer = |a: usize, b: usize| match (series.t.get(a), series.t.get(b)) {
            (Some(x), Some(y)) if (x - t).abs() <= (y - t).abs() => a,
            (Some(_), None) => a,
            _ => b,
        };
        nearer(before, after)
    };
    navigate::go_to(model, position);
    Ok(())
}
