//! The digest of a session file: what was changed in it since it was saved is seen, and named. It covers what the file
//! means, not how it is laid out: comments, blanks and the order of keys are free.
//!
//! Session files hold these sums: what is computed here must never change. `docs/session-format.md` describes it.

use std::fmt::Write as _;
use std::path::Path;

use serde::Deserialize;
use sha2::{Digest as _, Sha256};
use toml::{Table, Value};

use super::document::quoted;
use crate::error::{Error, Result};
use crate::track::hex;

/// The key of a session file that holds the digest and is not covered by it.
const OWN: &str = "digest";

/// Bytes of the sum of a part: against accidents and idle hands. The sum of the whole is a full SHA-256.
const SHORT: usize = 4;

/// The digest of a session file.
#[derive(Debug, Clone, PartialEq)]
pub struct Digest {
    /// SHA-256 of the whole, lower-case hexadecimal.
    session: String,
    /// For each value its short sum, in tables like those of the file: channels by name, decisions by row.
    parts: Table,
}

/// The same as a file has it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenDigest {
    session: String,
    #[serde(default)]
    parts: Table,
}

impl Digest {
    /// The digest of the text of the session file at `path`; what the text itself says of it is left out.
    ///
    /// # Errors
    /// [`Error::Session`] for a text that is no TOML.
    pub fn of(path: &Path, text: &str) -> Result<Self> {
        let table: Table = toml::from_str(text).map_err(|e| Error::Session {
            path: path.to_path_buf(),
            line: None,
            what: e.message().to_owned(),
            help: "save the session again".into(),
        })?;
        Ok(Self::of_table(table))
    }

    pub(super) fn of_table(mut table: Table) -> Self {
        table.remove(OWN);
        let parts = table.iter().map(|(key, value)| (key.clone(), part(value))).collect();
        let mut text = String::new();
        canonical(&Value::Table(table), &mut text);
        Self { session: hex(&Sha256::digest(&text)), parts }
    }

    /// The lines of the file that hold it.
    #[must_use]
    pub fn lines(&self) -> String {
        let mut out = format!("\n[{OWN}]\nsession = {}\n", quoted(&self.session));
        for (key, value) in &self.parts {
            match value {
                Value::Table(channels) if key == "channel" => {
                    for (name, value) in channels {
                        let _ = writeln!(out, "parts.{key}.{} = {}", quoted(name), inline(value));
                    }
                }
                value => {
                    let _ = writeln!(out, "parts.{key} = {}", inline(value));
                }
            }
        }
        out
    }

    /// What was changed since the digest was written, in words; empty when nothing was.
    pub(super) fn differences(&self, then: &WrittenDigest) -> Vec<String> {
        let mut found = Vec::new();
        compare(&then.parts, &self.parts, &mut Vec::new(), &mut found);
        match (then.session == self.session, found.is_empty()) {
            (true, false) => vec!["the digests of the parts were changed since the session was saved".into()],
            (false, true) => vec!["the digest of the session is another one, and its parts do not show why".into()],
            _ => found,
        }
    }
}

/// The short sum of a value, or a table of those of its parts.
fn part(value: &Value) -> Value {
    let named = |key: &str, value: &Value| -> Option<String> {
        Some(match value.as_table()?.get(key)? {
            Value::String(name) => name.clone(),
            other => other.as_integer()?.to_string(),
        })
    };
    let all_named =
        |items: &[Value], key: &str| -> Option<Vec<String>> { items.iter().map(|i| named(key, i)).collect() };
    match value {
        Value::Table(table) => Value::Table(table.iter().map(|(key, value)| (key.clone(), part(value))).collect()),
        Value::Array(items) if !items.is_empty() => match (all_named(items, "name"), all_named(items, "row")) {
            (Some(names), _) => Value::Table(names.into_iter().zip(items.iter().map(part)).collect()),
            (None, Some(rows)) => Value::Table(rows.into_iter().zip(items.iter().map(short)).collect()),
            _ => short(value),
        },
        _ => short(value),
    }
}

fn short(value: &Value) -> Value {
    let mut text = String::new();
    canonical(value, &mut text);
    Value::String(hex(Sha256::digest(&text).get(..SHORT).unwrap_or_default()))
}

/// One text for each value, whatever the file writes it like: tables by the order of their keys, numbers as Rust prints
/// them, every string in quotes.
fn canonical(value: &Value, out: &mut String) {
    match value {
        Value::String(text) => out.push_str(&quoted(text)),
        Value::Integer(n) => {
            let _ = write!(out, "{n}");
        }
        Value::Float(x) => {
            let _ = write!(out, "{x:?}");
        }
        Value::Boolean(b) => {
            let _ = write!(out, "{b}");
        }
        Value::Datetime(t) => {
            let _ = write!(out, "{t}");
        }
        Value::Array(items) => {
            out.push('[');
            for item in items {
                canonical(item, out);
                out.push(',');
            }
            out.push(']');
        }
        Value::Table(table) => {
            let mut keys: Vec<&String> = table.keys().collect();
            keys.sort();
            out.push('{');
            for key in keys {
                let _ = write!(out, "{}=", quoted(key));
                table.get(key).into_iter().for_each(|value| canonical(value, out));
                out.push(',');
            }
            out.push('}');
        }
    }
}

fn inline(value: &Value) -> String {
    match value {
        Value::Table(table) => {
            let bare = |key: &str| !key.is_empty() && key.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
            let key = |key: &str| if bare(key) { key.to_owned() } else { quoted(key) };
            let parts: Vec<String> = table.iter().map(|(k, v)| format!("{} = {}", key(k), inline(v))).collect();
            if parts.is_empty() { "{}".into() } else { format!("{{ {} }}", parts.join(", ")) }
        }
        Value::String(text) => quoted(text),
        other => other.to_string(),
    }
}

/// Names every part that is in one only, or differs.
fn compare<'a>(then: &'a Table, now: &'a Table, path: &mut Vec<&'a str>, found: &mut Vec<String>) {
    let mut keys: Vec<&'a String> = then.keys().chain(now.keys().filter(|k| !then.contains_key(*k))).collect();
    keys.sort_by_key(|key| (key.parse::<u64>().unwrap_or(0), *key));
    for key in keys {
        path.push(key);
        match (then.get(key), now.get(key)) {
            (Some(Value::Table(then)), Some(Value::Table(now))) => compare(then, now, path, found),
            (Some(then), Some(now)) if then != now => found.push(words(path, "changed")),
            (Some(_), None) => found.push(words(path, "removed")),
            (None, Some(_)) => found.push(words(path, "added")),
            _ => {}
        }
        path.pop();
    }
}

fn words(path: &[&str], what: &str) -> String {
    let subject = match path {
        ["channel", channel] => format!("channel {channel}"),
        ["channel", channel, "decisions"] => format!("all decisions on {channel}"),
        ["channel", channel, "decisions", row] => format!("row {row} of {channel}: the decision or its note"),
        ["channel", channel, "repair", "method"] => format!("the repair of {channel}"),
        ["channel", channel, .., key] => format!("{key} of {channel}"),
        [.., key] => (*key).to_owned(),
        [] => "the session".to_owned(),
    };
    let verb = if path.last() == Some(&"decisions") { "were" } else { "was" };
    format!("{subject} {verb} {what} since the session was saved")
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "format = 2\nprogram = \"wildpoint 1\"\n\n[data]\nrows = 3\nrow_check = \"ab\"\n\n[[channel]]\n\
        name = \"a b\"\nsettings = { k = 4.0, order = 2 }\ndecisions = [\n  { row = 9, verdict = \"outlier\", note = \"x\" },\n  \
        { row = 10, verdict = \"normal\" },\n]\n";

    fn written(text: &str) -> WrittenDigest {
        let lines = Digest::of(Path::new("s.toml"), text).unwrap().lines();
        let table: Table = toml::from_str(&(text.to_owned() + &lines)).unwrap();
        table[OWN].clone().try_into().unwrap()
    }

    /// What is said when `from` becomes `to` after the digest was written.
    fn said(from: &str, to: &str) -> Vec<String> {
        assert!(TEXT.contains(from), "{from}");
        let now = Digest::of(Path::new("s.toml"), &TEXT.replacen(from, to, 1)).unwrap();
        now.differences(&written(TEXT))
    }

    #[test]
    fn every_change_is_named() {
        let since = |what: &str| vec![format!("{what} since the session was saved")];
        assert_eq!(said("wildpoint 1", "wildpoint 2"), since("program was changed"));
        assert_eq!(said("rows = 3", "rows = 4"), since("rows was changed"));
        assert_eq!(said("row_check = \"ab\"\n", ""), since("row_check was removed"));
        assert_eq!(said("k = 4.0", "k = 4.1"), since("k of a b was changed"));
        assert_eq!(said("\"x\"", "\"y\""), since("row 9 of a b: the decision or its note was changed"));
        assert_eq!(said("normal", "outlier"), since("row 10 of a b: the decision or its note was changed"));
        assert_eq!(
            said("  { row = 10, verdict = \"normal\" },\n", ""),
            since("row 10 of a b: the decision or its note was removed")
        );
        assert_eq!(said(" },\n]\n", " },\n]\nrate = \"c\"\n"), since("rate of a b was added"));
        let both = said("\"x\" },\n  { row = 10", "\"y\" },\n  { row = 11");
        assert_eq!(both.len(), 3, "{both:?}");
    }

    #[test]
    fn what_the_file_looks_like_is_free() {
        assert_eq!(said("rows = 3\nrow_check", "# a comment\nrows   =   3\n\nrow_check"), [""; 0]);
        assert_eq!(said("k = 4.0, order = 2", "order = 2, k = 4.00"), [""; 0]);
    }

    #[test]
    fn sums_that_were_made_to_fit_do_not_hide_a_change() {
        let forged = Digest::of(Path::new("s.toml"), &TEXT.replace("4.0", "4.1")).unwrap();
        let then = written(TEXT);
        let parts_only = WrittenDigest { session: then.session.clone(), parts: forged.parts.clone() };
        assert!(forged.differences(&parts_only)[0].contains("parts do not show why"));
        let parts_gone = WrittenDigest { parts: Table::new(), ..then };
        assert!(!Digest::of(Path::new("s.toml"), TEXT).unwrap().differences(&parts_gone).is_empty());
    }

    #[test]
    fn what_is_computed_never_changes() {
        // Worked out apart: sha256sum of the text that docs/session-format.md gives as an example.
        let digest = Digest::of(Path::new("s.toml"), "format = 2\nname = \"\u{e9}\\t\"\nk = 4.0\n").unwrap();
        let mut text = String::new();
        let table: Table = toml::from_str("format = 2\nname = \"\u{e9}\\t\"\nk = 4.0\n").unwrap();
        canonical(&Value::Table(table), &mut text);
        assert_eq!(text, "{\"format\"=2,\"k\"=4.0,\"name\"=\"\u{e9}\\t\",}");
        assert_eq!(digest.session, "1f04799e524cbdfeb8b8d5efdf47bac15c96792879e5cba93799b2f7127d2ad8");
    }
}
