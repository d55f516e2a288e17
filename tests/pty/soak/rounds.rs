//! What is done in a round, and what must hold after it.

use std::collections::BTreeMap;
use std::fmt;

use super::super::terminal::{Terminal, title};
use super::desk::{Desk, WINDOW, not_journalled};
use super::random::{ANYTHING, Chance, HARMLESS};

/// The channel on which decisions are made, and rows of it: some are flagged, some are not.
const CHANNEL: &str = "vx_mps";
const ROWS: [u32; 14] = [61, 62, 91, 120, 200, 222, 239, 300, 323, 393, 397, 398, 458, 700];

/// What was done.
#[derive(Default)]
pub(super) struct Counts {
    rounds: usize,
    keys: usize,
    resizes: usize,
    grown: usize,
    grown_offered: usize,
    full: usize,
    killed: usize,
    signalled: usize,
    quit: usize,
    decisions: usize,
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rounds, keys, resizes, grown, grown_offered, full, killed, signalled, quit, decisions } = self;
        write!(
            f,
            "{rounds} rounds, {keys} keys, {resizes} resizes, {grown} rows appended to open records ({grown_offered} \
             rounds taken back in with them), {full} times a full disk, {killed} kills, {signalled} signals, {quit} \
             ends by the user; {decisions} decisions came back, none was lost"
        )
    }
}

/// One round: a workbench lives through all sorts of things and ends, and the next one has all of its work.
pub(super) fn round(seed: u64, counts: &mut Counts) {
    let mut chance = Chance::of(seed);
    if chance.one_in(3) {
        anything(&mut chance, counts)
    } else {
        Careful::new(chance, counts).run()
    }
    counts.rounds += 1;
}

/// All sorts of keys against all sorts of sizes: the program goes on, or ends because it was told to.
fn anything(chance: &mut Chance, counts: &mut Counts) {
    let desk = Desk::new();
    let mut terminal = desk.start(WINDOW);
    terminal.settle();
    for _ in 0..40 + chance.below(160) {
        terminal.keys(if chance.one_in(3) { chance.of_list(&HARMLESS) } else { chance.of_list(&ANYTHING) });
        counts.keys += 1;
        if chance.one_in(6) {
            terminal.resize(chance.size());
            counts.resizes += 1;
        }
        if chance.one_in(40) {
            desk.grow();
            counts.grown += 1;
        }
        if terminal.ended() {
            break;
        }
    }
    terminal.resize(WINDOW);
    if !terminal.ended() {
        // It answers.
        let before = terminal.bytes();
        terminal.keys("\x0c");
        terminal.wait_more_or_end(before);
    }
    if terminal.ended() {
        let (status, raw) = terminal.end();
        assert_eq!(status, 0, "{}", String::from_utf8_lossy(&raw[raw.len().saturating_sub(3000)..]));
        counts.quit += 1;
    } else {
        terminal.kill();
        counts.killed += 1;
    }
    desk.shrink();
    // Whatever is left is offered or told of, and can be saved.
    let mut terminal = desk.start(WINDOW);
    take_back(&mut terminal);
    desk.saved(terminal, CHANNEL);
}

/// Takes in all that is offered; gives whether there was something.
fn take_back(terminal: &mut Terminal) -> bool {
    let mut any = false;
    loop {
        terminal
            .wait_until("the first frame", |screen| screen.contents().contains("5 flag") || question(screen).is_some());
        let Some(asked) = terminal.look(question) else {
            terminal.settle();
            return any;
        };
        any = true;
        terminal.keys(if asked.starts_with("conflict") { "H" } else { "r" });
        // A key too many would decide on a flag.
        terminal.wait_until("another question, or none", |screen| question(screen).as_ref() != Some(&asked));
    }
}

/// Which question about unsaved work lies over the panels, if any: no two that follow each other are the same.
fn question(screen: &vt100::Screen) -> Option<String> {
    let text = screen.contents();
    let line = |words: &str| text.lines().find(|line| line.contains(words)).map(str::to_owned);
    if let Some(conflict) = line("conflict ") {
        return Some(format!("conflict {conflict}"));
    }
    line("unsaved work was found").map(|_| line("more after this").unwrap_or_default())
}

/// What the program says where there is nothing to decide on.
const NO_FLAG: &str = "no flag under the cursor";

/// What the screen says of a decision.
fn answer(screen: &vt100::Screen) -> Option<&'static str> {
    let text = screen.contents();
    let words = [NO_FLAG, "accepted", "rejected", "decision cleared:"];
    words.into_iter().find(|words| text.contains(&format!(" {words}{}", if *words == NO_FLAG { "" } else { " row" })))
}

/// A round in which every decision is written down, as soon as the screen shows it.
struct Careful<'a> {
    chance: Chance,
    counts: &'a mut Counts,
    desk: Desk,
    terminal: Terminal,
    /// What must come back, by row; none for a decision that was cleared.
    made: BTreeMap<u32, Option<char>>,
    /// What was decided while nothing could be journalled: it may come back.
    waiting: BTreeMap<u32, Option<char>>,
    full: bool,
    steps: usize,
    /// What was done, for whoever has to find out what went wrong.
    deeds: Vec<String>,
}

impl<'a> Careful<'a> {
    fn new(mut chance: Chance, counts: &'a mut Counts) -> Self {
        let desk = Desk::new();
        let terminal = desk.start(chance.size());
        // Keys before the terminal is the program's would be changed on their way.
        terminal.wait_more(0);
        Self {
            chance,
            counts,
            desk,
            terminal,
            made: BTreeMap::new(),
            waiting: BTreeMap::new(),
            full: false,
            steps: 0,
            deeds: Vec::new(),
        }
    }

    fn run(mut self) {
        for _ in 0..10 + self.chance.below(30) {
            match self.chance.below(12) {
                0..4 => self.decide(),
                4..6 => self.resize(),
                6 => self.disk(),
                7 if self.chance.one_in(3) => {
                    self.desk.grow();
                    self.deeds.push("grown".into());
                    self.counts.grown += 1;
                }
                _ => self.wander(),
            }
        }
        self.decide();
        self.end();
    }

    fn wander(&mut self) {
        for _ in 0..1 + self.chance.below(6) {
            self.terminal.keys(self.chance.of_list(&HARMLESS));
            self.counts.keys += 1;
        }
    }

    fn resize(&mut self) {
        self.terminal.resize(self.chance.size());
        self.counts.resizes += 1;
    }

    /// The disk is full, or has room again; then all that was missing is written.
    fn disk(&mut self) {
        self.full = !self.full;
        self.desk.fill(&self.terminal, self.full);
        self.deeds.push(format!("full: {}", self.full));
        if self.full {
            self.counts.full += 1;
            return;
        }
        self.steady();
        self.terminal.wait_until("the mark goes", |screen| !title(screen).contains("not journalled"));
        self.made.append(&mut self.waiting);
    }

    /// The window in which decisions are made, on their channel, with a result.
    fn steady(&mut self) {
        self.terminal.resize(WINDOW);
        // All keys before have been acted on when the screen shows a word that has not been typed before. Esc and a digit
        // that arrive together are Esc, which leaves the prompt and stops no computation, and the digit.
        self.steps += 1;
        let word = format!(":sync{}.", self.steps);
        self.terminal.keys(&word);
        self.terminal.wait_for(&word);
        self.terminal.keys(&format!("\x1b1:channel {CHANNEL}\r"));
        // What was said of the decision before is no answer to the next.
        self.terminal.wait_until("the channel", |screen| title(screen).contains(CHANNEL) && answer(screen).is_none());
        self.terminal.settle();
    }

    fn decide(&mut self) {
        self.steady();
        let failing = not_journalled(&self.terminal);
        let row = self.chance.of_list(&ROWS);
        self.terminal.keys(&format!("/#{row}\r"));
        let key = self.chance.of_list(&["a", "r", "a", "r", "x"]);
        let decision = match key {
            "a" => Some('o'),
            "r" => Some('n'),
            _ => None,
        };
        self.counts.keys += 2;
        self.terminal.keys(key);
        // The answer names the row, unless the journal has more urgent news: that this decision could not be written.
        let news = self.full && !failing;
        self.terminal.wait_until("the decision", |screen| {
            answer(screen).is_some() || news && screen.contents().contains("not journalled:")
        });
        match self.terminal.look(answer) {
            Some(NO_FLAG) => return,
            Some(words) => {
                let said = self.terminal.look(|screen| screen.contents().contains(&format!("{words} row {row} ")));
                assert!(said, "row {row} was decided on: {}", self.terminal.look(vt100::Screen::contents));
            }
            None => {}
        }
        self.deeds.push(format!("{key}{row}, answer {:?}", self.terminal.look(answer)));
        if self.full || not_journalled(&self.terminal) {
            self.deeds.push("not journalled".into());
            self.waiting.insert(row, decision);
        } else {
            // What was missing was written before this.
            self.made.append(&mut self.waiting);
            self.made.insert(row, decision);
        }
    }

    /// An end, and the next workbench.
    fn end(mut self) {
        match self.chance.below(3) {
            0 => {
                self.counts.signalled += 1;
                let (name, status) = self.chance.of_list(&[("TERM", 143), ("HUP", 129), ("INT", 130)]);
                self.terminal.signal(name);
                assert_eq!(self.terminal.end().0, status);
            }
            _ => {
                self.counts.killed += 1;
                self.terminal.kill();
            }
        }
        let mut terminal = self.desk.start(WINDOW);
        let mut offered = take_back(&mut terminal);
        let grown = self.desk.has_grown();
        if grown && offered {
            self.counts.grown_offered += 1;
        }
        if grown && !offered {
            // Work on a record that has grown since is kept for what it was: there it is offered.
            terminal.kill();
            self.desk.shrink();
            terminal = self.desk.start(WINDOW);
            offered = take_back(&mut terminal);
        }
        let back: BTreeMap<u32, char> = self.desk.saved(terminal, CHANNEL).into_iter().collect();
        assert!(offered || self.made.values().all(Option::is_none), "nothing was offered of {:?}", self.made);
        for row in ROWS {
            let now = back.get(&row).copied();
            let made = self.made.get(&row).copied().unwrap_or(None);
            let also = self.waiting.get(&row).copied().unwrap_or(made);
            assert!(
                now == made || now == also,
                "row {row}: {now:?} came back, {made:?} or {also:?} was decided: {:#?}",
                self.deeds
            );
            self.counts.decisions += usize::from(self.made.contains_key(&row));
        }
    }
}
