//! The session file: TOML, meant to be read and diffed. Every value of every knob is written, so that a later
//! default cannot change an old result.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::Deserialize;
use toml::{Spanned, Table};

use super::{Data, Plan, Recorded, Session, Setup, folder_of, method_of_id};
use crate::error::{Error, Result};
use crate::param::{Kind, Param, Settings, Value, find};
use crate::repair;
use crate::review::{Decision, Decisions, Ruling};
use crate::track::{Delimiter, LoadOptions, Source};

/// The version of the file that this program writes and reads.
const FORMAT: i64 = 1;

/// A session file larger than this is none.
const LARGEST: u64 = 64 << 20;

/// A decision as the file has it, with the texts of the input that it was made on.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenDecision {
    /// Data row from 1.
    pub(super) row: u32,
    /// The text of the time cell.
    #[serde(default)]
    pub(super) time: String,
    /// The text of the value cell.
    pub(super) value: String,
    verdict: String,
    #[serde(default)]
    note: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    #[serde(rename = "format")]
    _format: i64,
    #[serde(rename = "program", default)]
    _program: String,
    data: WrittenData,
    #[serde(default)]
    channel: Vec<Spanned<WrittenChannel>>,
    result: Option<WrittenResult>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenData {
    file: String,
    sha256: String,
    rows: usize,
    #[serde(default)]
    row_check: Option<String>,
    /// From here on: how the record is loaded, where the user had to say it.
    time: Option<String>,
    truth: Option<String>,
    #[serde(default)]
    missing: Vec<String>,
    delimiter: Option<Spanned<String>>,
    decimal_comma: Option<bool>,
    header: Option<bool>,
    quotes: Option<bool>,
    day_first: Option<bool>,
}

/// The words for delimiters.
const DELIMITERS: [(&str, Delimiter); 5] = [
    ("comma", Delimiter::Byte(b',')),
    ("semicolon", Delimiter::Byte(b';')),
    ("tab", Delimiter::Byte(b'\t')),
    ("pipe", Delimiter::Byte(b'|')),
    ("blanks", Delimiter::Blanks),
];

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenChannel {
    name: String,
    method: Spanned<String>,
    #[serde(default)]
    rate: Option<String>,
    #[serde(default)]
    settings: BTreeMap<String, Spanned<toml::Value>>,
    #[serde(default)]
    repair: BTreeMap<String, Spanned<toml::Value>>,
    #[serde(default)]
    decisions: Vec<Spanned<WrittenDecision>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenResult {
    flagged: usize,
    clean_sha256: String,
}

/// A session file as read, with the texts its decisions were made on (for each plan, in the order of its rows).
pub(super) struct Read {
    pub(super) session: Session,
    pub(super) texts: Vec<Vec<WrittenDecision>>,
}

/// Reads a session file. The record itself is not opened.
///
/// # Errors
/// [`Error::Session`] naming key and line for what is not understood; [`Error::Io`].
pub fn read(path: &Path) -> Result<Session> {
    read_with_texts(path).map(|r| r.session)
}

pub(super) fn read_with_texts(path: &Path) -> Result<Read> {
    let size = std::fs::metadata(path).map_err(Error::io("read", path))?.len();
    if size > LARGEST {
        return Err(fault(path, None, format!("{size} bytes are too many for a session"), "is it the right file?"));
    }
    let text = std::fs::read_to_string(path).map_err(Error::io("read", path))?;
    parse(path, &text)
}

fn parse(path: &Path, text: &str) -> Result<Read> {
    let at = |span: Option<Range<usize>>| span.map(|s| line_of(text, s.start));
    let broken = |e: toml::de::Error| {
        fault(path, at(e.span()), e.message().to_owned(), "correct the line, or save the session again")
    };
    let loose: Table = toml::from_str(text).map_err(broken)?;
    match loose.get("format").and_then(toml::Value::as_integer) {
        Some(FORMAT) => {}
        Some(newer) if newer > FORMAT => {
            let what = format!("format = {newer}: this program reads format {FORMAT}");
            return Err(fault(
                path,
                key_line(text, "format"),
                what,
                "use the version of wildpoint that wrote it, or a later one",
            ));
        }
        _ => {
            let what = "format: a session file starts with `format = 1`".to_owned();
            return Err(fault(path, key_line(text, "format"), what, "is it the right file?"));
        }
    }
    let document: Document = toml::from_str(text).map_err(broken)?;
    let reader = Reader { path, text };
    let mut plans = Vec::new();
    let mut texts = Vec::new();
    for channel in document.channel {
        let line = line_of(text, channel.span().start);
        let (plan, written) = reader.plan(channel.into_inner())?;
        if plans.iter().any(|p: &Plan| p.channel == plan.channel) {
            return Err(fault(
                path,
                Some(line),
                format!("{}: this channel comes twice", plan.channel),
                "keep one of them",
            ));
        }
        plans.push(plan);
        texts.push(written);
    }
    if plans.is_empty() {
        return Err(fault(
            path,
            None,
            "no [[channel]]: nothing to do".into(),
            "add a [[channel]] with name and method",
        ));
    }
    let data = reader.data(document.data)?;
    let result = document.result.map(|r| Recorded { flagged: r.flagged, clean_sha256: r.clean_sha256 });
    Ok(Read { session: Session { data, plans, result }, texts })
}

struct Reader<'a> {
    path: &'a Path,
    text: &'a str,
}

impl Reader<'_> {
    fn data(&self, data: WrittenData) -> Result<Data> {
        let delimiter = |word: Spanned<String>| {
            let known = DELIMITERS.iter().find(|d| d.0 == word.get_ref()).map(|d| d.1);
            known.ok_or_else(|| {
                let words = DELIMITERS.map(|d| d.0).join(", ");
                let what = format!("delimiter = {:?}", word.get_ref());
                fault(self.path, self.line(word.span()), what, &format!("delimiters are {words}"))
            })
        };
        let source = match Source::built_in(&data.file) {
            Some(source) => source,
            None => Source::File(folder_of(self.path).join(data.file)),
        };
        let options = LoadOptions {
            time: data.time,
            truth: data.truth,
            missing: data.missing,
            delimiter: data.delimiter.map(delimiter).transpose()?,
            decimal_comma: data.decimal_comma,
            header: data.header,
            quotes: data.quotes,
            day_first: data.day_first,
            ..LoadOptions::default()
        };
        Ok(Data { source, sha256: data.sha256, rows: data.rows, row_check: data.row_check, options })
    }

    fn plan(&self, channel: WrittenChannel) -> Result<(Plan, Vec<WrittenDecision>)> {
        let method_line = self.line(channel.method.span());
        let method = method_of_id(channel.method.get_ref()).map_err(|e| self.wrap(method_line, e))?;
        let about = method.about();
        let mut settings = Settings::defaults(about.params);
        self.fill(&mut settings, about.id, about.params, channel.settings)?;
        let mut repair = Settings::defaults(repair::PARAMS);
        self.fill(&mut repair, "repair", repair::PARAMS, channel.repair)?;
        let mut decisions = Decisions::default();
        let mut written = Vec::new();
        for decision in channel.decisions {
            let line = self.line(decision.span());
            let d = decision.into_inner();
            let ruling = Ruling::of_word(&d.verdict).ok_or_else(|| {
                fault(self.path, line, format!("verdict = {:?}", d.verdict), "a decision is `normal` or `outlier`")
            })?;
            let row = d
                .row
                .checked_sub(1)
                .ok_or_else(|| fault(self.path, line, "row = 0".into(), "rows count from 1, the first line of data"))?;
            if decisions.get(row).is_some() {
                return Err(fault(self.path, line, format!("row {}: decided twice", d.row), "keep one decision"));
            }
            decisions.set(row, Some(Decision { ruling, note: d.note.clone(), said: None }));
            written.push(d);
        }
        let setup = Setup { method, settings, rate: channel.rate, repair };
        Ok((Plan { channel: channel.name, setup, decisions }, written))
    }

    fn fill(
        &self,
        settings: &mut Settings,
        owner: &str,
        params: &'static [Param],
        values: BTreeMap<String, Spanned<toml::Value>>,
    ) -> Result<()> {
        for (key, value) in values {
            let line = self.line(value.span());
            find(params, owner, &key)
                .and_then(|p| value_of(p, value.get_ref()))
                .and_then(|v| settings.set(owner, &key, v))
                .map_err(|e| self.wrap(line, e))?;
        }
        Ok(())
    }

    fn line(&self, span: Range<usize>) -> Option<usize> {
        Some(line_of(self.text, span.start))
    }

    /// A complaint about a value, with the line it stands on.
    fn wrap(&self, line: Option<usize>, e: Error) -> Error {
        match e {
            Error::Usage { what, help } => fault(self.path, line, what, &help),
            other => other,
        }
    }
}

/// The value as the parameter takes it: a word only where it has words, a number only where it has numbers.
fn value_of(param: &Param, value: &toml::Value) -> Result<Value> {
    let words: &[&str] = match param.kind {
        Kind::Choice(words) | Kind::RealOr { words, .. } => words,
        Kind::WholeOrOff { .. } => &["off"],
        Kind::Whole { .. } | Kind::Real { .. } | Kind::Switch => &[],
    };
    match value {
        toml::Value::Integer(n) => param.accept(Value::Whole(*n)),
        toml::Value::Float(x) => param.accept(Value::Real(*x)),
        toml::Value::Boolean(b) => param.accept(Value::Switch(*b)),
        toml::Value::String(s) if words.contains(&s.as_str()) => param.parse(s),
        other => Err(Error::usage(
            format!("{} = {other}: not a legal value", param.key),
            format!("{} takes {}", param.key, param.range()),
        )),
    }
}

fn line_of(text: &str, offset: usize) -> usize {
    1 + text.bytes().take(offset).filter(|b| *b == b'\n').count()
}

fn key_line(text: &str, key: &str) -> Option<usize> {
    text.lines().position(|l| l.trim_start().starts_with(key)).map(|i| i + 1)
}

fn fault(path: &Path, line: Option<usize>, what: String, help: &str) -> Error {
    Error::Session { path: path.to_path_buf(), line, what, help: help.to_owned() }
}

/// The session file for a session that lies at `path`. `texts` gives, for each plan, the texts of time and value of
/// each decided row, in the order of the rows.
#[must_use]
pub fn render(session: &Session, path: &Path, texts: &[Vec<(String, String)>]) -> String {
    let mut out = String::new();
    let mut line = |text: String| {
        out.push_str(&text);
        out.push('\n');
    };
    line(format!("format = {FORMAT}"));
    line(format!("program = {}", quoted(concat!("wildpoint ", env!("CARGO_PKG_VERSION")))));
    line("\n[data]".into());
    line(format!("file = {}", quoted(&reference(&session.data.source, path))));
    line(format!("sha256 = {}", quoted(&session.data.sha256)));
    line(format!("rows = {}", session.data.rows));
    let options = &session.data.options;
    for (key, value) in [("time", &options.time), ("truth", &options.truth), ("row_check", &session.data.row_check)] {
        if let Some(value) = value {
            line(format!("{key} = {}", quoted(value)));
        }
    }
    let delimiter = options.delimiter.and_then(|d| DELIMITERS.iter().find(|x| x.1 == d));
    if let Some((word, _)) = delimiter {
        line(format!("delimiter = {}", quoted(word)));
    }
    let switches = [
        ("decimal_comma", options.decimal_comma),
        ("header", options.header),
        ("quotes", options.quotes),
        ("day_first", options.day_first),
    ];
    for (key, value) in switches {
        if let Some(value) = value {
            line(format!("{key} = {value}"));
        }
    }
    if !options.missing.is_empty() {
        let markers: Vec<String> = options.missing.iter().map(|m| quoted(m)).collect();
        line(format!("missing = [{}]", markers.join(", ")));
    }
    for (plan, texts) in session.plans.iter().zip(texts) {
        line("\n[[channel]]".into());
        line(format!("name = {}", quoted(&plan.channel)));
        line(format!("method = {}", quoted(plan.setup.method.about().id)));
        if let Some(rate) = &plan.setup.rate {
            line(format!("rate = {}", quoted(rate)));
        }
        line(format!("settings = {}", inline(&plan.setup.settings)));
        line(format!("repair = {}", inline(&plan.setup.repair)));
        if plan.decisions.is_empty() {
            continue;
        }
        line("decisions = [".into());
        for ((row, decision), (time, value)) in plan.decisions.iter().zip(texts) {
            let mut text = format!("  {{ row = {}", row + 1);
            let fields = [("time", time.as_str()), ("value", value), ("verdict", decision.ruling.verdict().word())];
            for (key, value) in fields {
                let _ = write!(text, ", {key} = {}", quoted(value));
            }
            if !decision.note.is_empty() {
                let _ = write!(text, ", note = {}", quoted(&decision.note));
            }
            line(text + " },");
        }
        line("]".into());
    }
    if let Some(result) = &session.result {
        line("\n[result]".into());
        line(format!("flagged = {}", result.flagged));
        line(format!("clean_sha256 = {}", quoted(&result.clean_sha256)));
    }
    out
}

/// How a session at `session` names its record.
fn reference(source: &Source, session: &Path) -> String {
    let file = match source {
        Source::BuiltIn { name, .. } => return (*name).to_owned(),
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
    path.to_string_lossy().replace('\\', "/")
}

fn inline(settings: &Settings) -> String {
    let one = |(p, v): (&Param, Value)| match v {
        Value::Word(word) => format!("{} = {}", p.key, quoted(word)),
        other => format!("{} = {other}", p.key),
    };
    format!("{{ {} }}", settings.iter().map(one).collect::<Vec<_>>().join(", "))
}

fn quoted(text: &str) -> String {
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
            c if c.is_control() => {
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
