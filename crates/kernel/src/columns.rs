//! Arrow columns as moments, ids and numbers.

use arrow_array::cast::AsArray as _;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, ArrayRef, RecordBatch, StringArray};
use arrow_cast::cast;
use arrow_schema::{ArrowError, DataType, TimeUnit};
use wildpoint_record::error::{Error, Result};
use wildpoint_record::session::archive::Rows;
use wildpoint_record::track::{ChannelValues, NO_MOMENT, moment_of};

use crate::layout::Layout;

const SECOND: i64 = 1_000_000_000;

/// What Arrow says of columns that cannot be read.
#[must_use]
pub fn unreadable(e: ArrowError) -> Error {
    match e {
        ArrowError::IoError(_, source) => Error::Io { action: "read", path: "standard input".into(), source },
        other => Error::input("standard input", other.to_string(), "send an Arrow IPC stream, not a file"),
    }
}

/// The ids of the tracks, as texts.
///
/// # Errors
/// [`Error::Usage`] for a row without one.
pub fn ids(column: &ArrayRef, name: &str) -> Result<StringArray> {
    let texts = cast(column, &DataType::Utf8).map_err(unreadable)?;
    let texts = texts.as_string::<i32>().clone();
    if texts.null_count() > 0 {
        return Err(Error::usage(format!("{name}: a row names no track"), "leave such rows out, or give them an id"));
    }
    Ok(texts)
}

/// The rows of a track.
pub(crate) fn rows(track: String, batch: &RecordBatch, layout: &Layout) -> Result<Rows> {
    let moments = match layout.time {
        Some(index) => moments(batch.column(index), layout.unit_ns)?,
        None => (0..).step_by(usize::try_from(SECOND).unwrap_or(usize::MAX)).take(batch.num_rows()).collect(),
    };
    let channel = |named: &crate::layout::Named| {
        Ok(ChannelValues { name: named.name.clone(), values: numbers(batch.column(named.index))? })
    };
    let channels = layout.values.iter().map(channel).collect::<Result<_>>()?;
    Ok(Rows { track, moments, unit_ns: layout.unit_ns, channels })
}

/// The values of a column, NaN for nulls.
fn numbers(column: &ArrayRef) -> Result<Vec<f64>> {
    let numbers = cast(column, &DataType::Float64).map_err(unreadable)?;
    let numbers = numbers.as_primitive::<Float64Type>();
    Ok(match numbers.null_count() {
        0 => numbers.values().to_vec(),
        _ => numbers.iter().map(|value| value.unwrap_or(f64::NAN)).collect(),
    })
}

/// Moments in nanoseconds: of timestamps and dates since 1970, of numbers since their own zero.
fn moments(column: &ArrayRef, unit_ns: i64) -> Result<Vec<i64>> {
    if column.data_type().is_floating() {
        return Ok(numbers(column)?.into_iter().map(|value| moment_of(value, unit_ns)).collect());
    }
    let whole = match column.data_type() {
        DataType::Date32 => cast(column, &DataType::Int32).and_then(|days| cast(&days, &DataType::Int64)),
        _ => cast(column, &DataType::Int64),
    };
    let whole = whole.map_err(unreadable)?;
    let unit = match column.data_type() {
        DataType::Timestamp(unit, _) | DataType::Time32(unit) | DataType::Time64(unit) | DataType::Duration(unit) => {
            ns_of(*unit)
        }
        DataType::Date32 => 86_400 * SECOND,
        DataType::Date64 => 1_000_000,
        _ => unit_ns,
    };
    let moment = |n: Option<i64>| n.and_then(|n| n.checked_mul(unit)).unwrap_or(NO_MOMENT);
    Ok(whole.as_primitive::<Int64Type>().iter().map(moment).collect())
}

fn ns_of(unit: TimeUnit) -> i64 {
    match unit {
        TimeUnit::Second => SECOND,
        TimeUnit::Millisecond => 1_000_000,
        TimeUnit::Microsecond => 1_000,
        TimeUnit::Nanosecond => 1,
    }
}
