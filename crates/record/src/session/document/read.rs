//! Reading a session file: what is not understood is an error that names key and line.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::sync::OnceLock;

use serde::Deserialize;
use toml::{Spanned, Table};
use wildpoint_core::error::Error as CoreError;

use super::measurement::{self, WrittenAdvice, WrittenDetectability};
use super::{FORMAT, OLDEST};
use crate::check::{Applied, find as find_check};
use crate::error::{Error, Result};
use crate::memory::Share;
use crate::param::{Kind, Numbers, Param, Settings, Value, Words, find};
use crate::repair;
use crate::review::{Decision, Decisions, Ruling, Signature};
use crate::session::archive::Archive;
use crate::session::digest::{Digest, WrittenDigest};
use crate::session::signature::at_of_text;
use crate::session::{Data, Plan, Preparation, Recorded, Session, Setup, folder_of, is_period, method_of_id, tidied};
use crate::track::{DASH, LoadOptions, Pattern, Rules, Source, Worded};

/// A parameter that sessions of earlier programs do not have.
struct Later {
    /// The method that has it; none for every method that does.
    method: Option<&'static str>,
    key: &'static str,
    /// The value that stands for what was done before.
    before: Value,
}

const LATER: [Later; 2] = [
    Later { method: Some("matched"), key: "repair_rule", before: Value::Word("expected") },
    Later { method: None, key: "doubt", before: Value::Real(1.0) },
];

/// A session file larger than this is none.
const LARGEST: u64 = 64 << 20;

/// Bytes that a byte of it takes while it is read.
const OF_BYTE: u64 = 80;

/// A decision as the file has it, with the texts of the input that it was made on.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::session) struct WrittenDecision {
    /// Data row from 1.
    pub(in crate::session) row: u32,
    /// The text of the time cell.
    #[serde(default)]
    pub(in crate::session) time: String,
    /// The text of the value cell.
    pub(in crate::session) value: String,
    pub(in crate::session) verdict: String,
    #[serde(default)]
    pub(in crate::session) note: String,
    /// The name of who decided.
    #[serde(default)]
    by: Option<String>,
    /// When, as in `2026-12-01T02:15:00Z`.
    #[serde(default)]
    at: Option<String>,
    /// The line of the session file it stands on.
    #[serde(skip)]
    pub(in crate::session) line: Option<usize>,
}

impl WrittenDecision {
    /// By whom and when it was decided; a moment that cannot be read is not known.
    pub(in crate::session) fn signature(&self) -> Signature {
        Signature { by: self.by.as_deref().map(Into::into), at: self.at.as_deref().and_then(at_of_text) }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    format: i64,
    #[serde(rename = "program", default)]
    _program: String,
    output_value: Option<Spanned<String>>,
    data: WrittenData,
    #[serde(default)]
    channel: Vec<Spanned<WrittenChannel>>,
    result: Option<WrittenResult>,
    digest: Option<WrittenDigest>,
    archive: Option<Archive>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenData {
    file: String,
    sha256: String,
    bytes: Option<u64>,
    rows: Spanned<usize>,
    record_was: Option<Spanned<String>>,
    #[serde(default)]
    row_check: Option<String>,
    /// From here on: how the record is loaded, where the user had to say it.
    time: Option<String>,
    truth: Option<String>,
    track: Option<String>,
    #[serde(default)]
    missing: Vec<String>,
    delimiter: Option<Spanned<String>>,
    encoding: Option<Spanned<String>>,
    time_unit: Option<Spanned<String>>,
    decimal_comma: Option<bool>,
    header: Option<bool>,
    quotes: Option<bool>,
    day_first: Option<bool>,
    time_format: Option<Spanned<String>>,
    time_zone: Option<String>,
    header_line: Option<usize>,
    skip: Option<usize>,
    units_line: Option<usize>,
    comment: Option<String>,
    #[serde(default)]
    names: Vec<String>,
    table: Option<usize>,
    /// By which rules the record was understood; the first, where nothing is said.
    rules: Option<Spanned<i64>>,
}

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
    checks: Vec<Spanned<WrittenCheck>>,
    #[serde(default)]
    period: Option<Spanned<f64>>,
    #[serde(default)]
    exclude_decided: bool,
    #[serde(default)]
    decisions: Vec<Spanned<WrittenDecision>>,
    advice: Option<WrittenAdvice>,
    detectability: Option<WrittenDetectability>,
}

#[derive(Deserialize)]
struct WrittenCheck {
    check: String,
    #[serde(default)]
    channels: Vec<String>,
    #[serde(default = "yes")]
    on: bool,
    /// The parameters of the check.
    #[serde(flatten)]
    settings: BTreeMap<String, toml::Value>,
}

fn yes() -> bool {
    true
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenResult {
    flagged: usize,
    clean_sha256: String,
    flags_sha256: Option<String>,
}

/// A session file as read, with the texts its decisions were made on (for each plan, in the order of its rows).
pub(in crate::session) struct Read {
    pub(in crate::session) session: Session,
    pub(in crate::session) texts: Vec<Vec<WrittenDecision>>,
    /// The line that gives the number of rows.
    pub(in crate::session) rows_line: Option<usize>,
    /// What was changed in the file since it was saved, in words; none where the file does not tell.
    pub(in crate::session) altered: Option<Vec<String>>,
    /// What came out on an archive.
    pub(in crate::session) archive: Option<Archive>,
}

/// Reads a session file. The record itself is not opened.
///
/// # Errors
/// [`Error::Session`] naming key and line for what is not understood; [`Error::Io`].
pub fn read(path: &Path) -> Result<Session> {
    read_with_texts(path).map(|r| r.session)
}

pub(in crate::session) fn read_with_texts(path: &Path) -> Result<Read> {
    use std::io::Read as _;
    let unreadable = || Error::io("read", path);
    let large = || {
        let what = format!("more than {} MiB are too many for a session", LARGEST >> 20);
        fault(path, None, what, "is it the right file?")
    };
    let mut text = String::new();
    let mut share = Share::default();
    let mut read =
        |from: &mut dyn std::io::Read| from.take(LARGEST + 1).read_to_string(&mut text).map_err(unreadable());
    if path == Path::new(DASH) {
        // It can be read once, and a session is asked for its record before it is run.
        static TEXT: OnceLock<String> = OnceLock::new();
        if TEXT.get().is_none() {
            read(&mut std::io::stdin().lock())?;
        }
        text = TEXT.get_or_init(|| text).clone();
    } else {
        // A pipe would wait for its other end, and a device may have none.
        let about = path.metadata().map_err(unreadable())?;
        if !about.is_file() {
            return Err(fault(path, None, "not a regular file".into(), "name a session file"));
        }
        // Known before anything of it is read.
        if about.len() > LARGEST {
            return Err(large());
        }
        share.set(about.len().saturating_mul(OF_BYTE)).map_err(Error::memory(path))?;
        read(&mut std::fs::File::open(path).map_err(unreadable())?)?;
    }
    // The size that a growing file tells is not what it gives.
    if text.len() as u64 > LARGEST {
        return Err(large());
    }
    share.set((text.len() as u64).saturating_mul(OF_BYTE)).map_err(Error::memory(path))?;
    parse_with_texts(path, &text)
}

/// Reads the text of a session file that lies (or would lie) at `path`. The record itself is not opened.
///
/// # Errors
/// [`Error::Session`] naming key and line for what is not understood.
pub fn parse(path: &Path, text: &str) -> Result<Session> {
    parse_with_texts(path, text).map(|r| r.session)
}

fn parse_with_texts(path: &Path, text: &str) -> Result<Read> {
    let at = |span: Option<Range<usize>>| span.map(|s| line_of(text, s.start));
    let broken = |e: toml::de::Error| {
        let what = format!("{}{}", key_before(text, e.span()), plain(e.message()));
        fault(path, at(e.span()), what, "correct the line, or save the session again")
    };
    let loose: Table = toml::from_str(text).map_err(broken)?;
    match loose.get("format").and_then(toml::Value::as_integer) {
        Some(OLDEST..=FORMAT) => {}
        Some(newer) if newer > FORMAT => {
            let what = format!("format = {newer}: this program reads format {OLDEST} to {FORMAT}");
            return Err(fault(
                path,
                key_line(text, "format"),
                what,
                "use the version of wildpoint that wrote it, or a later one",
            ));
        }
        _ => {
            let what = "format: a session file starts with `format = 2`".to_owned();
            return Err(fault(path, key_line(text, "format"), what, "is it the right file?"));
        }
    }
    let document: Document = toml::from_str(text).map_err(broken)?;
    let reader = Reader { path, text };
    let mut plans = Vec::new();
    let mut texts = Vec::new();
    for channel in document.channel {
        let line = line_of(text, channel.span().start);
        let (plan, written) = reader.plan(channel.into_inner(), Some(line))?;
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
    let rows_line = reader.line(document.data.rows.span());
    let newer = document.data.bytes.is_some() || document.data.record_was.is_some();
    let altered = match document.digest {
        None if document.format == OLDEST && !newer => None,
        None => Some(vec!["the digest was removed since the session was saved".to_owned()]),
        Some(written) => Some(Digest::of_table(loose).differences(&written)),
    };
    let value = reader.told("output_value", document.output_value)?.unwrap_or_default();
    let data = reader.data(document.data)?;
    let result = document.result.map(|r| Recorded {
        flagged: r.flagged,
        clean_sha256: r.clean_sha256,
        flags_sha256: r.flags_sha256,
    });
    let session = Session { data, plans, value, result };
    Ok(Read { session, texts, rows_line, altered, archive: document.archive })
}

struct Reader<'a> {
    path: &'a Path,
    text: &'a str,
}

impl Reader<'_> {
    fn data(&self, data: WrittenData) -> Result<Data> {
        let source = match Source::built_in(&data.file) {
            Some(source) => source,
            None => Source::File(tidied(&folder_of(self.path).join(data.file))),
        };
        let options = LoadOptions {
            time: data.time,
            truth: data.truth,
            track: data.track,
            missing: data.missing,
            delimiter: self.told("delimiter", data.delimiter)?,
            encoding: self.told("encoding", data.encoding)?,
            time_unit: self.told("time_unit", data.time_unit)?,
            decimal_comma: data.decimal_comma,
            header: data.header,
            quotes: data.quotes,
            day_first: data.day_first,
            time_format: self.pattern(data.time_format)?,
            time_zone: data.time_zone,
            header_line: data.header_line,
            skip: data.skip,
            units_line: data.units_line,
            comment: data.comment,
            names: data.names,
            table: data.table,
            rules: self.rules(data.rules)?,
            channels: Vec::new(),
            beside: Vec::new(),
        };
        Ok(Data {
            source,
            sha256: data.sha256,
            bytes: data.bytes,
            rows: data.rows.into_inner(),
            record_was: self.told("record_was", data.record_was)?,
            row_check: data.row_check,
            options,
        })
    }

    fn pattern(&self, text: Option<Spanned<String>>) -> Result<Option<Pattern>> {
        let Some(text) = text else { return Ok(None) };
        Pattern::new(text.get_ref()).map(Some).map_err(|e| self.wrap(self.line(text.span()), e))
    }

    fn rules(&self, number: Option<Spanned<i64>>) -> Result<Rules> {
        let Some(number) = number else { return Ok(Rules::First) };
        Rules::of_number(*number.get_ref()).ok_or_else(|| {
            let what = format!("rules = {}: this program knows rules 1 and 2", number.get_ref());
            fault(
                self.path,
                self.line(number.span()),
                what,
                "use the version of wildpoint that wrote it, or a later one",
            )
        })
    }

    /// A value of the loader that is told by a word.
    fn told<T: Worded>(&self, key: &str, word: Option<Spanned<String>>) -> Result<Option<T>> {
        let Some(word) = word else { return Ok(None) };
        let unknown = || {
            let what = format!("{key} = {:?}", word.get_ref());
            fault(self.path, self.line(word.span()), what, &format!("it can be {}", T::words()))
        };
        T::of_word(word.get_ref()).map(Some).ok_or_else(unknown)
    }

    /// The plan of the channel that begins at the line `at`.
    fn plan(&self, channel: WrittenChannel, at: Option<usize>) -> Result<(Plan, Vec<WrittenDecision>)> {
        let method_line = self.line(channel.method.span());
        let method = method_of_id(channel.method.get_ref()).map_err(|e| self.wrap(method_line, e))?;
        let about = method.about();
        let mut settings = Settings::defaults(about.params);
        // Parameters that came later mean what was done before.
        for later in LATER.iter().filter(|later| later.method.is_none_or(|id| id == about.id)) {
            if settings.get(later.key).is_some() {
                settings.set(about.id, later.key, later.before)?;
            }
        }
        self.fill(&mut settings, about.id, about.params, channel.settings)?;
        let mut repair = Settings::defaults(repair::PARAMS);
        self.fill(&mut repair, "repair", repair::PARAMS, channel.repair)?;
        let mut decisions = Decisions::default();
        let mut written = Vec::new();
        for decision in channel.decisions {
            let line = self.line(decision.span());
            let d = WrittenDecision { line, ..decision.into_inner() };
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
            let signature = d.signature();
            if let (Some(text), None) = (&d.at, signature.at) {
                let help = "write a moment such as \"2026-12-01T02:15:00Z\"";
                return Err(fault(self.path, line, format!("at = {text:?}"), help));
            }
            decisions.set(row, Some(Decision { ruling, note: d.note.clone(), said: None, signature }));
            written.push(d);
        }
        let preparation = Preparation {
            checks: channel.checks.into_iter().map(|check| self.check(check)).collect::<Result<_>>()?,
            period: channel.period.map(|period| self.period(&period)).transpose()?,
            exclude_decided: channel.exclude_decided,
        };
        let setup = Setup { method, settings, rate: channel.rate, repair, preparation };
        let measured = measurement::read(channel.advice, channel.detectability, &setup)
            .map_err(|what| fault(self.path, at, what, "correct it, or take the table out of the session"))?;
        Ok((Plan { measured, ..Plan::new(channel.name, setup, decisions) }, written))
    }

    fn check(&self, written: Spanned<WrittenCheck>) -> Result<Applied> {
        let line = self.line(written.span());
        let WrittenCheck { check, channels, on, settings } = written.into_inner();
        let mut applied = Applied::new(find_check(&check).map_err(|e| self.wrap(line, e))?);
        (applied.channels, applied.on) = (channels, on);
        for (key, value) in settings {
            find(applied.check.about().params, applied.id(), &key)
                .and_then(|param| value_of(param, &value))
                .and_then(|value| applied.set(&key, value))
                .map_err(|e| self.wrap(line, e))?;
        }
        applied.verify().map_err(|e| self.wrap(line, e))?;
        Ok(applied)
    }

    fn period(&self, period: &Spanned<f64>) -> Result<f64> {
        let value = *period.get_ref();
        if is_period(value) {
            return Ok(value);
        }
        let what = format!("period = {value}: not a period");
        Err(fault(self.path, self.line(period.span()), what, "give a positive number in units of the channel"))
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
    fn wrap(&self, line: Option<usize>, e: impl Into<Error>) -> Error {
        match e.into() {
            Error::Usage { what, help } => fault(self.path, line, what, &help),
            other => other,
        }
    }
}

/// The value as the parameter takes it: a word only where it has words, a number only where it has numbers.
fn value_of(param: &Param, value: &toml::Value) -> std::result::Result<Value, CoreError> {
    let words: &[&str] = match param.kind {
        Kind::Choice(words) | Kind::RealOr { words, .. } => words,
        Kind::WholeOrOff { .. } => &["off"],
        Kind::Whole { .. } | Kind::Real { .. } | Kind::Switch | Kind::Numbers | Kind::Words(_) => &[],
    };
    match value {
        toml::Value::Integer(n) => param.accept(Value::Whole(*n)),
        toml::Value::Float(x) => param.accept(Value::Real(*x)),
        toml::Value::Boolean(b) => param.accept(Value::Switch(*b)),
        toml::Value::Array(texts) if let Kind::Words(list) = param.kind => {
            let words: Option<Vec<&str>> = texts.iter().map(toml::Value::as_str).collect();
            let words = words.and_then(|words| Words::of(list, words));
            words.map_or_else(|| Err(illegal(param, value)), |words| param.accept(Value::Words(words)))
        }
        toml::Value::Array(list) => {
            numbers(list).map_or_else(|| Err(illegal(param, value)), |numbers| param.accept(Value::Numbers(numbers)))
        }
        toml::Value::String(s) if words.contains(&s.as_str()) => param.parse(s),
        // A number in quotes is none.
        toml::Value::String(s) if param.takes_durations() && s.parse::<f64>().is_err() => param.parse(s),
        other => Err(illegal(param, other)),
    }
}

fn illegal(param: &Param, value: &toml::Value) -> CoreError {
    CoreError::usage(
        format!("{} = {value}: not a legal value", param.key),
        format!("{} takes {}", param.key, param.range()),
    )
}

/// A list of numbers; none when something else is in it.
fn numbers(list: &[toml::Value]) -> Option<Numbers> {
    let number = |value: &toml::Value| match value {
        #[expect(clippy::cast_precision_loss, reason = "settings typed by a person are far below 2^53")]
        toml::Value::Integer(n) => Some(*n as f64),
        toml::Value::Float(x) => Some(*x),
        _ => None,
    };
    Numbers::of(&list.iter().map(number).collect::<Option<Vec<f64>>>()?)
}

fn line_of(text: &str, offset: usize) -> usize {
    1 + text.bytes().take(offset).filter(|b| *b == b'\n').count()
}

/// The key of the value at `span`, with a colon; empty where the span is no value. (The parser's own words name
/// unknown and missing keys, but not the key of a value of the wrong type.)
fn key_before(text: &str, span: Option<Range<usize>>) -> String {
    let before = span.and_then(|s| text.get(..s.start)).unwrap_or_default();
    let Some(before) = before.trim_end().strip_suffix('=') else { return String::new() };
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let key = before.trim_end().rsplit(|c| !bare(c)).next().unwrap_or_default();
    format!("{key}: ")
}

/// The parser's words without names of types.
fn plain(message: &str) -> String {
    ["usize", "u32", "i64"]
        .iter()
        .fold(message.to_owned(), |m, name| m.replace(&format!("expected {name}"), "expected a whole number"))
}

fn key_line(text: &str, key: &str) -> Option<usize> {
    text.lines().position(|l| l.trim_start().starts_with(key)).map(|i| i + 1)
}

fn fault(path: &Path, line: Option<usize>, what: String, help: &str) -> Error {
    Error::Session { path: path.to_path_buf(), line, what, help: help.to_owned() }
}
