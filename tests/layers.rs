//! The modules are layers: a module imports only from earlier lines of this list, and the two fronts do not know
//! each other. The lowest layers are the crate `wildpoint-core`, those above it `wildpoint-record`, the rest the program.

#![expect(clippy::expect_used, reason = "a test that cannot read its own data may say so by ending")]

use std::path::{Path, PathBuf};

/// The folders of source files: the program and the crates below it.
const CRATES: &[&str] = &["crates/core/src", "crates/record/src", "src"];

/// The layers, lowest first; modules of one line may know each other.
const LAYERS: &[&[&str]] = &[
    &["memory"],
    &["error", "wrapped", "counted", "clock"],
    &["math"],
    &["interval"],
    &["series"],
    &["stop"],
    &["param"],
    &["calibration"],
    &["method"],
    &["check"],
    &["preparation"],
    &["suggestions"],
    &["repair"],
    &["review"],
    &["setup"],
    &["analysis"],
    &["ballot"],
    &["sweep"],
    &["score"],
    &["detectability"],
    &["api"],
    &["track"],
    &["session"],
    &["experiment"],
    &["job"],
    &["plot"],
    &["report"],
    &["cli", "batch", "manual", "stream"],
];

/// The other front: above all layers but the last, which is its sibling.
const SCREEN: &str = "tui";

/// What a library of numbers must not need, directly or through others: terminals, command lines, files.
const NOT_IN_CORE: &[&str] =
    &["clap", "ratatui", "crossterm", "csv", "tempfile", "flate2", "toml", "signal-hook", "wildpoint-record"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

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

/// Modules that `text` names after `crate::`, comments left out. (What it names in a crate below is Cargo's business.)
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

/// The packages that `name` needs, directly or through others, by the lock file, without those of its tests.
fn needs(name: &str, lock: &str, own: &[String]) -> Vec<String> {
    let package = |name: &str| {
        let block = lock.split("[[package]]").find(|b| b.lines().any(|l| l == format!("name = \"{name}\"")));
        let list = block.and_then(|b| b.split_once("dependencies = [")).map_or("", |(_, list)| list);
        let quoted = list.split(']').next().unwrap_or("").split('"').skip(1).step_by(2);
        // A package of which there are several versions is followed by its version.
        quoted.filter_map(|q| q.split(' ').next()).map(str::to_owned).collect::<Vec<_>>()
    };
    let known = package(name);
    assert!(own.iter().all(|o| known.contains(o)), "{own:?} stand in the lock file for {name}: {known:?}");
    let mut found: Vec<String> = Vec::new();
    let mut open = own.to_vec();
    while let Some(next) = open.pop() {
        if !found.contains(&next) {
            open.extend(package(&next));
            found.push(next);
        }
    }
    found
}

/// The names under `[dependencies]` of a manifest.
fn dependencies(manifest: &str) -> Vec<String> {
    let section = manifest.split_once("\n[dependencies]\n").map_or("", |(_, rest)| rest);
    let lines = section.lines().take_while(|l| !l.starts_with('[')).filter(|l| !l.starts_with('#'));
    lines.filter_map(|l| l.split([' ', '.', '=']).next()).filter(|n| !n.is_empty()).map(str::to_owned).collect()
}

#[test]
fn every_module_imports_only_from_earlier_layers() {
    let mut faults = Vec::new();
    for folder in CRATES {
        let src = root().join(folder);
        for path in sources(&src) {
            let inside = path.strip_prefix(&src).expect("inside src");
            let first = inside.components().next().expect("a name").as_os_str().to_string_lossy().into_owned();
            let module = first.trim_end_matches(".rs").to_owned();
            if ["lib", "main", "program"].contains(&module.as_str()) {
                continue;
            }
            assert!(module == SCREEN || layer(&module).is_some(), "{module} stands in no layer");
            let text = std::fs::read_to_string(&path).expect("a source file");
            let wrong = wrong(&module, &imports(&text));
            faults.extend(wrong.into_iter().map(|w| format!("{folder}/{}: {w}", inside.display())));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_core_needs_neither_terminals_nor_command_lines_nor_files() {
    let read = |name: &str| std::fs::read_to_string(root().join(name)).expect("a file of the workspace");
    let lock = read("Cargo.lock");
    let core = needs("wildpoint-core", &lock, &dependencies(&read("crates/core/Cargo.toml")));
    assert!(core.iter().any(|n| n == "rayon") && core.iter().any(|n| n == "syn"), "what it needs is seen: {core:?}");
    let found: Vec<&&str> = NOT_IN_CORE.iter().filter(|n| core.iter().any(|c| c == **n)).collect();
    assert!(found.is_empty(), "wildpoint-core needs {found:?}");
    let program = needs("wildpoint", &lock, &dependencies(&read("Cargo.toml")));
    let unseen: Vec<&&str> = NOT_IN_CORE.iter().filter(|n| !program.iter().any(|p| p == **n)).collect();
    assert!(unseen.is_empty(), "names that mean no package of this workspace: {unseen:?}");
}

#[test]
fn the_check_itself_can_fail() {
    let upward = imports("use crate::{error::Error, session::Session};\nlet x = crate::tui::run();");
    assert_eq!(upward, ["error", "session", "tui"]);
    assert_eq!(wrong("method", &upward).len(), 2);
    assert_eq!(wrong("track", &imports("use crate::session::read;")).len(), 1);
    assert!(wrong("tui", &imports("use crate::cli::Cli;")).len() == 1);
    assert!(wrong("batch", &imports("use crate::tui::run;")).len() == 1);
    assert!(wrong("batch", &imports("use crate::cli::Cli;")).is_empty());
}
