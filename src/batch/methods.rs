//! `methods`: the registry, for people, for programs and for the README.

use std::fmt::Write as _;
use std::io::Write;

use serde::Serialize;

use super::{Ending, print, print_json};
use crate::check::{CHECKS, Check};
use crate::error::Result;
use crate::experiment::{CHOICES, Choice};
use crate::method::{METHODS, Method};
use crate::param::Param;
use crate::repair::{PARAMS, REPAIRS};
use crate::session::method_of_id;
use crate::wrapped::wrapped;

#[derive(Serialize)]
struct Listed {
    id: &'static str,
    name: &'static str,
    family: &'static str,
    source: &'static str,
    advice: &'static str,
    needs_rate: bool,
    parameters: Vec<ListedParam>,
}

#[derive(Serialize)]
struct ListedParam {
    key: &'static str,
    help: String,
    unit: &'static str,
    values: String,
    default: serde_json::Value,
    #[serde(skip_serializing_if = "Option::is_none")]
    paper: Option<serde_json::Value>,
    /// Whether the document gives the value of `paper`, or leaves it open.
    #[serde(skip_serializing_if = "Option::is_none")]
    printed: Option<bool>,
    /// Why the default is another than the value of the paper.
    #[serde(skip_serializing_if = "Option::is_none")]
    why: Option<&'static str>,
}

pub(super) fn run(id: Option<&str>, json: bool, as_markdown: bool, out: &mut dyn Write) -> Result<Ending> {
    if as_markdown {
        return print(out, &markdown());
    }
    match (id, json) {
        (Some(id), true) => print_json(out, &listed(method_of_id(id)?)),
        (Some(id), false) => print(out, &explained(id)?),
        (None, true) => print_json(out, &METHODS.iter().map(|m| listed(*m)).collect::<Vec<_>>()),
        (None, false) => print(out, &list()),
    }
}

/// The methods with their parameters, as JSON.
///
/// # Errors
/// None but those of the writer of JSON.
pub fn json() -> serde_json::Result<String> {
    serde_json::to_string(&METHODS.iter().map(|m| listed(*m)).collect::<Vec<_>>())
}

/// The page about a method or a check.
///
/// # Errors
/// [`crate::error::Error::Usage`] for an unknown id.
pub fn explained(id: &str) -> Result<String> {
    Ok(match check_of_id(id) {
        Some(check) => check_page(check),
        None => page(method_of_id(id)?),
    })
}

/// Whether a method or a check has this id.
#[must_use]
pub fn is_explained(id: &str) -> bool {
    check_of_id(id).is_some() || METHODS.iter().any(|method| method.about().id == id)
}

fn listed(method: &dyn Method) -> Listed {
    let about = method.about();
    Listed {
        id: about.id,
        name: about.name,
        family: about.family,
        source: about.source,
        advice: about.advice,
        needs_rate: about.needs_rate,
        parameters: about.params.iter().map(listed_param).collect(),
    }
}

fn listed_param(param: &Param) -> ListedParam {
    ListedParam {
        key: param.key,
        help: one_line(param.help),
        unit: param.unit,
        values: param.range(),
        default: serde_json::json!(param.default),
        paper: param.paper.map(|paper| serde_json::json!(paper.value)),
        printed: param.paper.map(|paper| paper.printed),
        why: param.paper.map(|paper| paper.why),
    }
}

fn list() -> String {
    let mut out = String::new();
    let mut family = "";
    for about in METHODS.iter().map(|m| m.about()) {
        if about.family != family {
            let _ = writeln!(out, "{}{}", if family.is_empty() { "" } else { "\n" }, about.family);
            family = about.family;
        }
        let _ = writeln!(out, "  {:18} {} ({})", about.id, about.name, about.source);
    }
    out.push_str("\nrepairs\n");
    for repair in REPAIRS {
        let _ = writeln!(out, "  {:18} {}", repair.id, repair.help);
    }
    out.push_str("\nchecks before the method (--check)\n");
    for about in CHECKS.iter().map(|c| c.about()) {
        let _ = writeln!(out, "  {:18} {}", about.id, about.help);
    }
    out.push_str(
        "\nwhich method when: the documents' own comparisons, and what was measured on their experiments here\n",
    );
    CHOICES.iter().for_each(|choice| choice_lines(choice, &mut out));
    out.push_str("\n`wildpoint methods ID` explains one, with its parameters.\n");
    out
}

/// A row of the table of advice.
fn choice_lines(choice: &Choice, out: &mut String) {
    let text = format!(
        "{}; in a row: {}; {}; {}. {}. Here: {}.",
        choice.outliers,
        choice.run,
        choice.record,
        choice.mode(),
        choice.document,
        choice.measured()
    );
    let first = format!("  {:18} ", choice.method);
    for line in wrapped(&text, WIDTH, (&first, "                     ")) {
        let _ = writeln!(out, "{line}");
    }
}

/// The same as a table of Markdown, for the pages.
#[must_use]
pub fn choices() -> String {
    let mut out = String::from(
        "| outliers | in a row | record | | method | the document | measured here |\n|---|---|---|---|---|---|---|\n",
    );
    for choice in CHOICES {
        let Choice { outliers, run, record, method, document, .. } = choice;
        let (mode, measured) = (choice.mode(), choice.measured());
        let _ = writeln!(out, "| {outliers} | {run} | {record} | {mode} | `{method}` | {document} | {measured} |");
    }
    out
}

fn page(method: &dyn Method) -> String {
    let about = method.about();
    let mut out = format!("{}: {} ({}, {})\n\n", about.id, about.name, about.family, about.source);
    wrap(&mut out, "", &one_line(about.advice));
    parameters(&mut out, "parameters", about.params);
    departures(&mut out, about.params);
    parameters(&mut out, "parameters of repair", PARAMS);
    out
}

/// Where the defaults are not what the document has, and why.
fn departures(out: &mut String, params: &[Param]) {
    if params.iter().all(|p| p.paper.is_none()) {
        return;
    }
    out.push_str("\nwhere the defaults depart from the document (--preset paper)\n");
    for (param, paper) in params.iter().filter_map(|p| Some((p, p.paper?))) {
        let whose = if paper.printed { "the document" } else { "the document leaves it open; --preset paper" };
        let _ = writeln!(out, "  {:16} {} ({whose}: {}): {}", param.key, param.default, paper.value, paper.why);
    }
}

/// The check with this id, unless a method has it.
fn check_of_id(id: &str) -> Option<&'static dyn Check> {
    CHECKS.iter().copied().find(|check| check.about().id == id)
}

fn check_page(check: &dyn Check) -> String {
    let about = check.about();
    let mut out = format!("{}: a check before the method\n\n", about.id);
    wrap(&mut out, "", about.help);
    let channels = about.channels.map_or("", |_| "channels=A,B,");
    wrap(&mut out, "", &format!("--check {}:{channels}KEY=VALUE,KEY=VALUE", about.id));
    parameters(&mut out, "parameters", about.params);
    out
}

fn parameters(out: &mut String, title: &str, params: &[Param]) {
    let _ = writeln!(out, "\n{title}");
    for p in params {
        let paper = p.paper.map_or(String::new(), |paper| format!(", paper {}", paper.value));
        let unit = if p.unit.is_empty() { String::new() } else { format!(" {}", p.unit) };
        let default = p.default.to_string();
        let default = if default.is_empty() { "none" } else { &default };
        let _ = writeln!(out, "  {:16} default {default}{paper}  [{}]{unit}", p.key, p.range());
        wrap(out, "                   ", &one_line(p.help));
    }
}

/// The methods table of the README.
#[must_use]
pub fn markdown() -> String {
    let mut out = String::from("| id | method | family | source | parameters (default) |\n|---|---|---|---|---|\n");
    for about in METHODS.iter().map(|m| m.about()) {
        let params: Vec<String> = about.params.iter().map(|p| format!("`{}` {}", p.key, p.default)).collect();
        let _ = writeln!(
            out,
            "| `{}` | {} | {} | {} | {} |",
            about.id,
            about.name,
            about.family,
            about.source,
            params.join(", ")
        );
    }
    out
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Columns of the text.
const WIDTH: usize = 98;

fn wrap(out: &mut String, indent: &str, text: &str) {
    for line in wrapped(text, WIDTH, (indent, indent)) {
        let _ = writeln!(out, "{line}");
    }
}
