//! Results as other programs read them: verdicts and methods by their words, numbers that are not there as null.

use serde::ser::{Serialize, SerializeStruct, Serializer};

use super::{Detection, Objected, Outcome};

/// A sample that a check objects to.
#[derive(serde::Serialize)]
struct Checked {
    position: usize,
    by: &'static str,
    evidence: String,
}

impl Serialize for Detection {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let tolerance: Vec<Option<f64>> = (0..self.judged.verdict().len()).map(|i| self.judged.tolerance(i)).collect();
        let checked = |position: usize| {
            self.objected(position).map(|Objected { by, evidence }| Checked { position, by, evidence })
        };
        let checked: Vec<Checked> = self.checked().filter_map(checked).collect();
        let mut out = serializer.serialize_struct("Detection", 6)?;
        out.serialize_field("setup", &self.setup)?;
        out.serialize_field("segments", &self.segments)?;
        out.serialize_field("verdict", self.judged.verdict())?;
        out.serialize_field("expected", self.judged.expected())?;
        out.serialize_field("tolerance", &tolerance)?;
        out.serialize_field("checked", &checked)?;
        out.end()
    }
}

impl Serialize for Outcome {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut out = serializer.serialize_struct("Outcome", 7)?;
        out.serialize_field("detection", &*self.detection)?;
        out.serialize_field("marks", &self.marks)?;
        out.serialize_field("outliers", &self.outliers)?;
        out.serialize_field("fixes", &self.fixes)?;
        out.serialize_field("runs", &self.runs)?;
        out.serialize_field("fills", &self.fills)?;
        out.serialize_field("counts", &self.counts)?;
        out.end()
    }
}
