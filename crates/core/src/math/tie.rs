//! When two numbers count as equal.

/// Equal to within this fraction of a limit is a tie (values on a grid sit exactly on limits; rounding must not
/// decide): it reaches the limit and does not exceed it.
pub const TIE: f64 = 1e-9;
