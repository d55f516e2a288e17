//! The stream that goes out.

use std::io::Write;

use arrow_array::{ArrayRef, RecordBatch};
use arrow_ipc::writer::StreamWriter;
use arrow_schema::{ArrowError, SchemaRef};
use wildpoint_record::error::{Error, Result};

/// Writes batches of one schema.
pub(crate) struct Output<W: Write> {
    writer: StreamWriter<std::io::BufWriter<W>>,
    schema: SchemaRef,
}

fn unwritable(e: ArrowError) -> Error {
    let source = match e {
        ArrowError::IoError(_, source) => source,
        other => std::io::Error::other(other.to_string()),
    };
    Error::Io { action: "write", path: "standard output".into(), source }
}

impl<W: Write> Output<W> {
    pub(crate) fn new(out: W, schema: &SchemaRef) -> Result<Self> {
        let writer = StreamWriter::try_new_buffered(out, schema).map_err(unwritable)?;
        Ok(Self { writer, schema: schema.clone() })
    }

    pub(crate) fn write(&mut self, columns: Vec<ArrayRef>) -> Result<()> {
        let batch = RecordBatch::try_new(self.schema.clone(), columns).map_err(unwritable)?;
        self.writer.write(&batch).map_err(unwritable)
    }

    pub(crate) fn finish(mut self) -> Result<()> {
        self.writer.finish().map_err(unwritable)
    }
}
