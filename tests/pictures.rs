//! The pictures of the book: what the workbench shows in a pseudo terminal, as SVG. They are checked against the program;
//! `WILDPOINT_UPDATE=1 cargo test --test pictures` makes them again.

#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

#[path = "pictures/cells.rs"]
mod cells;
#[expect(dead_code, reason = "it is shared by test programs")]
mod program;
#[path = "pictures/svg.rs"]
mod svg;
#[expect(dead_code, reason = "it is shared by test programs")]
mod terminal;

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use program::Folder;
use svg::{Frame, Picture};
use terminal::Terminal;

/// A step of a scene: keys, what they do, and for how long the moving picture shows the result.
struct Step {
    keys: &'static str,
    shown: &'static str,
    words: &'static str,
    seconds: f64,
}

const fn step(keys: &'static str, shown: &'static str, words: &'static str, seconds: f64) -> Step {
    Step { keys, shown, words, seconds }
}

/// A picture: its file, the size of the window, and what is typed. A picture of several steps moves.
struct Scene {
    name: &'static str,
    size: (u16, u16),
    steps: &'static [Step],
}

const SMALL: (u16, u16) = (80, 24);

const SCENES: &[Scene] = &[
    Scene {
        name: "tour",
        size: (100, 30),
        steps: &[
            step("", "wildpoint demo.csv", "open a record", 2.5),
            step("n", "n", "go to the next flag", 1.5),
            step("z", "z", "zoom to it", 2.5),
            step("a", "a", "accept it: an outlier", 2.0),
            step("z", "z", "zoom to the next flag", 2.0),
            step("r", "r", "reject it: a good sample", 2.0),
            step("0", "0", "show the whole record", 1.5),
            step("....", ". . . .", "raise the threshold", 2.0),
            step("C", "C", "run all methods", 3.0),
            step(":w demo.toml\r", ":w demo.toml", "save the session", 3.0),
        ],
    },
    Scene { name: "tutorial-start", size: SMALL, steps: &[step("", "", "", 0.0)] },
    Scene { name: "tutorial-flag", size: SMALL, steps: &[step("nz", "", "", 0.0)] },
    Scene { name: "tutorial-threshold", size: SMALL, steps: &[step("....", "", "", 0.0)] },
    Scene { name: "tutorial-consensus", size: SMALL, steps: &[step("nC", "", "", 0.0)] },
    Scene { name: "tutorial-export", size: SMALL, steps: &[step("\x05", "", "", 0.0)] },
];

fn path(scene: &Scene) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/pictures").join(scene.name).with_extension("svg")
}

/// Waits until nothing has come for half a second: while pictures are made, not while they are checked.
fn stands_still(terminal: &Terminal) {
    let (mut before, mut since) = (terminal.bytes(), Instant::now());
    while since.elapsed() < Duration::from_millis(500) {
        std::thread::sleep(Duration::from_millis(20));
        if terminal.bytes() != before {
            (before, since) = (terminal.bytes(), Instant::now());
        }
    }
}

/// Plays a scene. Where a picture is there to compare with, each of its frames is waited for; otherwise each step ends
/// when the screen stands still.
fn played(scene: &Scene, stored: Option<&Picture>) -> Picture {
    let folder = Folder::with_demo();
    let mut terminal = Terminal::start(&folder.path(""), "demo.csv", scene.size, &[]);
    terminal.settle();
    let mut frames = Vec::new();
    for (at, step) in scene.steps.iter().enumerate() {
        // Keys by themselves, as a person types them.
        for key in step.keys.chars() {
            terminal.keys(&key.to_string());
            if stored.is_none() {
                stands_still(&terminal);
            }
        }
        match stored.map(|picture| &picture.frames[at].rows) {
            Some(rows) => {
                let what = format!("frame {at} of {} (WILDPOINT_UPDATE=1 makes it again)", path(scene).display());
                terminal.wait_until(&what, |screen| cells::rows(screen) == *rows);
            }
            None => stands_still(&terminal),
        }
        let rows = terminal.look(cells::rows);
        frames.push(Frame { rows, keys: step.shown.into(), words: step.words.into(), seconds: step.seconds });
    }
    Picture { columns: scene.size.0, frames }
}

#[test]
fn the_pictures_are_those_of_the_program() {
    for scene in SCENES {
        if std::env::var_os("WILDPOINT_UPDATE").is_some() {
            std::fs::write(path(scene), played(scene, None).text()).unwrap();
        }
        let stored = std::fs::read_to_string(path(scene)).unwrap();
        let picture = Picture::of_text(&stored);
        assert_eq!(picture.frames.len(), scene.steps.len(), "{}: frames", scene.name);
        assert!(
            played(scene, Some(&picture)).text() == stored,
            "{} is stale: WILDPOINT_UPDATE=1 makes it again",
            scene.name
        );
    }
}
