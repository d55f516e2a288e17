//! Which method with which settings, from keyword arguments.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyTuple};
use wildpoint::cli::{PrepareArgs, PresetArg};
use wildpoint::error::{Error, Result};
use wildpoint::repair;
use wildpoint::session::archive::Prepare;
use wildpoint::session::{Preset, Setup, method_of_id};

use crate::errors::raised;

/// A method with its settings, and what is done with a channel before.
#[pyclass(frozen)]
#[derive(Debug)]
pub(crate) struct Settings {
    pub(crate) setup: Setup,
    pub(crate) preset: PresetArg,
    before: Vec<String>,
    period: Option<String>,
}

#[pymethods]
impl Settings {
    #[new]
    fn new(
        method: &str,
        preset: &str,
        rate: Option<String>,
        checks: Vec<String>,
        period: Option<String>,
        settings: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let preset = match preset {
            "default" => PresetArg::Default,
            "paper" => PresetArg::Paper,
            other => {
                return Err(raised(Error::usage(format!("preset {other}: there is no such preset"), "default, paper")));
            }
        };
        let method = method_of_id(method).map_err(raised)?;
        let mut setup = Setup::new(method, Preset::from(preset));
        for (key, value) in settings {
            set(&mut setup, &key.extract::<String>()?, &text(&value)?).map_err(raised)?;
        }
        setup.rate = rate;
        let settings = Self { setup, preset, before: checks, period };
        settings.prepare_args().understood().map_err(raised)?;
        Ok(settings)
    }

    /// The setup as JSON.
    fn json(&self) -> PyResult<String> {
        serde_json::to_string(&self.setup).map_err(|e| PyErr::from(std::io::Error::other(e)))
    }
}

impl Settings {
    fn prepare_args(&self) -> PrepareArgs {
        PrepareArgs { check: self.before.clone(), period: self.period.clone().into_iter().collect(), position: None }
    }

    /// What completes the plans of a track: as `wildpoint clean` does it.
    pub(crate) fn prepare(&self) -> Prepare {
        let (args, preset) = (self.prepare_args(), self.preset);
        Prepare::with(move |session, track| args.prepare(session, track, preset))
    }
}

/// Sets a parameter of the method or of the repair; `repair` is the repair itself.
fn set(setup: &mut Setup, key: &str, text: &str) -> Result<()> {
    if key == "repair" {
        return Ok(setup.repair.set_text(key, repair::METHOD.key, repair::find(text)?.id)?);
    }
    Ok(setup.set_text(key, text)?)
}

/// The text of a value, as after `--set KEY=`.
fn text(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(switch) = value.cast::<PyBool>() {
        return Ok(if switch.is_true() { "true" } else { "false" }.to_owned());
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let each: Vec<String> = value.try_iter()?.map(|part| text(&part?)).collect::<PyResult<_>>()?;
        return Ok(each.join(","));
    }
    value.str()?.extract()
}
