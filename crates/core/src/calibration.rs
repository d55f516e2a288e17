//! Calibration: what a record is, from its own times and values, before any method looks at it.

pub mod repeated;
pub mod stuck;
pub mod wrap;
