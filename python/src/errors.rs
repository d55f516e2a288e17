//! Errors of the program as exceptions, with the same words.

use pyo3::exceptions::{PyMemoryError, PyValueError};
use pyo3::{PyErr, create_exception};
use wildpoint::error::Error as Fault;

create_exception!(
    wildpoint,
    Error,
    PyValueError,
    "An argument, a table or a session that cannot be used. The second line of its text is the way out."
);

/// Options of the command line, and the arguments that are the same in Python.
const ARGUMENTS: [(&str, &str); 5] = [
    ("--time-unit", "time_unit="),
    ("--time", "time="),
    ("--track", "track="),
    ("--decisions=", "decisions="),
    ("--rate", "rate="),
];

/// The exception for an error: `OSError` and its kinds for files, `MemoryError`, otherwise `wildpoint.Error`.
pub(crate) fn raised(fault: impl Into<Fault>) -> PyErr {
    let fault = fault.into();
    let text = ARGUMENTS.iter().fold(fault.to_string(), |text, (option, argument)| text.replace(option, argument));
    match fault {
        Fault::Io { source, .. } => std::io::Error::new(source.kind(), text).into(),
        Fault::Memory { .. } => PyMemoryError::new_err(text),
        _ => Error::new_err(text),
    }
}
