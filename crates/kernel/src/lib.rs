//! Applies a session to tracks that are columns of Arrow.
//!
//! The program `wildpoint-kernel` reads them from a stream; the Python package takes them from a table.

mod columns;
mod emit;
mod flags;
mod kernel;
mod layout;
mod samples;
mod summary;

pub use columns::{ids, unreadable};
pub use emit::Emit;
pub use kernel::Kernel;
