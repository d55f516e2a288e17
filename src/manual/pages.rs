//! The pages, with the topics they are found by.

/// A page of the manual.
#[derive(Debug)]
pub struct Page {
    /// What finds it.
    pub topic: &'static str,
    /// Heading under which it is listed.
    pub kind: &'static str,
    /// Its file, from the folder `docs`.
    pub file: &'static str,
    /// Markdown.
    pub text: &'static str,
}

impl Page {
    /// Its first heading.
    #[must_use]
    pub fn title(&self) -> &'static str {
        self.text.lines().next().unwrap_or_default().trim_start_matches("# ")
    }
}

macro_rules! page {
    ($kind:expr, $topic:literal, $file:literal) => {
        Page { topic: $topic, kind: $kind, file: $file, text: include_str!(concat!("../../docs/", $file)) }
    };
}

const START: &str = "Start";
const HOW_TO: &str = "How to";
const REFERENCE: &str = "Reference";
const EXPLANATION: &str = "Explanation";

/// Every page that can be shown, in the order of the list.
pub static PAGES: &[Page] = &[
    page!(START, "tutorial", "tutorial.md"),
    page!(START, "choosing", "choosing.md"),
    page!(HOW_TO, "tracks", "how-to/tracks.md"),
    page!(HOW_TO, "checks", "how-to/checks.md"),
    page!(HOW_TO, "positions", "how-to/positions.md"),
    page!(HOW_TO, "campaign", "how-to/campaign.md"),
    page!(HOW_TO, "ssh", "how-to/ssh.md"),
    page!(HOW_TO, "batch", "how-to/batch.md"),
    page!(HOW_TO, "archives", "archive.md"),
    page!(HOW_TO, "real-time", "how-to/real-time.md"),
    page!(HOW_TO, "python", "how-to/python.md"),
    page!(REFERENCE, "key-map", "reference/keys.md"),
    page!(REFERENCE, "configuration", "reference/configuration.md"),
    page!(REFERENCE, "formats", "what-it-reads.md"),
    page!(REFERENCE, "formulas", "methods.md"),
    page!(REFERENCE, "references", "references.md"),
    page!(REFERENCE, "session", "session-format.md"),
    page!(REFERENCE, "tables", "reference/tables.md"),
    page!(REFERENCE, "exit-status", "reference/exit-status.md"),
    page!(REFERENCE, "terms", "terms.md"),
    page!(EXPLANATION, "wild-points", "explanation/wild-points.md"),
    page!(EXPLANATION, "verdicts", "explanation/verdicts.md"),
    page!(EXPLANATION, "calibration", "explanation/calibration.md"),
    page!(EXPLANATION, "replays", "explanation/replay.md"),
];
