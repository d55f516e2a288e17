//! The rows of one track, in an order that does not depend on how they came.

use std::cmp::Ordering;

use crate::track::{ChannelValues, NO_MOMENT};

/// The rows of one track.
#[derive(Debug, Clone, Default)]
pub struct Rows {
    /// Id of the track; empty where the rows are those of the only one.
    pub track: String,
    /// Moments in nanoseconds; [`NO_MOMENT`] where there is none.
    pub moments: Vec<i64>,
    /// Nanoseconds in one unit of the times, where they were numbers.
    pub unit_ns: i64,
    /// The columns that the session needs, each with a value for each row.
    pub channels: Vec<ChannelValues>,
}

impl Rows {
    /// The first row (from 0) whose moment lies before that of an earlier row.
    #[must_use]
    pub fn first_backward(&self) -> Option<usize> {
        let mut last = i64::MIN;
        self.moments.iter().position(|&moment| {
            let back = moment != NO_MOMENT && moment < last;
            last = last.max(moment);
            back
        })
    }

    /// Puts the rows in the order of their moments, those without one first. Rows of the same moment are in the order
    /// of their values: those of the first channel decide, then those of the next; missing ones come last. Gives for
    /// each row the place that it had; none where all stay.
    pub(super) fn sort(&mut self) -> Option<Vec<u32>> {
        if self.moments.windows(2).all(|pair| pair[0] < pair[1]) {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, reason = "tracks of 2^32 rows and more are refused")]
        let mut places: Vec<u32> = (0..self.moments.len() as u32).collect();
        places.sort_by(|&a, &b| self.compare(a as usize, b as usize));
        if places.is_sorted() {
            return None;
        }
        self.moments = places.iter().map(|&at| self.moments[at as usize]).collect();
        for channel in &mut self.channels {
            channel.values = places.iter().map(|&at| channel.values[at as usize]).collect();
        }
        Some(places)
    }

    fn compare(&self, a: usize, b: usize) -> Ordering {
        let values = |row: usize| self.channels.iter().map(move |channel| finite(channel.values[row]));
        let by_values = || values(a).zip(values(b)).map(|(a, b)| a.total_cmp(&b)).find(|order| order.is_ne());
        self.moments[a].cmp(&self.moments[b]).then_with(|| by_values().unwrap_or(Ordering::Equal))
    }
}

/// One NaN for all that is missing, which is larger than any number in the total order.
pub(super) fn finite(value: f64) -> f64 {
    if value.is_finite() { value } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(moments: &[i64], values: &[f64]) -> Rows {
        let channels = vec![ChannelValues { name: "a".into(), values: values.to_vec() }];
        Rows { track: String::new(), moments: moments.to_vec(), unit_ns: 1, channels }
    }

    #[test]
    fn rows_of_one_moment_are_in_the_order_of_their_values() {
        let mut given = rows(&[1, 4, 4, 4, 2], &[0.0, f64::NAN, 7.0, -7.0, 1.0]);
        assert_eq!(given.sort(), Some(vec![0, 4, 3, 2, 1]));
        assert_eq!(given.moments, [1, 2, 4, 4, 4]);
        assert_eq!(given.channels[0].values[..4], [0.0, 1.0, -7.0, 7.0]);
        assert_eq!(given.sort(), None);
    }

    #[test]
    fn a_row_that_goes_back_is_named_and_one_without_a_moment_is_none() {
        assert_eq!(rows(&[1, NO_MOMENT, 1, 3, 2], &[0.0; 5]).first_backward(), Some(4));
        assert_eq!(rows(&[NO_MOMENT, 1, 2], &[0.0; 3]).first_backward(), None);
    }
}
