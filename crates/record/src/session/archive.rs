//! A session applied to the tracks of an archive, one at a time: no file of the archive is the record that the session
//! was made on. An engine hands tracks over (`wildpoint-kernel`), or a folder is read on this machine ([`replay_folder`]).

mod decided;
mod digest;
mod folder;
mod judged;
mod partition;
mod plans;
mod recorded;
mod rows;
mod spill;

pub use digest::{SUMMARY_COLUMNS, Summary, archive_digest};
pub use folder::{Step, replay_folder};
pub use judged::{Estimates, Flag, Judged, Samples};
pub use plans::{DecisionsFor, Named, Prepare, Template};
pub use recorded::{Archive, Recorded, recorded, with_archive};
pub use rows::Rows;
