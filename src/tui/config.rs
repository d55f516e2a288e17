//! The user's configuration: keys, theme and screen, from a TOML file. What it leaves out stays as the program has
//! it; what is not understood is an error that names file, line and way out.

use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::Keys;
use super::theme::Paints;
use crate::error::{Error, Result, nearest};

mod keys;
mod listing;
mod screen;
mod theme;

pub use listing::listing;
pub use screen::{SETTINGS, Screen, Setting};

/// A configuration larger than this is none.
const LARGEST: u64 = 1 << 20;

/// What the user wants different.
#[derive(Debug, Clone, Default)]
pub struct Config {
    /// The key map.
    pub keys: Keys,
    /// Colours.
    pub paints: Paints,
    /// Everything else about the screen.
    pub screen: Screen,
    /// The name of the analyst in reports.
    pub analyst: Option<String>,
}

/// Something that is not understood.
#[derive(Debug)]
struct Fault {
    /// Where in the text.
    at: usize,
    what: String,
    help: String,
}

impl Fault {
    fn new(span: &Range<usize>, what: impl Into<String>, help: impl Into<String>) -> Self {
        Self { at: span.start, what: what.into(), help: help.into() }
    }
}

/// An entry of a table: its key, and its value with the place of the key.
type Entry<'a> = (&'a str, &'a Spanned<DeValue<'a>>, Range<usize>);

/// The entries of a table.
fn entries<'a>(table: &'a DeTable<'_>) -> impl Iterator<Item = Entry<'a>> {
    table.iter().map(|(key, value)| (key.get_ref().as_ref(), value, key.span()))
}

/// Where the configuration is looked for: `$XDG_CONFIG_HOME/wildpoint/config.toml`, else in `~/.config`. None where
/// there is no home.
#[must_use]
pub fn default_path() -> Option<PathBuf> {
    let named = std::env::var_os("XDG_CONFIG_HOME").map(PathBuf::from).filter(|p| p.is_absolute());
    let folder = named.or_else(|| std::env::home_dir().map(|home| home.join(".config")))?;
    Some(folder.join("wildpoint/config.toml"))
}

impl Config {
    /// The configuration at `named` or, where none is named, at [`default_path`], if a file is there.
    ///
    /// # Errors
    /// [`Error::Input`] with the line of what is not understood; [`Error::Io`].
    pub fn find(named: Option<&Path>) -> Result<Self> {
        match (named, default_path()) {
            (Some(path), _) => Self::read(path),
            (None, Some(path)) if path.is_file() => Self::read(&path),
            (None, _) => Ok(Self::default()),
        }
    }

    /// Reads a configuration.
    ///
    /// # Errors
    /// As [`Config::find`].
    pub fn read(path: &Path) -> Result<Self> {
        let size = std::fs::metadata(path).map_err(Error::io("read", path))?.len();
        if size > LARGEST {
            return Err(Error::input(path, "not a configuration: larger than 1 MiB", "name another --config"));
        }
        let text = std::fs::read_to_string(path).map_err(Error::io("read", path))?;
        Self::of_text(&text, path)
    }

    /// The configuration of this text; `path` is named in errors.
    ///
    /// # Errors
    /// [`Error::Input`] with the line of the first thing that is not understood.
    pub fn of_text(text: &str, path: &Path) -> Result<Self> {
        let document = DeTable::parse(text).map_err(|e| {
            let at = e.span().map_or(0, |span| span.start);
            let fault = Fault { at, what: e.message().replace('\n', "; "), help: "not valid TOML".into() };
            told(path, text, vec![fault])
        })?;
        let mut config = Self::default();
        let mut faults = Vec::new();
        for (name, value, span) in entries(document.get_ref()) {
            let DeValue::Table(table) = value.get_ref() else {
                match (name, value.get_ref().as_str()) {
                    (ANALYST, Some(text)) => config.analyst = Some(text.to_owned()),
                    (ANALYST, None) => faults.push(wrong(value, name, "a name, as in \"M. Ito\"")),
                    _ => faults.push(unknown(&span, name, "table", &TABLES)),
                }
                continue;
            };
            match name {
                "keys" => config.keys = keys::read(table, &mut faults),
                "theme" => config.paints = theme::read(table, &mut faults),
                "screen" => config.screen = screen::read(table, &mut faults),
                _ => faults.push(unknown(&span, name, "table", &TABLES)),
            }
        }
        if faults.is_empty() { Ok(config) } else { Err(told(path, text, faults)) }
    }
}

/// The key of the analyst's name.
const ANALYST: &str = "analyst";

/// The tables of a configuration, and its key outside of them.
const TABLES: [&str; 4] = ["keys", "theme", "screen", ANALYST];

/// The fault of a name that is none of `names`.
fn unknown(span: &Range<usize>, name: &str, kind: &str, names: &[&str]) -> Fault {
    let hint = nearest(name, names.iter().copied()).map_or(String::new(), |n| format!("did you mean {n}? "));
    Fault::new(span, format!("{name}: there is no such {kind}"), format!("{hint}there are: {}", names.join(", ")))
}

/// The fault of a value of the wrong kind.
fn wrong(value: &Spanned<DeValue<'_>>, name: &str, wanted: &str) -> Fault {
    let is = value.get_ref().type_str();
    Fault::new(&value.span(), format!("{name}: this is of type {is}"), format!("{name} takes {wanted}"))
}

/// The error for the first of several faults.
fn told(path: &Path, text: &str, mut faults: Vec<Fault>) -> Error {
    faults.sort_by_key(|f| f.at);
    let others = faults.len().saturating_sub(1);
    let more = if others > 0 { format!(" (and {others} more)") } else { String::new() };
    let first = faults.into_iter().next();
    let (at, what, help) = first.map_or((0, String::new(), String::new()), |f| (f.at, f.what, f.help));
    let line = 1 + text.bytes().take(at).filter(|b| *b == b'\n').count();
    Error::Input {
        path: path.to_path_buf(),
        line: u64::try_from(line).ok(),
        what: crate::track::printable(&what) + &more,
        help: format!("{help}; --no-config starts without it"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Config> {
        Config::of_text(text, Path::new("config.toml"))
    }

    #[test]
    fn nothing_changes_nothing() {
        let config = read("").unwrap();
        assert_eq!(listing(&config.keys), listing(&Keys::default()));
        assert_eq!((config.paints, config.screen), (Paints::default(), Screen::default()));
    }

    #[test]
    fn what_is_not_understood_is_told_with_its_line_and_the_way_out() {
        for (text, line, what, help) in [
            ("x = 1", 1, "x: there is no such table", "there are: keys, theme, screen, analyst"),
            ("analyst = 5", 1, "of type integer", "a name"),
            ("\n[key]\n", 2, "key: there is no such table", "did you mean keys?"),
            ("[keys]\n\nnext-flg = \"n\"", 3, "next-flg: there is no such action", "did you mean next-flag?"),
            ("[keys]\nnext-flag = 5", 2, "of type integer", "a list of keys"),
            ("[keys]\nnext-flag = [\"n\", 5]", 2, "of type integer", "a list of keys"),
            ("[keys]\nnext-flag = \"ctrl-i\"", 2, "cannot be bound", "a terminal sends it as tab"),
            ("[keys]\nnext-flag = \"a\"", 2, "a means next-flag and accept", "[] takes its keys away"),
            ("[keys]\naccept = \"C\"", 2, "C can be pressed by a torn escape sequence", "accept changes"),
            ("[keys]\nquit = []", 2, "no key would quit", "give quit a key"),
            ("[keys]\nnext-flag = \"g\"", 2, "g starts other keys (g a)", "give one of them another key"),
            ("[keys]\nzoom-flag = \"K\"", 2, "zoom-flag has keys in view and queue", "[keys.view] or [keys.queue]"),
            ("[keys.revue]\n", 1, "revue: there is no such context", "did you mean review?"),
            ("[keys.queue]\naccept = \"K\"", 2, "accept: there is no such action in queue", "next-in-queue"),
            ("[theme]\nbase = \"darkk\"", 2, "darkk: there is no such base", "did you mean dark?"),
            ("[theme]\nraww = 5", 2, "raww: there is no such role", "did you mean raw?"),
            ("[theme]\nraw = 256", 2, "256: no such colour", "0 to 255"),
            ("[theme]\nraw = \"#12345\"", 2, "no such colour", "#rrggbb"),
            ("[screen]\nmouse = 1", 2, "mouse: this is of type integer", "true or false"),
            ("[screen]\nfps = 0", 2, "fps = 0: out of range", "1 to 120"),
            ("[screen]\nglyphs = \"uni\"", 2, "uni: there is no such glyph set", "unicode"),
            ("[screen]\nmouse = true\nmouse = true", 3, "duplicate key", "not valid TOML"),
        ] {
            let told = read(text).map(|_| ()).unwrap_err().to_string();
            let start = format!("config.toml:{line}: ");
            assert!(told.starts_with(&start) && told.contains(what) && told.contains(help), "{text:?}: {told}");
        }
    }

    #[test]
    fn the_analyst_has_a_name() {
        assert_eq!(read("analyst = \"M. Ito\"\n[screen]\nfps = 9").unwrap().analyst.as_deref(), Some("M. Ito"));
    }

    #[test]
    fn of_several_faults_the_first_in_the_file_is_told() {
        let told = read("[screen]\nfps = 0\n[keys]\nnope = \"n\"").map(|_| ()).unwrap_err().to_string();
        assert!(told.starts_with("config.toml:2: fps = 0") && told.contains("(and 1 more)"), "{told}");
    }

    #[test]
    fn keys_are_exchanged_and_taken_away() {
        let config =
            read("[keys]\nnext-flag = \"a\"\naccept = [\"n\", \"f5\"]\nundo = []\n[keys.queue]\nzoom-flag = 'K'");
        let listed = listing(&config.unwrap().keys);
        for line in ["next-flag = [\"a\"]", "accept = [\"n\", \"f5\"]", "undo = []", "zoom-flag = [\"z\"]"] {
            assert!(listed.lines().any(|l| l.starts_with(line)), "{line} is not in\n{listed}");
        }
        assert!(listed.contains("[\"K\"]"));
    }
}
