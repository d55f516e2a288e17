//! Expected value and scale of the window around every sample, on the data as given.

use std::ops::Range;

use rayon::prelude::*;

use super::sorted::around;
use super::{CHUNK, Center, Rule, Spread, Windows};
use crate::math::moments::Moments;
use crate::math::moments_of_four::MomentsOfFour;
use crate::math::sliding::Sliding;
use crate::math::sorted_four::{FOUR, SortedFour};
use crate::math::sorted_window::SortedWindow;
use crate::stop::{Stop, Stopped};

/// What the windows on the data as given say, one entry per sample.
#[derive(Debug)]
pub(super) struct Figures {
    pub(super) expected: Vec<f64>,
    pub(super) scale: Vec<f64>,
}

/// The figures of all windows over the padded values `x`.
pub(super) fn figures(rule: &Rule, x: &[f64], windows: &Windows, stop: &Stop) -> Result<Figures, Stopped> {
    let n = windows.len();
    let mut figures = Figures { expected: vec![0.0; n], scale: vec![0.0; n] };
    if rule.center == Center::Median || rule.spread == Spread::Mad {
        by_order(&mut figures, x, windows, stop)?;
    }
    if rule.center == Center::Mean || rule.spread == Spread::Rms {
        by_moments(rule, &mut figures, x, windows, stop)?;
    }
    Ok(figures)
}

/// Median and median absolute deviation of every window.
fn by_order(figures: &mut Figures, x: &[f64], windows: &Windows, stop: &Stop) -> Result<(), Stopped> {
    let pieces = figures.expected.par_chunks_mut(CHUNK).zip(figures.scale.par_chunks_mut(CHUNK));
    pieces.enumerate().try_for_each(|(chunk, (expected, scale))| {
        stop.check()?;
        let at = chunk * CHUNK..chunk * CHUNK + expected.len();
        let one = |window: &SortedWindow| {
            let median = window.median();
            [median, window.mad_scale(median)]
        };
        let four = |windows: &SortedFour| {
            let medians = windows.median();
            let scales = windows.mad_scale(medians);
            std::array::from_fn(|lane| [medians[lane], scales[lane]])
        };
        around(x, windows, &at, one, four, |i, said| [expected[i], scale[i]] = said);
        Ok(())
    })
}

/// Mean, where the rule asks for it, and root mean square about the expected value, likewise. The bits of sums depend
/// on where they begin: each chunk begins its own, and four whole chunks do so side by side.
fn by_moments(rule: &Rule, figures: &mut Figures, x: &[f64], windows: &Windows, stop: &Stop) -> Result<(), Stopped> {
    let pieces = pieces(windows.len(), &windows.whole());
    let expected = split(&mut figures.expected, &pieces);
    let scale = split(&mut figures.scale, &pieces);
    let all = pieces.par_iter().zip(expected).zip(scale);
    let (mean, rms) = (rule.center == Center::Mean, rule.spread == Spread::Rms);
    all.try_for_each(|((at, expected), scale)| {
        stop.check()?;
        if at.len() < FOUR * CHUNK {
            let mut window = Sliding::<Moments>::default();
            for (i, c) in at.clone().enumerate() {
                window.move_to(x, windows.range(c));
                let sums = window.get();
                if mean {
                    expected[i] = sums.mean;
                }
                if rms {
                    scale[i] = (sums.squares_about(expected[i]) / (sums.count - 1.0)).sqrt();
                }
            }
            return Ok(());
        }
        slide_four(x, windows, at.start, |i, sums| {
            let place = |lane: usize| lane * CHUNK + i;
            if mean {
                sums.mean().into_iter().enumerate().for_each(|(lane, mean)| expected[place(lane)] = mean);
            }
            if rms {
                let deviation = sums.deviation_about(std::array::from_fn(|lane| expected[place(lane)]));
                deviation.into_iter().enumerate().for_each(|(lane, d)| scale[place(lane)] = d);
            }
        });
        Ok(())
    })
}

/// Shows the moments of the windows of four whole chunks from sample `begin` on, and how far into each chunk they are.
fn slide_four(x: &[f64], windows: &Windows, begin: usize, mut each: impl FnMut(usize, &MomentsOfFour)) {
    let width = windows.width();
    let lanes: [&[f64]; FOUR] = std::array::from_fn(|lane| {
        let start = windows.range(begin + lane * CHUNK).start;
        &x[start..start + CHUNK + width - 1]
    });
    let items: Vec<[f64; FOUR]> = (0..CHUNK + width - 1).map(|i| lanes.map(|lane| lane[i])).collect();
    let mut window = Sliding::<MomentsOfFour>::default();
    for i in 0..CHUNK {
        window.move_to(&items, i..i + width);
        each(i, &window.get());
    }
}

/// The chunks of `len` positions; four whole ones inside `inner` are one piece.
fn pieces(len: usize, inner: &Range<usize>) -> Vec<Range<usize>> {
    let mut pieces = Vec::with_capacity(len / CHUNK + 1);
    let mut at = 0;
    while at < len {
        let four = at + FOUR * CHUNK;
        let end = if at >= inner.start && four <= inner.end { four } else { (at + CHUNK).min(len) };
        pieces.push(at..end);
        at = end;
    }
    pieces
}

/// The parts of a slice that lie side by side and are as long as the pieces.
fn split<'a, T>(mut slice: &'a mut [T], pieces: &[Range<usize>]) -> Vec<&'a mut [T]> {
    let part = |piece: &Range<usize>| {
        let (part, rest) = std::mem::take(&mut slice).split_at_mut(piece.len());
        slice = rest;
        part
    };
    pieces.iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::super::statistics::Statistics;
    use super::super::{Edge, level};
    use super::*;

    #[test]
    fn four_chunks_side_by_side_have_the_bits_of_each_by_itself() {
        let n = 7 * CHUNK + 100;
        let y: Vec<f64> = (0..n).map(|i| ((i * 7919) % 10_007) as f64 * 0.01 + (i as f64 * 0.37).sin()).collect();
        for (center, spread) in [
            (Center::Mean, Spread::Rms),
            (Center::Mean, Spread::Mad),
            (Center::Median, Spread::Rms),
            (Center::Median, Spread::Mad),
        ] {
            for (width, edge) in [(11, Edge::Shrink), (10, Edge::Reflect), (101, Edge::Zero)] {
                let rule = Rule { center, spread, width, edge, detrend: false, pooled: false, feedback: false, k: 3.0 };
                let windows = Windows::new(n, width, edge);
                let x = windows.padded(y.clone(), -level(&y), &Stop::never()).unwrap();
                let all = figures(&rule, &x, &windows, &Stop::never()).unwrap();
                for begin in (0..n).step_by(CHUNK) {
                    let mut single = Statistics::new(&rule);
                    for c in begin..(begin + CHUNK).min(n) {
                        let range = windows.range(c);
                        single.move_to(&x, range.clone(), range.start);
                        let [expected, scale] = single.figures();
                        assert_eq!(all.expected[c].to_bits(), expected.to_bits(), "{center:?} {spread:?} {width} {c}");
                        assert_eq!(all.scale[c].to_bits(), scale.to_bits(), "{center:?} {spread:?} {width} {c}");
                    }
                }
            }
        }
    }
}
