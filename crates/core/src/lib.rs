//! wildpoint-core: finding and repairing wild points of a series of times and values.
//!
//! The modules are layers: each imports only from those listed before it in `tests/layers.rs`.

pub mod analysis;
pub mod ballot;
pub mod calibration;
pub mod check;
pub mod error;
pub mod calibration;
mod interval;
pub mod math;
pub mod method;
pub mod param;
pub mod preparation;
pub mod repair;
pub mod review;
pub mod score;
pub mod series;
pub mod setup;
pub mod stop;
pub mod suggestions;
pub mod sweep;
