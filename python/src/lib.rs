//! The compiled part of the Python package `wildpoint`: arrays and tables of Arrow in, verdicts out. What users call is in
//! `python/wildpoint`.

mod advice;
mod arrays;
mod arrow;
mod errors;
mod registry;
mod session;
mod settings;
mod table;

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs the program with its arguments, of which the first is its name, and gives its exit status.
#[pyfunction]
fn main(py: Python<'_>, args: Vec<OsString>) -> u8 {
    py.detach(|| wildpoint::program::run(args))
}

#[pymodule]
fn _wildpoint(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("Error", module.py().get_type::<errors::Error>())?;
    module.add_class::<arrow::Columns>()?;
    module.add_class::<settings::Settings>()?;
    module.add_function(wrap_pyfunction!(main, module)?)?;
    module.add_function(wrap_pyfunction!(arrays::detect, module)?)?;
    module.add_function(wrap_pyfunction!(advice::advise, module)?)?;
    module.add_function(wrap_pyfunction!(arrow::columns, module)?)?;
    module.add_function(wrap_pyfunction!(registry::methods, module)?)?;
    module.add_function(wrap_pyfunction!(session::session, module)?)?;
    module.add_function(wrap_pyfunction!(table::judge, module)?)?;
    Ok(())
}
