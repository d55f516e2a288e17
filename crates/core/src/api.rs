//! The functions of the crate root: from times and values to verdicts, repairs and cleaned values.

use std::sync::Arc;

use crate::analysis::{Detection, Input, Outcome, Place, Rows, settle};
use crate::error::{Error, Result};
use crate::review::Decisions;
use crate::series::Series;
use crate::setup::Setup;
use crate::stop::Stop;

/// Finds the wild points of a channel with the method of `setup`. A method that needs the rate of the channel gets it
/// from an [`Input`] that has one.
///
/// # Errors
/// [`Error::Usage`] when the method needs a rate and the input has none.
///
/// ```
/// use wildpoint_core::{Series, Setup, Verdict, detect};
///
/// let t: Vec<f64> = (0..80).map(f64::from).collect();
/// let mut y: Vec<f64> = (0..80).map(|i| 3.0 * f64::from(i) + f64::from(i * i).sin()).collect();
/// y[40] += 25.0;
///
/// let detection = detect(&Series::new(&t, &y), &Setup::standard())?;
/// let flagged = |i: &usize| detection.judged.verdict()[*i] == Verdict::Outlier;
/// assert_eq!((0..80).filter(flagged).collect::<Vec<_>>(), [40]);
/// assert!((detection.judged.expected()[40] - 120.0).abs() < 5.0);
/// # Ok::<(), wildpoint_core::Error>(())
/// ```
pub fn detect<'a>(input: impl Into<Input<'a>>, setup: &Setup) -> Result<Detection> {
    Detection::of(input.into(), setup, &Stop::never())
}

/// Repairs what a detection flags, and fills gaps, as its setup says. `t` are the times that the series was made of;
/// [`settle`] does the same where an analyst has decided on samples.
///
/// # Errors
/// [`Error::Usage`] when there are fewer times than rows of the series.
///
/// ```
/// use wildpoint_core::{Series, Setup, detect, repair};
///
/// let t: Vec<f64> = (0..80).map(f64::from).collect();
/// let mut y: Vec<f64> = (0..80).map(|i| 3.0 * f64::from(i) + f64::from(i * i).sin()).collect();
/// y[40] += 25.0;
/// y[41] += 25.0;
///
/// let mut setup = Setup::standard();
/// setup.repair.set_text("repair", "method", "linear")?;
/// let series = Series::new(&t, &y);
/// let outcome = repair(&t, &series, detect(&series, &setup)?)?;
/// assert_eq!(outcome.outliers, [40, 41]);
/// let step = (y[42] - y[39]) / 3.0;
/// assert!((outcome.fixes[0] - (y[39] + step)).abs() < 1e-9);
/// assert_eq!((outcome.counts.flagged, outcome.counts.patches), (2, 1));
/// # Ok::<(), wildpoint_core::Error>(())
/// ```
pub fn repair(t: &[f64], series: &Series<'_>, detection: Detection) -> Result<Outcome> {
    let rows = series.len().checked_sub(1).map_or(0, |last| series.row(last) + 1);
    if t.len() < rows {
        let what = format!("{} times for a series of {rows} rows", t.len());
        return Err(Error::usage(what, "give the times that the series was made of"));
    }
    let rows = Rows { seconds: t, own: None };
    Ok(settle(series, rows, Arc::new(detection), &Decisions::default(), &Stop::never())?)
}

/// Values without wild points, and how they came about.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Cleaned {
    /// One value for each that was handed in: the same bits where nothing was found, the repair where one was, NaN
    /// where a sample was removed or is missing.
    pub values: Vec<f64>,
    /// Indices of the wild points, ascending.
    pub outliers: Vec<usize>,
    /// Verdicts, evidence and counts, by position among the present samples.
    pub outcome: Outcome,
}

/// Finds and repairs the wild points of the values `y` at the times `t` (in seconds). A sample whose time or value is
/// NaN is missing.
///
/// # Errors
/// [`Error::Usage`] when there are not as many values as times, when the times do not increase, or
/// when the method needs the rate of the channel: [`detect`] takes that.
///
/// ```
/// use wildpoint_core::{Setup, clean};
///
/// let t: Vec<f64> = (0..80).map(f64::from).collect();
/// let mut y: Vec<f64> = (0..80).map(|i| 3.0 * f64::from(i) + f64::from(i * i).sin()).collect();
/// y[20] = f64::NAN;
/// y[40] += 25.0;
///
/// let cleaned = clean(&t, &y, &Setup::standard())?;
/// assert_eq!(cleaned.outliers, [40]);
/// assert!((cleaned.values[40] - 120.0).abs() < 5.0);
/// assert_eq!(cleaned.values[39], y[39]);
/// assert!(cleaned.values[20].is_nan());
/// # Ok::<(), wildpoint_core::Error>(())
/// ```
pub fn clean(t: &[f64], y: &[f64], setup: &Setup) -> Result<Cleaned> {
    let series = Series::checked(t, y)?;
    let detection = Arc::new(detect(&series, setup)?);
    let rows = Rows { seconds: t, own: None };
    let outcome = settle(&series, rows, detection, &Decisions::default(), &Stop::never())?;
    let mut values = y.to_vec();
    let outliers: Vec<usize> = outcome.outliers.iter().map(|&position| series.row(position)).collect();
    for (&row, &fix) in outliers.iter().zip(&outcome.fixes) {
        values[row] = fix;
    }
    for fill in &outcome.fills {
        // A new row has no place among these; it stays in the outcome.
        if let Place::Cell(row) = fill.place {
            values[row] = fill.value;
        }
    }
    Ok(Cleaned { values, outliers, outcome })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::find;
    use crate::setup::Preset;

    fn wavy(n: u32) -> (Vec<f64>, Vec<f64>) {
        let t = (0..n).map(f64::from).collect();
        (t, (0..n).map(|i| 0.2 * f64::from(i) + f64::from(i * i).sin()).collect())
    }

    #[test]
    fn missing_cells_are_filled_in_their_rows() {
        let (t, mut y) = wavy(80);
        let (before, wild) = (y[30], 50);
        y[30] = f64::NAN;
        y[wild] += 40.0;
        let mut setup = Setup::standard();
        setup.repair.set_text("repair", "method", "linear").unwrap();
        setup.repair.set_text("repair", "fill_gaps", "cells").unwrap();
        let cleaned = clean(&t, &y, &setup).unwrap();
        assert_eq!(cleaned.outliers, [wild]);
        assert!((cleaned.values[30] - f64::midpoint(y[29], y[31])).abs() < 1e-9, "{before} {}", cleaned.values[30]);
        let series = Series::new(&t, &y);
        let detection = detect(&series, &setup).unwrap();
        assert_eq!(repair(&t, &series, detection.clone()).unwrap().fills, cleaned.outcome.fills);
        assert!(matches!(repair(&t[..79], &series, detection), Err(Error::Usage { .. })));
    }

    #[test]
    fn what_makes_no_series_is_an_error_that_names_the_place() {
        let error = |t: &[f64], y: &[f64]| clean(t, y, &Setup::standard()).unwrap_err().to_string();
        assert!(error(&[0.0, 1.0], &[1.0]).contains("2 times and 1 values"));
        let backward = error(&[0.0, 1.0, f64::NAN, 1.0], &[1.0; 4]);
        assert!(backward.contains("index 3"), "{backward}");
    }

    #[test]
    fn a_method_that_needs_a_rate_takes_it_from_the_input() {
        let (t, y) = wavy(80);
        let rate = vec![0.2; 80];
        let (series, rates) = (Series::new(&t, &y), Series::new(&t, &rate));
        let setup = Setup::new(find("matched").unwrap(), Preset::Default);
        assert!(matches!(detect(&series, &setup), Err(Error::Usage { .. })));
        let input = Input::new(&series, Some(&rates));
        assert_eq!(detect(input, &setup).unwrap().judged.verdict().len(), 80);
    }

    #[test]
    fn results_are_json_for_other_programs() {
        let (t, mut y) = wavy(80);
        y[50] += 40.0;
        let cleaned = clean(&t, &y, &Setup::standard()).unwrap();
        let json = serde_json::to_value(&cleaned).unwrap();
        assert_eq!(json["outliers"], serde_json::json!([50]));
        assert_eq!(json["outcome"]["detection"]["setup"]["method"], "two-sided");
        assert_eq!(json["outcome"]["detection"]["setup"]["settings"]["k"], 4.0);
        assert_eq!(json["outcome"]["detection"]["verdict"][50], "outlier");
        assert_eq!(json["outcome"]["marks"][0]["verdict"], "outlier");
        assert_eq!(json["outcome"]["counts"]["flagged"], 1);
    }
}
