//! The sentences that are read, and what stands in their cells.

use super::date_of_six;
use crate::track::calendar::Date;
use crate::track::view::{Piece, Spelling};

/// A quantity in a cell of a sentence.
#[derive(Debug, PartialEq)]
pub(super) struct Quantity {
    /// Its cell, from 0 for the name of the sentence.
    pub(super) cell: usize,
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    pub(super) spelling: Spelling,
    /// True for what is no measurement.
    pub(super) aside: bool,
}

/// A kind of sentence.
pub(super) struct Sentence {
    pub(super) kind: &'static str,
    /// The cell of the clock, where it has one.
    pub(super) clock: Option<usize>,
    /// The date in days since 1970, where it tells one.
    pub(super) date: fn(&[Piece<'_>]) -> Option<i64>,
    pub(super) quantities: &'static [Quantity],
}

impl PartialEq for Sentence {
    fn eq(&self, other: &Self) -> bool {
        self.kind == other.kind
    }
}

const fn number(cell: usize, name: &'static str, unit: &'static str) -> Quantity {
    Quantity { cell, name, unit, spelling: Spelling::Number, aside: false }
}

const fn latitude(cell: usize) -> Quantity {
    Quantity { cell, name: "latitude", unit: "deg", spelling: Spelling::Latitude, aside: false }
}

const fn longitude(cell: usize) -> Quantity {
    Quantity { cell, name: "longitude", unit: "deg", spelling: Spelling::Longitude, aside: false }
}

const fn quality(cell: usize, name: &'static str) -> Quantity {
    Quantity { cell, name, unit: "", spelling: Spelling::Number, aside: true }
}

pub(super) const SENTENCES: [Sentence; 6] = [
    Sentence {
        kind: "GGA",
        clock: Some(1),
        date: |_| None,
        quantities: &[
            latitude(2),
            longitude(4),
            quality(6, "quality"),
            quality(7, "satellites"),
            number(8, "hdop", ""),
            number(9, "altitude", "m"),
            number(11, "geoid_separation", "m"),
        ],
    },
    Sentence {
        kind: "RMC",
        clock: Some(1),
        date: |cells| date_of_six(cells.get(9)?.text()),
        quantities: &[latitude(3), longitude(5), number(7, "speed", "kt"), number(8, "course", "deg")],
    },
    Sentence {
        kind: "VTG",
        clock: None,
        date: |_| None,
        quantities: &[
            number(1, "course", "deg"),
            number(3, "course_magnetic", "deg"),
            number(5, "speed", "kt"),
            number(7, "speed_kmh", "km/h"),
        ],
    },
    Sentence {
        kind: "GST",
        clock: Some(1),
        date: |_| None,
        quantities: &[
            number(2, "residual_rms", "m"),
            number(3, "semi_major", "m"),
            number(4, "semi_minor", "m"),
            number(5, "orientation", "deg"),
            number(6, "latitude_sd", "m"),
            number(7, "longitude_sd", "m"),
            number(8, "altitude_sd", "m"),
        ],
    },
    Sentence { kind: "GLL", clock: Some(5), date: |_| None, quantities: &[latitude(1), longitude(3)] },
    Sentence { kind: "ZDA", clock: Some(1), date: date_of_zda, quantities: &[] },
];

/// Day, month and year in cells of their own.
fn date_of_zda(cells: &[Piece<'_>]) -> Option<i64> {
    let whole = |at: usize| cells.get(at)?.text().parse::<i64>().ok();
    Date { year: whole(4)?, month: whole(3)?, day: whole(2)? }.days()
}
