//! How the columns of a text are stored, by all their cells.

use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, TimeUnit, Type as Physical};
use parquet::errors::Result as ParquetResult;
use parquet::schema::types::{Type, TypePtr};

use super::super::super::number::{Cell, Reading};
use super::super::super::{Column, ColumnKind, Track, for_each_row};
use crate::error::Result;

/// How a column is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ColumnForm {
    Double,
    Whole,
    Text,
    /// A time of a calendar.
    Timestamp {
        utc: bool,
        nanos: bool,
    },
    /// Another time, in the file's own numbers or else in seconds.
    Time,
}

/// A value, as it is stored.
pub(super) enum Stored {
    Nothing,
    Double(f64),
    Whole(i64),
    Text(Vec<u8>),
}

impl ColumnForm {
    pub(super) fn field(self, name: &str) -> ParquetResult<TypePtr> {
        let (physical, logical) = match self {
            Self::Double | Self::Time => (Physical::DOUBLE, None),
            Self::Whole => (Physical::INT64, None),
            Self::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
            Self::Timestamp { utc, nanos } => {
                let unit = if nanos { TimeUnit::NANOS } else { TimeUnit::MICROS };
                (Physical::INT64, Some(LogicalType::timestamp(utc, unit)))
            }
        };
        let field = Type::primitive_type_builder(name, physical).with_repetition(Repetition::OPTIONAL);
        field.with_logical_type(logical).build().map(Arc::new)
    }

    /// What a text is in the column.
    pub(super) fn value(self, text: &str, reading: &Reading) -> Stored {
        let cell = || reading.cell(text.trim().as_bytes());
        match self {
            Self::Text if text.is_empty() => Stored::Nothing,
            Self::Text => Stored::Text(text.as_bytes().to_vec()),
            Self::Whole => text.trim().parse().map_or(Stored::Nothing, Stored::Whole),
            Self::Double | Self::Time => match cell() {
                Cell::Number(number) => Stored::Double(number),
                Cell::Missing | Cell::Infinite | Cell::Text => Stored::Nothing,
            },
            Self::Timestamp { .. } => Stored::Nothing,
        }
    }
}

/// How each column is stored, by all its cells.
pub(super) fn forms(track: &Track) -> Result<Vec<ColumnForm>> {
    let reading = Reading::new(track.dialect.decimal_comma, &track.dialect.missing);
    let mut looks = vec![Looks::default(); track.columns.len()];
    let (mut zoned, mut fine) = (false, false);
    for_each_row(track, |_, cells| {
        for (place, look) in looks.iter_mut().enumerate() {
            look.add(&cells.text(place), &reading);
        }
        if let Some(column) = track.time.column {
            let text = cells.text(column);
            zoned |= text.contains(':') && names_zone(&text);
            fine |= text
                .find(['.', ','])
                .is_some_and(|at| text[at + 1..].bytes().take_while(u8::is_ascii_digit).count() > 6);
        }
        Ok(())
    })?;
    let time = &track.time;
    let absolute = zoned || time.zone.is_some() || time.is_absolute();
    let form = |(place, (column, look)): (usize, (&Column, &Looks))| match column.kind {
        ColumnKind::Time if time.column == Some(place) && time.is_calendar() => {
            ColumnForm::Timestamp { utc: absolute, nanos: fine || time.counts_nanoseconds() }
        }
        ColumnKind::Time if time.column == Some(place) => ColumnForm::Time,
        ColumnKind::Number => ColumnForm::Double,
        _ if look.whole() => ColumnForm::Whole,
        ColumnKind::Aside(_) | ColumnKind::Truth if look.texts == 0 && look.numbers > 0 => ColumnForm::Double,
        _ => ColumnForm::Text,
    };
    Ok(track.columns.iter().zip(&looks).enumerate().map(form).collect())
}

/// True for a time that ends with its zone.
fn names_zone(text: &str) -> bool {
    let clock = text.rsplit_once(':').map_or("", |(_, after)| after);
    let signed = text.rfind(['+', '-']).is_some_and(|at| text[..at].contains(':'));
    signed || clock.trim().ends_with(|c: char| c.is_ascii_alphabetic() && !matches!(c, 'M' | 'm'))
}

/// What the cells of a column look like.
#[derive(Debug, Clone, Default)]
struct Looks {
    /// Whole numbers that are written as short as they can be.
    wholes: usize,
    numbers: usize,
    texts: usize,
}

impl Looks {
    fn add(&mut self, text: &str, reading: &Reading) {
        match reading.cell(text.trim().as_bytes()) {
            Cell::Missing => {}
            Cell::Number(_) if text.parse::<i64>().is_ok_and(|n| n.to_string() == text) => self.wholes += 1,
            // Zeros that no number needs belong to a name.
            Cell::Number(_) if matches!(text.trim().as_bytes(), [b'0', b'0'..=b'9', ..]) => self.texts += 1,
            Cell::Number(_) => self.numbers += 1,
            Cell::Infinite | Cell::Text => self.texts += 1,
        }
    }

    fn whole(&self) -> bool {
        self.wholes > 0 && self.numbers + self.texts == 0
    }
}
