//! A session file of arbitrary text: refused in words, or read so that writing it gives it again.

use std::path::Path;

use wildpoint::session::{parse, render};

pub(super) fn body(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let path = Path::new("folder/fuzz.toml");
    let session = match parse(path, &text) {
        Ok(session) => session,
        Err(e) => return assert!(!e.to_string().is_empty()),
    };
    assert!(!session.plans.is_empty());
    let texts: Vec<Vec<(String, String)>> =
        session.plans.iter().map(|p| vec![("0".into(), "1".into()); p.decisions.len()]).collect();
    let again = parse(path, &render(&session, path, &texts).expect("names are text")).expect("what is written is read");
    assert_eq!(again.plans, session.plans);
    assert_eq!((again.result, again.data.rows), (session.result, session.data.rows));
    assert_eq!(again.data.options, session.data.options);
}
