use std::sync::Arc;

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::super::message::{Effect, Written};
use super::super::office::Judge;
use super::super::plot::Glyphs;
use super::super::theme::Theme;
use super::super::update::update;
use super::*;
use crate::error::Error;
use crate::session::{Session, Setup};
use crate::stop::Stop;
use crate::track::{LoadOptions, load};

/// A workbench without a screen, and its journal.
struct Bench {
    model: Model,
    journal: Journal,
    errors: Receiver<Message>,
}

impl Bench {
    fn open(folder: &Path) -> Self {
        let track = load(&Source::demo(), &LoadOptions::default()).unwrap();
        let session = Session::new(&track, LoadOptions::default(), &Setup::standard());
        let mut model = Model::new(Arc::new(track), session, None, Theme::mono(), Glyphs::Ascii);
        let (sender, errors) = unbounded();
        let journal = Journal::start(Some(folder.join("journal")), &mut model, sender);
        let mut bench = Self { model, journal, errors };
        bench.carry_out(vec![Effect::Analyse(0)]);
        bench
    }

    fn carry_out(&mut self, effects: Vec<Effect>) {
        for effect in effects {
            match effect {
                Effect::Analyse(plan) => {
                    let result = Judge::new(&self.model, plan).run(&Stop::never()).map(Box::new);
                    self.model.awaited = Some(0);
                    update(&mut self.model, Message::Analysed { generation: 0, plan, result });
                }
                Effect::Offered { path, fate } => self.journal.settle(&self.model, &path, fate),
                _ => {}
            }
        }
    }

    fn take(&mut self, message: Message) {
        let effects = update(&mut self.model, message);
        self.journal.note(&mut self.model);
        self.carry_out(effects);
    }

    fn press(&mut self, code: KeyCode) {
        self.take(Message::Key(KeyEvent::new(code, KeyModifiers::NONE)));
    }

    fn keys(&mut self, keys: &str) {
        keys.chars().for_each(|c| self.press(KeyCode::Char(c)));
    }

    /// The session was saved as it was at this revision.
    fn saved(&mut self, revision: u64) {
        let what = Written::Session { revision, then_quit: false };
        self.take(Message::Written { what, path: "/nowhere/a.toml".into(), result: Ok("saved".into()) });
        self.journal.saved(&self.model);
    }
}

fn journals(folder: &Path) -> usize {
    std::fs::read_dir(folder.join("journal")).unwrap().count()
}

#[test]
fn whatever_is_typed_comes_back_as_it_was() {
    const KEYS: &[&str] =
        &["a", "r", "n", " ", "x", "u", "u", "U", ".", ",", ";", "ga", "gr", "gx", "i", "d", "p", "o"];
    let mut random = Pcg64Mcg::seed_from_u64(11);
    for round in 0..12 {
        let folder = tempfile::tempdir().unwrap();
        let mut bench = Bench::open(folder.path());
        let mut revision = 0;
        for _ in 0..random.next_u32() % 40 {
            bench.keys(KEYS[random.next_u32() as usize % KEYS.len()]);
            match random.next_u32() % 12 {
                // A save begins; what is typed until it ends is not in it.
                0 => revision = bench.model.revision,
                1 => bench.saved(revision),
                _ => {}
            }
        }
        let (plans, unsaved) = (bench.model.session.plans.clone(), bench.model.unsaved());
        drop(bench.journal);
        assert_eq!(journals(folder.path()), usize::from(unsaved), "round {round}");
        let mut again = Bench::open(folder.path());
        assert_eq!(matches!(again.model.overlay, Overlay::Recover(_)), unsaved, "round {round}");
        if unsaved {
            again.keys("r");
            assert_eq!(again.model.session.plans, plans, "round {round}");
        }
        drop(again.journal);
        assert_eq!(journals(folder.path()), usize::from(unsaved), "round {round}: one takes the place of the other");
    }
}

#[test]
fn changes_since_a_save_began_are_kept_and_counted() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open(folder.path());
    bench.keys("aa");
    let revision = bench.model.revision;
    bench.keys("rrr");
    bench.saved(revision);
    bench.keys("a");
    drop(bench.journal);
    let again = Bench::open(folder.path());
    let Overlay::Recover(found) = &again.model.overlay else { panic!("nothing is offered") };
    assert_eq!((found.len(), found[0].changes, found[0].entries.len()), (1, 4, 2));
}

#[test]
fn an_error_is_told_once_and_a_save_begins_anew() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open(folder.path());
    // Nobody can write into a folder that is a file.
    std::fs::remove_dir(folder.path().join("journal")).unwrap();
    std::fs::write(folder.path().join("journal"), "").unwrap();
    bench.keys("aar");
    let told = bench.errors.recv().unwrap();
    assert!(matches!(&told, Message::Unjournalled(Error::Io { .. })));
    bench.take(told);
    assert!(bench.model.toast.as_ref().is_some_and(|t| t.text.starts_with("the journal ends here, :w saves: ")));
    std::fs::remove_file(folder.path().join("journal")).unwrap();
    std::fs::create_dir(folder.path().join("journal")).unwrap();
    bench.saved(bench.model.revision);
    bench.keys("a");
    assert!(bench.journal.end(false).is_some_and(|path| path.exists()));
    assert!(bench.errors.try_recv().is_err(), "no second complaint");
}

#[test]
fn a_clean_end_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open(folder.path());
    bench.keys("aar");
    bench.journal.catch_up();
    assert_eq!((bench.journal.end(true), journals(folder.path())), (None, 0));
}

#[test]
fn what_lies_about_in_the_folder_is_neither_offered_nor_touched() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open(folder.path());
    bench.keys("aar");
    let own = bench.journal.end(false).unwrap();
    let at = |name: &str| folder.path().join("journal").join(name);
    let good = std::fs::read_to_string(&own).unwrap();
    std::fs::write(at("empty.journal"), "").unwrap();
    std::fs::write(at("torn.journal"), &good[..30]).unwrap();
    std::fs::write(at("noise.journal"), [0xff; 5000]).unwrap();
    std::fs::write(at("forged.journal"), good.replacen("wildpoint", "wildcard", 1)).unwrap();
    std::fs::write(at("notes.txt"), &good).unwrap();
    std::fs::create_dir(at("folder.journal")).unwrap();
    let before = journals(folder.path());
    let mut again = Bench::open(folder.path());
    let Overlay::Recover(found) = &again.model.overlay else { panic!("the good one is offered") };
    assert_eq!(found.iter().map(|f| &f.path).collect::<Vec<_>>(), [&own]);
    again.keys("d");
    drop(again.journal);
    assert_eq!((journals(folder.path()), own.exists()), (before - 1, false));
}
