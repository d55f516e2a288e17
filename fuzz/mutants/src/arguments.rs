//! The command line.

/// What a run is asked for.
#[derive(Clone, PartialEq, Debug)]
pub struct Arguments {
    /// Threads that run tests.
    pub jobs: usize,
    /// Only files whose name this pattern matches (`*` stands for anything).
    pub only: Option<String>,
    /// Only say what is remembered.
    pub list: bool,
    /// Judge those again that survived.
    pub again: bool,
    /// Forget what is remembered.
    pub fresh: bool,
}

/// What can be said on the command line.
pub const USAGE: &str = "fuzz/mutants/run [--jobs N] [--only GLOB] [--list] [--again] [--fresh]
  --jobs N     threads that run tests (default 2)
  --only GLOB  only mutants of files that match, * for anything: 'src/method/window*'
  --list       survivors and figures as remembered in target/mutants/outcomes.tsv; nothing is built or run
  --again      judge those again that survived (after new tests); others are judged again when their function changes
  --fresh      forget what is remembered
Ends with 1 when a mutant survives that fuzz/SURVIVORS.md does not list, with 2 when it cannot run.";

impl Arguments {
    /// Reads the command line.
    ///
    /// # Errors
    /// Words that name what is not understood.
    pub fn read(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut read = Self { jobs: 2, only: None, list: false, again: false, fresh: false };
        while let Some(word) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{word} needs a value\n{USAGE}"));
            match word.as_str() {
                "--jobs" => {
                    let value = value()?;
                    let jobs = value.parse().ok().filter(|n| *n > 0);
                    read.jobs = jobs.ok_or_else(|| format!("--jobs: {value} is no number from 1\n{USAGE}"))?;
                }
                "--only" => read.only = Some(value()?),
                "--list" => read.list = true,
                "--again" => read.again = true,
                "--fresh" => read.fresh = true,
                _ => return Err(format!("{word} is not understood\n{USAGE}")),
            }
        }
        Ok(read)
    }

    /// Whether mutants of this file are asked for.
    #[must_use]
    pub fn wants(&self, file: &str) -> bool {
        self.only.as_deref().is_none_or(|glob| matches(glob, file))
    }
}

/// Whether `text` is `glob`, in which `*` stands for anything.
fn matches(glob: &str, text: &str) -> bool {
    match glob.split_once('*') {
        None => glob == text,
        Some((head, rest)) => text.strip_prefix(head).is_some_and(|tail| {
            tail.char_indices().map(|(at, _)| at).chain([tail.len()]).any(|at| matches(rest, &tail[at..]))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(line: &str) -> Result<Arguments, String> {
        Arguments::read(line.split_whitespace().map(str::to_owned))
    }

    #[test]
    fn what_is_said_is_read_and_nonsense_is_refused() {
        let said = read("--jobs 3 --only src/method/* --again").unwrap();
        assert_eq!((said.jobs, said.again, said.list), (3, true, false));
        assert!(said.wants("src/method/window/sorted.rs") && !said.wants("src/method.rs"));
        assert!(read("--jobs 0").unwrap_err().contains("no number from 1"));
        assert!(read("--only").unwrap_err().contains("needs a value"));
        assert!(read("--all").unwrap_err().contains("--all is not understood"));
    }

    #[test]
    fn a_star_stands_for_anything() {
        assert!(matches("src/*/sorted*", "src/method/window/sorted.rs"));
        assert!(!matches("src/*/sorted", "src/method/window/sorted.rs"));
    }
}
