//! Several kinds of records in one text, and times made of parts.

use super::super::calendar::{DAY, Date, SECOND};
use super::Want;
use crate::error::{Error, Result};

/// The kinds of records of a text, each a table, in the order in which they first appear.
#[derive(Debug, Default)]
pub(crate) struct Kinds {
    names: Vec<String>,
    rows: Vec<usize>,
}

impl Kinds {
    /// Counts a record of the kind `name`.
    pub(crate) fn count(&mut self, name: &str) {
        match self.names.iter().position(|n| n == name) {
            Some(at) => self.rows[at] += 1,
            None => {
                self.names.push(name.to_owned());
                self.rows.push(1);
            }
        }
    }

    /// The name of the wanted kind; else of the first of `preferred` that is there, or of that with the most records. What
    /// there is goes to `said`.
    ///
    /// # Errors
    /// [`Error::Usage`] for a table that is not there.
    pub(crate) fn chosen(&self, want: Want, preferred: &[&str], said: &mut Vec<String>) -> Result<Option<&str>> {
        let most = (0..self.names.len()).max_by_key(|at| (self.rows[*at], usize::MAX - at));
        let first = preferred.iter().find_map(|p| self.names.iter().position(|n| n == p));
        let chosen = match want.table {
            None => first.or(most),
            Some(table) => {
                let found = table.checked_sub(1).filter(|at| *at < self.names.len());
                Some(found.ok_or_else(|| {
                    let what = format!("there is no table {table}: the records are of {} kinds", self.names.len());
                    Error::usage(what, format!("tables count from 1: {}", self.listed()))
                })?)
            }
        };
        if let (Some(chosen), true) = (chosen, self.names.len() > 1 && want.table.is_none()) {
            said.push(format!(
                "records of {} kinds: {}; table {} is read (--table reads another)",
                self.names.len(),
                self.listed(),
                chosen + 1
            ));
        }
        Ok(chosen.map(|at| self.names[at].as_str()))
    }

    fn listed(&self) -> String {
        const SHOWN: usize = 40;
        let one = |(i, name): (usize, &String)| format!("{} {name} ({} rows)", i + 1, self.rows[i]);
        let mut list = self.names.iter().enumerate().take(SHOWN).map(one).collect::<Vec<_>>().join(", ");
        if self.names.len() > SHOWN {
            list.push_str(", …");
        }
        list
    }
}

/// A short label for each list of words: what not all of them have; the whole list where that tells too little.
pub(crate) fn labels(lists: &[Vec<String>]) -> Vec<String> {
    let common = |word: &String| lists.iter().all(|list| list.contains(word));
    let label = |list: &Vec<String>, all: bool| {
        let mut words: Vec<&str> = Vec::new();
        for word in list.iter().filter(|word| all || !common(word)) {
            if !words.contains(&word.as_str()) {
                words.push(word);
            }
        }
        words.join("/")
    };
    let short: Vec<String> = lists.iter().map(|list| label(list, false)).collect();
    let distinct =
        |labels: &[String]| labels.iter().enumerate().all(|(i, l)| !l.is_empty() && !labels[..i].contains(l));
    if distinct(&short) {
        return short;
    }
    let full: Vec<String> = lists.iter().map(|list| label(list, true)).collect();
    if distinct(&full) { full } else { lists.iter().map(|list| list.join("/")).collect() }
}

/// The moment `days` after 1970 and `of_day` nanoseconds after midnight (perhaps more than a day), in ISO order, with as
/// many decimals as are needed.
pub(crate) fn stamp(days: i64, of_day: i64) -> String {
    let date = Date::of_days(days + of_day.div_euclid(DAY));
    let rest = of_day.rem_euclid(DAY);
    let (seconds, fraction) = (rest / SECOND, rest % SECOND);
    let mut text = format!(
        "{:04}-{:02}-{:02}T{:02}:{:02}:{:02}",
        date.year,
        date.month,
        date.day,
        seconds / 3600,
        seconds / 60 % 60,
        seconds % 60
    );
    if fraction > 0 {
        text.push_str(format!(".{fraction:09}").trim_end_matches('0'));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stamp_goes_on_past_midnight() {
        assert_eq!(stamp(0, 0), "1970-01-01T00:00:00");
        assert_eq!(stamp(18_690, DAY + 3_661_250_000_000), "2021-03-05T01:01:01.25");
    }

    #[test]
    fn labels_leave_out_what_all_share() {
        let lists = |lists: &[&[&str]]| -> Vec<Vec<String>> {
            lists.iter().map(|l| l.iter().map(|w| (*w).to_owned()).collect()).collect()
        };
        assert_eq!(labels(&lists(&[&["DSS-25", "SAT", "DSS-25"], &["DSS-63", "SAT", "DSS-63"]])), ["DSS-25", "DSS-63"]);
        assert_eq!(labels(&lists(&[&["A", "B"], &["A", "B", "C"]])), ["A/B", "A/B/C"]);
    }

    #[test]
    fn the_longest_table_is_read_unless_another_is_wanted() {
        let mut kinds = Kinds::default();
        ["IMU", "GPS", "GPS"].into_iter().for_each(|k| kinds.count(k));
        let mut said = Vec::new();
        assert_eq!(kinds.chosen(Want::default(), &[], &mut said).unwrap(), Some("GPS"));
        assert_eq!(
            said,
            ["records of 2 kinds: 1 IMU (1 rows), 2 GPS (2 rows); table 2 is read (--table reads another)"]
        );
        assert_eq!(kinds.chosen(Want { table: Some(1) }, &[], &mut said).unwrap(), Some("IMU"));
        let e = kinds.chosen(Want { table: Some(3) }, &[], &mut said).unwrap_err().to_string();
        assert!(e.contains("no table 3"), "{e}");
    }
}
