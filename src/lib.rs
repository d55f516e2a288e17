//! wildpoint: finding, reviewing and repairing wild points of tracking records.
//!
//! The modules are layers: each imports only from those listed before it (`tests/layers.rs` holds them to that).

pub mod batch;
pub mod calibration;
pub mod check;
pub mod cli;
pub mod error;
pub mod experiment;
pub mod job;
pub mod math;
pub mod method;
pub mod param;
pub mod plot;
pub mod repair;
pub mod report;
pub mod review;
pub mod score;
pub mod session;
pub mod stop;
pub mod stream;
pub mod track;
pub mod tui;
mod wrapped;
