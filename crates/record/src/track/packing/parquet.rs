//! Parquet.

use super::super::columnar::{known, unpack};
use super::{Form, Packing};

pub(super) const PACKING: Packing =
    Packing { name: "Parquet", ending: ".parquet", known, tool: "", joins: false, unpack, form: Form::Columns };
