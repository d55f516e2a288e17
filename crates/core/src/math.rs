//! Numerical kernels on slices: no track, no parameters.

pub mod circle;
pub mod difference;
pub mod extrapolate;
pub mod extremes;
pub mod gains;
pub mod huber;
pub mod integral;
pub mod least_spread;
pub mod leave_one_out;
pub mod line;
pub mod line_of_five;
pub mod moments;
pub mod moments_of_four;
pub mod movement;
pub mod order;
pub mod pieces;
pub mod polyfit;
pub mod random;
pub mod sliding;
pub mod smoothing;
pub mod sorted_four;
pub mod sorted_window;
pub mod spline;
pub mod student;
pub mod tie;
pub mod window_fit;
