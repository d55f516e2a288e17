//! Running tests of a program with limits.

use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use crate::compile::Program;
use crate::switch::{MUTANT, REACHED};
use crate::tree::{Tree, fault};

/// What the program is run with.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Switch<'a> {
    /// No mutant; the units that are entered are written to this file.
    Record(&'a Path),
    /// This mutant, by its place in the list.
    Mutant(usize),
}

/// How a run ended.
#[derive(Clone, PartialEq, Debug)]
pub enum End {
    /// Every test passed.
    Passed,
    /// A test failed, this one, or the program broke down.
    Failed(String),
    /// It took too long.
    TooLong,
}

/// Memory that a run may ask for, KiB: a mutant that fills a list for ever must not fill the machine.
const MEMORY: usize = 6 << 20;
/// Signals of a processor time that is used up (SIGXCPU, SIGKILL).
const USED_UP: [i32; 2] = [24, 9];

/// Runs `tests` of `program`, by their whole names, one after the other, for at most `seconds` of processor time (and
/// ten times that on the clock), with temporary files in `scratch`.
///
/// # Errors
/// Words that say what could not be run or written.
pub fn run(
    tree: &Tree,
    program: &Program,
    tests: &[&str],
    switch: Switch<'_>,
    seconds: u64,
    scratch: &Path,
) -> Result<End, String> {
    fs::create_dir_all(scratch).map_err(fault(scratch))?;
    let said = scratch.join("said");
    let output = File::create(&said).map_err(fault(&said))?;
    let mut command = Command::new("sh");
    command
        .args(["-c", &format!("ulimit -t {seconds}; ulimit -v {MEMORY}; ulimit -c 0; exec nice -n 10 \"$0\" \"$@\"")])
        .arg(&program.path)
        .args(["--exact", "--test-threads=1"])
        .args(tests)
        .current_dir(&tree.copy)
        .env("TMPDIR", scratch)
        .env("HOME", scratch)
        .env("INSTA_UPDATE", "no")
        .env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "1")
        .stdin(Stdio::null())
        .stdout(output)
        .stderr(Stdio::null());
    match switch {
        Switch::Record(file) => _ = command.env(REACHED, file),
        Switch::Mutant(index) => _ = command.env(MUTANT, (index + 1).to_string()),
    }
    let status = wait(command, Duration::from_secs(10 * seconds))?;
    let end = match status {
        None => End::TooLong,
        Some(status) if status.success() => End::Passed,
        Some(status) if status.signal().is_some_and(|s| USED_UP.contains(&s)) => End::TooLong,
        Some(status) => End::Failed(failed(&fs::read_to_string(&said).unwrap_or_default(), status)),
    };
    fs::remove_dir_all(scratch).map_err(fault(scratch))?;
    Ok(end)
}

/// The exit status, none when it had to be ended after `limit`.
fn wait(mut command: Command, limit: Duration) -> Result<Option<ExitStatus>, String> {
    let begin = Instant::now();
    let mut child = command.spawn().map_err(|e| format!("a test program cannot be run: {e}"))?;
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait().map_err(|e| format!("a test program is lost: {e}"))? {
            return Ok(Some(status));
        }
        if begin.elapsed() > limit {
            child.kill().and_then(|()| child.wait()).map_err(|e| format!("a test program cannot be ended: {e}"))?;
            return Ok(None);
        }
        std::thread::sleep(pause);
        pause = (pause * 2).min(Duration::from_millis(16));
    }
}

/// The first test that failed by what the program said; that it broke down when it came to no failure.
fn failed(said: &str, status: ExitStatus) -> String {
    let test = said.lines().find_map(|line| line.strip_prefix("test ")?.strip_suffix(" ... FAILED"));
    test.map_or_else(|| format!("broke down ({status})"), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shell(line: &str) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", line]).stdin(Stdio::null());
        command
    }

    #[test]
    fn a_program_that_does_not_end_is_ended() {
        assert_eq!(wait(shell("exec sleep 1000"), Duration::ZERO).unwrap(), None);
        assert!(wait(shell("exit 3"), Duration::from_secs(60)).unwrap().is_some_and(|s| s.code() == Some(3)));
    }

    #[test]
    fn the_failed_test_is_named() {
        let status = ExitStatus::from_raw(101 << 8);
        assert_eq!(failed("running 2 tests\ntest a::b ... ok\ntest a::c ... FAILED\n", status), "a::c");
        assert!(failed("running 2 tests\n", status).contains("101"));
    }
}
