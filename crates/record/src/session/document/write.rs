//! Writing a session file.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use super::{FORMAT, measurement};
use crate::error::{Error, Result};
use crate::param::{Param, Settings, Value};
use crate::session::signature::at_text;
use crate::session::{Data, Digest, OutputValue, Plan, Preparation, Session, folder_of};
use crate::track::{Pattern, Rules, Source, Worded, is_hidden};

/// The session file, with its digest, for a session that lies at `path`. `texts` gives, for each plan, the texts of time and value of
/// each decided row, in the order of the rows.
///
/// # Errors
/// [`Error::Input`] for a record whose name no text can hold.
pub fn render(session: &Session, path: &Path, texts: &[Vec<(String, String)>]) -> Result<String> {
    let record = reference(&session.data.source, path)?;
    let mut out = String::new();
    let mut line = |text: String| {
        out.push_str(&text);
        out.push('\n');
    };
    line(format!("format = {FORMAT}"));
    line(format!("program = {}", quoted(concat!("wildpoint ", env!("CARGO_PKG_VERSION")))));
    if let Some(word) = session.value.word().filter(|_| session.value != OutputValue::default()) {
        line(format!("output_value = {}", quoted(word)));
    }
    line("\n[data]".into());
    line(format!("file = {}", quoted(&record)));
    line(format!("sha256 = {}", quoted(&session.data.sha256)));
    if let Some(bytes) = session.data.bytes {
        line(format!("bytes = {bytes}"));
    }
    line(format!("rows = {}", session.data.rows));
    if let Some(word) = session.data.record_was.and_then(Worded::word) {
        line(format!("record_was = {}", quoted(word)));
    }
    loading(&session.data).into_iter().for_each(&mut line);
    for (plan, texts) in session.plans.iter().zip(texts) {
        line("\n[[channel]]".into());
        line(format!("name = {}", quoted(&plan.channel)));
        line(format!("method = {}", quoted(plan.setup.method.about().id)));
        if let Some(rate) = &plan.setup.rate {
            line(format!("rate = {}", quoted(rate)));
        }
        line(format!("settings = {}", inline(&plan.setup.settings)));
        line(format!("repair = {}", inline(&plan.setup.repair)));
        preparation(&plan.setup.preparation).into_iter().for_each(&mut line);
        decisions(plan, texts).into_iter().for_each(&mut line);
        measurement::lines(&plan.measured, &plan.setup).into_iter().for_each(&mut line);
    }
    if let Some(result) = &session.result {
        line("\n[result]".into());
        line(format!("flagged = {}", result.flagged));
        line(format!("clean_sha256 = {}", quoted(&result.clean_sha256)));
        if let Some(flags) = &result.flags_sha256 {
            line(format!("flags_sha256 = {}", quoted(flags)));
        }
    }
    out.push_str(&Digest::of(path, &out)?.lines());
    Ok(out)
}

/// The lines of what the loader was told, and of the sums of the rows.
fn loading(data: &Data) -> Vec<String> {
    let options = &data.options;
    let mut lines = Vec::new();
    for (key, value) in
        [("time", &options.time), ("truth", &options.truth), ("track", &options.track), ("row_check", &data.row_check)]
    {
        if let Some(value) = value {
            lines.push(format!("{key} = {}", quoted(value)));
        }
    }
    for (key, word) in [
        ("delimiter", options.delimiter.and_then(Worded::word)),
        ("encoding", options.encoding.and_then(Worded::word)),
        ("time_unit", options.time_unit.and_then(Worded::word)),
    ] {
        if let Some(word) = word {
            lines.push(format!("{key} = {}", quoted(word)));
        }
    }
    let switches = [
        ("decimal_comma", options.decimal_comma),
        ("header", options.header),
        ("quotes", options.quotes),
        ("day_first", options.day_first),
    ];
    for (key, value) in switches {
        if let Some(value) = value {
            lines.push(format!("{key} = {value}"));
        }
    }
    for (key, number) in [
        ("header_line", options.header_line),
        ("skip", options.skip),
        ("units_line", options.units_line),
        ("table", options.table),
    ] {
        if let Some(number) = number {
            lines.push(format!("{key} = {number}"));
        }
    }
    for (key, text) in [
        ("time_format", options.time_format.as_ref().map(Pattern::text)),
        ("time_zone", options.time_zone.as_deref()),
        ("comment", options.comment.as_deref()),
    ] {
        if let Some(text) = text {
            lines.push(format!("{key} = {}", quoted(text)));
        }
    }
    if !options.names.is_empty() {
        let names: Vec<String> = options.names.iter().map(|n| quoted(n)).collect();
        lines.push(format!("names = [{}]", names.join(", ")));
    }
    if options.rules != Rules::First {
        lines.push(format!("rules = {}", options.rules.number()));
    }
    if !options.missing.is_empty() {
        let markers: Vec<String> = options.missing.iter().map(|m| quoted(m)).collect();
        lines.push(format!("missing = [{}]", markers.join(", ")));
    }
    lines
}

/// The lines of what is done with a channel before its method; none where nothing is.
fn preparation(preparation: &Preparation) -> Vec<String> {
    let mut lines = Vec::new();
    if !preparation.checks.is_empty() {
        lines.push("checks = [".to_owned());
        for applied in &preparation.checks {
            let mut text = format!("  {{ check = {}", quoted(applied.id()));
            if !applied.channels.is_empty() {
                let names: Vec<String> = applied.channels.iter().map(|name| quoted(name)).collect();
                let _ = write!(text, ", channels = [{}]", names.join(", "));
            }
            if !applied.on {
                text.push_str(", on = false");
            }
            for (param, value) in applied.settings.iter() {
                let _ = write!(text, ", {}", assignment(param, value));
            }
            lines.push(text + " },");
        }
        lines.push("]".into());
    }
    lines.extend(preparation.period.map(|period| format!("period = {period:?}")));
    if preparation.exclude_decided {
        lines.push("exclude_decided = true".into());
    }
    lines
}

/// The lines of the decisions of a channel; none where there are none.
fn decisions(plan: &Plan, texts: &[(String, String)]) -> Vec<String> {
    if plan.decisions.is_empty() {
        return Vec::new();
    }
    let mut lines = vec!["decisions = [".to_owned()];
    for ((row, decision), (time, value)) in plan.decisions.iter().zip(texts) {
        let mut text = format!("  {{ row = {}", row + 1);
        let fields = [("time", time.as_str()), ("value", value), ("verdict", decision.ruling.verdict().word())];
        for (key, value) in fields {
            let _ = write!(text, ", {key} = {}", quoted(value));
        }
        if !decision.note.is_empty() {
            let _ = write!(text, ", note = {}", quoted(&decision.note));
        }
        if let Some(by) = &decision.signature.by {
            let _ = write!(text, ", by = {}", quoted(by));
        }
        if let Some(at) = at_text(&decision.signature) {
            let _ = write!(text, ", at = {}", quoted(&at));
        }
        lines.push(text + " },");
    }
    lines.push("]".into());
    lines
}

/// How a session at `session` names its record.
fn reference(source: &Source, session: &Path) -> Result<String> {
    let file = match source {
        Source::BuiltIn { name, .. } => return Ok((*name).to_owned()),
        Source::Input(_) => {
            let help = "save the record as a file, and give its name";
            return Err(Error::input(source.name(), "a session cannot find it again", help));
        }
        Source::File(file) => file,
    };
    let whole = |p: &Path| std::path::absolute(p).unwrap_or_else(|_| p.to_path_buf());
    let (from, to) = (whole(&folder_of(session)), whole(file));
    let from = std::fs::canonicalize(&from).unwrap_or(from);
    let to = std::fs::canonicalize(&to).unwrap_or(to);
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let mut path = PathBuf::new();
    from.components().skip(common).for_each(|_| path.push(".."));
    to.components().skip(common).for_each(|c| path.push(c));
    let what = "its name is not UTF-8, so a session could not refer to it";
    let text = path.to_str().ok_or_else(|| Error::input(file, what, "give it another name, then load it again"))?;
    // Elsewhere a backslash is a character like any other.
    Ok(if cfg!(windows) { text.replace('\\', "/") } else { text.to_owned() })
}

fn inline(settings: &Settings) -> String {
    format!("{{ {} }}", settings.iter().map(|(p, v)| assignment(p, v)).collect::<Vec<_>>().join(", "))
}

fn assignment(param: &Param, value: Value) -> String {
    match value {
        Value::Word(_) | Value::Duration(_) => format!("{} = {}", param.key, quoted(&value.to_string())),
        Value::Numbers(list) => format!("{} = {:?}", param.key, list.as_slice()),
        Value::Words(words) => format!("{} = {}", param.key, list(words.iter())),
        other => format!("{} = {other}", param.key),
    }
}

/// Texts as an array on one line.
pub(super) fn list<'a>(texts: impl Iterator<Item = &'a str>) -> String {
    format!("[{}]", texts.map(quoted).collect::<Vec<_>>().join(", "))
}

pub(in crate::session) fn quoted(text: &str) -> String {
    // A basic string, so that every text stays on one line of its own.
    let mut out = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c if c.is_control() || is_hidden(c) => {
                let code = u32::from(c);
                let _ = if code > 0xffff { write!(out, "\\U{code:08X}") } else { write!(out, "\\u{code:04X}") };
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
