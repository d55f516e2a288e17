//! A simulated record with everything that is known of it.

use std::fmt::Write as _;

/// Runs that are written to one file lie this many intervals apart, so that methods cut between them.
const BETWEEN_RUNS: f64 = 100.0;

/// A simulated record: its columns, and which samples are wild.
#[derive(Debug, Clone)]
pub struct Record {
    /// Times in seconds.
    pub time: Signal,
    /// The channels, the judged one first.
    pub signals: Vec<Signal>,
    /// For each sample, in which way it is wild; none for a good one.
    pub wild: Vec<Option<Wild>>,
    /// Name of the truth column.
    pub truth: &'static str,
}

/// The way in which a sample is wild.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wild {
    /// It was put in alone.
    Isolated,
    /// One of several neighbours with about the same error.
    Patch,
    /// One of several neighbours whose errors vary (\[001\]'s time-varying kind).
    Varying,
}

/// One column of numbers. Every value is what its text in the file reads back as, so that an experiment judges the
/// same numbers as somebody who loads the file.
#[derive(Debug, Clone)]
pub struct Signal {
    /// Name of the column.
    pub name: &'static str,
    /// Decimals in the file.
    pub decimals: usize,
    /// One value per sample.
    pub values: Vec<f64>,
    /// The same before the outliers were added, with its noise: column `NAME_clean`. None where none were.
    pub clean: Option<Vec<f64>>,
}

impl Signal {
    /// A column without outliers, rounded to `decimals`.
    #[must_use]
    pub fn new(name: &'static str, decimals: usize, values: Vec<f64>) -> Self {
        Self { name, decimals, values: rounded(values, decimals), clean: None }
    }

    /// A column to which `errors` have been added, sample by sample; 0 where there is none.
    #[must_use]
    pub fn with_errors(name: &'static str, decimals: usize, clean: &[f64], errors: &[f64]) -> Self {
        let values = clean.iter().zip(errors).map(|(x, e)| x + e).collect();
        let clean = Some(rounded(clean.to_vec(), decimals));
        Self { name, decimals, values: rounded(values, decimals), clean }
    }

    /// Name of the column of its outlier-free values.
    #[must_use]
    pub fn clean_name(&self) -> String {
        format!("{}_clean", self.name)
    }
}

fn rounded(mut values: Vec<f64>, decimals: usize) -> Vec<f64> {
    let unit = (0..decimals).fold(1.0, |unit, _| unit * 10.0);
    values.iter_mut().for_each(|v| *v = (*v * unit).round() / unit);
    values
}

impl Record {
    /// A record whose truth column is `truth`.
    #[must_use]
    pub fn new(time: Signal, signals: Vec<Signal>, wild: Vec<Option<Wild>>) -> Self {
        Self { time, signals, wild, truth: "truth" }
    }

    /// How many samples are wild in this way.
    #[must_use]
    pub fn count(&self, kind: Wild) -> usize {
        self.wild.iter().filter(|w| **w == Some(kind)).count()
    }

    /// The record as a CSV file.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = self.header();
        text.push('\n');
        self.rows(&mut text, 0.0, "");
        text
    }

    fn header(&self) -> String {
        let mut names = vec![self.time.name.to_owned()];
        for signal in &self.signals {
            names.push(signal.name.to_owned());
            names.extend(signal.clean.is_some().then(|| signal.clean_name()));
        }
        names.push(self.truth.to_owned());
        names.join(",")
    }

    fn rows(&self, text: &mut String, offset: f64, end: &str) {
        for (i, t) in self.time.values.iter().enumerate() {
            let _ = write!(text, "{:.*}", self.time.decimals, t + offset);
            for signal in &self.signals {
                let columns = [Some(&signal.values), signal.clean.as_ref()];
                for column in columns.into_iter().flatten() {
                    // Without the sign of a negative zero.
                    let _ = write!(text, ",{:.*}", signal.decimals, column[i] + 0.0);
                }
            }
            let _ = writeln!(text, ",{}{end}", u8::from(self.wild[i].is_some()));
        }
    }

    /// The time from the start of one run to that of the next when several are written to one file.
    fn period(&self) -> f64 {
        let t = &self.time.values;
        let (first, last) = (t.first().copied().unwrap_or(0.0), t.last().copied().unwrap_or(0.0));
        let step = t.get(1).map_or(1.0, |second| second - first);
        last - first + BETWEEN_RUNS * step
    }
}

/// Several runs as one CSV file: one after the other in time, far enough apart that methods cut between them, with
/// a column `run` that holds `run1`, `run2`, …, which a loader takes for text.
#[must_use]
pub fn csv_of_runs(runs: &[Record]) -> String {
    let Some(first) = runs.first() else { return String::new() };
    let mut text = first.header() + ",run\n";
    let mut offset = 0.0;
    for (i, run) in runs.iter().enumerate() {
        run.rows(&mut text, offset, &format!(",run{}", i + 1));
        offset += run.period();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Record {
        let x = Signal::with_errors("x_m", 2, &[0.125_4, -0.001, 2.0], &[0.0, 10.0, -2.003]);
        let rate = Signal::new("rate", 1, vec![1.0, 1.25, 1.44]);
        Record::new(Signal::new("t_s", 1, vec![0.0, 0.1, 0.2]), vec![x, rate], vec![None, Some(Wild::Isolated), None])
    }

    #[test]
    fn a_record_is_written_as_it_is_judged() {
        let expected = "t_s,x_m,x_m_clean,rate,truth\n0.0,0.13,0.13,1.0,0\n0.1,10.00,0.00,1.3,1\n0.2,0.00,2.00,1.4,0\n";
        assert_eq!(record().csv(), expected);
        assert_eq!(record().signals[0].values[0].to_bits(), 0.13_f64.to_bits());
    }

    #[test]
    fn runs_follow_each_other_in_time_with_a_cut_between() {
        let text = csv_of_runs(&[record(), record()]);
        assert!(text.starts_with("t_s,x_m,x_m_clean,rate,truth,run\n0.0,0.13,"));
        assert!(text.contains("0.2,0.00,2.00,1.4,0,run1\n10.2,0.13,0.13,1.0,0,run2\n10.3,"));
    }
}
