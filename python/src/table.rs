//! Tables with one track or many.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use arrow_array::cast::AsArray as _;
use arrow_array::ffi_stream::RecordBatchStreamReader;
use arrow_array::types::Int64Type;
use arrow_array::{Array as _, ArrayRef, Int64Array, RecordBatch, RecordBatchReader as _, UInt64Array};
use arrow_pyarrow::FromPyArrow as _;
use arrow_schema::{Schema, SchemaRef};
use arrow_select::concat::concat_batches;
use arrow_select::take::{take, take_record_batch};
use pyo3::prelude::*;
use rayon::prelude::*;
use wildpoint::error::{Error, Result};
use wildpoint::session::archive::{DecisionsFor, Judged, Named, Template};
use wildpoint_kernel::{Emit, Kernel, ids, unreadable};

use crate::arrow::Columns;
use crate::errors::raised;
use crate::settings::Settings;

/// How a table is judged: by a session, or by settings for some of its channels.
#[derive(FromPyObject)]
pub(crate) enum How<'py> {
    /// Path of a session, and the id of the track that its decisions are for.
    Session(PathBuf, Option<String>),
    /// Settings, and the channels.
    Settings(PyRef<'py, Settings>, Vec<String>),
}

impl How<'_> {
    fn template(&self, columns: Named) -> Result<Template> {
        match self {
            Self::Session(path, decisions) => {
                let decisions = decisions.clone().map_or(DecisionsFor::Nobody, DecisionsFor::Track);
                Template::read(path, decisions, columns)
            }
            Self::Settings(settings, channels) => {
                Ok(Template::of_setup(&settings.setup, channels, columns, settings.prepare()))
            }
        }
    }
}

/// What goes out, by its word.
fn emit_of(word: &str) -> PyResult<Emit> {
    match word {
        "samples" => Ok(Emit::Samples),
        "flags" => Ok(Emit::Flags),
        "summary" => Ok(Emit::Summary),
        other => {
            let what = format!("emit {other}: there is no such output");
            Err(raised(Error::usage(what, "samples, flags, summary")))
        }
    }
}

/// Judges and repairs the tracks of a table, whose rows may be in any order. Of samples, the columns of the input are left
/// out unless `whole`.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "the arguments of a function of Python")]
pub(crate) fn judge(
    py: Python<'_>,
    table: &Bound<'_, PyAny>,
    how: How<'_>,
    time: Option<String>,
    track: Option<String>,
    unit_ns: Option<i64>,
    emit: &str,
    whole: bool,
) -> PyResult<Columns> {
    let emit = emit_of(emit)?;
    let template = how.template(Named { time, track, unit_ns }).map_err(raised)?;
    let reader = RecordBatchStreamReader::from_pyarrow_bound(table).map_err(|e| no_table(&e))?;
    let schema = reader.schema();
    let batches: Vec<RecordBatch> = py.detach(|| reader.collect::<std::result::Result<_, _>>()).map_err(unread)?;
    let batch = py.detach(|| judged(template, &schema, &batches, (emit, whole))).map_err(raised)?;
    Ok(Columns { batch })
}

fn no_table(e: &PyErr) -> PyErr {
    raised(Error::usage(format!("the object is no table: {e}"), "give a table of Arrow"))
}

fn unread(e: arrow_schema::ArrowError) -> PyErr {
    raised(unreadable(e))
}

fn judged(
    template: Template,
    schema: &SchemaRef,
    batches: &[RecordBatch],
    (emit, whole): (Emit, bool),
) -> Result<RecordBatch> {
    let batch = concat_batches(schema, batches).map_err(unreadable)?;
    let kernel = Kernel::new(template, schema.clone(), emit)?;
    let schema_out = kernel.schema_out()?;
    let tracks = tracks(&kernel, &batch)?;
    let parts: Vec<RecordBatch> =
        tracks.par_iter().map(|track| part(&kernel, &schema_out, track, (&batch, emit))).collect::<Result<_>>()?;
    let out = concat_batches(&schema_out, &parts).map_err(unreadable)?;
    if emit != Emit::Samples {
        return Ok(out);
    }
    let new: Vec<usize> = (if whole { 0 } else { schema.fields().len() }..schema_out.fields().len()).collect();
    let out = out.project(&new).map_err(unreadable)?;
    let order = tracks.iter().flat_map(|track| track.rows.values().iter().copied());
    let mut places = vec![0; batch.num_rows()];
    (0..).zip(order).for_each(|(place, row)| places[usize::try_from(row).unwrap_or(0)] = place);
    take_record_batch(&out, &UInt64Array::from(places)).map_err(unreadable)
}

/// The rows of a track, in the order of the table.
struct OfTrack {
    id: String,
    rows: UInt64Array,
}

/// The tracks in the order of their first rows.
fn tracks(kernel: &Kernel, batch: &RecordBatch) -> Result<Vec<OfTrack>> {
    let Some(column) = kernel.track_column() else {
        let rows = UInt64Array::from_iter_values(0..batch.num_rows() as u64);
        return Ok(vec![OfTrack { id: String::new(), rows }]);
    };
    let ids = ids(batch.column(column), batch.schema_ref().field(column).name())?;
    let mut places: HashMap<&str, usize> = HashMap::new();
    let mut found: Vec<(&str, Vec<u64>)> = Vec::new();
    for row in 0..ids.len() {
        let id = ids.value(row);
        let place = *places.entry(id).or_insert_with(|| {
            found.push((id, Vec::new()));
            found.len() - 1
        });
        found[place].1.push(row as u64);
    }
    Ok(found.into_iter().map(|(id, rows)| OfTrack { id: id.to_owned(), rows: rows.into() }).collect())
}

fn part(
    kernel: &Kernel,
    schema: &SchemaRef,
    track: &OfTrack,
    (batch, emit): (&RecordBatch, Emit),
) -> Result<RecordBatch> {
    let own = take_record_batch(batch, &track.rows).map_err(unreadable)?;
    let judged: Judged = kernel.judge(kernel.rows(track.id.clone(), &own)?)?;
    let mut columns = kernel.columns(&own, &judged)?;
    if emit == Emit::Flags {
        rows_of_table(schema, &mut columns, &track.rows)?;
    }
    RecordBatch::try_new(schema.clone(), columns).map_err(unreadable)
}

/// Counts rows from the first of the table and not of the track.
fn rows_of_table(schema: &Schema, columns: &mut [ArrayRef], rows: &UInt64Array) -> Result<()> {
    let of_table =
        Int64Array::from_iter_values(rows.values().iter().map(|row| i64::try_from(row + 1).unwrap_or(i64::MAX)));
    // The column of tracks comes before and may have any name.
    let last = |name: &str| (0..columns.len()).rev().find(|at| schema.field(*at).name() == name);
    for at in ["row", "run_start"].into_iter().filter_map(last).collect::<Vec<_>>() {
        let counted = columns[at].as_primitive::<Int64Type>();
        let places: Int64Array = counted.iter().map(|row| row.map(|row| row - 1)).collect();
        columns[at] = Arc::new(take(&of_table, &places, None).map_err(unreadable)?);
    }
    Ok(())
}
