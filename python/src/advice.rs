//! Which method to take.

use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use wildpoint::error::Result;
use wildpoint::method::voting;
use wildpoint::session::detectability::{Advice, OnChannel};
use wildpoint::session::{Preset, candidates, method_of_id};
use wildpoint::stop::Stop;
use wildpoint::track::{Reading, Samples, Track};

use crate::arrays::{RATE, Times, VALUE, rows};
use crate::errors::raised;

/// The advice of `wildpoint advise --json` on a channel, as JSON, and its reasons.
#[pyfunction]
pub(crate) fn advise(
    py: Python<'_>,
    values: PyReadonlyArray1<'_, f64>,
    times: Option<Times<'_>>,
    rate: Option<PyReadonlyArray1<'_, f64>>,
    methods: Vec<String>,
    seed: u64,
) -> PyResult<(String, Vec<String>)> {
    let rate_name = rate.as_ref().map(|_| RATE);
    let rows = rows(&values, times, rate)?;
    let advice: Result<Advice> = py.detach(|| {
        let track = Track::of_columns("time", rows.moments, rows.channels, &Reading::new(false, &[]));
        let named: Vec<_> = methods.iter().map(|id| method_of_id(id)).collect::<std::result::Result<_, _>>()?;
        let all = if named.is_empty() { voting().collect() } else { named };
        let (setups, _) = candidates(all, Preset::Default, rate_name);
        let channel = &track.channels[0];
        debug_assert_eq!(channel.name, VALUE);
        let preparation = wildpoint::session::suggested(channel);
        let setups = setups.into_iter().map(|setup| setup.prepared(&preparation)).collect();
        let samples = Samples::of(channel, &track.time);
        OnChannel { track: &track, channel, samples: &samples, seed }.advise(setups, &Stop::never(), |_| ())
    });
    let advice = advice.map_err(raised)?;
    let json = serde_json::to_string(&advice).map_err(|e| PyErr::from(std::io::Error::other(e)))?;
    let reasons = match advice.unsuitable {
        Some(why) => vec![why.to_string(), why.way_out().to_owned()],
        None => advice.reasons(""),
    };
    Ok((json, reasons))
}
