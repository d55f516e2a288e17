//! What came out of an experiment: tables beside those of the document, and which of its statements hold here.

use serde::{Serialize, Serializer};

use super::shown::Chart;

/// The result of an experiment over all its runs.
#[derive(Debug, Clone, Serialize)]
pub struct Reproduction {
    /// Id of the experiment.
    pub id: &'static str,
    /// The document.
    pub source: &'static str,
    /// What the experiment is, in one line.
    pub help: &'static str,
    /// What stands in for the document's data.
    pub stand_in: &'static str,
    /// Seed of the first run; the others follow.
    pub seed: u64,
    /// How many runs the figures are means of.
    pub runs: usize,
    /// The tables.
    pub tables: Vec<Table>,
    /// The statements of the document, each with what was measured here.
    pub findings: Vec<Finding>,
    /// Curves over the runs; the tables have their numbers.
    #[serde(skip)]
    pub charts: Vec<Chart>,
}

/// A table: the figures of the document, where it has them, beside those measured here.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Table {
    /// What it shows.
    pub title: String,
    /// Heads of its columns.
    pub columns: Vec<&'static str>,
    /// Its rows, a cell per column.
    pub rows: Vec<Vec<Cell>>,
}

/// One cell of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A figure with its decimals, and its deviation from run to run where that tells something.
    Number {
        /// The figure.
        value: f64,
        /// How many decimals are shown.
        decimals: usize,
        /// Standard deviation over the runs.
        spread: Option<f64>,
    },
    /// The document has no figure here.
    Empty,
}

/// A statement of a document, and whether it holds here.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Finding {
    /// A short name that does not change.
    pub id: &'static str,
    /// What the document says.
    pub statement: &'static str,
    /// Whether it holds in the figures measured here.
    pub held: Held,
    /// The figures that decide, or why none can.
    pub measured: String,
    /// True where the stand-in for the document's data was chosen so that it holds.
    pub fitted: bool,
}

/// Whether a statement holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Held {
    /// It does.
    #[serde(rename = "holds")]
    Yes,
    /// It does not.
    #[serde(rename = "does not")]
    No,
    /// Nothing that can be measured here decides.
    #[serde(rename = "cannot be told")]
    CannotTell,
}

impl Held {
    /// As tables have it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Yes => "holds",
            Self::No => "does not",
            Self::CannotTell => "cannot be told",
        }
    }
}

impl From<bool> for Held {
    fn from(holds: bool) -> Self {
        if holds { Self::Yes } else { Self::No }
    }
}

impl Finding {
    /// A statement that figures decide.
    #[must_use]
    pub fn new(id: &'static str, statement: &'static str, holds: bool, measured: String) -> Self {
        Self { id, statement, held: holds.into(), measured, fitted: false }
    }

    /// A statement that nothing measured here decides, and why.
    #[must_use]
    pub fn untold(id: &'static str, statement: &'static str, why: impl Into<String>) -> Self {
        Self { id, statement, held: Held::CannotTell, measured: why.into(), fitted: false }
    }

    /// The same of a stand-in that was chosen so that it holds.
    #[must_use]
    pub fn fitted(self) -> Self {
        Self { fitted: true, ..self }
    }
}

impl Cell {
    /// Words.
    #[must_use]
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }

    /// A figure; NaN is an empty cell.
    #[must_use]
    pub fn number(value: f64, decimals: usize) -> Self {
        if value.is_nan() { Self::Empty } else { Self::Number { value, decimals, spread: None } }
    }

    /// A figure with its deviation from run to run.
    #[must_use]
    pub fn with_spread(value: f64, spread: f64, decimals: usize) -> Self {
        // One run has no deviation.
        let spread = (!spread.is_nan()).then_some(spread);
        if value.is_nan() { Self::Empty } else { Self::Number { value, decimals, spread } }
    }

    /// As a table of text has it.
    #[must_use]
    pub fn shown(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number { value, decimals, spread: None } => format!("{value:.decimals$}"),
            Self::Number { value, decimals, spread: Some(spread) } => {
                format!("{value:.decimals$} ± {spread:.decimals$}")
            }
            Self::Empty => "-".to_owned(),
        }
    }
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Text(text) => serializer.serialize_str(text),
            Self::Number { value, spread: None, .. } => serializer.serialize_f64(*value),
            Self::Number { value, spread: Some(spread), .. } => {
                #[derive(Serialize)]
                struct Both {
                    mean: f64,
                    spread: f64,
                }
                Both { mean: *value, spread: *spread }.serialize(serializer)
            }
            Self::Empty => serializer.serialize_none(),
        }
    }
}

/// The figures of one run: for each row of the tables to come, its label and its values. NaN where a run has none.
pub type Figures = Vec<(&'static str, Vec<f64>)>;

/// Means and deviations of the figures over runs.
#[derive(Debug, Clone, Copy)]
pub struct Runs<'a>(pub &'a [Figures]);

impl Runs<'_> {
    /// Mean of the value in `column` of the row `label` over the runs that have one; NaN when none has.
    #[must_use]
    pub fn mean(&self, label: &str, column: usize) -> f64 {
        let values = self.values(label, column);
        #[expect(clippy::cast_precision_loss, reason = "a number of runs")]
        let n = values.len() as f64;
        values.iter().sum::<f64>() / n
    }

    /// Sample standard deviation over the runs; NaN with fewer than two.
    #[must_use]
    pub fn spread(&self, label: &str, column: usize) -> f64 {
        let (values, mean) = (self.values(label, column), self.mean(label, column));
        #[expect(clippy::cast_precision_loss, reason = "a number of runs")]
        let n = values.len() as f64;
        (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0)).sqrt()
    }

    /// In how many runs the figures are such.
    #[must_use]
    pub fn count(&self, is_such: impl Fn(&Runs<'_>) -> bool) -> usize {
        self.0.iter().filter(|run| is_such(&Runs(std::slice::from_ref(run)))).count()
    }

    fn values(&self, label: &str, column: usize) -> Vec<f64> {
        let rows = self.0.iter().flat_map(|run| run.iter().filter(|(l, _)| *l == label));
        rows.filter_map(|(_, values)| values.get(column).copied()).filter(|v| v.is_finite()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_without_a_figure_are_left_out_of_its_mean() {
        let runs = [vec![("a", vec![1.0, 5.0])], vec![("a", vec![f64::NAN, 7.0])], vec![("a", vec![4.0, 9.0])]];
        let runs = Runs(&runs);
        assert_eq!((runs.mean("a", 0), runs.mean("a", 1)), (2.5, 7.0));
        assert!((runs.spread("a", 0) - 4.5_f64.sqrt()).abs() < 1e-12 && (runs.spread("a", 1) - 2.0).abs() < 1e-12);
        assert!(runs.mean("b", 0).is_nan());
        assert_eq!(runs.count(|run| run.mean("a", 1) > 6.0), 2);
        assert_eq!(Cell::number(runs.mean("b", 0), 1).shown(), "-");
        assert_eq!(Cell::with_spread(2.5, 2.12, 1).shown(), "2.5 ± 2.1");
        assert_eq!(Cell::with_spread(2.5, f64::NAN, 1).shown(), "2.5", "of one run");
    }
}
