//! Which time the rows of an Android GNSS log have.

use super::{Kind, cell};
use crate::track::calendar::{DAY, Date};
use crate::track::view::{Cell, Field, Piece, stamp};

/// Columns that are times, the best first where they are as fine as each other.
const COLUMNS: [(&str, &str); 8] = [
    ("UnixTimeMillis", "ms"),
    ("utcTimeMillis", "ms"),
    ("(UTC)TimeInMs", "ms"),
    ("elapsedRealtimeNanos", "ns"),
    ("ElapsedRealtimeNanos", "ns"),
    ("TimeNanos", "ns"),
    ("ChipsetElapsedRealtimeNanos", "ns"),
    ("ElapsedRealtimeMillis", "ms"),
];

/// True for the name of a time.
pub(super) fn is_time(name: &str) -> bool {
    COLUMNS.iter().any(|(column, _)| *column == name)
}

/// Where the time of a row comes from.
pub(super) enum Times {
    /// GPS time: that of the receiver's clock without its biases, which stand in these columns.
    Gps { clock: usize, full_bias: usize, bias: Option<usize> },
    /// A column.
    Column { at: usize, name: &'static str, unit: &'static str },
    /// There is none.
    None,
}

impl Times {
    pub(super) fn of(kind: &Kind, rows: &[&[Piece<'_>]]) -> Self {
        let find = |name: &str| kind.columns.iter().position(|c| c == name);
        if let (Some(clock), Some(full_bias)) = (find("TimeNanos"), find("FullBiasNanos")) {
            let gps = Self::Gps { clock, full_bias, bias: find("BiasNanos") };
            if rows.iter().all(|row| gps.moment(row).is_some()) {
                return gps;
            }
            // Other clocks tell when the row was written.
            return Self::Column { at: clock, name: "TimeNanos", unit: "ns" };
        }
        let steps = |at: usize| rows.windows(2).filter(|w| text(w[0], at) != text(w[1], at)).count();
        let mut best: Option<(usize, Self)> = None;
        for (name, unit) in COLUMNS {
            let Some(at) = find(name) else { continue };
            let steps = steps(at);
            if best.as_ref().is_none_or(|(most, _)| steps > *most) {
                best = Some((steps, Self::Column { at, name, unit }));
            }
        }
        best.map_or(Self::None, |(_, times)| times)
    }

    /// Nanoseconds since the zero of GPS time.
    fn moment(&self, row: &[Piece<'_>]) -> Option<i64> {
        let Self::Gps { clock, full_bias, bias } = self else { return None };
        let full: i64 = text(row, *full_bias).parse().ok().filter(|ns| *ns != 0)?;
        let bias = bias.and_then(|at| text(row, at).parse::<f64>().ok()).filter(|b| b.abs() < 1e12).unwrap_or(0.0);
        #[expect(clippy::cast_possible_truncation, reason = "checked")]
        let bias = bias.round() as i64;
        text(row, *clock).parse::<i64>().ok()?.checked_sub(full)?.checked_sub(bias).filter(|ns| *ns >= 0)
    }

    pub(super) fn field(&self) -> Field {
        match self {
            Self::Gps { .. } => Field::new("GpsTime", ""),
            Self::Column { name, unit, .. } => Field::new(*name, unit),
            Self::None => Field::new("row", ""),
        }
    }

    pub(super) fn said(&self) -> Option<String> {
        matches!(self, Self::Gps { .. }).then(|| {
            "`GpsTime` is TimeNanos without the biases of the clock: GPS time, ahead of UTC by the leap seconds".into()
        })
    }

    /// True for the column that is the time.
    pub(super) fn is(&self, column: usize) -> bool {
        matches!(self, Self::Column { at, .. } if *at == column)
    }

    pub(super) fn cell(&self, row: &[Piece<'_>]) -> Cell {
        let zero = Date { year: 1980, month: 1, day: 6 }.days().unwrap_or(0);
        match self {
            Self::Gps { .. } => {
                Cell::Made(self.moment(row).map_or_else(String::new, |ns| stamp(zero + ns / DAY, ns % DAY)))
            }
            Self::Column { at, .. } => row.get(*at).map_or_else(|| Cell::Made(String::new()), cell),
            Self::None => Cell::Made(String::new()),
        }
    }

    /// What is the same in all rows of one epoch.
    pub(super) fn epoch<'a>(&self, row: &[Piece<'a>]) -> &'a str {
        match self {
            Self::Gps { clock: at, .. } | Self::Column { at, .. } => text(row, *at),
            Self::None => "",
        }
    }
}

fn text<'a>(row: &[Piece<'a>], at: usize) -> &'a str {
    row.get(at).map_or("", |piece| piece.text())
}
