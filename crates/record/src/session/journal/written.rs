//! Headers and entries as JSON, values in the words of the session file.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::{Base, Entry, Foreign, Header};
use crate::check::{Applied, find};
use crate::method::Verdict;
use crate::param::Settings;
use crate::review::{Decision, Decisions, Ruling, Signature};
use crate::session::signature::{at_of_text, at_text};
use crate::session::{Plan, Preparation, Preset, Setup, is_period, method_of_id};

/// The version of the lines that this program writes and reads.
const FORMAT: u32 = 1;

#[derive(Serialize, Deserialize)]
struct WrittenHeader {
    format: u32,
    program: String,
    record: String,
    sha256: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    bytes: Option<u64>,
    rows: usize,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    session: Option<WrittenBase>,
    #[serde(default)]
    begun: usize,
    #[serde(default)]
    carried: usize,
}

#[derive(Serialize, Deserialize)]
struct WrittenBase {
    path: String,
    sha256: String,
    /// The bytes of a path that is no UTF-8.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    bytes: Option<Vec<u8>>,
}

impl WrittenBase {
    fn of(base: &Base) -> Self {
        let bytes = base.path.to_str().is_none().then(|| base.path.as_os_str().as_encoded_bytes().to_vec());
        Self { path: base.path.to_string_lossy().into_owned(), sha256: base.sha256.clone(), bytes }
    }

    fn read(self) -> Base {
        let path = self.bytes.and_then(path_of).unwrap_or_else(|| self.path.into());
        Base { path, sha256: self.sha256 }
    }
}

/// The path that these bytes are, where paths are bytes.
#[cfg(unix)]
fn path_of(bytes: Vec<u8>) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStringExt as _;
    Some(std::ffi::OsString::from_vec(bytes).into())
}

#[cfg(not(unix))]
fn path_of(_: Vec<u8>) -> Option<PathBuf> {
    None
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenEntry {
    channel: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    setup: Option<WrittenSetup>,
    /// All decisions there are.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    decisions: Option<Vec<WrittenDecision>>,
    /// Decisions that have changed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    changes: Option<Vec<WrittenDecision>>,
}

/// What one edit changed in several places.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenSeveral {
    several: Vec<WrittenEntry>,
}

#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum WrittenLine {
    Several(WrittenSeveral),
    Single(WrittenEntry),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenSetup {
    method: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rate: Option<String>,
    settings: BTreeMap<String, String>,
    repair: BTreeMap<String, String>,
    /// Checks as `--check` has them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    checks: Vec<WrittenCheck>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    period: Option<f64>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    exclude_decided: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenCheck {
    check: String,
    /// Names may hold any character, so that they stand apart.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    channels: Vec<String>,
    settings: BTreeMap<String, String>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    off: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenDecision {
    /// From 1, as in sessions.
    row: u64,
    /// None: the decision was cleared.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    verdict: Option<String>,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    note: String,
    /// What the method said when it was decided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    said: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    by: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    at: Option<String>,
}

/// The JSON of a header, on one line.
pub(super) fn header_text(header: &Header) -> String {
    json(&WrittenHeader {
        format: FORMAT,
        program: concat!("wildpoint ", env!("CARGO_PKG_VERSION")).into(),
        record: header.record.clone(),
        sha256: header.sha256.clone(),
        bytes: header.bytes,
        rows: header.rows,
        session: header.base.as_ref().map(WrittenBase::of),
        begun: header.begun,
        carried: header.carried,
    })
}

/// The header of a JSON text; none for one that this version does not read.
pub(super) fn header_of(text: &str) -> Option<Header> {
    let w: WrittenHeader = serde_json::from_str(text).ok()?;
    let base = w.session.map(WrittenBase::read);
    let WrittenHeader { record, sha256, bytes, rows, begun, carried, .. } = w;
    (w.format == FORMAT).then_some(Header { record, sha256, bytes, rows, base, begun, carried })
}

/// What every version says in its header.
#[derive(Deserialize)]
struct AnyHeader {
    format: u64,
    #[serde(default)]
    program: String,
    #[serde(default)]
    record: String,
    #[serde(default)]
    sha256: String,
}

/// What a header of another version says; none for one of this version, and for what is no header.
pub(super) fn foreign_of(text: &str) -> Option<Foreign> {
    let AnyHeader { format, program, record, sha256 } = serde_json::from_str(text).ok()?;
    (format != u64::from(FORMAT)).then_some(Foreign { program, record, sha256 })
}

/// The JSON of an entry, on one line.
pub(super) fn entry_text(entry: &Entry) -> String {
    match entry {
        Entry::Several(_) => json(&WrittenSeveral { several: singles(entry) }),
        _ => singles(entry).first().map(json).unwrap_or_default(),
    }
}

/// The entries that an entry consists of.
fn singles(entry: &Entry) -> Vec<WrittenEntry> {
    let of = |channel: &str| WrittenEntry { channel: channel.to_owned(), setup: None, decisions: None, changes: None };
    vec![match entry {
        Entry::Several(entries) => return entries.iter().flat_map(singles).collect(),
        Entry::Whole(plan) => {
            let decisions = plan.decisions.iter().map(|(row, d)| written(row, Some(d))).collect();
            let setup = Some(written_setup(&plan.setup));
            WrittenEntry { setup, decisions: Some(decisions), ..of(&plan.channel) }
        }
        Entry::Setup { channel, setup } => WrittenEntry { setup: Some(written_setup(setup)), ..of(channel) },
        Entry::Decide { channel, decisions } => {
            let changes = decisions.iter().map(|(row, d)| written(*row, d.as_ref())).collect();
            WrittenEntry { changes: Some(changes), ..of(channel) }
        }
    }]
}

/// The entry of a JSON text about a record of `rows` rows; none for one that makes no sense.
pub(super) fn entry_of(text: &str, rows: usize) -> Option<Entry> {
    match serde_json::from_str(text).ok()? {
        WrittenLine::Single(single) => single.read(rows),
        WrittenLine::Several(WrittenSeveral { several }) => {
            Some(Entry::Several(several.into_iter().map(|e| e.read(rows)).collect::<Option<_>>()?))
        }
    }
}

impl WrittenEntry {
    fn read(self, rows: usize) -> Option<Entry> {
        let Self { channel, setup, decisions, changes } = self;
        let read = |list: Vec<WrittenDecision>| list.into_iter().map(|d| d.read(rows)).collect::<Option<Vec<_>>>();
        match (setup, decisions, changes) {
            (Some(setup), Some(list), None) => {
                let mut decisions = Decisions::default();
                read(list)?.into_iter().for_each(|(row, d)| decisions.set(row, d));
                Some(Entry::Whole(Box::new(Plan::new(channel, setup.read()?, decisions))))
            }
            (Some(setup), None, None) => Some(Entry::Setup { channel, setup: Box::new(setup.read()?) }),
            (None, None, Some(list)) => Some(Entry::Decide { channel, decisions: read(list)? }),
            _ => None,
        }
    }
}

fn json(value: &impl Serialize) -> String {
    // These structures hold nothing that JSON cannot: no maps with odd keys, no numbers but whole ones.
    serde_json::to_string(value).unwrap_or_default()
}

fn written(row: u32, decision: Option<&Decision>) -> WrittenDecision {
    WrittenDecision {
        row: u64::from(row) + 1,
        verdict: decision.map(|d| d.ruling.verdict().word().to_owned()),
        note: decision.map(|d| d.note.clone()).unwrap_or_default(),
        said: decision.and_then(|d| d.said).map(|v| v.word().to_owned()),
        by: decision.and_then(|d| d.signature.by.as_deref()).map(str::to_owned),
        at: decision.and_then(|d| at_text(&d.signature)),
    }
}

fn written_setup(setup: &Setup) -> WrittenSetup {
    let texts = |s: &Settings| s.iter().map(|(p, v)| (p.key.to_owned(), v.to_string())).collect();
    let check = |applied: &Applied| WrittenCheck {
        check: applied.id().to_owned(),
        channels: applied.channels.clone(),
        settings: texts(&applied.settings),
        off: !applied.on,
    };
    WrittenSetup {
        method: setup.method.about().id.to_owned(),
        rate: setup.rate.clone(),
        settings: texts(&setup.settings),
        repair: texts(&setup.repair),
        checks: setup.preparation.checks.iter().map(check).collect(),
        period: setup.preparation.period,
        exclude_decided: setup.preparation.exclude_decided,
    }
}

impl WrittenDecision {
    fn read(self, rows: usize) -> Option<(u32, Option<Decision>)> {
        let row = self.row.checked_sub(1).and_then(|r| u32::try_from(r).ok()).filter(|r| (*r as usize) < rows)?;
        let said = match self.said {
            None => None,
            Some(word) => Some(Verdict::ALL.into_iter().find(|v| v.word() == word)?),
        };
        let at = match self.at {
            None => None,
            Some(text) => Some(at_of_text(&text)?),
        };
        let signature = Signature { by: self.by.map(Into::into), at };
        let decision = match self.verdict {
            None => None,
            Some(word) => Some(Decision { ruling: Ruling::of_word(&word)?, note: self.note, said, signature }),
        };
        Some((row, decision))
    }
}

impl WrittenSetup {
    fn read(self) -> Option<Setup> {
        let mut setup = Setup::new(method_of_id(&self.method).ok()?, Preset::Default);
        setup.rate = self.rate;
        let fill = |settings: &mut Settings, texts: BTreeMap<String, String>| {
            texts.iter().all(|(key, text)| settings.set_text("journal", key, text).is_ok())
        };
        let read = |written: WrittenCheck| {
            let mut applied = Applied::new(find(&written.check).ok()?);
            (applied.channels, applied.on) = (written.channels, !written.off);
            (fill(&mut applied.settings, written.settings) && applied.verify().is_ok()).then_some(applied)
        };
        setup.preparation = Preparation {
            checks: self.checks.into_iter().map(read).collect::<Option<_>>()?,
            period: self.period,
            exclude_decided: self.exclude_decided,
        };
        let whole = self.period.is_none_or(is_period);
        (whole && fill(&mut setup.settings, self.settings) && fill(&mut setup.repair, self.repair)).then_some(setup)
    }
}
