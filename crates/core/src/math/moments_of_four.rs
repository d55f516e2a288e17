//! Mean and sum of squares of four windows of one length side by side: the sums of [`Moments`], operation by operation,
//! so that their bits are the same, with four divisions at a time.

use super::moments::Moments;
use super::sliding::Summary;
use super::sorted_four::FOUR;

/// Count, means and centred sums of squares of four equally long lists of values.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MomentsOfFour {
    count: f64,
    mean: [f64; FOUR],
    squares: [f64; FOUR],
}

impl MomentsOfFour {
    /// The means.
    #[must_use]
    #[inline]
    pub fn mean(&self) -> [f64; FOUR] {
        self.mean
    }

    /// `sqrt(sum (x - center)^2 / (n - 1))` of each list about its centre.
    #[must_use]
    #[inline]
    pub fn deviation_about(&self, center: [f64; FOUR]) -> [f64; FOUR] {
        std::array::from_fn(|lane| {
            let one = Moments { count: self.count, mean: self.mean[lane], squares: self.squares[lane] };
            (one.squares_about(center[lane]) / (self.count - 1.0)).sqrt()
        })
    }
}

impl Summary for MomentsOfFour {
    type Item = [f64; FOUR];

    #[inline]
    fn add(&mut self, item: [f64; FOUR]) {
        self.count += 1.0;
        for (lane, x) in item.into_iter().enumerate() {
            let d = x - self.mean[lane];
            self.mean[lane] += d / self.count;
            self.squares[lane] += d * (x - self.mean[lane]);
        }
    }

    #[inline]
    fn joined(&self, other: &Self) -> Self {
        if self.count == 0.0 {
            return *other;
        }
        let count = self.count + other.count;
        let share = other.count / count;
        let mut both = Self { count, ..*self };
        for lane in 0..FOUR {
            let d = other.mean[lane] - self.mean[lane];
            both.mean[lane] = self.mean[lane] + d * share;
            both.squares[lane] = self.squares[lane] + other.squares[lane] + d * d * (self.count * share);
        }
        both
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sliding::Sliding;

    #[test]
    fn four_windows_have_the_bits_of_each_by_itself() {
        let lanes: [Vec<f64>; FOUR] = std::array::from_fn(|lane| {
            (0..200).map(|i| (f64::from(i) * 12.9898 + lane as f64).sin() * 7919.0 % 13.0).collect()
        });
        let items: Vec<[f64; FOUR]> = (0..200).map(|i| std::array::from_fn(|lane| lanes[lane][i])).collect();
        for width in [1, 2, 11, 30] {
            let mut four = Sliding::<MomentsOfFour>::default();
            let mut single: [Sliding<Moments>; FOUR] = std::array::from_fn(|_| Sliding::default());
            for start in 0..=200 - width {
                four.move_to(&items, start..start + width);
                let center = [0.5; FOUR];
                let (mean, deviation) = (four.get().mean(), four.get().deviation_about(center));
                for lane in 0..FOUR {
                    single[lane].move_to(&lanes[lane], start..start + width);
                    let one = single[lane].get();
                    let alone = (one.squares_about(0.5) / (one.count - 1.0)).sqrt();
                    assert_eq!(mean[lane].to_bits(), one.mean.to_bits(), "{width} {start}");
                    assert_eq!(deviation[lane].to_bits(), alone.to_bits(), "{width} {start}");
                }
            }
        }
    }
}
