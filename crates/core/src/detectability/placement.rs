//! Where in a record wild points are put: calm places, far from each other.

use std::ops::Range;

use super::event::{Event, Kind, Wanted};
use crate::math::random::Random;

/// Calm samples that an event has on each side.
const MARGIN: usize = 3;

/// A held value that is longer than this is left alone.
const LONGEST_HELD: usize = 20;

/// A dropout has at most this many samples.
const LONGEST_DROPOUT: usize = 5;

/// The places of a record.
#[derive(Debug)]
pub(super) struct Places {
    /// How many samples before each position are not calm.
    disturbed: Vec<u32>,
    /// How many segments begin before or at each position.
    begun: Vec<u32>,
    /// Where each sample's run of equal values begins and ends; empty where values are not held.
    held: Vec<Range<u32>>,
}

impl Places {
    /// `calm` says of each sample whether nothing objects to it; `segments` are the stretches between cuts; `held` are
    /// the values where wild points may cover a held one.
    pub(super) fn new(calm: &[bool], segments: &[Range<usize>], held: Option<&[f64]>) -> Self {
        let mut disturbed = vec![0_u32; calm.len() + 1];
        let mut begun = vec![0_u32; calm.len()];
        for segment in segments {
            begun[segment.start] = 1;
        }
        for (i, calm) in calm.iter().enumerate() {
            disturbed[i + 1] = disturbed[i] + u32::from(!calm);
        }
        for i in 1..begun.len() {
            begun[i] += begun[i - 1];
        }
        Self { disturbed, begun, held: held.map_or_else(Vec::new, runs_of_equal) }
    }

    /// How many samples have a calm place around them.
    pub(super) fn calm(&self) -> usize {
        (0..self.begun.len()).filter(|&at| self.fits(at..at + 1)).count()
    }

    /// True when the samples of `range` and those beside them are calm and lie in one segment.
    fn fits(&self, range: Range<usize>) -> bool {
        let Some(from) = range.start.checked_sub(MARGIN) else { return false };
        let to = range.end + MARGIN;
        to <= self.begun.len() && self.disturbed[from] == self.disturbed[to] && self.begun[from] == self.begun[to - 1]
    }

    /// The samples of an event of this kind at `at`; none where it does not fit.
    fn range(&self, kind: Kind, length: usize, at: usize) -> Option<Range<usize>> {
        let range = match kind {
            Kind::Held => {
                let run = self.held.get(at)?;
                let run = run.start as usize..run.end as usize;
                if !(2..=LONGEST_HELD).contains(&run.len()) {
                    return None;
                }
                run
            }
            _ => at..at + length,
        };
        self.fits(range.clone()).then_some(range)
    }

    /// An event in each of `count` equal parts of the record: in the first what is `wanted(0)`. A part in which there is no
    /// room for it stays empty.
    pub(super) fn place(&self, count: usize, wanted: impl Fn(usize) -> Wanted, random: &mut Random) -> Vec<Event> {
        let n = self.begun.len();
        let mut events: Vec<Event> = Vec::with_capacity(count);
        for index in 0..count {
            let part = index * n / count..(index + 1) * n / count;
            let Wanted { kind, size } = wanted(index);
            let length = if kind == Kind::Dropout { random.whole(1, LONGEST_DROPOUT) } else { kind.length() };
            let from = random.whole(part.start, part.end.saturating_sub(1).max(part.start));
            let free_from = events.last().map_or(0, |before| before.range.end + MARGIN);
            let place = |at: usize| self.range(kind, length, at).filter(|r| r.start >= free_from && r.end <= part.end);
            if let Some(range) = (from..part.end).chain(part.start..from).find_map(place) {
                events.push(Event { kind, size, range });
            }
        }
        events
    }
}

/// For each sample the run of equal values that it is in.
fn runs_of_equal(y: &[f64]) -> Vec<Range<u32>> {
    let mut runs = Vec::with_capacity(y.len());
    #[expect(clippy::cast_possible_truncation, reason = "at most the samples of an excerpt")]
    for run in y.chunk_by(|a, b| a.to_bits() == b.to_bits()) {
        let start = runs.len() as u32;
        let end = start + run.len() as u32;
        runs.extend(run.iter().map(|_| start..end));
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    const SINGLE: Wanted = Wanted { kind: Kind::Single, size: 3 };

    #[test]
    fn events_lie_in_calm_places_of_one_segment_and_apart() {
        let mut calm = vec![true; 1000];
        calm[200..300].fill(false);
        let places = Places::new(&calm, &[0..600, 600..1000], None);
        let five = Wanted { kind: Kind::RunOf5, size: 1 };
        let events = places.place(50, |i| if i % 2 == 0 { SINGLE } else { five }, &mut Random::new(3));
        assert!((40..=50).contains(&events.len()), "{}", events.len());
        for event in &events {
            let around = event.range.start - MARGIN..event.range.end + MARGIN;
            assert!(around.end <= 200 || around.start >= 300, "{event:?}");
            assert!(around.end <= 600 || around.start >= 600, "{event:?}");
            assert_eq!(event.range.len(), event.kind.length());
        }
        assert!(events.windows(2).all(|w| w[0].range.end + MARGIN <= w[1].range.start));
        assert_eq!(
            places.place(50, |_| SINGLE, &mut Random::new(3)),
            places.place(50, |_| SINGLE, &mut Random::new(3))
        );
    }

    #[test]
    fn a_part_without_room_stays_empty_and_the_next_gets_its_own() {
        let mut calm = vec![true; 100];
        calm[..50].fill(false);
        let whole = 0..100;
        let places = Places::new(&calm, std::slice::from_ref(&whole), None);
        let events = places.place(2, |i| Wanted { kind: Kind::Single, size: i }, &mut Random::new(1));
        assert_eq!(events.len(), 1);
        assert_eq!(events[0].size, 1);
        // A kind for which there is room nowhere holds up no other.
        let kinds = [Kind::RunOf10, Kind::Single];
        let short: Vec<Range<usize>> = (0..10).map(|i| 10 * i..10 * i + 10).collect();
        let places = Places::new(&[true; 100], &short, None);
        let events = places.place(10, |i| Wanted { kind: kinds[i % 2], size: 0 }, &mut Random::new(1));
        assert_eq!(events.len(), 5);
        assert!(events.iter().all(|event| event.kind == Kind::Single));
    }

    #[test]
    fn a_held_value_is_covered_whole() {
        let y: Vec<f64> = (0..90).map(|i| f64::from(i / 3)).collect();
        let whole = 0..90;
        let places = Places::new(&[true; 90], std::slice::from_ref(&whole), Some(&y));
        let events = places.place(3, |_| Wanted { kind: Kind::Held, size: 0 }, &mut Random::new(1));
        assert_eq!(events.len(), 3);
        assert!(events.iter().all(|e| e.range.len() == 3 && e.range.start % 3 == 0), "{events:?}");
    }
}
