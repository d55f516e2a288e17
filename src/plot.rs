//! Records of up to 10^7 samples reduced to the columns of a picture, without losing a wild point.
//!
//! Samples become columns ([`Columns`]) through pyramids of extremes ([`Pyramid`]); a result made ready for that is a
//! [`Drawn`]. All of it is pure: the same inputs give the same columns. The screen draws them in cells, the report
//! in SVG.

pub(crate) mod columns;
pub(crate) mod dots;
mod drawn;
mod filtered;
pub(crate) mod flags;
mod histogram;
pub(crate) mod labels;
mod locate;
mod marks;
pub(crate) mod pyramid;
pub(crate) mod scale;
mod sides;
mod sparkline;
mod steps;
mod stroke;
mod ticks;
pub(crate) mod view;

pub use columns::{ColumnSummary, Columns, Curve, Grid, Trace};
pub use drawn::{Drawn, residual_top, state};
pub use filtered::FilteredTrack;
pub use flags::{Flag, FlagState, Flags};
pub use histogram::{Histogram, Tally};
pub use labels::{LABEL_WIDTH, ValueLabels};
pub use pyramid::{Pyramid, Span};
pub use scale::{YFit, YScale, widened};
pub use sides::{Side, Sides, step};
pub use sparkline::{SparkColumn, Sparkline};
pub use steps::{StepColumn, Steps};
pub use ticks::{TickSteps, TimeTicks, tick_step, ticks};
pub use view::{Axis, View};
