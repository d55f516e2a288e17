use std::sync::Arc;

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};
use ratatui::crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::super::jobs::Judge;
use super::super::message::{Effect, Written};
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

/// In place of the folder of journals there is a file, into which nobody can write; or the folder again.
fn obstruct(folder: &Path, on: bool) {
    let journals = folder.join("journal");
    if on {
        std::fs::remove_dir_all(&journals).unwrap();
        std::fs::write(&journals, "").unwrap();
    } else {
        std::fs::remove_file(&journals).unwrap();
    }
}

#[test]
fn what_could_not_be_written_is_told_once_shown_meanwhile_and_written_when_it_can_be() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open(folder.path());
    bench.keys("a");
    bench.journal.catch_up();
    obstruct(folder.path(), true);
    bench.keys("arr");
    let told = bench.errors.recv().unwrap();
    assert!(matches!(&told, Message::Journal(JournalNews::Failing(Error::Io { .. }))), "{told:?}");
    bench.take(told);
    let is_said =
        |bench: &Bench| bench.model.toast.as_ref().is_some_and(|t| t.text.starts_with("changes are not journalled: "));
    assert!(is_said(&bench));
    bench.carry_out(vec![Effect::Analyse(0)]);
    assert!(is_said(&bench), "no result takes it away");
    bench.keys("a");
    assert!(bench.model.not_journalled.is_some(), "whatever else is said");
    obstruct(folder.path(), false);
    let told = bench.errors.recv().unwrap();
    assert!(matches!(&told, Message::Journal(JournalNews::Resumed)), "no second complaint: {told:?}");
    bench.take(told);
    assert_eq!(bench.model.not_journalled, None);
    let plans = bench.model.session.plans.clone();
    let kept = bench.journal.end(false).unwrap();
    assert_eq!((kept.missing, kept.journal.is_some_and(|path| path.exists())), (0, true));
    let mut again = Bench::open(folder.path());
    again.keys("r");
    assert_eq!(again.model.session.plans, plans, "with all that was missing");
}

#[test]
fn the_end_says_how_much_could_not_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open(folder.path());
    obstruct(folder.path(), true);
    bench.keys("arr");
    assert_eq!(bench.journal.end(false), Some(Kept { journal: None, missing: 3 }));
}

#[test]
fn a_folder_that_cannot_be_made_is_shown_until_it_can_be() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("journal"), "").unwrap();
    let mut bench = Bench::open(folder.path());
    assert!(bench.model.not_journalled.is_some());
    obstruct(folder.path(), false);
    let told = bench.errors.recv().unwrap();
    bench.take(told);
    assert_eq!(bench.model.not_journalled, None);
}

#[test]
fn a_clean_end_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open(folder.path());
    bench.keys("aar");
    bench.journal.catch_up();
    assert_eq!((bench.journal.end(true), journals(folder.path())), (Some(Kept::default()), 0));
}

#[test]
fn what_lies_about_in_the_folder_is_neither_offered_nor_touched() {
    let folder = tempfile::tempdir().unwrap();
    let mut bench = Bench::open(folder.path());
    bench.keys("aar");
    let own = bench.journal.end(false).unwrap().journal.unwrap();
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

/// A journal of a workbench in which these keys were typed.
fn left_behind(folder: &Path, keys: &str) -> PathBuf {
    let mut bench = Bench::open(folder);
    if matches!(bench.model.overlay, Overlay::Recover(_)) {
        bench.press(KeyCode::Esc);
    }
    bench.keys(keys);
    bench.journal.end(false).unwrap().journal.unwrap()
}

/// The rows decided on in the channel on the screen, with the verdicts' initials.
fn decided(bench: &Bench) -> Vec<(u32, char)> {
    let initial = |d: &crate::review::Decision| d.ruling.verdict().word().chars().next().unwrap();
    bench.model.plan().decisions.iter().map(|(row, d)| (row + 1, initial(d))).collect()
}

#[test]
fn journals_of_one_record_are_taken_in_one_after_the_other_and_nothing_of_either_is_dropped() {
    let folder = tempfile::tempdir().unwrap();
    // The first wild points are in rows 61, 91 and 200.
    left_behind(folder.path(), "aa");
    left_behind(folder.path(), "nnr");
    let mut bench = Bench::open(folder.path());
    bench.keys("r");
    assert!(matches!(&bench.model.overlay, Overlay::Recover(rest) if rest.len() == 1), "the next is offered");
    bench.keys("r");
    assert!(matches!(bench.model.overlay, Overlay::None));
    assert_eq!(decided(&bench), [(61, 'o'), (91, 'o'), (200, 'n')]);
    bench.journal.catch_up();
    drop(bench.journal);
    assert_eq!(journals(folder.path()), 1, "one journal has all of it");
    let mut again = Bench::open(folder.path());
    assert!(matches!(&again.model.overlay, Overlay::Recover(all) if all[0].changes == 3));
    again.keys("r");
    assert_eq!(decided(&again), [(61, 'o'), (91, 'o'), (200, 'n')]);
}

#[test]
fn a_sample_with_two_verdicts_is_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    left_behind(folder.path(), "aa");
    left_behind(folder.path(), "rnr");
    for (answer, expected) in [("h", 'n'), ("t", 'o'), ("H", 'n'), ("T", 'o')] {
        let mut bench = Bench::open(folder.path());
        bench.keys("rr");
        assert!(
            matches!(&bench.model.overlay, Overlay::Merge(m) if m.conflicts.len() == 1),
            "{:?}",
            bench.model.overlay
        );
        // Nothing is taken in before it is answered.
        assert_eq!(decided(&bench), [(61, 'n'), (200, 'n')]);
        bench.press(KeyCode::Esc);
        assert!(matches!(&bench.model.overlay, Overlay::Recover(rest) if rest.len() == 1));
        bench.keys("r");
        bench.keys(answer);
        assert!(matches!(bench.model.overlay, Overlay::None));
        assert_eq!(decided(&bench), [(61, expected), (91, 'o'), (200, 'n')], "{answer}");
        // What was there before is offered again to the next round.
        bench.journal.end(true);
        drop(bench);
        left_behind(folder.path(), "aa");
        left_behind(folder.path(), "rnr");
    }
}

#[test]
fn a_journal_that_is_not_offered_is_told_of() {
    let folder = tempfile::tempdir().unwrap();
    let path = left_behind(folder.path(), "aa");
    let text = std::fs::read_to_string(&path).unwrap();
    // As a later version would write it: it is not for this one to check its sums.
    std::fs::write(&path, text.replacen("\"format\":1", "\"format\":2", 1).replacen("wildpoint 0", "wildpoint 9", 1))
        .unwrap();
    let said = |bench: &Bench| bench.model.toast.as_ref().map(|t| t.text.clone()).unwrap_or_default();
    let bench = Bench::open(folder.path());
    assert!(matches!(bench.model.overlay, Overlay::None));
    assert!(said(&bench).contains("by wildpoint 9") && said(&bench).contains("cannot read it"), "{}", said(&bench));
    drop(bench);
    std::fs::write(&path, &text[..10]).unwrap();
    let bench = Bench::open(folder.path());
    assert!(said(&bench).contains("its first line is damaged"), "{}", said(&bench));
    assert!(path.exists());
}

#[test]
fn however_many_journals_of_other_records_are_newer_this_one_is_offered() {
    let folder = tempfile::tempdir().unwrap();
    let own = left_behind(folder.path(), "aa");
    let text = std::fs::read_to_string(&own).unwrap();
    for i in 0..1100 {
        std::fs::write(folder.path().join(format!("journal/{i:016}-record-4000000.journal")), "other\n").unwrap();
    }
    let later = std::time::SystemTime::now() - Duration::from_secs(3600);
    std::fs::File::options().write(true).open(&own).unwrap().set_modified(later).unwrap();
    let bench = Bench::open(folder.path());
    assert!(matches!(&bench.model.overlay, Overlay::Recover(found) if found[0].path == own));
    let said = bench.model.toast.as_ref().map(|t| t.text.clone()).unwrap_or_default();
    assert!(said.contains("100 older journals of other records"), "{said}");
    assert!(!text.is_empty());
}

#[cfg(unix)]
#[test]
fn nobody_else_gets_to_see_the_journal_and_no_link_leads_it_elsewhere() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("journal")).unwrap();
    std::fs::set_permissions(folder.path().join("journal"), std::fs::Permissions::from_mode(0o755)).unwrap();
    let mut bench = Bench::open(folder.path());
    let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o777;
    assert_eq!(mode(&folder.path().join("journal")), 0o700);
    // Whatever somebody has put where the draft will be.
    let name = files::name(&folder.path().join("journal"), &bench.model.track.sha256, "");
    let victim = folder.path().join("victim");
    std::fs::write(&victim, "precious").unwrap();
    symlink(&victim, name.with_extension("draft")).unwrap();
    bench.keys("a");
    let kept = bench.journal.end(false).unwrap().journal.unwrap();
    assert_eq!(std::fs::read_to_string(&victim).unwrap(), "precious");
    assert_eq!((mode(&kept), kept), (0o600, name));
}
