//! The documents that methods and repairs come from, in full.

use crate::session::Session;

/// The page of references: a table of the documents by number, and a list of what else is cited.
const REFERENCES: &str = include_str!("../../../docs/references.md");

/// What the methods of a session cite: `[001]` or the id of a method, and the document.
pub(super) fn cited(session: &Session) -> Vec<(String, String)> {
    let mut found: Vec<(String, String)> = Vec::new();
    for plan in &session.plans {
        let about = plan.setup.method.about();
        let new = numbered(about.source).chain(named(about.id));
        for citation in new {
            if !found.contains(&citation) {
                found.push(citation);
            }
        }
    }
    found
}

/// The documents whose numbers are in a source.
pub(in crate::report) fn numbered(source: &str) -> impl Iterator<Item = (String, String)> {
    let rows = REFERENCES.lines().filter_map(|line| line.strip_prefix("| `["));
    let rows = rows.filter_map(|row| row.split_once("]` | "));
    rows.filter(|(number, _)| source.contains(&format!("[{number}]")))
        .map(|(number, document)| (format!("[{number}]"), plain(document.trim_end_matches('|').trim())))
}

/// The documents that the list gives for a method.
fn named(id: &str) -> impl Iterator<Item = (String, String)> {
    let end = format!("(`{id}`)");
    let items = REFERENCES.lines().filter_map(|line| line.strip_prefix("- "));
    items
        .filter(move |item| item.contains(&end))
        .map(move |item| (id.to_owned(), plain(item.split(" (`").next().unwrap_or_default())))
}

fn plain(markdown: &str) -> String {
    markdown.replace('*', "")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::METHODS;

    #[test]
    fn every_method_has_its_document() {
        // The consensus is of no document.
        for about in METHODS.iter().map(|m| m.about()).filter(|about| about.id != "consensus") {
            let found: Vec<_> = numbered(about.source).chain(named(about.id)).collect();
            assert!(!found.is_empty(), "{}: {}", about.id, about.source);
            assert!(found.iter().all(|(_, document)| document.len() > 40), "{found:?}");
        }
        let rosner: Vec<_> = named("gesd").collect();
        assert!(rosner[0].1.starts_with("B. Rosner") && rosner[0].1.contains("Technometrics"), "{rosner:?}");
    }
}
