//! wildpoint: finding, reviewing and repairing wild points of tracking records.
//!
//! Numbers are in `wildpoint-core`, files in `wildpoint-record`; their modules are re-exported here. The modules are
//! layers: each imports only from those below it (`tests/layers.rs`).

pub mod batch;
pub mod cli;
mod clock;
mod counted;
pub mod experiment;
pub mod job;
pub mod manual;
pub mod plot;
pub mod program;
pub mod report;
pub mod stream;
pub mod tui;
mod wrapped;

pub use wildpoint_core::{analysis, calibration, check, math, memory, method, param, repair, review, score, stop};
pub use wildpoint_record::{error, session, track};
