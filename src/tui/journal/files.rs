//! Where journals lie, and how they are made and held.

use std::fs::{File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

use crate::error::{Error, Result};

/// How the name of every journal ends.
pub(super) const ENDING: &str = "journal";

/// How the name of a journal ends until it is whole.
pub(super) const DRAFT: &str = "draft";

/// The folder of journals in the user's state folder (XDG Base Directory Specification: `$XDG_STATE_HOME`, or
/// `~/.local/state`); none where there is no home either.
#[must_use]
pub fn folder() -> Option<PathBuf> {
    let named = std::env::var_os("XDG_STATE_HOME").map(PathBuf::from).filter(|p| p.is_absolute());
    let state = named.or_else(|| std::env::home_dir().map(|home| home.join(".local/state")))?;
    Some(state.join("wildpoint/journal"))
}

/// Makes the folder; nobody else may look into it, since notes are the analyst's.
pub(super) fn make(folder: &Path) -> Result<()> {
    let mut builder = std::fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder).map_err(Error::io("make", folder))?;
    #[cfg(unix)]
    keep_others_out(folder).map_err(Error::io("close to others", folder))?;
    Ok(())
}

/// Takes from everybody else what a folder that was there before allows them.
#[cfg(unix)]
fn keep_others_out(folder: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt as _;
    let mut permissions = std::fs::metadata(folder)?.permissions();
    if permissions.mode() & 0o077 == 0 {
        return Ok(());
    }
    permissions.set_mode(0o700);
    std::fs::set_permissions(folder, permissions)
}

/// How the names of all journals begin that are about the record with this SHA-256.
pub(super) fn beginning(record: &str) -> String {
    format!("{}-", record.chars().take(16).collect::<String>())
}

/// The name of a journal of this process about the record with this SHA-256, on the session with that one.
pub(super) fn name(folder: &Path, record: &str, session: &str) -> PathBuf {
    let short = |sum: &str, n: usize| sum.chars().take(n).collect::<String>();
    let session = if session.is_empty() { "record".to_owned() } else { short(session, 8) };
    let stem = format!("{}{session}-{}", beginning(record), std::process::id());
    // An earlier process with the same number may have left one.
    let numbered =
        |n: u32| folder.join(if n == 0 { format!("{stem}.{ENDING}") } else { format!("{stem}.{n}.{ENDING}") });
    (0..u32::MAX).map(numbered).find(|path| !path.exists()).unwrap_or_else(|| numbered(u32::MAX))
}

/// A new file that this process holds. It has another name until it is whole. What stands under that name, a draft
/// that was left or a link to somewhere else, is removed and not written to.
pub(super) fn create(path: &Path) -> std::io::Result<(File, PathBuf)> {
    let draft = path.with_extension(DRAFT);
    let _ = std::fs::remove_file(&draft);
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let file = options.open(&draft)?;
    // Where locks do not work, the number of the process in the name says whose it is.
    let _ = file.try_lock();
    Ok((file, draft))
}

/// A journal that no running process holds, now held by this one.
pub(super) fn take(path: &Path) -> Option<File> {
    let file = File::open(path).ok()?;
    match file.try_lock() {
        Ok(()) => Some(file),
        Err(TryLockError::WouldBlock) => None,
        Err(TryLockError::Error(_)) => (!runs(path)).then_some(file),
    }
}

/// Whether the process in the name of a journal still runs, as far as `/proc` tells.
fn runs(path: &Path) -> bool {
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let process = name.split('.').next().and_then(|stem| stem.rsplit('-').next()).map(str::to_owned);
    process.is_some_and(|number| Path::new("/proc").join(number).exists())
}

/// Brings the names in a folder to the disk, where the system can.
pub(super) fn sync(folder: &Path) -> std::io::Result<()> {
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_journal_has_one_holder() {
        let folder = tempfile::tempdir().unwrap();
        let path = name(folder.path(), &"a".repeat(64), "");
        let (held, draft) = create(&path).unwrap();
        std::fs::rename(&draft, &path).unwrap();
        assert!(take(&path).is_none(), "it is being written");
        assert_ne!(name(folder.path(), &"a".repeat(64), ""), path);
        drop(held);
        let taken = take(&path);
        assert!(taken.is_some() && take(&path).is_none());
    }

    #[test]
    fn the_name_says_whose_it_is() {
        let path = name(Path::new("/nowhere"), &"0123456789abcdef".repeat(4), &"f".repeat(64));
        let expected = format!("/nowhere/0123456789abcdef-ffffffff-{}.journal", std::process::id());
        assert_eq!(path, Path::new(&expected));
        assert!(!cfg!(target_os = "linux") || runs(&path));
        assert!(!runs(Path::new("/nowhere/0123456789abcdef-record-4000000000.3.journal")));
    }
}
