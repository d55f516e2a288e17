//! wildpoint: finding, reviewing and repairing wild points of tracking records.
//!
//! The modules are layers: each imports only from those listed before it (`tests/layers.rs` holds them to that).

pub mod error;
pub mod track;
pub mod math;
pub mod stop;
pub mod param;
pub mod method;
pub mod repair;
pub mod review;
pub mod session;
pub mod score;
pub mod experiment;
pub mod job;
pub mod report;
pub mod cli;
pub mod batch;
