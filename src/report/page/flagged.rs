//! The tables of flags and decisions, with their evidence: a row for each run.

use super::super::inspection::short;
use super::Table;
use crate::error::Result;
use crate::method::Direction;
use crate::session::flags::{Evidence, evidence};
use crate::session::table::{time_text, walk};
use crate::session::{Analysed, Session, signature_words};
use crate::track::{Track, number_text};

/// Rows of a table at most.
const MOST: usize = 200;

/// A table of flags.
#[derive(Debug)]
pub(super) struct Flagged {
    /// The rows that are listed.
    pub(super) table: Table,
    /// Samples in them.
    pub(super) listed: usize,
    /// Samples that are left out.
    pub(super) more: usize,
    /// Those of them that the analyst decided on.
    pub(super) decided: usize,
}

/// One table for each channel: outliers, suspects and decisions by row, the samples of a run in one row.
///
/// # Errors
/// When the input cannot be read again, or is no longer the one that was loaded.
pub(super) fn tables(track: &Track, session: &Session, analysed: &Analysed) -> Result<Vec<Flagged>> {
    let mut lists: Vec<List> = session.plans.iter().map(|_| List::default()).collect();
    walk(track, session, analysed, |row, cells, channel| {
        let Some(position) = channel.position(row) else { return Ok(()) };
        // Samples that could not be judged are counted, not listed.
        if channel.outcome.mark(position).is_none() {
            return Ok(());
        }
        let Some(found) = evidence(session, channel, row, position) else { return Ok(()) };
        lists[channel.plan].add(found, || time_text(track, row, cells));
        Ok(())
    })?;
    Ok(lists.into_iter().map(List::flagged).collect())
}

/// The groups of a channel so far.
#[derive(Default)]
struct List {
    groups: Vec<Group>,
    more: usize,
    decided: usize,
}

impl List {
    fn add(&mut self, found: Evidence, time: impl FnOnce() -> String) {
        let room = self.groups.len() < MOST;
        match self.groups.last_mut() {
            Some(group) if group.goes_on(&found) => group.add(found, time()),
            _ if room => self.groups.push(Group::new(found, time())),
            _ => {
                self.more += 1;
                self.decided += usize::from(found.decided);
            }
        }
    }

    fn flagged(self) -> Flagged {
        let Self { groups, more, decided } = self;
        let listed = groups.iter().map(|group| group.all.len()).sum();
        let marks = groups.iter().map(|group| group.all[0].mark.as_ref().and_then(crate::plot::state)).collect();
        let notes = groups.iter().map(|group| group.all[0].note.clone()).collect();
        let rows = groups.iter().map(Group::cells).collect();
        Flagged { table: Table { head: HEAD.to_vec(), rows, marks, notes }, listed, more, decided }
    }
}

const HEAD: [(&str, bool); 9] = [
    ("row", true),
    ("time", true),
    ("raw", true),
    ("expected ± tolerance", true),
    ("ratio", true),
    ("verdict", false),
    ("forward, backward", false),
    ("cleaned file", true),
    ("decided by", false),
];

/// Samples that follow each other in one run, and of which the same is said.
struct Group {
    all: Vec<Evidence>,
    /// Times of the first and of the last.
    times: (String, String),
}

impl Group {
    fn new(found: Evidence, time: String) -> Self {
        Self { all: vec![found], times: (time.clone(), time) }
    }

    /// Whether a sample belongs to the same run and nothing else is said of it.
    fn goes_on(&self, next: &Evidence) -> bool {
        let said = |e: &Evidence| (e.verdict, e.decided, e.action(), e.run.map(|run| run.start));
        let by = |e: &Evidence| e.objected.as_ref().map(|o| o.by);
        self.all.last().is_some_and(|last| {
            let signed = |e: &Evidence| signature_words(&e.signature);
            last.run.is_some()
                && said(last) == said(next)
                && by(last) == by(next)
                && (last.note == next.note && signed(last) == signed(next))
        })
    }

    fn add(&mut self, found: Evidence, time: String) {
        self.times.1 = time;
        self.all.push(found);
    }

    fn cells(&self) -> Vec<String> {
        let (first, last) = (&self.all[0], &self.all[self.all.len() - 1]);
        let ratio = |e: &&Evidence| e.ratio().unwrap_or(0.0);
        let worst = self.all.iter().max_by(|a, b| ratio(a).total_cmp(&ratio(b))).unwrap_or(first);
        let expected = match (worst.expected, worst.tolerance) {
            (Some(p), Some(h)) => format!("{} ± {}", short(p), short(h)),
            (Some(p), None) => short(p),
            _ => String::new(),
        };
        vec![
            span(&first.row.to_string(), &last.row.to_string()),
            span(&self.times.0, &self.times.1),
            self.range(|e| Some(e.raw), number_text),
            expected,
            worst.ratio().map(|r| format!("{r:.2}")).unwrap_or_default(),
            self.verdict(),
            self.directions(),
            self.cleaned(),
            match (&first.objected, first.decided) {
                (Some(o), false) => format!("{}: {}", o.by, o.evidence),
                _ => signature_words(&first.signature).unwrap_or_else(|| first.decided_by().to_owned()),
            },
        ]
    }

    /// The verdict, and what part of which run this is.
    fn verdict(&self) -> String {
        let (word, here) = (self.all[0].verdict.word(), self.all.len());
        match self.all[0].run {
            Some(run) if run.length == 1 => format!("{word}, isolated"),
            Some(run) if run.length == here => format!("{word}, run of {here}"),
            Some(run) => format!("{word}, {here} of a run of {}", run.length),
            None => word.to_owned(),
        }
    }

    fn directions(&self) -> String {
        let of = |e: &Evidence| [e.forward, e.backward];
        let first = of(&self.all[0]);
        match first.map(|d| d.map_or("", Direction::word)) {
            _ if self.all.iter().any(|e| of(e) != first) => "mixed".to_owned(),
            ["", ""] => String::new(),
            words => words.join(", "),
        }
    }

    /// What the cleaned file has.
    fn cleaned(&self) -> String {
        match self.all[0].action() {
            "repaired" => self.range(|e| e.clean, short),
            other => other.to_owned(),
        }
    }

    /// The value of the one sample, or the smallest and the largest.
    fn range(&self, of: impl Fn(&Evidence) -> Option<f64>, text: impl Fn(f64) -> String) -> String {
        let values = || self.all.iter().filter_map(&of);
        let (low, high) = (values().reduce(f64::min), values().reduce(f64::max));
        match (low, high) {
            (Some(low), Some(high)) if low == high => text(low),
            (Some(low), Some(high)) => format!("{} … {}", text(low), text(high)),
            _ => String::new(),
        }
    }
}

fn span(first: &str, last: &str) -> String {
    if first == last { first.to_owned() } else { format!("{first} to {last}") }
}

/// How much of a table is listed, and where the rest is; empty when all is. `file` is the table of flags beside the
/// report.
pub(super) fn in_words(flagged: &Flagged, file: Option<&str>) -> String {
    let Flagged { listed, more, decided, .. } = *flagged;
    if more == 0 {
        return String::new();
    }
    let decided = if decided == 0 { String::new() } else { format!(" ({decided} of them decided by the analyst)") };
    let place = file.map_or("not listed; `--flags FILE` writes all of them".to_owned(), |file| format!("in {file}"));
    format!(
        "The first {listed} of {} flags and decisions are listed; the other {more}{decided} are {place}.",
        listed + more
    )
}
