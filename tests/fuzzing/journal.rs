//! A journal of arbitrary bytes, and one of arbitrary lines under right sums: what is read is a prefix of what was
//! written, and it goes into any session and out again.

use sha2::{Digest, Sha256};
use wildpoint::session::journal::{Encoder, Journal, decode, replay};
use wildpoint::session::{Session, parse};

pub(super) fn body(data: &[u8]) {
    if let Some(journal) = decode(data) {
        read(&journal);
    }
    let summed = summed(data);
    if let Some(journal) = decode(&summed) {
        read(&journal);
        // Torn anywhere, it is the same journal with fewer entries.
        let torn = decode(&summed[..summed.len() - summed.len() / 3]);
        if let Some(torn) = torn {
            assert!(torn.entries.len() <= journal.entries.len());
            assert_eq!(torn.entries, journal.entries[..torn.entries.len()]);
        }
    }
}

/// The lines of `data` as a journal would hold them.
fn summed(data: &[u8]) -> Vec<u8> {
    let mut before = String::new();
    let mut out = Vec::new();
    for line in String::from_utf8_lossy(data).lines() {
        let digest = Sha256::new().chain_update(&before).chain_update(line).finalize();
        before = digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
        out.extend_from_slice(format!("{before} {line}\n").as_bytes());
    }
    out
}

fn read(journal: &Journal) {
    let (mut encoder, mut text) = Encoder::new(&journal.header);
    journal.entries.iter().for_each(|e| text.push_str(&encoder.entry(e)));
    let again = decode(text.as_bytes()).expect("what is written is read");
    assert_eq!((&again.header, &again.entries, again.complete), (&journal.header, &journal.entries, true));
    let mut session = blank();
    let before = session.plans.clone();
    let edits = replay(&mut session, &journal.entries);
    edits.iter().rev().for_each(|e| session.revert(e));
    assert_eq!(session.plans, before, "undone to the last bit");
}

/// A session of two channels.
fn blank() -> Session {
    let text = "format = 1\n[data]\nfile = \"x\"\nsha256 = \"\"\nrows = 100\n[[channel]]\nname = \"x\"\nmethod = \
                \"hampel\"\n[[channel]]\nname = \"y\"\nmethod = \"kalman\"\n";
    parse(std::path::Path::new("blank.toml"), text).expect("a session")
}
