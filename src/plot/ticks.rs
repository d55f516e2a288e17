//! Round steps along the x axis, and what stands at them.

use super::labels::{DECIMAL, round_step};
use super::view::View;
use crate::track::{Clocks, NANOSECONDS_PER_DAY, SECONDS_PER_DAY, TimeAxis, TimeFormat};

/// Which steps count as round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TickSteps {
    /// 1, 2 and 5 times powers of ten: seconds of a file's own, sample numbers.
    Decimal,
    /// Parts of minutes, hours and days: calendar times and times of day.
    Clock,
}

/// Round steps of a clock from a second to a day, in seconds.
const CLOCK: [f64; 17] = [
    1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 900.0, 1800.0, 3600.0, 7200.0, 10800.0, 21600.0,
    43200.0,
];
const DAY: f64 = SECONDS_PER_DAY;

/// The smallest round step whose labels of `label_width` columns leave room between them on `width` columns. A
/// caller needs it to give labels enough digits.
#[must_use]
pub fn tick_step(view: View, width: u16, label_width: u16, steps: TickSteps) -> f64 {
    let room = f64::from(label_width) + 3.0;
    let least = view.width() * room / f64::from(width.max(1));
    match steps {
        TickSteps::Clock if least > 1.0 => {
            let step = CLOCK.into_iter().find(|step| *step >= least);
            step.unwrap_or_else(|| if least <= DAY { DAY } else { DAY * round_step(least / DAY, &DECIMAL) })
        }
        TickSteps::Clock | TickSteps::Decimal => round_step(least, &DECIMAL),
    }
}

/// The multiples of `step` in view, where the clock shows `phase` at x = 0; at most `most` of them.
#[must_use]
pub fn ticks(view: View, step: f64, phase: f64, most: u16) -> Vec<f64> {
    if view.width() == 0.0 {
        return Vec::new();
    }
    let first = ((view.from + phase) / step).ceil();
    let x = |i: u16| (first + f64::from(i)) * step - phase;
    (0..most).map(x).take_while(|x| *x <= view.to).collect()
}

/// How times are labelled on an axis of this many columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeTicks {
    /// Which steps are round.
    pub steps: TickSteps,
    /// What the clock shows where x is 0, in seconds.
    pub phase: f64,
    /// Columns that a label takes at most.
    pub label_width: u16,
    /// The unit or zone of the labels; may be empty.
    pub unit: &'static str,
    /// Decimals that tell labels apart.
    digits: usize,
    /// True where steps are so long that labels are dates.
    dated: bool,
}

impl TimeTicks {
    /// The labels of `time` over `view` on `width` columns.
    #[must_use]
    pub fn new(time: &TimeAxis, view: View, width: u16) -> Self {
        let calendar = time.date(0.0).is_some();
        let clock = calendar || time.format == TimeFormat::Clock;
        let steps = if clock { TickSteps::Clock } else { TickSteps::Decimal };
        // Days need the date, short steps the fraction of a second.
        let step = tick_step(view, width, 12, steps);
        let digits = decimals(step);
        let label_width = if clock { 8 + if digits > 0 { digits + 1 } else { 0 } } else { 10 };
        #[expect(clippy::cast_precision_loss, reason = "the remainder of a day fits a double")]
        let phase = if clock {
            (time.origin_ns.rem_euclid(i128::from(NANOSECONDS_PER_DAY))) as f64 / 1e9
        } else {
            time.origin_ns as f64 / 1e9
        };
        let unit = match time.format {
            _ if calendar && time.clocks == Clocks::Unstated => "zone not stated",
            _ if calendar => "UTC",
            TimeFormat::Seconds => "s",
            TimeFormat::SampleNumber => "sample",
            _ => "",
        };
        let label_width = u16::try_from(label_width).unwrap_or(12);
        Self { steps, phase, label_width, unit, digits, dated: step >= DAY / 2.0 }
    }

    /// The label of an x.
    #[must_use]
    pub fn label(&self, time: &TimeAxis, x: f64) -> String {
        let date = if self.dated { time.date(x) } else { None };
        date.unwrap_or_else(|| time.label(x, self.digits))
    }

    /// The x of the labels over `view` on `width` columns.
    #[must_use]
    pub fn at(&self, view: View, width: u16) -> Vec<f64> {
        ticks(view, tick_step(view, width, self.label_width, self.steps), self.phase, width)
    }
}

/// Decimals that tell labels `step` seconds apart from each other.
fn decimals(step: f64) -> usize {
    (0..9).find(|&d| (step * 10_f64.powi(d)).fract().abs() < 1e-9).map_or(9, |d| usize::try_from(d).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clock_steps_are_those_of_a_clock_and_decimal_ones_of_a_ruler() {
        let step = |width, steps| tick_step(View { from: 0.0, to: width }, 80, 8, steps);
        assert_eq!(step(3600.0, TickSteps::Clock), 600.0);
        assert_eq!(step(3600.0, TickSteps::Decimal), 500.0);
        assert_eq!(step(10.0 * DAY, TickSteps::Clock), 2.0 * DAY);
        assert_eq!(step(0.7, TickSteps::Clock), 0.1);
    }

    #[test]
    fn ticks_are_round_on_the_clock_of_the_record() {
        // 17:57:05 at x = 0: minutes are full at 55, 115 and 175.
        assert_eq!(ticks(View { from: 0.0, to: 200.0 }, 60.0, 64_625.0, 80), [55.0, 115.0, 175.0]);
        assert_eq!(ticks(View { from: 0.0, to: 0.0 }, 60.0, 0.0, 80), [0.0; 0]);
        assert_eq!(ticks(View { from: 0.0, to: 200.0 }, 1.0, 0.0, 7).len(), 7);
    }
}
