//! Where windows lie, and what they hold beyond the ends of a segment.

use std::ops::Range;

use crate::math::order::median;
use crate::math::pieces::PIECE;
use crate::method::shared;
use crate::param::Settings;
use crate::stop::{Stop, Stopped};

/// What a window holds beyond the ends of its segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::method) enum Edge {
    /// Nothing: it is cut, to no fewer than the three samples nearest the end.
    Shrink,
    /// The samples mirrored about the one at the end, which is not repeated.
    Reflect,
    /// Zeros.
    Zero,
}

impl Edge {
    /// The edge that `settings` name.
    pub(in crate::method) fn of(settings: &Settings) -> Self {
        match settings.word(shared::EDGE.key) {
            "reflect" => Self::Reflect,
            "zero" => Self::Zero,
            _ => Self::Shrink,
        }
    }
}

/// The windows around each sample of a segment of at least three: `c - n/2 .. c - n/2 + n - 1` for sample `c`, in
/// positions of the padded values.
#[derive(Debug, Clone, Copy)]
pub(in crate::method) struct Windows {
    len: usize,
    width: usize,
    edge: Edge,
    /// Padding values before the first sample.
    pad: usize,
}

impl Windows {
    /// The windows of `width` over `len` samples.
    pub(in crate::method) fn new(len: usize, width: usize, edge: Edge) -> Self {
        let pad = if edge == Edge::Shrink { 0 } else { width / 2 };
        Self { len, width, edge, pad }
    }

    /// The window around sample `c`.
    #[inline]
    pub(in crate::method) fn range(&self, c: usize) -> Range<usize> {
        if self.edge != Edge::Shrink {
            return c..c + self.width;
        }
        let start = c.saturating_sub(self.width / 2);
        let end = (c + self.width - self.width / 2).min(self.len);
        match end - start {
            3.. => start..end,
            _ if start == 0 => 0..3.min(self.len),
            _ => self.len - 3..self.len,
        }
    }

    /// How many samples there are.
    pub(in crate::method) fn len(&self) -> usize {
        self.len
    }

    /// How many values a whole window holds.
    pub(in crate::method) fn width(&self) -> usize {
        self.width
    }

    /// The samples whose windows are not cut; they begin one after the other.
    pub(in crate::method) fn whole(&self) -> Range<usize> {
        if self.edge != Edge::Shrink {
            return 0..self.len;
        }
        let begin = self.width / 2;
        begin..(self.len + begin + 1).saturating_sub(self.width).max(begin)
    }

    /// The position of sample `c`.
    #[inline]
    pub(in crate::method) fn center(&self, c: usize) -> usize {
        c + self.pad
    }

    /// The samples with what is put before and after them; `zero` is the value that counts as zero.
    pub(in crate::method) fn padded(&self, samples: Vec<f64>, zero: f64, stop: &Stop) -> Result<Vec<f64>, Stopped> {
        if self.edge == Edge::Shrink {
            return Ok(samples);
        }
        let after = self.width - 1 - self.pad;
        let mut x = Vec::with_capacity(self.pad + self.len + after);
        x.resize(self.pad, zero);
        for piece in samples.chunks(PIECE) {
            stop.check()?;
            x.extend_from_slice(piece);
        }
        x.resize(self.pad + self.len + after, zero);
        if self.edge == Edge::Reflect {
            for at in (0..self.pad).chain(self.pad + self.len..x.len()) {
                x[at] = x[self.pad + self.mirrored(at)];
            }
        }
        Ok(x)
    }

    /// Puts `value` in the place of sample `c` and of its mirror images; says in how many places.
    pub(in crate::method) fn replace(&self, x: &mut [f64], c: usize, value: f64) -> usize {
        x[self.center(c)] = value;
        let far = c > self.pad && c + self.width < self.len;
        if self.edge != Edge::Reflect || far {
            return 1;
        }
        let mut places = 1;
        for at in (0..self.pad).chain(self.pad + self.len..x.len()) {
            if self.mirrored(at) == c {
                x[at] = value;
                places += 1;
            }
        }
        places
    }

    /// The last position at which a replaced sample `c` can stand: no window that begins after it holds it.
    pub(in crate::method) fn last_touched(&self, c: usize) -> usize {
        // Beyond the ends of a reflected segment an image stands in no window that the sample itself has left,
        // unless the segment is so short that there are images of images.
        if self.edge == Edge::Reflect && self.len <= self.width { usize::MAX } else { self.center(c) }
    }

    /// The sample whose value stands at a position of the padding.
    fn mirrored(&self, at: usize) -> usize {
        let period = 2 * (self.len - 1);
        // A multiple of the period large enough to keep the difference positive.
        let k = (at + period * self.pad.div_ceil(period) - self.pad) % period;
        if k < self.len { k } else { period - k }
    }
}

/// A level of the values that no single wild point moves.
pub(in crate::method) fn level(y: &[f64]) -> f64 {
    median(&[y[0], y[y.len() / 2], y[y.len() - 1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn padded(windows: &Windows, samples: &[f64], zero: f64) -> Vec<f64> {
        windows.padded(samples.to_vec(), zero, &Stop::never()).unwrap()
    }

    #[test]
    fn even_windows_reach_one_further_back() {
        let w = Windows::new(30, 10, Edge::Shrink);
        assert_eq!((w.range(15), w.range(0), w.range(29)), (10..20, 0..5, 24..30));
        let cut = |c: &usize| w.range(*c).len() < 10;
        assert!((0..30).filter(|c| !cut(c)).eq(w.whole()) && Windows::new(9, 10, Edge::Shrink).whole().is_empty());
        let w = Windows::new(30, 3, Edge::Shrink);
        assert_eq!((w.range(0), w.range(1), w.range(29)), (0..3, 0..3, 27..30));
    }

    #[test]
    fn reflection_does_not_repeat_the_end() {
        let x = [1.0, 2.0, 3.0, 4.0];
        let w = Windows::new(4, 5, Edge::Reflect);
        assert_eq!(padded(&w, &x, 0.0), [3.0, 2.0, 1.0, 2.0, 3.0, 4.0, 3.0, 2.0]);
        let w = Windows::new(3, 11, Edge::Reflect);
        let values = padded(&w, &[1.0, 2.0, 3.0], 0.0);
        assert_eq!(values, [2.0, 1.0, 2.0, 3.0, 2.0, 1.0, 2.0, 3.0, 2.0, 1.0, 2.0, 3.0, 2.0]);
        let mut changed = values;
        assert_eq!(w.replace(&mut changed, 1, 9.0), 7);
        assert_eq!(changed.iter().filter(|v| **v == 9.0).count(), 7);
        let w = Windows::new(3, 4, Edge::Zero);
        assert_eq!(padded(&w, &[1.0, 2.0, 3.0], -7.0), [-7.0, -7.0, 1.0, 2.0, 3.0, -7.0]);
    }
}
