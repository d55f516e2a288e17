//! The module that goes into the rewritten program: which mutant is in force.

/// Environment variable with the number of the mutant that is in force (none: the program as it is).
pub const MUTANT: &str = "WILDPOINT_MUTANT";
/// Environment variable with the file to which the units that are entered are appended, a number a line.
pub const REACHED: &str = "WILDPOINT_REACHED";

/// The text of the module, for a program of `units` units.
#[must_use]
pub fn module(units: usize) -> String {
    TEXT.replace("UNITS", &units.to_string())
}

const TEXT: &str = r#"//! Which mutant is in force.
use std::io::Write;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

const UNREAD: u32 = u32::MAX;
const RECORDING: u32 = u32::MAX - 1;
static IN_FORCE: AtomicU32 = AtomicU32::new(UNREAD);
static SEEN: [AtomicBool; UNITS] = [const { AtomicBool::new(false) }; UNITS];

/// The mutant in force, 0 for none, asked in this unit.
#[inline(always)]
pub fn at(unit: usize) -> u32 {
    match IN_FORCE.load(Ordering::Relaxed) {
        UNREAD | RECORDING => first(unit),
        number => number,
    }
}

#[cold]
#[inline(never)]
fn first(unit: usize) -> u32 {
    if IN_FORCE.load(Ordering::Relaxed) == UNREAD {
        let number = std::env::var("WILDPOINT_MUTANT").ok().and_then(|n| n.parse().ok());
        let recording = std::env::var_os("WILDPOINT_REACHED").is_some();
        IN_FORCE.store(if recording { RECORDING } else { number.unwrap_or(0) }, Ordering::Relaxed);
        return at(unit);
    }
    if !SEEN[unit].swap(true, Ordering::Relaxed) {
        let path = std::env::var_os("WILDPOINT_REACHED").unwrap_or_default();
        let file = std::fs::OpenOptions::new().create(true).append(true).open(path);
        file.and_then(|mut file| file.write_all(format!("{unit}\n").as_bytes())).unwrap();
    }
    0
}
"#;
