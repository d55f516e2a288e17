//! One channel in arrays.

use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use wildpoint::error::{Error, Result};
use wildpoint::method::Verdict;
use wildpoint::session::archive::{Judged, Named, Rows, Template};
use wildpoint::track::{ChannelValues, moment_of};

use crate::errors::raised;
use crate::settings::Settings;

pub(crate) const SECOND: i64 = 1_000_000_000;

/// The name of the channel, and of the one that measures its rate.
pub(crate) const VALUE: &str = "value";
pub(crate) const RATE: &str = "rate";

/// Times as they come from numpy.
#[derive(FromPyObject)]
pub(crate) enum Times<'py> {
    /// Nanoseconds since 1970; the least number is none.
    Nanoseconds(PyReadonlyArray1<'py, i64>),
    /// Seconds.
    Seconds(PyReadonlyArray1<'py, f64>),
}

impl Times<'_> {
    fn moments(&self) -> PyResult<Vec<i64>> {
        Ok(match self {
            Self::Nanoseconds(ns) => ns.as_slice()?.to_vec(),
            Self::Seconds(s) => s.as_slice()?.iter().map(|s| moment_of(*s, SECOND)).collect(),
        })
    }
}

/// The samples of a channel with their times (those of `range(len(values))` seconds where none are given), and the channel
/// that measures its rate.
pub(crate) fn rows(
    values: &PyReadonlyArray1<'_, f64>,
    times: Option<Times<'_>>,
    rate: Option<PyReadonlyArray1<'_, f64>>,
) -> PyResult<Rows> {
    let values = values.as_slice()?.to_vec();
    let moments = match times {
        Some(times) => times.moments()?,
        None => (0..).step_by(usize::try_from(SECOND)?).take(values.len()).collect(),
    };
    let rate = rate.map(|rate| Ok::<_, PyErr>(rate.as_slice()?.to_vec())).transpose()?;
    for (what, length) in [("times", moments.len()), ("rate", rate.as_ref().map_or(values.len(), Vec::len))] {
        if length != values.len() {
            let what = format!("{} values and {length} {what}", values.len());
            return Err(raised(Error::usage(what, "give arrays of the same length")));
        }
    }
    let mut channels = vec![ChannelValues { name: VALUE.to_owned(), values }];
    channels.extend(rate.map(|values| ChannelValues { name: RATE.to_owned(), values }));
    Ok(Rows { track: String::new(), moments, unit_ns: SECOND, channels })
}

/// The number of a verdict, the same as in digests.
fn code(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Normal => 0,
        Verdict::Outlier => 1,
        Verdict::Suspect => 2,
        Verdict::Unchecked => 3,
        Verdict::Missing => 4,
    }
}

type Array<'py, T> = Bound<'py, PyArray1<T>>;

/// Verdicts, expected values, tolerances, cleaned values, and warnings.
pub(crate) type Found<'py> = (Array<'py, u8>, Array<'py, f64>, Array<'py, f64>, Array<'py, f64>, Vec<String>);

/// Judges and repairs a channel.
#[pyfunction]
#[pyo3(signature = (values, times, rate, settings))]
pub(crate) fn detect<'py>(
    py: Python<'py>,
    values: PyReadonlyArray1<'py, f64>,
    times: Option<Times<'py>>,
    rate: Option<PyReadonlyArray1<'py, f64>>,
    settings: &Settings,
) -> PyResult<Found<'py>> {
    let rows = rows(&values, times, rate)?;
    let judged: Result<Judged> = py.detach(|| {
        let channels = [VALUE.to_owned()];
        Template::of_setup(&settings.setup, &channels, Named::default(), settings.prepare()).judge(rows)
    });
    let judged = judged.map_err(raised)?;
    let (samples, estimates) = (judged.samples(0), judged.estimates(0));
    let verdicts = samples.verdicts.iter().map(|verdict| code(*verdict)).collect();
    Ok((
        PyArray1::from_vec(py, verdicts),
        PyArray1::from_vec(py, estimates.expected),
        PyArray1::from_vec(py, estimates.tolerance),
        PyArray1::from_vec(py, samples.clean),
        judged.warnings(0),
    ))
}
