//! The files that were opened or saved last, in the user's state folder.
//!
//! One path a line, the newest first. Bytes that could end a line, and `%`, are written as `%0A`.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::error::{Error, Result};
use crate::track::Outputs;

/// Files that are remembered.
const MOST: usize = 20;
/// A list longer than this is none.
const LARGEST: u64 = 1 << 20;

/// The remembered files, the newest first; none where there is no list. With a note where the list is no list.
pub(super) fn read(list: &Path) -> (Vec<PathBuf>, Option<String>) {
    let mut text = String::new();
    let Ok(file) = std::fs::File::open(list) else { return (Vec::new(), None) };
    let note = || Some(format!("{} is not a list of recent files: it is ignored", list.display()));
    match file.take(LARGEST + 1).read_to_string(&mut text) {
        Ok(n) if n as u64 <= LARGEST => {}
        _ => return (Vec::new(), note()),
    }
    let paths: Option<Vec<PathBuf>> = text.lines().take(MOST).map(decoded).collect();
    match paths {
        Some(paths) => (paths, None),
        None => (Vec::new(), note()),
    }
}

/// Puts a file at the top of the list.
///
/// # Errors
/// [`Error::Io`] when the list cannot be written.
pub(super) fn remember(list: &Path, path: &Path) -> Result<()> {
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let (mut paths, _) = read(list);
    paths.retain(|p| *p != whole);
    paths.insert(0, whole);
    paths.truncate(MOST);
    let text: String = paths.iter().map(|p| encoded(p) + "\n").collect();
    if let Some(folder) = list.parent() {
        std::fs::create_dir_all(folder).map_err(Error::io("make", folder))?;
    }
    keep_others_out(list).map_err(Error::io("close to others", list))?;
    let mut files = Outputs::new(true, &[]);
    files.stage(list, |w| w.write_all(text.as_bytes()).map_err(Error::io("write", list)))?;
    files.commit()
}

/// Sees to it that the list is there and that nobody else may read it: which records somebody works on is not for
/// everybody. Outputs have the mode of the file whose place they take.
#[cfg(unix)]
fn keep_others_out(list: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::{OpenOptionsExt as _, PermissionsExt as _};
    let file = std::fs::OpenOptions::new().write(true).create(true).truncate(false).mode(0o600).open(list)?;
    file.set_permissions(std::fs::Permissions::from_mode(0o600))
}

#[cfg(not(unix))]
fn keep_others_out(_: &Path) -> std::io::Result<()> {
    Ok(())
}

fn encoded(path: &Path) -> String {
    let mut out = String::new();
    for &b in path.as_os_str().as_encoded_bytes() {
        match b {
            b'%' | 0..=31 | 127.. => {
                let _ = write!(out, "%{b:02X}");
            }
            b => out.push(char::from(b)),
        }
    }
    out
}

/// The path of a line; none for a line that was not written here.
fn decoded(line: &str) -> Option<PathBuf> {
    let mut bytes = Vec::new();
    let mut rest = line.as_bytes();
    while let [first, after @ ..] = rest {
        rest = after;
        match first {
            b'%' => {
                let (digits, later) = after.split_at_checked(2)?;
                bytes.push(u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()?);
                rest = later;
            }
            32..127 => bytes.push(*first),
            _ => return None,
        }
    }
    let path = path_of(bytes)?;
    path.is_absolute().then_some(path)
}

#[cfg(unix)]
#[expect(clippy::unnecessary_wraps, reason = "elsewhere names are text")]
fn path_of(bytes: Vec<u8>) -> Option<PathBuf> {
    use std::os::unix::ffi::OsStringExt as _;
    Some(OsString::from_vec(bytes).into())
}

#[cfg(not(unix))]
fn path_of(bytes: Vec<u8>) -> Option<PathBuf> {
    Some(OsString::from(String::from_utf8(bytes).ok()?).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_comes_first_once_and_the_list_is_bounded() {
        let folder = tempfile::tempdir().unwrap();
        let list = folder.path().join("state/recent");
        for i in 0..30 {
            remember(&list, Path::new(&format!("/a/{i}.csv"))).unwrap();
        }
        remember(&list, Path::new("/a/25.csv")).unwrap();
        let (paths, note) = read(&list);
        assert_eq!((paths.len(), note), (MOST, None));
        assert_eq!(paths[..3], ["/a/25.csv", "/a/29.csv", "/a/28.csv"].map(PathBuf::from));
        assert_eq!(std::fs::read_dir(folder.path().join("state")).unwrap().count(), 1, "nothing else is left");
    }

    #[cfg(unix)]
    #[test]
    fn nobody_else_may_read_the_list_an_older_one_included() {
        use std::os::unix::fs::PermissionsExt as _;
        let folder = tempfile::tempdir().unwrap();
        let list = folder.path().join("recent");
        let mode = || std::fs::metadata(&list).unwrap().permissions().mode() & 0o777;
        remember(&list, Path::new("/a/1.csv")).unwrap();
        assert_eq!(mode(), 0o600);
        std::fs::set_permissions(&list, std::fs::Permissions::from_mode(0o644)).unwrap();
        remember(&list, Path::new("/a/2.csv")).unwrap();
        assert_eq!(mode(), 0o600);
    }

    #[cfg(unix)]
    #[test]
    fn any_name_comes_back() {
        use std::os::unix::ffi::OsStringExt as _;
        let folder = tempfile::tempdir().unwrap();
        let list = folder.path().join("recent");
        let names: [&[u8]; 4] = [b"/a b%41", b"/new\nline", b"/\xff\xfe.csv", "/高さ".as_bytes()];
        for name in names {
            let path = PathBuf::from(OsString::from_vec(name.to_vec()));
            remember(&list, &path).unwrap();
            assert_eq!(read(&list).0[0], path);
        }
        assert_eq!(read(&list).0.len(), 4);
    }

    #[test]
    fn what_is_no_list_is_left_aside_with_a_note() {
        let folder = tempfile::tempdir().unwrap();
        let list = folder.path().join("recent");
        assert_eq!(read(&list), (Vec::new(), None));
        for bytes in [&b"relative/path\n"[..], b"/a\x1b[2J\n", b"/a%4\n", b"\xff\xff", b"/a%zz\n"] {
            std::fs::write(&list, bytes).unwrap();
            let (paths, note) = read(&list);
            assert!(paths.is_empty() && note.is_some(), "{bytes:?}");
        }
        // The next file that is opened makes a list again.
        remember(&list, Path::new("/a.csv")).unwrap();
        assert_eq!(read(&list), (vec![PathBuf::from("/a.csv")], None));
    }
}
