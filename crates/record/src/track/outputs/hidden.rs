//! Files under names of their own until they get their real ones. Their locks say that somebody is at work: what no
//! process holds is left over.

use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;

use tempfile::NamedTempFile;

use super::faults::point;

/// How every such name begins.
pub(super) const PREFIX: &str = ".wildpoint-";
/// How the name of a file ends that is being written.
pub(super) const DRAFT: &str = ".tmp";

/// A new file in `folder` that this process holds.
pub(super) fn create(folder: &Path) -> io::Result<NamedTempFile> {
    loop {
        point()?;
        let file = builder().tempfile_in(folder)?;
        match file.as_file().try_lock() {
            // Another process looks just now whether it is left over.
            Err(TryLockError::WouldBlock) => {}
            // And may have taken it away before the lock.
            Ok(()) if !file.path().exists() => {}
            // Where locks do not work, nobody takes anything away.
            Ok(()) | Err(TryLockError::Error(_)) => return Ok(file),
        }
    }
}

/// The file at `path`, held by this process, if no other holds it.
pub(super) fn take(path: &Path) -> Option<File> {
    // A pipe would wait for its other end.
    let file = path.symlink_metadata().ok().filter(|m| m.is_file()).and_then(|_| File::open(path).ok())?;
    file.try_lock().ok().map(|()| file)
}

fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(DRAFT);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // What any new file gets; the umask takes its part off.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}
