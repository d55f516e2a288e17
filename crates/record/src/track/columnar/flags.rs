//! Columns of flags.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArrayType, Int32Type};
use parquet::errors::Result;
use parquet::schema::types::{ColumnDescPtr, Type, TypePtr};

use super::encode::{Encoded, Form, encode};
use super::recode::Levelled;

/// The column of flags of this name.
pub(super) fn field(name: &str, whole: bool) -> Result<TypePtr> {
    let (physical, logical) = if whole {
        (Physical::INT32, LogicalType::integer(8, true))
    } else {
        (Physical::BYTE_ARRAY, LogicalType::String)
    };
    let field = Type::primitive_type_builder(name, physical)
        .with_repetition(Repetition::REQUIRED)
        .with_logical_type(Some(logical));
    field.build().map(Arc::new)
}

/// A chunk of flags.
pub(super) fn encoded<'a>(
    column: ColumnDescPtr,
    form: &Form,
    whole: bool,
    texts: impl Iterator<Item = &'a str>,
) -> Result<Encoded> {
    if whole {
        let values = texts.map(|text| text.parse().unwrap_or_default()).collect();
        encode(column, form, &Levelled::<Int32Type>::required(values))
    } else {
        let values = texts.map(|text| text.as_bytes().to_vec().into()).collect();
        encode(column, form, &Levelled::<ByteArrayType>::required(values))
    }
}
