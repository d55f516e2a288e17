//! Counts and digest of each channel of a track.

use std::sync::Arc;

use arrow_array::{ArrayRef, Int64Array, StringArray};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use wildpoint_record::session::archive::{Judged, SUMMARY_COLUMNS, Summary};

/// The columns of a summary, and the line of it that the digest of the archive is made of.
pub(crate) fn schema() -> SchemaRef {
    let field = |name: &&str| {
        let text = matches!(*name, "track" | "channel" | "digest");
        Field::new(*name, if text { DataType::Utf8 } else { DataType::Int64 }, false)
    };
    let mut fields: Vec<Field> = SUMMARY_COLUMNS.iter().map(field).collect();
    fields.push(Field::new("line", DataType::Utf8, false));
    Arc::new(Schema::new(fields))
}

pub(crate) fn columns(judged: &Judged) -> Vec<ArrayRef> {
    let all: Vec<Summary> = (0..judged.channels().len()).map(|channel| judged.summary(channel)).collect();
    let text = |of: &dyn Fn(&Summary) -> String| -> ArrayRef {
        Arc::new(all.iter().map(|summary| Some(of(summary))).collect::<StringArray>())
    };
    let mut columns = vec![text(&|s| s.track.clone()), text(&|s| s.channel.clone())];
    let numbers: Vec<_> = all.iter().map(Summary::numbers).collect();
    for at in 0..numbers.first().map_or(0, |of| of.len()) {
        let column = numbers.iter().map(|of| i64::try_from(of[at]).unwrap_or(i64::MAX));
        columns.push(Arc::new(column.map(Some).collect::<Int64Array>()));
    }
    columns.push(text(&|s| s.digest.clone()));
    columns.push(text(&|s| s.line()));
    columns
}
