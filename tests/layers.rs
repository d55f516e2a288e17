//! The modules are layers: a module imports only from earlier lines of this list, and the two fronts do not know
//! each other.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

use std::path::{Path, PathBuf};

/// The layers, lowest first; modules of one line may know each other.
const LAYERS: &[&[&str]] = &[
    &["error", "wrapped"],
    &["math"],
    &["track"],
    &["stop"],
    &["param"],
    &["calibration"],
    &["method"],
    &["check"],
    &["repair"],
    &["review"],
    &["session"],
    &["score"],
    &["experiment"],
    &["job"],
    &["plot"],
    &["report"],
    &["cli", "batch", "stream"],
];

/// The other front: above all layers but the last, which is its sibling.
const SCREEN: &str = "tui";

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).expect("src can be read") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files
}

/// Index of the layer of a module; none for one that is not listed.
fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|line| line.contains(&module))
}

/// Modules that `text` names after `crate::`, comments left out.
fn imports(text: &str) -> Vec<String> {
    let code: Vec<&str> = text.lines().filter(|l| !l.trim_start().starts_with("//")).collect();
    let code = code.join("\n");
    let name = |rest: &str| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut found: Vec<String> = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(list) => found.extend(list.split('}').next().unwrap_or("").split(',').map(|p| name(p.trim()))),
            None => found.push(name(rest)),
        }
    }
    found
}

/// What is wrong with the imports of `module`.
fn wrong(module: &str, imports: &[String]) -> Vec<String> {
    let allowed = |import: &str| {
        if module == import {
            return true;
        }
        match (module == SCREEN, layer(module), layer(import)) {
            (true, _, Some(theirs)) => theirs + 1 < LAYERS.len(),
            (false, Some(own), Some(theirs)) => theirs < own || (theirs == own && own + 1 == LAYERS.len()),
            _ => false,
        }
    };
    imports.iter().filter(|i| !allowed(i)).map(|i| format!("{module} imports {i}")).collect()
}

#[test]
fn every_module_imports_only_from_earlier_layers() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut faults = Vec::new();
    for path in sources(&src) {
        let inside = path.strip_prefix(&src).expect("inside src");
        let first = inside.components().next().expect("a name").as_os_str().to_string_lossy().into_owned();
        let module = first.trim_end_matches(".rs").to_owned();
        if module == "lib" || module == "main" {
            continue;
        }
        assert!(module == SCREEN || layer(&module).is_some(), "{module} stands in no layer");
        let text = std::fs::read_to_string(&path).expect("a source file");
        faults.extend(wrong(&module, &imports(&text)).into_iter().map(|w| format!("{}: {w}", inside.display())));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_check_itself_can_fail() {
    let upward = imports("use crate::{error::Error, session::Session};\nlet x = crate::tui::run();");
    assert_eq!(upward, ["error", "session", "tui"]);
    assert_eq!(wrong("method", &upward).len(), 2);
    assert!(wrong("tui", &imports("use crate::cli::Cli;")).len() == 1);
    assert!(wrong("batch", &imports("use crate::tui::run;")).len() == 1);
    assert!(wrong("batch", &imports("use crate::cli::Cli;")).is_empty());
}
