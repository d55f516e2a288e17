//! Tables that are handed over through Arrow's interface of capsules.

use std::sync::Arc;

use arrow_array::cast::AsArray as _;
use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::types::{Float64Type, Int32Type, Int64Type};
use arrow_array::{
    Array as _, ArrayRef, DictionaryArray, Float64Array, Int64Array, RecordBatch, RecordBatchIterator, StringArray,
    TimestampNanosecondArray,
};
use arrow_buffer::NullBuffer;
use arrow_schema::{ArrowError, DataType, Field, Schema};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::errors::raised;

/// A table: what goes out, and what numpy has on the way in.
#[pyclass(frozen)]
#[derive(Debug)]
pub(crate) struct Columns {
    pub(crate) batch: RecordBatch,
}

/// What Arrow says of columns that do not fit together.
pub(crate) fn refused(e: ArrowError) -> PyErr {
    raised(wildpoint::error::Error::usage(e.to_string(), "give columns of the same length"))
}

#[pymethods]
impl Columns {
    /// The names of the columns.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.batch.schema_ref().fields().iter().map(|field| field.name().clone()).collect()
    }

    /// A column as numpy has it: numbers as an array (NaN for nulls), texts as a list (None for nulls).
    fn column<'py>(&self, py: Python<'py>, index: usize) -> PyResult<Bound<'py, PyAny>> {
        let column = self.batch.column(index);
        Ok(match column.data_type() {
            DataType::Float64 => {
                let values = column.as_primitive::<Float64Type>().iter().map(|v| v.unwrap_or(f64::NAN));
                PyArray1::from_vec(py, values.collect()).into_any()
            }
            DataType::Int64 if column.null_count() == 0 => {
                PyArray1::from_slice(py, column.as_primitive::<Int64Type>().values()).into_any()
            }
            DataType::Int64 => {
                #[expect(clippy::cast_precision_loss, reason = "a count of rows")]
                let values = column.as_primitive::<Int64Type>().iter().map(|v| v.map_or(f64::NAN, |v| v as f64));
                PyArray1::from_vec(py, values.collect()).into_any()
            }
            DataType::Timestamp(_, _) => {
                let values =
                    arrow_array::cast::as_primitive_array::<arrow_array::types::TimestampNanosecondType>(column);
                PyArray1::from_vec(py, values.iter().map(|v| v.unwrap_or(i64::MIN)).collect()).into_any()
            }
            DataType::Dictionary(_, _) => {
                let texts = column.as_dictionary::<Int32Type>();
                let words = texts.downcast_dict::<StringArray>();
                let words: Vec<Option<&str>> = words.map(|words| words.into_iter().collect()).unwrap_or_default();
                words.into_pyobject(py)?.into_any()
            }
            _ => column.as_string::<i32>().iter().collect::<Vec<_>>().into_pyobject(py)?.into_any(),
        })
    }

    /// The columns as a stream of Arrow.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // The interface lets a producer give its own types where it cannot give those.
        drop(requested_schema);
        let batches = RecordBatchIterator::new([Ok(self.batch.clone())], self.batch.schema());
        PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(batches)), c"arrow_array_stream")
    }
}

/// A column of numpy.
#[derive(FromPyObject)]
pub(crate) enum Given<'py> {
    /// Numbers; NaN is missing.
    Numbers(PyReadonlyArray1<'py, f64>),
    /// Whole numbers.
    Whole(PyReadonlyArray1<'py, i64>),
    /// Nanoseconds since 1970, of which the least number is missing, and the word `ns`.
    Nanoseconds(PyReadonlyArray1<'py, i64>, String),
    /// Words, and for each row the index of its word; -1 is missing.
    Words(PyReadonlyArray1<'py, i32>, Vec<String>),
}

impl Given<'_> {
    fn array(&self) -> PyResult<ArrayRef> {
        Ok(match self {
            Self::Numbers(values) => Arc::new(Float64Array::from(values.as_slice()?.to_vec())),
            Self::Whole(values) => Arc::new(Int64Array::from(values.as_slice()?.to_vec())),
            Self::Nanoseconds(_, unit) if unit != "ns" => {
                return Err(raised(wildpoint::error::Error::usage(format!("unit {unit}"), "give nanoseconds, ns")));
            }
            Self::Nanoseconds(ns, _) => {
                let ns = ns.as_slice()?;
                let present: NullBuffer = ns.iter().map(|ns| *ns != i64::MIN).collect();
                Arc::new(TimestampNanosecondArray::new(ns.to_vec().into(), Some(present)))
            }
            Self::Words(codes, words) => {
                let codes = codes.as_slice()?.iter().map(|code| Some(*code).filter(|code| *code >= 0));
                let words = Arc::new(StringArray::from_iter_values(words));
                Arc::new(DictionaryArray::<Int32Type>::try_new(codes.collect(), words).map_err(refused)?)
            }
        })
    }
}

/// A table of columns of numpy.
#[pyfunction]
pub(crate) fn columns(names: Vec<String>, given: Vec<Given<'_>>) -> PyResult<Columns> {
    let arrays: Vec<ArrayRef> = given.iter().map(Given::array).collect::<PyResult<_>>()?;
    let fields = names.iter().zip(&arrays).map(|(name, array)| Field::new(name, array.data_type().clone(), true));
    let schema = Arc::new(Schema::new(fields.collect::<Vec<_>>()));
    Ok(Columns { batch: RecordBatch::try_new(schema, arrays).map_err(refused)? })
}
