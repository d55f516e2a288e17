//! Numerical kernels on slices: no track, no parameters.

pub mod difference;
pub mod order;
pub mod polyfit;
pub mod smoothing;
