//! The filtered values of methods whose expected value is smoothed from all samples around, this one included.

use super::{Filter, Filtered, Settled};
use crate::stop::{Stop, Stopped};

/// The expected values; at an outlier what the own repair puts in.
pub(in crate::method) struct Expected(pub(in crate::method) &'static str);

impl Filter for Expected {
    fn about(&self) -> &'static str {
        self.0
    }

    fn run(&self, settled: &Settled<'_>, _: &Stop) -> Result<Filtered, Stopped> {
        let mut value = settled.damaged.judged.expected.to_vec();
        for (&i, own) in settled.damaged.outliers.iter().zip(settled.own).filter(|(_, own)| own.is_finite()) {
            value[i] = *own;
        }
        Ok(Filtered::of_values(value))
    }
}
