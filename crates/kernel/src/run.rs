//! From the stream that comes in to the one that goes out.

use std::io::{Read, Write};

use arrow_ipc::reader::StreamReader;
use arrow_schema::SchemaRef;
use arrow_select::concat::concat_batches;
use wildpoint_record::error::{Error, Result};
use wildpoint_record::session::archive::{DecisionsFor, Judged, Named, Template};

use crate::args::{Args, Emit};
use crate::columns::{rows, unreadable};
use crate::layout::Layout;
use crate::output::Output;
use crate::tracks::{Complete, Tracks};
use crate::{flags, samples, summary};

/// What is needed to judge a track.
struct Kernel {
    template: Template,
    layout: Layout,
    schema: SchemaRef,
    emit: Emit,
}

pub(crate) fn run(args: &Args, input: impl Read, out: impl Write) -> Result<()> {
    let decisions = args.decisions.clone().map_or(DecisionsFor::Nobody, DecisionsFor::Track);
    let columns =
        Named { time: args.time.clone(), track: args.track.clone(), unit_ns: args.time_unit.map(|unit| unit.ns()) };
    let template = Template::read(&args.session, decisions, columns)?;
    let reader = StreamReader::try_new(input, None).map_err(unreadable)?;
    let schema = reader.schema();
    let layout = Layout::of(&schema, &template)?;
    let kernel = Kernel { template, layout, schema, emit: args.emit };
    let mut output = Output::new(out, &kernel.schema_out()?)?;
    let mut tracks = Tracks::told_apart_by(kernel.layout.track);
    for batch in reader {
        let batch = batch.map_err(unreadable)?;
        tracks.take(&batch, |track| kernel.one(track, &mut output))?;
    }
    if let Some(track) = tracks.close() {
        kernel.one(track, &mut output)?;
    }
    output.finish()
}

impl Kernel {
    fn schema_out(&self) -> Result<SchemaRef> {
        let track = self.layout.track.map(|index| self.schema.field(index));
        Ok(match self.emit {
            Emit::Samples => samples::schema(&self.schema, &self.template)?,
            Emit::Flags => {
                flags::schema(track, self.layout.time.map(|index| self.schema.field(index)), self.template.checks())
            }
            Emit::Summary => summary::schema(),
        })
    }

    fn one(&self, track: Complete, output: &mut Output<impl Write>) -> Result<()> {
        let batch = concat_batches(&self.schema, &track.pieces).map_err(unreadable)?;
        drop(track.pieces);
        let rows = rows(track.id, &batch, &self.layout)?;
        if let Some(row) = rows.first_backward() {
            let of = if rows.track.is_empty() { String::new() } else { format!("track {}: ", rows.track) };
            let what = format!("{of}the time of row {} lies before that of an earlier row", row + 1);
            return Err(Error::usage(what, "sort the rows of each track by time"));
        }
        let judged = self.template.judge(rows)?;
        self.emitted(&batch, &judged, output)
    }

    fn emitted(
        &self,
        batch: &arrow_array::RecordBatch,
        judged: &Judged,
        output: &mut Output<impl Write>,
    ) -> Result<()> {
        match self.emit {
            Emit::Samples => output.write(samples::columns(batch, judged)),
            Emit::Flags => output.write(flags::columns(batch, judged, &self.layout, self.template.checks())?),
            Emit::Summary => output.write(summary::columns(judged)),
        }
    }
}
