//! The rows of the input with what holds for each channel.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use wildpoint_record::error::{Error, Result};
use wildpoint_record::session::archive::{Judged, Template};

/// The columns of the input, then `CHANNEL_verdict` (a word) and `CHANNEL_clean` for each channel. Words, because not
/// every engine has small whole numbers.
pub(crate) fn schema(input: &Schema, template: &Template) -> Result<SchemaRef> {
    let mut fields: Vec<Field> = input.fields().iter().map(|field| field.as_ref().clone()).collect();
    for channel in template.channels() {
        fields.push(Field::new(format!("{channel}_verdict"), DataType::Utf8, false));
        fields.push(Field::new(format!("{channel}_clean"), DataType::Float64, true));
    }
    let twice = |at: &usize| fields[..*at].iter().any(|field| field.name() == fields[*at].name());
    if let Some(at) = (input.fields().len()..fields.len()).find(twice) {
        let what = format!("{}: the stream has such a column already", fields[at].name());
        return Err(Error::usage(what, "leave it out of the stream, or rename it"));
    }
    Ok(Arc::new(Schema::new_with_metadata(fields, input.metadata().clone())))
}

pub(crate) fn columns(batch: &RecordBatch, judged: &Judged) -> Vec<ArrayRef> {
    let mut columns = batch.columns().to_vec();
    for channel in 0..judged.channels().len() {
        let samples = judged.samples(channel);
        let words: StringArray = samples.verdicts.iter().map(|verdict| Some(verdict.word())).collect();
        let clean: Float64Array = samples.clean.iter().map(|value| Some(*value).filter(|v| v.is_finite())).collect();
        columns.push(Arc::new(words));
        columns.push(Arc::new(clean));
    }
    columns
}
