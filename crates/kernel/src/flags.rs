//! The audit table: a row for each sample that is not normal, or that somebody decided on.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray, UInt64Array};
use arrow_schema::{DataType, Field, Schema, SchemaRef};
use arrow_select::take::take;
use wildpoint_record::error::Result;
use wildpoint_record::session::archive::{Flag, Judged};
use wildpoint_record::session::flags::{BY_CHECKS, COLUMNS};
use wildpoint_record::session::table::Column;

use crate::columns::unreadable;
use crate::layout::Layout;

/// The column of ids under its name, then those of `wildpoint clean --flags`.
pub(crate) fn schema(track: Option<&Field>, time: Option<&Field>, checks: bool) -> SchemaRef {
    let named = |column: &Column| match column.name {
        "row" => Field::new("row", DataType::Int64, false),
        "time" => time.map_or_else(|| Field::new("time", DataType::Int64, true), |f| f.clone().with_name("time")),
        "run_start" | "run_length" => Field::new(column.name, DataType::Int64, true),
        "raw" | "expected" | "tolerance" | "ratio" | "clean" => Field::new(column.name, DataType::Float64, true),
        text => Field::new(text, DataType::Utf8, true),
    };
    let mut fields: Vec<Field> = track.into_iter().cloned().collect();
    fields.extend(COLUMNS.iter().map(named));
    if checks {
        fields.extend(BY_CHECKS.iter().map(named));
    }
    Arc::new(Schema::new(fields))
}

pub(crate) fn columns(batch: &RecordBatch, judged: &Judged, layout: &Layout, checks: bool) -> Result<Vec<ArrayRef>> {
    let flags = judged.flags();
    let names: Vec<&str> = judged.channels().collect();
    let rows: UInt64Array = flags.iter().map(|flag| Some(flag.row as u64)).collect();
    let of_batch = |index: usize| take(batch.column(index), &rows, None).map_err(unreadable);
    let mut columns: Vec<ArrayRef> = layout.track.map(of_batch).transpose()?.into_iter().collect();
    columns.push(whole(&flags, |f| Some(f.evidence.row)));
    columns.push(layout.time.map_or_else(|| Ok(whole(&flags, |f| Some(f.row))), of_batch)?);
    columns.push(text(&flags, |f| Some(names[f.channel].to_owned())));
    columns.push(real(&flags, |f| Some(f.evidence.raw)));
    columns.push(text(&flags, |f| Some(f.evidence.verdict.word().to_owned())));
    let kind = |f: &Flag| f.evidence.run.map(|r| if r.length == 1 { "isolated" } else { "patch" }.to_owned());
    columns.push(text(&flags, kind));
    columns.push(whole(&flags, |f| f.evidence.run.map(|r| r.start)));
    columns.push(whole(&flags, |f| f.evidence.run.map(|r| r.length)));
    columns.push(real(&flags, |f| f.expected));
    columns.push(real(&flags, |f| f.evidence.tolerance));
    columns.push(real(&flags, |f| f.evidence.ratio()));
    columns.push(text(&flags, |f| f.evidence.forward.map(|d| d.word().to_owned())));
    columns.push(text(&flags, |f| f.evidence.backward.map(|d| d.word().to_owned())));
    columns.push(real(&flags, |f| f.evidence.clean));
    columns.push(text(&flags, |f| Some(f.evidence.action().to_owned())));
    columns.push(text(&flags, |f| Some(f.evidence.decided_by().to_owned())));
    columns.push(text(&flags, |f| Some(f.evidence.note.clone()).filter(|note| !note.is_empty())));
    if checks {
        columns.push(text(&flags, |f| Some(f.by.clone()).filter(|by| !by.is_empty())));
        columns.push(text(&flags, |f| f.evidence.objected.as_ref().map(|o| o.evidence.clone())));
    }
    Ok(columns)
}

fn text(flags: &[Flag], of: impl Fn(&Flag) -> Option<String>) -> ArrayRef {
    Arc::new(flags.iter().map(of).collect::<StringArray>())
}

fn real(flags: &[Flag], of: impl Fn(&Flag) -> Option<f64>) -> ArrayRef {
    Arc::new(flags.iter().map(|flag| of(flag).filter(|value| value.is_finite())).collect::<Float64Array>())
}

fn whole(flags: &[Flag], of: impl Fn(&Flag) -> Option<usize>) -> ArrayRef {
    Arc::new(flags.iter().map(|flag| of(flag).and_then(|n| i64::try_from(n).ok())).collect::<Int64Array>())
}
