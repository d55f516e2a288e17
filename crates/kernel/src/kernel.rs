//! Tracks in, tracks judged.

use arrow_array::{ArrayRef, RecordBatch};
use arrow_schema::SchemaRef;
use wildpoint_record::error::Result;
use wildpoint_record::session::archive::{Judged, Rows, Template};

use crate::columns::rows;
use crate::layout::Layout;
use crate::{Emit, flags, samples, summary};

/// What is needed to judge tracks with the columns of one schema.
#[derive(Debug)]
pub struct Kernel {
    template: Template,
    layout: Layout,
    schema: SchemaRef,
    emit: Emit,
}

impl Kernel {
    /// A kernel for tracks with the columns of `schema`.
    ///
    /// # Errors
    /// [`wildpoint_record::error::Error::Usage`] when a column of time, of tracks or of a channel is not there, or is no such thing.
    pub fn new(template: Template, schema: SchemaRef, emit: Emit) -> Result<Self> {
        let layout = Layout::of(&schema, &template)?;
        Ok(Self { template, layout, schema, emit })
    }

    /// Index of the column that tells tracks apart; none where all rows are one track.
    #[must_use]
    pub fn track_column(&self) -> Option<usize> {
        self.layout.track
    }

    /// The session.
    #[must_use]
    pub fn template(&self) -> &Template {
        &self.template
    }

    /// The columns that go out.
    ///
    /// # Errors
    /// [`wildpoint_record::error::Error::Usage`] when a column that is added is there already.
    pub fn schema_out(&self) -> Result<SchemaRef> {
        let track = self.layout.track.map(|index| self.schema.field(index));
        Ok(match self.emit {
            Emit::Samples => samples::schema(&self.schema, &self.template)?,
            Emit::Flags => {
                flags::schema(track, self.layout.time.map(|index| self.schema.field(index)), self.template.checks())
            }
            Emit::Summary => summary::schema(),
        })
    }

    /// The rows of a track, with the columns that the session needs.
    ///
    /// # Errors
    /// [`wildpoint_record::error::Error::Input`] for a column that is not numbers.
    pub fn rows(&self, track: String, batch: &RecordBatch) -> Result<Rows> {
        rows(track, batch, &self.layout)
    }

    /// Judges and repairs a track, whose rows may be in any order.
    ///
    /// # Errors
    /// As [`Template::judge`].
    pub fn judge(&self, rows: Rows) -> Result<Judged> {
        self.template.judge(rows)
    }

    /// What goes out for a track: the columns of [`Kernel::schema_out`], of which those of the input are those of
    /// `batch`.
    ///
    /// # Errors
    /// [`wildpoint_record::error::Error::Input`] for columns that cannot be cut.
    pub fn columns(&self, batch: &RecordBatch, judged: &Judged) -> Result<Vec<ArrayRef>> {
        Ok(match self.emit {
            Emit::Samples => samples::columns(batch, judged),
            Emit::Flags => flags::columns(batch, judged, &self.layout, self.template.checks())?,
            Emit::Summary => summary::columns(judged),
        })
    }
}
