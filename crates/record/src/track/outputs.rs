//! Output files that appear whole or not at all.

use std::fs::{File, Metadata};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use flate2::{Compression, GzBuilder};
use tempfile::NamedTempFile;

use crate::error::{Error, Result};
use faults::{Disk, point};
use unfinished::Unfinished;

#[cfg(not(any(test, feature = "faults")))]
mod faults;
#[cfg(any(test, feature = "faults"))]
pub mod faults;
mod unfinished;

pub use unfinished::take_unfinished_away;

/// Several output files. Each is written beside its target under another name; [`Outputs::commit`] gives all of them
/// their names. Dropped before that, they leave nothing.
#[derive(Debug)]
pub struct Outputs {
    force: bool,
    inputs: Vec<PathBuf>,
    staged: Vec<Staged>,
}

#[derive(Debug)]
struct Staged {
    target: PathBuf,
    folder: PathBuf,
    file: NamedTempFile,
    existed: bool,
    known: Unfinished,
}

/// A target that has its new content, and what it takes to undo that.
struct Renamed {
    target: PathBuf,
    old: Option<NamedTempFile<()>>,
    existed: bool,
}

impl Outputs {
    /// No outputs yet. `force` overwrites existing files, except `inputs`.
    #[must_use]
    pub fn new(force: bool, inputs: &[&Path]) -> Self {
        let inputs = inputs.iter().filter_map(|p| p.canonicalize().ok()).collect();
        Self { force, inputs, staged: Vec::new() }
    }

    /// Writes the content of the file `path` through `write`, packed where its name ends with `.gz`. The file itself
    /// appears with [`Outputs::commit`].
    ///
    /// # Errors
    /// [`Error::Exists`], [`Error::IsInput`]; [`Error::Usage`] for a path that two outputs share; [`Error::Input`] for
    /// a target that is no file; [`Error::Io`] where the folder is missing or cannot be written; what `write` gives.
    pub fn stage(&mut self, path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<()>) -> Result<()> {
        let (target, folder) = self.place(path)?;
        let existing = std::fs::symlink_metadata(&target).ok();
        self.permit(path, &target, existing.as_ref())?;
        let mut file = point().and_then(|()| hidden().tempfile_in(&folder)).map_err(Error::io("write to", &folder))?;
        let known = Unfinished::new(file.path());
        if let Some(existing) = &existing {
            let permitted = point().and_then(|()| file.as_file().set_permissions(existing.permissions()));
            permitted.map_err(Error::io("write", path))?;
        }
        let gzipped = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gz"));
        let mut buffer = BufWriter::with_capacity(1 << 20, Disk(file.as_file_mut()));
        if gzipped {
            // No time stamp: the same content makes the same file.
            let mut packed = GzBuilder::new().mtime(0).write(&mut buffer, Compression::default());
            write(&mut packed)?;
            packed.finish().map_err(Error::io("write", path))?;
        } else {
            write(&mut buffer)?;
        }
        buffer.flush().map_err(Error::io("write", path))?;
        drop(buffer);
        point().and_then(|()| file.as_file().sync_all()).map_err(Error::io("write", path))?;
        self.staged.push(Staged { target, folder, file, existed: existing.is_some(), known });
        Ok(())
    }

    /// Gives all files their names. When one cannot get its name, or the names do not get to the disk, all are taken
    /// back.
    ///
    /// # Errors
    /// [`Error::Io`]; [`Error::Exists`] when a target has appeared meanwhile.
    pub fn commit(self) -> Result<()> {
        let _not_interrupted = unfinished::commit();
        let mut renamed = Vec::new();
        let mut folders = Vec::new();
        for staged in self.staged {
            folders.push(staged.folder.clone());
            match staged.rename(self.force) {
                Ok(done) => renamed.push(done),
                Err(error) => {
                    renamed.into_iter().rev().for_each(Renamed::undo);
                    return Err(error);
                }
            }
        }
        folders.sort();
        folders.dedup();
        // The names are on the disk when their folder is.
        let synced = folders.iter().try_for_each(|folder| sync(folder));
        if synced.is_err() {
            renamed.into_iter().rev().for_each(Renamed::undo);
        }
        synced
    }

    /// The file that `path` leads to, and its folder.
    fn place(&self, path: &Path) -> Result<(PathBuf, PathBuf)> {
        if path.is_dir() {
            return Err(Error::input(path, "this is a folder", "give the output a file name"));
        }
        let target = match path.canonicalize() {
            Ok(existing) => existing,
            Err(_) => {
                let name =
                    path.file_name().ok_or_else(|| Error::input(path, "this names no file", "give a file name"))?;
                let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
                folder.canonicalize().map_err(Error::io("write to the folder", folder))?.join(name)
            }
        };
        let folder = target.parent().map(Path::to_path_buf).unwrap_or_default();
        if self.staged.iter().any(|s| s.target == target) {
            return Err(Error::usage(
                format!("{}: two outputs would be this file", path.display()),
                "give them different names",
            ));
        }
        Ok((target, folder))
    }

    fn permit(&self, path: &Path, target: &PathBuf, existing: Option<&Metadata>) -> Result<()> {
        if self.inputs.contains(target) {
            return Err(Error::IsInput(path.to_path_buf()));
        }
        match existing {
            Some(found) if !found.is_file() => {
                Err(Error::input(path, "this is no ordinary file", "give the output another name"))
            }
            Some(_) if !self.force => Err(Error::Exists(path.to_path_buf())),
            _ => Ok(()),
        }
    }
}

impl Staged {
    fn rename(self, force: bool) -> Result<Renamed> {
        let Self { target, folder, file, existed, known: _known } = self;
        // A second name for the old content, where the file system has such; without it there is no way back.
        let old = if existed { link(&folder, &target).ok() } else { None };
        point().map_err(Error::io("write", &target))?;
        let persisted = if force { file.persist(&target) } else { file.persist_noclobber(&target) };
        match persisted {
            Ok(_) => Ok(Renamed { target, old, existed }),
            Err(e) if e.error.kind() == std::io::ErrorKind::AlreadyExists => Err(Error::Exists(target)),
            Err(e) => Err(Error::io("write", target)(e.error)),
        }
    }
}

impl Renamed {
    /// As far as it goes: the error that led here is the one to report.
    fn undo(self) {
        if let Some(old) = self.old {
            let _ = old.persist(&self.target);
        } else if !self.existed {
            let _ = std::fs::remove_file(&self.target);
        }
    }
}

/// Names of files that are not there yet.
fn hidden() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".wildpoint-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // What any new file gets; the umask takes its part off.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}

fn link(folder: &Path, target: &Path) -> std::io::Result<NamedTempFile<()>> {
    point()?;
    hidden().make_in(folder, |name| std::fs::hard_link(target, name))
}

fn sync(folder: &Path) -> Result<()> {
    use std::io::ErrorKind as Kind;
    let synced = point().and_then(|()| if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) });
    match synced {
        // Some network file systems cannot do this to a folder.
        Err(e) if !matches!(e.kind(), Kind::InvalidInput | Kind::Unsupported) => Err(Error::io("write to", folder)(e)),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

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
