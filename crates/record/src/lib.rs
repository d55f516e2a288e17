//! wildpoint-record: tracking records in files, and the sessions that say what is done to them.
//!
//! The modules are layers: each imports only from those listed before it in `tests/layers.rs`.

pub mod error;
pub mod session;
pub mod track;

use wildpoint_core::{analysis, check, memory, method, param, repair, review, stop};
