//! The present samples of the channels of a record.

use std::sync::OnceLock;

use super::{Channel, Series, TimeAxis};

/// What a [`Series`] has to remember of a channel so that it can be looked at again at no cost: nothing but the
/// interval when every row is present, otherwise copies of the present samples.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples(OnceLock<Remembered>);

#[derive(Debug, Clone, PartialEq)]
struct Remembered {
    present: Option<Series<'static>>,
    interval: f64,
}

impl Samples {
    /// The present samples of `channel`.
    #[must_use]
    pub fn of(channel: &Channel, time: &TimeAxis) -> Self {
        Self(OnceLock::from(Remembered::of(channel, time)))
    }

    /// The samples of a channel that perhaps nobody looks at: nothing is remembered before somebody does.
    #[must_use]
    pub fn later() -> Self {
        Self(OnceLock::new())
    }

    /// The samples, of the channel and the times that they are made of.
    #[must_use]
    pub fn series<'a>(&'a self, channel: &'a Channel, time: &'a TimeAxis) -> Series<'a> {
        let Remembered { present, interval } = self.0.get_or_init(|| Remembered::of(channel, time));
        match present {
            None => Series::whole(&time.seconds, &channel.values, *interval),
            Some(present) => present.borrowed(),
        }
    }
}

impl Remembered {
    fn of(channel: &Channel, time: &TimeAxis) -> Self {
        let series = channel.series(time);
        let interval = series.interval;
        Self { present: series.kept(), interval }
    }
}

impl Channel {
    /// The present samples.
    #[must_use]
    pub fn series<'a>(&'a self, time: &'a TimeAxis) -> Series<'a> {
        match &self.target {
            None if time.newest_first => {
                let n = time.seconds.len().min(self.values.len());
                #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
                Series::of_pairs((0..n).rev().map(|row| (row as u32, self.values[row])), &time.seconds)
            }
            None => Series::new(&time.seconds, &self.values),
            Some(target) if time.newest_first => {
                let pairs = target.rows.iter().copied().zip(self.values.iter().copied()).rev();
                Series::of_pairs(pairs, &time.seconds)
            }
            Some(target) => Series::of_rows(&target.rows, &time.seconds, &self.values),
        }
    }

    /// Times of the first and the last present sample, in seconds; none when there is none.
    #[must_use]
    pub fn ends(&self, time: &TimeAxis) -> Option<(f64, f64)> {
        if self.target.is_some() || time.newest_first {
            let series = self.series(time);
            return series.t.first().copied().zip(series.t.last().copied());
        }
        let present = |(t, y): (&f64, &f64)| (t.is_finite() && y.is_finite()).then_some(*t);
        let n = time.seconds.len().min(self.values.len());
        let samples = || time.seconds[..n].iter().zip(&self.values[..n]);
        samples().find_map(present).zip(samples().rev().find_map(present))
    }
}

#[cfg(test)]
mod tests {
    use super::super::TimeFormat;
    use super::*;

    #[test]
    fn samples_looked_at_later_are_those_made_at_once_and_the_ends_are_theirs() {
        let time = TimeAxis {
            name: String::new(),
            column: None,
            date_column: None,
            part_columns: Vec::new(),
            zone: None,
            clocks: super::super::Clocks::Stated,
            newest_first: false,
            format: TimeFormat::SampleNumber,
            origin_ns: 0,
            seconds: vec![f64::NAN, 1.0, 2.0, 4.0],
        };
        for values in [vec![1.0; 4], vec![1.0, f64::NAN, 2.0, 3.0], vec![f64::NAN; 4]] {
            let channel = Channel { name: String::new(), unit: String::new(), column: 0, target: None, values };
            let (now, later) = (Samples::of(&channel, &time), Samples::later());
            let (a, b) = (now.series(&channel, &time), later.series(&channel, &time));
            assert_eq!((&a.t, &a.y, a.interval.to_bits()), (&b.t, &b.y, b.interval.to_bits()));
            assert_eq!(channel.ends(&time), a.t.first().copied().zip(a.t.last().copied()));
        }
    }
}
