//! The mutants of the program, as `cargo mutants --list --json` lists them.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// A place in a file: line and column, both from 1, the column in characters.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Place {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
}

/// One change of the program that a test ought to notice.
#[derive(Clone, PartialEq, Debug)]
pub struct Mutant {
    /// File, relative to the root of the checkout.
    pub file: String,
    /// What is changed, in words and without its place: `replace < with <= in gate`.
    pub name: String,
    /// The text that is replaced: from, to (exclusive).
    pub span: (Place, Place),
    /// The text that takes its place.
    pub replacement: String,
}

/// The mutants of the checkout at `root`.
///
/// # Errors
/// Words that say why `cargo mutants` could not be asked, or which field its answer lacks.
pub fn list(root: &Path) -> Result<Vec<Mutant>, String> {
    let output = Command::new("cargo")
        .args(["mutants", "--list", "--json"])
        .current_dir(root)
        .output()
        .map_err(|e| format!("cargo cannot be run: {e}"))?;
    if !output.status.success() {
        let words = String::from_utf8_lossy(&output.stderr);
        return Err(format!("cargo mutants --list: {words}\n(cargo install cargo-mutants)"));
    }
    parse(&String::from_utf8_lossy(&output.stdout))
}

/// The mutants of a list in JSON.
///
/// # Errors
/// Words that name the field that is not there.
pub fn parse(json: &str) -> Result<Vec<Mutant>, String> {
    let list: Value = serde_json::from_str(json).map_err(|e| format!("the list of mutants is no JSON: {e}"))?;
    list.as_array().ok_or("the list of mutants is no array")?.iter().map(mutant).collect()
}

fn mutant(value: &Value) -> Result<Mutant, String> {
    let text = |key: &str| -> Result<String, String> {
        Ok(value[key].as_str().ok_or_else(|| format!("a mutant has no {key}: {value}"))?.to_owned())
    };
    let number = |end: &str, key: &str| -> Result<usize, String> {
        let number = value["span"][end][key].as_u64().and_then(|n| usize::try_from(n).ok());
        number.ok_or_else(|| format!("a mutant has no span.{end}.{key}: {value}"))
    };
    let place = |end: &str| Ok::<_, String>(Place { line: number(end, "line")?, column: number(end, "column")? });
    let (file, name) = (text("file")?, text("name")?);
    let span = (place("start")?, place("end")?);
    let at = format!("{file}:{}:{}: ", span.0.line, span.0.column);
    let name = name.strip_prefix(&at).unwrap_or(&name).to_owned();
    Ok(Mutant { file, name, span, replacement: text("replacement")? })
}

/// Offset in bytes of a place of a text; its end where there is no such place.
#[must_use]
pub fn offset(text: &str, place: Place) -> usize {
    let line = text.split_inclusive('\n').take(place.line.saturating_sub(1)).map(str::len).sum::<usize>();
    let rest = text.get(line..).unwrap_or("");
    line + rest.char_indices().nth(place.column.saturating_sub(1)).map_or(rest.len(), |(at, _)| at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mutant_is_read_with_its_name_freed_of_its_place() {
        let json = r#"[{"file": "src/a.rs", "name": "src/a.rs:2:7: replace + with - in f", "replacement": "-",
            "span": {"start": {"line": 2, "column": 7}, "end": {"line": 2, "column": 8}}, "function": null}]"#;
        let read = parse(json).unwrap();
        assert_eq!(read[0].name, "replace + with - in f");
        assert_eq!(read[0].span, (Place { line: 2, column: 7 }, Place { line: 2, column: 8 }));
        assert!(
            parse(r#"[{"file": "src/a.rs", "name": "x", "replacement": "-"}]"#).unwrap_err().contains("span.start")
        );
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(offset("ab\nσ + 1\n", Place { line: 2, column: 3 }), 3 + 3);
    }
}
