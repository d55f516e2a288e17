//! Output files that appear whole or not at all.

use std::collections::BTreeSet;
use std::fs::{File, Metadata};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use tempfile::NamedTempFile;

use super::{DASH, names_columns, unpacked_name};
use crate::error::{Error, Result};
use faults::{Disk, point};
use identity::{FileId, Protected};
use manifest::{Manifest, Naming};
use unfinished::Unfinished;

#[cfg(not(any(test, feature = "faults")))]
mod faults;
#[cfg(any(test, feature = "faults"))]
pub mod faults;
mod hidden;
mod identity;
mod manifest;
mod unfinished;

pub use unfinished::take_unfinished_away;

/// Several output files. Each is written beside its target under another name; [`Outputs::commit`] gives all of them
/// their names. Dropped before that, they leave nothing; where the program is killed, the next one that writes to the
/// folder finishes the set or takes it back, and takes away what is left.
#[derive(Debug)]
pub struct Outputs {
    force: bool,
    inputs: Vec<Protected>,
    staged: Vec<Staged>,
    /// True where `-` is no file.
    dash: bool,
    /// What goes to standard output.
    printed: Option<File>,
    /// True where everything is done but writing.
    dry: bool,
}

#[derive(Debug)]
struct Staged {
    target: PathBuf,
    folder: PathBuf,
    file: NamedTempFile,
    existed: bool,
    known: Unfinished,
}

impl Outputs {
    /// No outputs yet. `force` overwrites existing files, except `inputs`, whatever the paths that lead to them.
    #[must_use]
    pub fn new(force: bool, inputs: &[&Path]) -> Self {
        let inputs = inputs.iter().map(|path| Protected::new(path)).collect();
        Self { force, inputs, staged: Vec::new(), dash: false, printed: None, dry: false }
    }

    /// The same where `-` means standard output, to which it is written with [`Outputs::commit`], after the files.
    #[must_use]
    pub fn or_standard_output(self) -> Self {
        Self { dash: true, ..self }
    }

    /// The same where nothing is written if `dry`: what would be an error is one all the same.
    #[must_use]
    pub fn dry(self, dry: bool) -> Self {
        Self { dry, ..self }
    }

    /// Writes the content of the file `path` through `write`, packed where its name ends like that of a packed file. The file itself
    /// appears with [`Outputs::commit`].
    ///
    /// # Errors
    /// [`Error::Exists`], [`Error::IsInput`]; [`Error::Usage`] for a path that two outputs share, and for the name of a
    /// Parquet file; [`Error::Input`] for a target that is no file; [`Error::Io`] where the folder is missing or cannot
    /// be written; what `write` gives.
    pub fn stage(&mut self, path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<()> {
        if names_columns(path) {
            let what = format!("{}: only the cleaned file can be a Parquet file", path.display());
            return Err(Error::usage(what, "give it a name that ends in .csv"));
        }
        self.stage_columns(path, write)
    }

    /// The same for what `write` writes as Parquet.
    ///
    /// # Errors
    /// As [`Outputs::stage`], whatever the name.
    pub fn stage_columns(&mut self, path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<()> {
        if self.dry {
            return self.rehearse(path, write);
        }
        if self.dash && path == Path::new(DASH) {
            let folder = std::env::temp_dir();
            let file = tempfile::tempfile().map_err(Error::io("write to", &folder))?;
            let mut buffer = BufWriter::with_capacity(1 << 20, file);
            write(&mut buffer)?;
            let file = buffer.into_inner().map_err(|e| Error::io("write to", &folder)(e.into_error()))?;
            self.printed = Some(file);
            return Ok(());
        }
        let (target, folder) = self.place(path)?;
        self.permit(path, &target)?;
        let mut file = hidden::create(&folder).map_err(Error::io("write to", &folder))?;
        let known = Unfinished::new(file.path());
        tidy(&folder, file.as_file());
        // A set that was finished just now may have put a file there.
        let existing = self.permit(path, &target)?;
        if let Some(existing) = &existing {
            let permitted = point().and_then(|()| file.as_file().set_permissions(existing.permissions()));
            permitted.map_err(Error::io("write", path))?;
        }
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let mut buffer = BufWriter::with_capacity(1 << 20, Disk(file.as_file_mut()));
        match unpacked_name(&name) {
            (name, Some(packing)) => {
                let mut packed = packing.pack(&mut buffer, name).map_err(Error::io("write", path))?;
                write(&mut packed)?;
                packed.finish().map_err(Error::io("write", path))?;
            }
            (_, None) => write(&mut buffer)?,
        }
        buffer.flush().map_err(Error::io("write", path))?;
        drop(buffer);
        point().and_then(|()| file.as_file().sync_all()).map_err(Error::io("write", path))?;
        self.staged.push(Staged { target, folder, file, existed: existing.is_some(), known });
        Ok(())
    }

    /// Checks an output and makes its content without writing it. A folder that is not there yet would be made.
    fn rehearse(&self, path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<()> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        if !(self.dash && path == Path::new(DASH)) && folder.is_none_or(Path::exists) {
            let (target, _) = self.place(path)?;
            self.permit(path, &target)?;
        }
        write(&mut std::io::sink())
    }

    /// Gives all files their names. When one cannot get its name, or the names do not get to the disk, all are rolled
    /// back.
    ///
    /// # Errors
    /// [`Error::Io`]; [`Error::Exists`] when a target has appeared meanwhile; [`Error::Usage`] when two targets are one
    /// file.
    pub fn commit(mut self) -> Result<()> {
        let printed = self.printed.take();
        self.name_files()?;
        match printed {
            Some(file) => print(file).map_err(Error::io("write", "standard output")),
            None => Ok(()),
        }
    }

    fn name_files(self) -> Result<()> {
        let _not_interrupted = unfinished::commit();
        let Some(first) = self.staged.first() else { return Ok(()) };
        if let ([only], false) = (self.staged.as_slice(), first.existed) {
            // One name is given at once.
            let (target, folder) = (only.target.clone(), only.folder.clone());
            for staged in self.staged {
                staged.rename(self.force, &[])?;
            }
            return sync(&folder).map_err(|e| {
                let _ = std::fs::remove_file(&target);
                Error::io("write to", &folder)(e)
            });
        }
        let names = |s: &Staged| (s.file.path().to_path_buf(), s.target.clone());
        let names: Vec<(PathBuf, PathBuf)> = self.staged.iter().map(names).collect();
        let namings: Vec<Naming<'_>> = names.iter().map(|(hidden, target)| Naming { hidden, target }).collect();
        let manifest = Manifest::commit(&namings).map_err(Error::io("write to", &first.folder))?;
        match give_names(self.staged, self.force, &manifest) {
            Ok(()) => {
                manifest.finish();
                Ok(())
            }
            Err(error) => {
                manifest.undo();
                Err(error)
            }
        }
    }

    /// The file that `path` leads to, and its folder.
    fn place(&self, path: &Path) -> Result<(PathBuf, PathBuf)> {
        if path.is_dir() {
            return Err(Error::input(path, "this is a folder", "give the output a file name"));
        }
        let target = match path.canonicalize() {
            Ok(existing) => existing,
            Err(_) => {
                let name = path.file_name().ok_or_else(|| Error::input(path, "not a file name", "give a file name"))?;
                let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
                folder.canonicalize().map_err(Error::io("write to the folder", folder))?.join(name)
            }
        };
        let folder = target.parent().map(Path::to_path_buf).unwrap_or_default();
        let id = FileId::at(&target);
        if self.staged.iter().any(|s| s.target == target || (id.is_some() && FileId::at(&s.target) == id)) {
            return Err(twice(path));
        }
        Ok((target, folder))
    }

    /// What is there, when it may be written over.
    fn permit(&self, path: &Path, target: &Path) -> Result<Option<Metadata>> {
        let existing = std::fs::symlink_metadata(target).ok();
        if self.inputs.iter().any(|input| input.is(target, existing.as_ref())) {
            return Err(Error::IsInput(path.to_path_buf()));
        }
        match existing {
            Some(found) if !found.is_file() => {
                Err(Error::input(path, "not a regular file", "give the output another name"))
            }
            Some(_) if !self.force => Err(Error::Exists(path.to_path_buf())),
            existing => Ok(existing),
        }
    }
}

/// Copies a file to standard output.
fn print(mut file: File) -> std::io::Result<()> {
    let mut stdout = std::io::stdout().lock();
    std::io::Seek::rewind(&mut file)?;
    std::io::copy(&mut file, &mut stdout)?;
    stdout.flush()
}

fn twice(path: &Path) -> Error {
    Error::usage(format!("{}: two outputs would be this file", path.display()), "give them different names")
}

/// Gives each file its name, and brings the names to the disk.
fn give_names(staged: Vec<Staged>, force: bool, manifest: &Manifest) -> Result<()> {
    let mut folders: Vec<PathBuf> = staged.iter().map(|s| s.folder.clone()).collect();
    let mut given = Vec::new();
    for staged in staged {
        manifest.keep(&staged.target);
        given.extend(staged.rename(force, &given)?);
    }
    folders.sort();
    folders.dedup();
    folders.iter().try_for_each(|folder| sync(folder).map_err(Error::io("write to", folder)))
}

impl Staged {
    /// Gives the file its name, unless one of those that are `given` already has it: a file system that does not tell
    /// upper from lower case takes two names for one.
    fn rename(self, force: bool, given: &[FileId]) -> Result<Option<FileId>> {
        let Self { target, file, known: _known, .. } = self;
        if FileId::at(&target).is_some_and(|id| given.contains(&id)) {
            return Err(twice(&target));
        }
        point().map_err(Error::io("write", &target))?;
        let persisted = if force { file.persist(&target) } else { file.persist_noclobber(&target) };
        match persisted {
            Ok(file) => Ok(file.metadata().ok().as_ref().and_then(FileId::of)),
            Err(e) if e.error.kind() == std::io::ErrorKind::AlreadyExists => Err(Error::Exists(target)),
            Err(e) => Err(Error::io("write", target)(e.error)),
        }
    }
}

/// Sees to what dead runs have left in a folder, once in each run; `own` is a file of this one in it.
fn tidy(folder: &Path, own: &File) {
    static TIDIED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let new = TIDIED.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_path_buf());
    if let (true, Ok(about)) = (new, own.metadata()) {
        manifest::tidy(folder, manifest::user(&about));
    }
}

/// Brings the names in a folder to the disk.
fn sync(folder: &Path) -> std::io::Result<()> {
    use std::io::ErrorKind as Kind;
    let synced = point().and_then(|()| if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) });
    match synced {
        // Some network file systems cannot do this to a folder.
        Err(e) if !matches!(e.kind(), Kind::InvalidInput | Kind::Unsupported) => Err(e),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;
    use std::process::Stdio;
    use std::sync::RwLock;

    use super::*;

    fn put(text: &'static str) -> impl FnOnce(&mut dyn Write) -> Result<()> {
        move |w| w.write_all(text.as_bytes()).map_err(Error::io("write", "test"))
    }

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            folder.read_dir().unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_dry_run_writes_nothing_and_refuses_what_a_real_one_would() {
        let folder = tempfile::tempdir().unwrap();
        let old = folder.path().join("old.csv");
        std::fs::write(&old, "kept").unwrap();
        let mut dry = Outputs::new(false, &[]).dry(true);
        dry.stage(&folder.path().join("new.csv"), put("x")).unwrap();
        assert!(matches!(dry.stage(&old, put("x")), Err(Error::Exists(_))));
        assert!(matches!(Outputs::new(true, &[&old]).dry(true).stage(&old, put("x")), Err(Error::IsInput(_))));
        dry.commit().unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn files_appear_together_or_not_at_all() {
        let dir = tempfile::tempdir().unwrap();
        let mut outputs = Outputs::new(false, &[]);
        outputs.stage(&dir.path().join("a"), put("one")).unwrap();
        outputs.stage(&dir.path().join("b"), put("two")).unwrap();
        assert!(names(dir.path()).iter().all(|n| n.starts_with('.')));
        outputs.commit().unwrap();
        assert_eq!(names(dir.path()), ["a", "b"]);
        assert_eq!(std::fs::read_to_string(dir.path().join("b")).unwrap(), "two");

        let mut outputs = Outputs::new(false, &[]);
        outputs.stage(&dir.path().join("c"), put("three")).unwrap();
        let failed = outputs.stage(&dir.path().join("d"), |_| Err(Error::Stopped));
        assert!(matches!(failed, Err(Error::Stopped)));
        drop(outputs);
        assert_eq!(names(dir.path()), ["a", "b"]);
    }

    #[test]
    fn a_failed_commit_takes_back_what_it_did() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        std::fs::write(at("old"), "old").unwrap();
        let mut outputs = Outputs::new(true, &[]);
        for name in ["old", "new", "late"] {
            outputs.stage(&at(name), put("new")).unwrap();
        }
        // A folder in the place of the third target: a rename cannot replace it.
        std::fs::create_dir(at("late")).unwrap();
        assert!(outputs.commit().is_err());
        assert_eq!(names(dir.path()), ["late", "old"]);
        assert_eq!(std::fs::read_to_string(at("old")).unwrap(), "old");
    }

    #[test]
    fn nothing_is_overwritten_unasked() {
        let dir = tempfile::tempdir().unwrap();
        let old = dir.path().join("old");
        std::fs::write(&old, "old").unwrap();
        assert!(matches!(Outputs::new(false, &[]).stage(&old, put("x")), Err(Error::Exists(_))));
        let mut late = Outputs::new(false, &[]);
        late.stage(&dir.path().join("late"), put("x")).unwrap();
        std::fs::write(dir.path().join("late"), "theirs").unwrap();
        assert!(matches!(late.commit(), Err(Error::Exists(_))));
        assert_eq!(std::fs::read_to_string(dir.path().join("late")).unwrap(), "theirs");

        let mut outputs = Outputs::new(true, &[&old]);
        let detour = dir.path().join("./old");
        assert!(matches!(outputs.stage(&detour, put("x")), Err(Error::IsInput(_))));
        outputs.stage(&dir.path().join("new"), put("x")).unwrap();
        let twice = outputs.stage(&dir.path().join("./new"), put("y"));
        assert!(matches!(twice, Err(Error::Usage { .. })));
        assert!(matches!(outputs.stage(dir.path(), put("x")), Err(Error::Input { .. })));
        assert!(matches!(outputs.stage(&dir.path().join("no/new"), put("x")), Err(Error::Io { .. })));
    }

    /// Writes a set: two files in the folder of the variable, one in the folder inside it.
    fn write_set(dir: &Path, text: &'static str) -> Result<()> {
        let mut outputs = Outputs::new(true, &[]);
        for name in ["a", "b", "inside/c"] {
            outputs.stage(&dir.join(name), put(text))?;
        }
        outputs.commit()
    }

    /// Not a test of its own: what [`a_set_of_a_killed_run_is_finished_or_taken_back_by_the_next`] starts and kills.
    #[test]
    fn killed_run() {
        let (Some(dir), Ok(at)) = (std::env::var_os("WILDPOINT_TEST_SET"), std::env::var("WILDPOINT_TEST_DIES")) else {
            return;
        };
        faults::die_at(at.parse().unwrap());
        write_set(Path::new(&dir), "new").unwrap();
    }

    /// A process holds the open files of this one, locks included, until it runs its own program: nobody begins one
    /// while a test looks at who holds what.
    static PROCESSES: RwLock<()> = RwLock::new(());

    /// A run that writes its set in `dir` and is killed at the step `at`, if it has this many.
    fn killed_at(at: usize, dir: &Path) -> std::process::Output {
        let mut command = std::process::Command::new(std::env::current_exe().unwrap());
        command.args(["--exact", "track::outputs::tests::killed_run"]);
        command.env("WILDPOINT_TEST_SET", dir).env("WILDPOINT_TEST_DIES", at.to_string());
        let begun = PROCESSES.write().unwrap();
        let run = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        drop(begun);
        run.wait_with_output().unwrap()
    }

    #[test]
    fn a_set_of_a_killed_run_is_finished_or_taken_back_by_the_next() {
        let (mut finished, mut taken_back) = (0, 0);
        for old in [true, false] {
            for first in ["", "inside"] {
                for at in 0.. {
                    let dir = tempfile::tempdir().unwrap();
                    let dir = dir.path();
                    std::fs::create_dir(dir.join("inside")).unwrap();
                    if old {
                        write_set(dir, "old").unwrap();
                    }
                    let run = killed_at(at, dir);
                    // The next run, in either of the folders, then in the other.
                    for folder in [first, if first.is_empty() { "inside" } else { "" }] {
                        manifest::tidy(&dir.join(folder), dir.metadata().ok().as_ref().and_then(manifest::user));
                    }
                    let texts = ["a", "b", "inside/c"].map(|name| std::fs::read_to_string(dir.join(name)).ok());
                    let before = if old { Some("old".to_owned()) } else { None };
                    let all = |text: Option<&str>| texts.iter().all(|t| t.as_deref() == text);
                    assert!(all(Some("new")) || all(before.as_deref()), "old {old}, killed at {at}: {texts:?}");
                    let hidden = |folder: PathBuf| names(&folder).iter().filter(|n| n.starts_with('.')).count();
                    assert_eq!(hidden(dir.to_path_buf()) + hidden(dir.join("inside")), 0, "killed at {at}");
                    if run.status.success() {
                        assert!(all(Some("new")));
                        break;
                    }
                    *if all(Some("new")) { &mut finished } else { &mut taken_back } += 1;
                }
            }
        }
        assert!(finished > 10 && taken_back > 10, "{finished} {taken_back}");
    }

    #[test]
    fn a_target_that_somebody_changed_since_is_left_alone_and_the_set_taken_back() {
        let _no_process_begins = PROCESSES.read().unwrap();
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        let owner = dir.path().metadata().ok().as_ref().and_then(manifest::user);
        std::fs::write(at("a"), "old").unwrap();
        std::fs::write(at("b"), "old").unwrap();
        let mut outputs = Outputs::new(true, &[]);
        outputs.stage(&at("a"), put("new")).unwrap();
        outputs.stage(&at("b"), put("new")).unwrap();
        // Killed after the first name was given: what is left is the manifest, and the hidden file of the second.
        let names_of = |s: &Staged| (s.file.path().to_path_buf(), s.target.clone());
        let pairs: Vec<_> = outputs.staged.iter().map(names_of).collect();
        let namings: Vec<_> = pairs.iter().map(|(hidden, target)| Naming { hidden, target }).collect();
        let manifest = Manifest::commit(&namings).unwrap();
        manifest.keep(&at("a"));
        std::fs::rename(&pairs[0].0, at("a")).unwrap();
        outputs.staged.drain(..).for_each(|s| drop(s.file.keep()));
        drop(manifest);
        std::fs::write(at("b"), "theirs").unwrap();
        manifest::tidy(dir.path(), owner);
        assert_eq!(names(dir.path()), ["a", "b"]);
        let texts = ["a", "b"].map(|name| std::fs::read_to_string(at(name)).unwrap());
        assert_eq!(texts, ["old", "theirs"]);
    }

    #[test]
    fn what_a_dead_run_left_is_taken_away_and_what_a_live_one_holds_is_not() {
        let _no_process_begins = PROCESSES.read().unwrap();
        let dir = tempfile::tempdir().unwrap();
        let owner = dir.path().metadata().ok().as_ref().and_then(manifest::user);
        let mut live = Outputs::new(false, &[]);
        live.stage(&dir.path().join("a"), put("x")).unwrap();
        for name in [".wildpoint-dead.tmp", ".wildpoint-note.txt", ".other.tmp"] {
            std::fs::write(dir.path().join(name), "left").unwrap();
        }
        manifest::tidy(dir.path(), owner.map(|user| user + 1));
        assert_eq!(names(dir.path()).len(), 4, "files of others");
        manifest::tidy(dir.path(), owner);
        assert_eq!(names(dir.path()).len(), 3);
        live.commit().unwrap();
        assert_eq!(names(dir.path()), [".other.tmp", ".wildpoint-note.txt", "a"]);
    }

    #[test]
    fn a_manifest_that_leads_elsewhere_by_a_name_is_not_followed() {
        let dir = tempfile::tempdir().unwrap();
        let owner = dir.path().metadata().ok().as_ref().and_then(manifest::user);
        let name = |text: &str| serde_json::to_string(&std::ffi::OsString::from(text)).unwrap();
        let member = format!(
            r#"{{"folder":null,"target":{},"hidden":{},"backup":{},"old":null,"new":null}}"#,
            name("../victim"),
            name("mine"),
            name(".wildpoint-x.old")
        );
        std::fs::write(dir.path().join(".wildpoint-x.set"), format!(r#"{{"Set":[{member}]}}"#)).unwrap();
        std::fs::write(dir.path().join("mine"), "mine").unwrap();
        manifest::tidy(dir.path(), owner);
        assert_eq!(names(dir.path()), [".wildpoint-x.set", "mine"]);
    }

    #[cfg(unix)]
    #[test]
    fn the_input_is_known_under_any_name() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        std::fs::write(at("input"), "old").unwrap();
        std::fs::hard_link(at("input"), at("other")).unwrap();
        let input = at("input");
        let mut outputs = Outputs::new(true, &[&input]);
        assert!(matches!(outputs.stage(&at("other"), put("x")), Err(Error::IsInput(_))));
        // A record that was deleted keeps its name.
        std::fs::remove_file(&input).unwrap();
        let mut outputs = Outputs::new(true, &[&input]);
        assert!(matches!(outputs.stage(&input, put("x")), Err(Error::IsInput(_))));
    }

    #[cfg(unix)]
    #[test]
    fn two_names_of_one_file_are_no_two_outputs() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        std::fs::write(at("one"), "old").unwrap();
        std::fs::hard_link(at("one"), at("two")).unwrap();
        let mut outputs = Outputs::new(true, &[]);
        outputs.stage(&at("one"), put("x")).unwrap();
        assert!(matches!(outputs.stage(&at("two"), put("y")), Err(Error::Usage { .. })));
    }

    #[cfg(unix)]
    #[test]
    fn the_mode_of_an_existing_file_is_kept_and_links_are_followed() {
        use std::os::unix::fs::PermissionsExt as _;
        let dir = tempfile::tempdir().unwrap();
        let (old, link) = (dir.path().join("old"), dir.path().join("link"));
        std::fs::write(&old, "old").unwrap();
        std::fs::set_permissions(&old, std::fs::Permissions::from_mode(0o640)).unwrap();
        std::os::unix::fs::symlink(&old, &link).unwrap();
        let mut outputs = Outputs::new(true, &[]);
        outputs.stage(&link, put("new")).unwrap();
        outputs.commit().unwrap();
        assert_eq!(std::fs::read_to_string(&old).unwrap(), "new");
        assert_eq!(old.metadata().unwrap().permissions().mode() & 0o777, 0o640);
        assert!(link.symlink_metadata().unwrap().is_symlink());
    }

    #[test]
    fn a_gz_name_packs_without_a_time_stamp() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.csv.gz");
        let mut outputs = Outputs::new(false, &[]);
        outputs.stage(&path, put("t,x\n")).unwrap();
        outputs.commit().unwrap();
        let packed = std::fs::read(&path).unwrap();
        assert_eq!((&packed[..2], &packed[4..8]), (&[0x1f, 0x8b][..], &[0; 4][..]));
        let mut text = String::new();
        flate2::read::GzDecoder::new(&packed[..]).read_to_string(&mut text).unwrap();
        assert_eq!(text, "t,x\n");
    }
}
