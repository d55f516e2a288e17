//! The methods.

use pyo3::prelude::*;

/// The methods as `wildpoint methods --json` lists them.
#[pyfunction]
pub(crate) fn methods() -> PyResult<String> {
    wildpoint::batch::methods_json().map_err(|e| PyErr::from(std::io::Error::other(e)))
}
