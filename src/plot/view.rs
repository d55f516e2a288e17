//! The x axis: samples in order of time or of number, and the part of it that is in view.

use std::ops::Range;

/// Where samples lie along x.
#[derive(Debug, Clone, Copy)]
pub enum Axis<'a> {
    /// By time, in seconds after the origin of the track.
    Time(&'a [f64]),
    /// By position; the times still tell where samples are lost.
    Position(&'a [f64]),
}

impl<'a> Axis<'a> {
    /// Times of the samples.
    #[must_use]
    pub fn times(self) -> &'a [f64] {
        match self {
            Self::Time(t) | Self::Position(t) => t,
        }
    }

    /// How many samples there are.
    #[must_use]
    pub fn len(self) -> usize {
        self.times().len()
    }

    /// True when there is no sample.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.times().is_empty()
    }

    /// The x of a sample; NaN past the end.
    #[must_use]
    pub fn x(self, position: usize) -> f64 {
        match self {
            Self::Time(t) => t.get(position).copied().unwrap_or(f64::NAN),
            Self::Position(t) if position < t.len() => position as f64,
            Self::Position(_) => f64::NAN,
        }
    }

    /// The same samples by position where this is by time, and by time where it is by position.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Time(t) => Self::Position(t),
            Self::Position(t) => Self::Time(t),
        }
    }

    /// Where `x` of this axis lies on the other one: in proportion between two neighbours, and at the first or last
    /// sample beyond them.
    #[must_use]
    pub fn on_other(self, x: f64) -> f64 {
        let last = self.len().saturating_sub(1);
        let after = self.first_at(x).clamp(1, last.max(1));
        let (a, b) = (self.x(after - 1), self.x(after));
        let (c, d) = (self.other().x(after - 1), self.other().x(after));
        let share = ((x - a) / (b - a)).clamp(0.0, 1.0);
        if share.is_nan() || d.is_nan() { c } else { c + (d - c) * share }
    }

    /// How many samples lie before `x`: the position of the first at or after it.
    #[must_use]
    pub fn first_at(self, x: f64) -> usize {
        self.first_where(x, 0, |sample| sample < x)
    }

    /// How many samples lie at or before `x`.
    #[must_use]
    pub fn first_after(self, x: f64) -> usize {
        self.first_where(x, 0, |sample| sample <= x)
    }

    /// The first position from `hint` on whose sample is not `before`. Steady sampling makes a guess near `x` good:
    /// the search starts there and widens.
    pub(crate) fn first_where(self, x: f64, hint: usize, before: impl Fn(f64) -> bool) -> usize {
        let n = self.len();
        let hint = hint.min(n);
        let share = (x - self.x(hint)) / (self.x(n.saturating_sub(1)) - self.x(hint));
        // A cast from float saturates and takes NaN to 0.
        let guess = hint.saturating_add((share * (n - hint) as f64) as usize).clamp(hint, n);
        let (mut low, mut high, mut width) = (guess, guess, 16);
        while low > hint && !before(self.x(low - 1)) {
            low = low.saturating_sub(width).max(hint);
            width *= 4;
        }
        width = 16;
        while high < n && before(self.x(high)) {
            high = (high + width).min(n);
            width *= 4;
        }
        while low < high {
            let middle = low + (high - low) / 2;
            if before(self.x(middle)) {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        low
    }
}

/// The part of the x axis that is shown, both ends included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Where it starts, in units of the axis.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

impl View {
    /// The whole record; of a single sample, half a unit around it.
    #[must_use]
    pub fn whole(axis: Axis<'_>) -> Self {
        if axis.is_empty() {
            return Self { from: 0.0, to: 1.0 };
        }
        let (from, to) = (axis.x(0), axis.x(axis.len() - 1));
        if to > from { Self { from, to } } else { Self { from: from - 0.5, to: from + 0.5 } }
    }

    /// Its width; 0 when there is nothing to draw in it (reversed, empty, or not finite).
    #[must_use]
    pub fn width(self) -> f64 {
        let width = self.to - self.from;
        if width.is_finite() && width > 0.0 { width } else { 0.0 }
    }

    /// The positions in view.
    #[must_use]
    pub fn positions(self, axis: Axis<'_>) -> Range<usize> {
        if self.width() == 0.0 {
            return 0..0;
        }
        let first = axis.first_at(self.from);
        first..axis.first_after(self.to).max(first)
    }

    /// The same samples on the other axis.
    #[must_use]
    pub fn on_other(self, axis: Axis<'_>) -> Self {
        let view = Self { from: axis.on_other(self.from), to: axis.on_other(self.to) };
        // Between two samples far apart there may be nothing to see, and of a single sample there is no width.
        if view.width() > 0.0 { view } else { Self::whole(axis.other()) }
    }

    /// The same view `factor` times as wide, with `x` staying where it is on the screen.
    #[must_use]
    pub fn zoomed(self, x: f64, factor: f64) -> Self {
        Self { from: x - (x - self.from) * factor, to: x + (self.to - x) * factor }
    }

    /// The view moved by `share` of its width.
    #[must_use]
    pub fn panned(self, share: f64) -> Self {
        let step = self.width() * share;
        Self { from: self.from + step, to: self.to + step }
    }

    /// Moved, and narrowed if need be, so that it lies within `whole`.
    #[must_use]
    pub fn within(self, whole: Self) -> Self {
        if self.width() >= whole.width() || self.width() == 0.0 {
            return whole;
        }
        let shift = (whole.from - self.from).max(0.0) + (whole.to - self.to).min(0.0);
        Self { from: self.from + shift, to: self.to + shift }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn searches_agree_with_a_plain_count(
            steps in prop::collection::vec(prop_oneof![4 => Just(1.0), 1 => 0.01_f64..500.0], 0..300), x in -10.0..3e3,
        ) {
            let t: Vec<f64> = steps.iter().scan(0.0, |t, step| { *t += step; Some(*t) }).collect();
            let count = |before: &dyn Fn(f64) -> bool| t.iter().filter(|t| before(**t)).count();
            prop_assert_eq!(Axis::Time(&t).first_at(x), count(&|t| t < x));
            prop_assert_eq!(Axis::Time(&t).first_after(x), count(&|t| t <= x));
            let middle = t.get(t.len() / 2).copied().unwrap_or(0.0);
            prop_assert_eq!(Axis::Time(&t).first_at(middle), count(&|t| t < middle));
        }
    }

    #[test]
    fn a_view_goes_to_the_other_axis_and_back() {
        let t = [0.0, 1.0, 2.0, 10.0, 11.0];
        let axis = Axis::Time(&t);
        // Halfway between the third and the fourth sample by time is halfway by number.
        assert_eq!(View { from: 1.0, to: 6.0 }.on_other(axis), View { from: 1.0, to: 2.5 });
        assert_eq!(View { from: 1.0, to: 2.5 }.on_other(axis.other()), View { from: 1.0, to: 6.0 });
        assert_eq!(View::whole(axis).on_other(axis), View { from: 0.0, to: 4.0 });
        assert_eq!(View { from: 20.0, to: 30.0 }.on_other(axis), View { from: 0.0, to: 4.0 }, "nothing is there");
        for t in [&[][..], &[7.0]] {
            let whole = View::whole(Axis::Time(t)).on_other(Axis::Time(t));
            assert!(whole.width() > 0.0, "{whole:?}");
        }
    }

    #[test]
    fn positions_count_from_zero_whatever_the_times() {
        let axis = Axis::Position(&[5.0, 50.0, 500.0]);
        assert_eq!((axis.first_at(0.5), axis.first_at(1.0), axis.first_after(1.0), axis.first_at(9.0)), (1, 1, 2, 3));
        assert_eq!(axis.first_where(1e300, 1, |x| x < 1e300), 3);
        assert_eq!(View { from: 0.5, to: 2.0 }.positions(axis), 1..3);
        assert_eq!(View { from: 2.0, to: 0.5 }.positions(axis), 0..0);
    }

    #[test]
    fn zooming_keeps_the_point_and_moving_stays_inside() {
        let view = View { from: 0.0, to: 10.0 };
        assert_eq!(view.zoomed(4.0, 0.5), View { from: 2.0, to: 7.0 });
        assert_eq!(view.panned(-0.5), View { from: -5.0, to: 5.0 });
        assert_eq!(view.panned(-0.5).within(view), view);
        assert_eq!(View { from: 8.0, to: 12.0 }.within(view), View { from: 6.0, to: 10.0 });
        assert_eq!(View::whole(Axis::Time(&[7.0])), View { from: 6.5, to: 7.5 });
    }
}
