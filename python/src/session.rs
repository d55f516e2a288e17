//! A session file, as far as Python shows it.

use std::path::PathBuf;

use pyo3::prelude::*;
use wildpoint::session::archive::{DecisionsFor, Named, Template};
use wildpoint::session::{Plan, read};

use crate::errors::raised;

/// The plans of the session at `path`, as JSON: channel, setup and number of decisions.
#[pyfunction]
pub(crate) fn session(path: PathBuf) -> PyResult<String> {
    let session = read(&path).map_err(raised)?;
    // Whether decisions can be applied is asked when they are.
    let template = Template::read(&path, DecisionsFor::Track(String::new()), Named::default()).map_err(raised)?;
    let plan = |plan: &Plan| {
        serde_json::json!({
            "channel": plan.channel,
            "setup": plan.setup,
            "decisions": plan.decisions.len(),
        })
    };
    let options = &session.data.options;
    let about = serde_json::json!({
        "time": options.time,
        "track": options.track,
        "columns": template.columns(),
        "channels": session.plans.iter().map(plan).collect::<Vec<_>>(),
    });
    Ok(about.to_string())
}
