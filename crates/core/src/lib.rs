//! Finds and repairs *wild points* (outliers that the target cannot have produced) in series of times and values.
//!
//! ```
//! use wildpoint_core::{Setup, clean};
//!
//! let t: Vec<f64> = (0..80).map(f64::from).collect();
//! let mut y: Vec<f64> = (0..80).map(|i| 3.0 * f64::from(i) + f64::from(i * i).sin()).collect();
//! y[40] += 25.0;
//!
//! let cleaned = clean(&t, &y, &Setup::standard())?;
//! assert_eq!(cleaned.outliers, [40]);
//! # Ok::<(), wildpoint_core::Error>(())
//! ```
//!
//! | step | with |
//! |---|---|
//! | times and values | [`Series`] |
//! | a method and a repair with their settings | [`Setup`], [`METHODS`], [`Preset`] |
//! | verdicts, expected values, tolerances | [`detect()`] gives a [`Detection`] of [`Verdict`]s |
//! | repairs, runs, counts | [`repair()`] gives an [`Outcome`] |
//! | all of it at once | [`clean()`] gives [`Cleaned`] |
//! | what an analyst decided | [`review::Decisions`], [`analysis::settle`] |
//! | the right threshold | [`mod@sweep`] |
//! | what several methods say | [`ballot`] |
//! | how good a result is, where the truth is known | [`score`] |
//! | how small a wild point a method finds on this record, and which method to take | [`detectability`] |
//! | a method of your own | implement [`Method`] |
//!
//! Results implement `serde::Serialize`. Work is shared among the threads of the current rayon pool; the crate makes
//! none, and the number of threads changes no bit of a result. Long work can be ended through a [`stop::Stop`].
//!
//! What each method computes is described in `docs/methods.md` of the repository.

pub mod analysis;
mod api;
pub mod ballot;
pub mod calibration;
pub mod check;
pub mod detectability;
pub mod error;
mod interval;
pub mod math;
pub mod memory;
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

pub use analysis::{Detection, Outcome};
pub use api::{Cleaned, clean, detect, repair};
pub use error::Error;
pub use method::{METHODS, Method, Verdict};
pub use series::Series;
pub use setup::{Preset, Setup};
