//! Which columns of the stream are time, track and channels.

use arrow_schema::{DataType, Schema};
use wildpoint_record::error::{Error, Result, one_of};
use wildpoint_record::session::archive::Template;

/// The places of the columns.
#[derive(Debug)]
pub(crate) struct Layout {
    /// None: the number of the row in its track, one a second.
    pub(crate) time: Option<usize>,
    /// None: all rows are one track.
    pub(crate) track: Option<usize>,
    /// Every column that the session needs.
    pub(crate) values: Vec<Named>,
    /// Nanoseconds in one unit of a time that is a number.
    pub(crate) unit_ns: i64,
}

/// A column by its name.
#[derive(Debug)]
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) index: usize,
}

/// What the session calls the number of the row.
const SAMPLE: &str = "sample";

impl Layout {
    pub(crate) fn of(schema: &Schema, template: &Template) -> Result<Self> {
        let time = match template.time() {
            Some(SAMPLE) if schema.index_of(SAMPLE).is_err() => None,
            Some(name) => Some(place(schema, name, "the time (--time names another)")?),
            None => {
                let help = one_of("name it with --time; columns", "", &names(schema));
                return Err(Error::usage("the session does not name the column of the time", help));
            }
        };
        let track =
            template.track().map(|name| place(schema, name, "the track (--track names another)")).transpose()?;
        let named = |name: &str| -> Result<Named> {
            let index = place(schema, name, "a channel of the session")?;
            let kind = schema.field(index).data_type();
            if !kind.is_numeric() && *kind != DataType::Null {
                return Err(Error::usage(format!("{name}: {kind} is no number"), "cast the column to a number"));
            }
            Ok(Named { name: name.to_owned(), index })
        };
        let values = template.columns().into_iter().map(named).collect::<Result<_>>()?;
        if let Some(index) = time {
            timed(schema, index)?;
        }
        let unit_ns = template.unit_of(time.map_or(SAMPLE, |index| schema.field(index).name()));
        Ok(Self { time, track, values, unit_ns })
    }
}

fn timed(schema: &Schema, index: usize) -> Result<()> {
    let field = schema.field(index);
    let kind = field.data_type();
    let temporal = kind.is_temporal() && !matches!(kind, DataType::Interval(_));
    if temporal || kind.is_integer() || kind.is_floating() {
        return Ok(());
    }
    let what = format!("{}: {kind} is no time", field.name());
    Err(Error::usage(what, "cast the column to a timestamp or to a number"))
}

fn names(schema: &Schema) -> Vec<&str> {
    schema.fields().iter().map(|field| field.name().as_str()).collect()
}

fn place(schema: &Schema, name: &str, role: &str) -> Result<usize> {
    let mut found = (0..schema.fields().len()).filter(|at| schema.field(*at).name() == name);
    let missing = || Error::usage(format!("{name}: no such column, {role}"), one_of("columns", name, &names(schema)));
    let index = found.next().ok_or_else(missing)?;
    match found.next() {
        None => Ok(index),
        Some(_) => Err(Error::usage(format!("{name}: two columns have this name"), "rename one of them")),
    }
}
