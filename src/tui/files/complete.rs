//! A path completed as shells do.

use std::path::{MAIN_SEPARATOR, Path};

/// Names that are looked at in one folder.
const MOST: usize = 10_000;

/// `typed` as far as the names in its folder make clear; a lone folder with a separator at its end.
pub(super) fn path(typed: &str) -> String {
    let (folder, start) = typed
        .rsplit_once(std::path::is_separator)
        .map_or(("", typed), |(_, start)| (&typed[..typed.len() - start.len()], start));
    let place = if folder.is_empty() { Path::new(".") } else { Path::new(folder) };
    let Ok(entries) = std::fs::read_dir(place) else { return typed.to_owned() };
    // A name that is not text could not be typed to its end.
    let names = entries.flatten().take(MOST).filter_map(|e| e.file_name().into_string().ok());
    let mut fitting: Vec<String> =
        names.filter(|n| n.starts_with(start) && (start.starts_with('.') || !n.starts_with('.'))).collect();
    fitting.sort();
    let Some(first) = fitting.first() else { return typed.to_owned() };
    let common = fitting
        .iter()
        .skip(1)
        .fold(first.clone(), |a, b| a.chars().zip(b.chars()).take_while(|(x, y)| x == y).map(|(x, _)| x).collect());
    let whole = format!("{folder}{common}");
    let lone = fitting.len() == 1 && Path::new(&whole).is_dir();
    if lone { format!("{whole}{MAIN_SEPARATOR}") } else { whole }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_goes_on_as_far_as_it_is_clear() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["run1.csv", "run2.csv", ".hidden", "notes.txt"] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        std::fs::create_dir(folder.path().join("later")).unwrap();
        let base = format!("{}/", folder.path().display());
        let completed = |typed: &str| path(&format!("{base}{typed}")).replace(&base, "");
        assert_eq!(completed("r"), "run");
        assert_eq!(completed("run2"), "run2.csv");
        assert_eq!(completed("l"), "later/");
        assert_eq!(completed("x"), "x");
        assert_eq!(completed(".h"), ".hidden");
        assert_eq!(path("/no/such/folder/x"), "/no/such/folder/x");
    }
}
