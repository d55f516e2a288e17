//! The command line that the workbench prints gives the same bytes without it.

use super::{COMPACT, Folder, Terminal};

/// A name that a shell takes apart unless it is quoted.
const RECORD: &str = "it's$HOME.csv";

fn folder() -> Folder {
    let demo = String::from_utf8_lossy(include_bytes!("../../data/demo.csv")).replacen("vx_mps", "v'x $y", 1);
    Folder::with(&[(RECORD, demo.as_bytes())])
}

/// The texts that were put on the clipboard: RFC 4648 backwards, as any terminal would do it.
fn copied(raw: &[u8]) -> Vec<String> {
    const DIGITS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let decoded = |code: &str| {
        let mut bits: Vec<bool> = Vec::new();
        for digit in code.chars().filter(|c| *c != '=') {
            let value = DIGITS.find(digit).unwrap();
            bits.extend((0..6).rev().map(|bit| value >> bit & 1 == 1));
        }
        let bytes = bits.chunks_exact(8).map(|byte| byte.iter().fold(0u8, |all, bit| all << 1 | u8::from(*bit)));
        String::from_utf8(bytes.collect()).unwrap()
    };
    let text = String::from_utf8_lossy(raw).into_owned();
    text.split("\x1b]52;c;").skip(1).map(|rest| decoded(rest.split('\x07').next().unwrap())).collect()
}

/// Runs a line in a shell that finds the program by its name.
fn run(folder: &Folder, line: &str) {
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_wildpoint")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", line]).current_dir(folder.path("")).env("PATH", path);
    let output = shell.output().unwrap();
    assert!(output.status.success(), "{line}\n{}", String::from_utf8_lossy(&output.stderr));
}

#[test]
fn without_decisions_one_clean_gives_the_same_bytes() {
    let folder = folder();
    let mut terminal = Terminal::start(&folder.path(""), RECORD, COMPACT, &[]);
    terminal.settle();
    for (keys, shown) in [
        (":method hampel\r", "hampel: Hampel"),
        (":set window 31\r", "window 31"),
        (":set max_fill=5\r", "max_fill 5"),
        (":repair linear\r", "repair linear"),
    ] {
        terminal.keys(keys);
        terminal.wait_for(shown);
    }
    terminal.settle();
    terminal.keys(":export exported.csv\r");
    terminal.wait_for("wrote exported.csv");
    terminal.keys(":command-line again.csv\r");
    terminal.wait_for("equivalent command");
    terminal.keys("\x1b");
    terminal.keys(":q!\r");
    let lines = copied(&terminal.end().1);
    let [line] = lines.as_slice() else { panic!("{lines:?}") };
    let wanted = "wildpoint clean 'it'\\''s$HOME.csv' --time t_s --channel 'v'\\''x $y' --method hampel \
                  --set window=31 --repair linear --set max_fill=5 -o again.csv";
    assert_eq!(line, wanted);
    run(&folder, line);
    assert!(folder.text("again.csv") == folder.text("exported.csv"));
    let input = folder.text(RECORD);
    assert!(folder.text("again.csv") != input, "something was repaired");
}

#[test]
fn with_decisions_the_saved_session_is_replayed() {
    let folder = folder();
    let mut terminal = Terminal::start(&folder.path(""), RECORD, COMPACT, &[]);
    terminal.settle();
    terminal.keys("nar");
    terminal.wait_for("rejected row 200");
    terminal.settle();
    terminal.keys("Y");
    terminal.wait_for("are in a session only");
    terminal.keys(":w s.toml\r");
    terminal.wait_for("saved s.toml");
    terminal.keys(":export exported.csv\r");
    terminal.wait_for("wrote exported.csv");
    terminal.keys(":command-line again.csv\r");
    terminal.wait_for("equivalent command");
    terminal.keys("\x1b");
    terminal.keys("q");
    let lines = copied(&terminal.end().1);
    assert_eq!(lines, ["wildpoint replay s.toml -o again.csv"]);
    run(&folder, &lines[0]);
    assert!(folder.text("again.csv") == folder.text("exported.csv"));
}
