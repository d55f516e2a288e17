use std::path::PathBuf;

use super::*;
use crate::error::Error;
use crate::review::{Decision, Ruling, Signature};
use crate::session::{Setup, write_cleaned};
use crate::stop::Stop;
use crate::track::{LoadOptions, Outputs, Source, faults, load};

/// Saves the session and the cleaned file of the demonstration record under these names, together.
fn save(session: &Session, track: &Track, analysed: &Analysed, names: &[PathBuf; 2]) -> Result<()> {
    let mut session = session.clone();
    let mut files = Outputs::new(true, &[]);
    let text = document(&mut session, track, analysed, &names[0])?;
    files.stage(&names[0], |w| w.write_all(text.as_bytes()).map_err(Error::io("write", &names[0])))?;
    files.stage(&names[1], |w| write_cleaned(track, &analysed.changes(track), w).map(|_| ()))?;
    files.commit()
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
#[expect(clippy::print_stdout, reason = "figures for whoever runs it with --nocapture")]
fn a_disk_that_fails_at_any_place_leaves_the_old_files_whole_and_nothing_else() {
    let track = load(&Source::demo(), &LoadOptions::default()).unwrap();
    let mut session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    let decision =
        Decision { ruling: Ruling::Outlier, note: "glint".into(), said: None, signature: Signature::default() };
    session.plans[0].decisions.set(60, Some(decision));
    let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap();
    let (mut injected, mut survived) = (0, 0);
    for (cleaned, old) in [("a.csv", true), ("a.csv", false), ("a.csv.gz", true), ("a.csv.gz", false)] {
        for fault in 0.. {
            let folder = tempfile::tempdir().unwrap();
            let names = [folder.path().join("a.toml"), folder.path().join(cleaned)];
            if old {
                names.iter().for_each(|name| std::fs::write(name, "what was there").unwrap());
            }
            let before = content(folder.path());
            faults::fail_at(Some(fault));
            let saved = save(&session, &track, &analysed, &names);
            let hit = faults::passed() > fault;
            faults::fail_at(None);
            let after = content(folder.path());
            injected += usize::from(hit);
            if saved.is_err() {
                assert!(matches!(&saved, Err(Error::Io { .. })), "{saved:?}");
                assert!(after == before, "{cleaned}, old {old}, place {fault}: {:?}", after.keys());
                survived += 1;
                continue;
            }
            // A place that may fail (a second name for the way back) or none at all: all is new, and nothing else.
            assert!(after.keys().eq(["a.csv", "a.csv.gz", "a.toml"].iter().filter(|n| after.contains_key(**n))));
            assert!(after.len() == 2 && after.iter().all(|(name, bytes)| before.get(name) != Some(bytes)));
            if !hit {
                break;
            }
        }
    }
    println!(
        "faults injected: {injected}; failed saves that left all files as they were: {survived}; saves that went on: {}",
        injected - survived
    );
    // A census: a place that is no longer asked, or a new one, changes these on purpose.
    assert_eq!((injected, survived), (72, 68));
}

#[test]
fn a_session_and_its_table_say_who_decided_and_when() {
    let track = load(&Source::demo(), &LoadOptions::default()).unwrap();
    let mut session = Session::new(&track, LoadOptions::default(), &Setup::standard());
    // 20,788 days after 1970-01-01 is 2026-12-01.
    let signature = Signature { by: Some("M. \"Mika\" Ito".into()), at: Some(20_788 * 86_400 + 8_100) };
    let signed = Decision { ruling: Ruling::Outlier, note: "glint".into(), said: None, signature };
    let unsigned =
        Decision { ruling: Ruling::Normal, note: String::new(), said: None, signature: Signature::default() };
    session.plans[0].decisions.set(60, Some(signed.clone()));
    session.plans[0].decisions.set(61, Some(unsigned.clone()));
    let analysed = Analysed::of(&session, &track, &Stop::never()).unwrap();
    let path = Path::new("s.toml");
    let text = document(&mut session, &track, &analysed, path).unwrap();
    let lines: Vec<&str> = text.lines().filter(|line| line.contains("verdict =")).collect();
    assert!(lines[0].ends_with("by = \"M. \\\"Mika\\\" Ito\", at = \"2026-12-01T02:15:00Z\" },"), "{}", lines[0]);
    assert!(lines[1].ends_with("verdict = \"normal\" },"), "{}", lines[1]);
    let back = crate::session::parse(path, &text).unwrap();
    assert_eq!(back.plans[0].decisions.get(60), Some(&signed));
    assert_eq!(back.plans[0].decisions.get(61), Some(&unsigned));
    let mut table = Vec::new();
    crate::session::decisions(&track, &session, &mut table).unwrap();
    let table = String::from_utf8(table).unwrap();
    assert!(table.contains("outlier,glint,\"M. \"\"Mika\"\" Ito\",2026-12-01T02:15:00Z\n"), "{table}");
    assert!(table.ends_with("normal,,,\n"), "{table}");
    let wrong = text.replace("2026-12-01T02:15:00Z", "yesterday");
    let error = crate::session::parse(path, &wrong).unwrap_err().to_string();
    assert!(error.contains("at = \"yesterday\"") && error.contains("2026-12-01T02:15:00Z"), "{error}");
}
