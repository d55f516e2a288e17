use std::collections::BTreeMap;

use super::*;
use crate::review::{Decision, Ruling, Signature};
use crate::track::{LoadOptions, Source, faults, load};

fn opened() -> (Track, Session) {
    let track = load(&Source::demo(), &LoadOptions::default()).unwrap();
    let mut session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    session.plans[0].decisions.set(
        60,
        Some(Decision { ruling: Ruling::Normal, note: "x".into(), said: None, signature: Signature::default() }),
    );
    (track, session)
}

fn all(folder: &Path, report: &str) -> Vec<Output> {
    let output = |kind: OutputKind| Output {
        kind,
        path: folder.join(if kind == OutputKind::Report { report.into() } else { format!("a{}", kind.ending()) }),
    };
    OutputKind::ALL.map(output).to_vec()
}

/// Everything in a folder, by name.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entry = |e: std::io::Result<std::fs::DirEntry>| {
        let path = e.unwrap().path();
        (path.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read(&path).unwrap())
    };
    std::fs::read_dir(folder).unwrap().map(entry).collect()
}

#[test]
fn all_outputs_appear_together() {
    let (track, session) = opened();
    let folder = tempfile::tempdir().unwrap();
    let words = export(&track, &session, &all(folder.path(), "a.md"), false, &Byline::default()).unwrap();
    assert!(words.starts_with("wrote 6 files: "), "{words}");
    let names: Vec<String> = content(folder.path()).into_keys().collect();
    assert_eq!(names, ["a.clean.csv", "a.decisions.csv", "a.diagnostics.csv", "a.flags.csv", "a.md", "a.wild.toml"]);
    // One of them is there: none is written, the others stay away too.
    std::fs::remove_file(folder.path().join("a.clean.csv")).unwrap();
    std::fs::write(folder.path().join("a.flags.csv"), "theirs").unwrap();
    let before = content(folder.path());
    let refused = export(&track, &session, &all(folder.path(), "a.md"), false, &Byline::default());
    assert!(matches!(refused, Err(Error::Exists(_))), "{refused:?}");
    assert!(content(folder.path()) == before);
    export(&track, &session, &all(folder.path(), "a.md"), true, &Byline::default()).unwrap();
    assert_eq!(content(folder.path()).len(), 6);
}

#[test]
fn a_disk_that_fails_at_any_place_leaves_what_was_there() {
    let (track, session) = opened();
    let mut survived = 0;
    for fault in 0.. {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a.html", "a.flags.csv"] {
            std::fs::write(folder.path().join(name), "what was there").unwrap();
        }
        let before = content(folder.path());
        faults::fail_at(Some(fault));
        let written = export(&track, &session, &all(folder.path(), "a.html"), true, &Byline::default());
        let hit = faults::passed() > fault;
        faults::fail_at(None);
        if written.is_err() {
            assert!(matches!(written, Err(Error::Io { .. })), "{written:?}");
            assert!(content(folder.path()) == before, "place {fault}: {:?}", content(folder.path()).keys());
            survived += 1;
            continue;
        }
        assert_eq!(content(folder.path()).len(), 6, "place {fault}");
        if !hit {
            break;
        }
    }
    assert!(survived >= 20, "only {survived} faults");
}
