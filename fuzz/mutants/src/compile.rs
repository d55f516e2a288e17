//! Building the rewritten program, and what rustc says against it.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::tree::Tree;

/// A test program.
#[derive(Clone, PartialEq, Debug)]
pub struct Program {
    /// `lib`, or the name of the file in `tests`.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
}

/// A line of a file that rustc points at.
pub type Spot = (String, usize);

/// An error of rustc.
#[derive(Clone, PartialEq, Debug)]
pub struct Fault {
    /// Where it is, what it is about first.
    pub spots: Vec<Spot>,
    /// As rustc shows it.
    pub words: String,
}

/// What came of a build.
#[derive(Clone, PartialEq, Debug)]
pub enum Built {
    /// The test programs.
    Programs(Vec<Program>),
    /// Why there are none.
    Faults(Vec<Fault>),
}

/// Runs cargo with `arguments` in the copy.
///
/// # Errors
/// Words that say that cargo could not be run, or failed without an error of rustc.
pub fn cargo(tree: &Tree, arguments: &[String]) -> Result<Built, String> {
    let output = Command::new("cargo")
        .args(arguments)
        .arg("--message-format=json")
        .args(["--config", "profile.test.debug=false"])
        .args(["--config", "profile.dev.debug=false"])
        .current_dir(&tree.copy)
        .env("CARGO_TARGET_DIR", &tree.build)
        .env("CARGO_INCREMENTAL", "1")
        // A mutant may leave a variable unused, or overflow in a constant.
        .env("RUSTFLAGS", "--cap-lints allow")
        .stderr(Stdio::piped())
        .output()
        .map_err(|e| format!("cargo cannot be run: {e}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let messages: Vec<Value> = text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    if output.status.success() {
        return Ok(Built::Programs(messages.iter().filter_map(program).collect()));
    }
    let faults: Vec<Fault> = messages.iter().filter_map(fault).collect();
    if faults.is_empty() {
        return Err(format!("cargo {}:\n{}", arguments.join(" "), String::from_utf8_lossy(&output.stderr)));
    }
    Ok(Built::Faults(faults))
}

fn program(message: &Value) -> Option<Program> {
    let path = message["executable"].as_str()?;
    let target = &message["target"];
    if message["profile"]["test"] != true {
        return None;
    }
    let library = target["kind"].as_array()?.iter().any(|kind| kind == "lib");
    let name = if library { "lib" } else { target["name"].as_str()? };
    Some(Program { name: name.to_owned(), path: path.into() })
}

fn fault(message: &Value) -> Option<Fault> {
    let message = &message["message"];
    if message["level"] != "error" {
        return None;
    }
    let spans = |message: &Value| message["spans"].as_array().cloned().unwrap_or_default();
    let all = spans(message);
    let (first, rest): (Vec<Value>, Vec<Value>) = all.into_iter().partition(|span| span["is_primary"] == true);
    let children = message["children"].as_array().cloned().unwrap_or_default();
    let mut spots = Vec::new();
    for span in first.iter().chain(&rest).chain(&children.iter().flat_map(spans).collect::<Vec<_>>()) {
        collect(span, &mut spots);
    }
    let words = message["rendered"].as_str().unwrap_or_default().to_owned();
    // The count of errors at the end is none.
    (!spots.is_empty()).then_some(Fault { spots, words })
}

/// The line of a span, and those of the macros it comes out of.
fn collect(span: &Value, spots: &mut Vec<Spot>) {
    if let (Some(file), Some(line)) = (span["file_name"].as_str(), span["line_start"].as_u64()) {
        spots.push((file.to_owned(), usize::try_from(line).unwrap_or(0)));
    }
    if span["expansion"].is_object() {
        collect(&span["expansion"]["span"], spots);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_leads_with_what_it_is_about_and_comes_out_of_its_macro() {
        let json = r#"{"message": {"level": "error", "rendered": "E", "children": [], "spans": [
            {"file_name": "src/b.rs", "line_start": 1, "is_primary": false, "expansion": null},
            {"file_name": "std.rs", "line_start": 9, "is_primary": true,
             "expansion": {"span": {"file_name": "src/a.rs", "line_start": 4, "expansion": null}}}]}}"#;
        let found = fault(&serde_json::from_str(json).unwrap()).unwrap();
        let spots: Vec<(&str, usize)> = found.spots.iter().map(|(file, line)| (file.as_str(), *line)).collect();
        assert_eq!(spots, [("std.rs", 9), ("src/a.rs", 4), ("src/b.rs", 1)]);
    }

    #[test]
    fn a_warning_is_no_error() {
        assert_eq!(fault(&serde_json::from_str(r#"{"message": {"level": "warning", "spans": []}}"#).unwrap()), None);
    }
}
