//! From the stream that comes in to the one that goes out.

use std::io::{Read, Write};

use arrow_ipc::reader::StreamReader;
use arrow_schema::SchemaRef;
use arrow_select::concat::concat_batches;
use wildpoint_kernel::{Kernel, unreadable};
use wildpoint_record::error::{Error, Result};
use wildpoint_record::session::archive::{DecisionsFor, Named, Template};

use crate::args::Args;
use crate::output::Output;
use crate::tracks::{Complete, Tracks};

pub(crate) fn run(args: &Args, input: impl Read, out: impl Write) -> Result<()> {
    let decisions = args.decisions.clone().map_or(DecisionsFor::Nobody, DecisionsFor::Track);
    let columns =
        Named { time: args.time.clone(), track: args.track.clone(), unit_ns: args.time_unit.map(|unit| unit.ns()) };
    let template = Template::read(&args.session, decisions, columns)?;
    let reader = StreamReader::try_new(input, None).map_err(unreadable)?;
    let schema = reader.schema();
    let kernel = Kernel::new(template, schema.clone(), args.emit)?;
    let mut output = Output::new(out, &kernel.schema_out()?)?;
    let mut tracks = Tracks::told_apart_by(kernel.track_column());
    for batch in reader {
        let batch = batch.map_err(unreadable)?;
        tracks.take(&batch, |track| one(&kernel, &schema, track, &mut output))?;
    }
    if let Some(track) = tracks.close() {
        one(&kernel, &schema, track, &mut output)?;
    }
    output.finish()
}

fn one(kernel: &Kernel, schema: &SchemaRef, track: Complete, output: &mut Output<impl Write>) -> Result<()> {
    let batch = concat_batches(schema, &track.pieces).map_err(unreadable)?;
    drop(track.pieces);
    let rows = kernel.rows(track.id, &batch)?;
    if let Some(row) = rows.first_backward() {
        let of = if rows.track.is_empty() { String::new() } else { format!("track {}: ", rows.track) };
        let what = format!("{of}the time of row {} lies before that of an earlier row", row + 1);
        return Err(Error::usage(what, "sort the rows of each track by time"));
    }
    let judged = kernel.judge(rows)?;
    output.write(kernel.columns(&batch, &judged)?)
}
