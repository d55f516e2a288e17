//! A channel's judgement whose multiplier can be turned.
//!
//! Where a multiplier only gates, turning it changes the verdict of the few samples whose deviation lies between the
//! old tolerance and the new one. Blocks of samples remember between which multipliers none of them changes, so that
//! a step looks at the others alone; scores are shared between the steps.

use std::ops::Range;
use std::sync::Arc;

use rayon::prelude::*;

use super::judged::{gated, tolerance_of};
use super::local::Sample;
use super::noise::Objection;
use super::{Directions, Judged, Part, Restart, Verdict};
use crate::stop::{Stop, Stopped};

/// Samples of a block.
const BLOCK: usize = 64;
/// Blocks in one piece of parallel work.
const PIECE: usize = 256;
/// A ratio is known to about 1e-15 of itself and ties reach a limit from 1e-9 below it; within this fraction of a
/// ratio the comparison itself decides.
const MARGIN: f64 = 1e-6;
/// Quotients of a deviation and a scale in this range neither overflow nor lose digits.
const ORDINARY: Range<f64> = 1e-200..1e200;

/// What a method says of a channel, one entry per present sample.
#[derive(Debug, Clone)]
pub struct Gated {
    /// What it said when it ran. Without verdicts and tolerances where the multiplier only gates.
    scores: Arc<Judged>,
    /// The multiplier, and what it makes of the scores, where it only gates.
    gate: Option<Gate>,
    /// What is said of samples that the method did not see: position and verdict.
    unseen: Arc<[(u32, Verdict)]>,
    /// What the calibration has against the samples, where the floor comes from that.
    record: Option<Record>,
}

/// What the calibration has against each sample, and the share of a tolerance from which on one is doubtful.
#[derive(Debug, Clone)]
pub struct Record {
    /// One for each sample.
    pub objections: Arc<[Objection]>,
    /// The setting `doubt`.
    pub doubt: f64,
}

#[derive(Debug, Clone)]
struct Gate {
    k: f64,
    verdict: Vec<Verdict>,
    /// Between which multipliers no verdict of a block changes. Empty until the multiplier is turned for the first
    /// time.
    still: Vec<(f64, f64)>,
}

impl Gated {
    /// A judgement under the multiplier `k`, if that only gates.
    #[must_use]
    pub fn new(mut judged: Judged, k: Option<f64>) -> Self {
        let gate = k.filter(|_| judged.scale.len() == judged.verdict.len()).map(|k| {
            judged.tolerance = Vec::new();
            Gate { k, verdict: std::mem::take(&mut judged.verdict), still: Vec::new() }
        });
        Self { scores: Arc::new(judged), gate, unseen: Arc::default(), record: None }
    }

    /// The same where `record` had a say in the verdicts, and has when the multiplier is turned.
    #[must_use]
    pub fn with_record(mut self, record: Option<Record>) -> Self {
        self.record = record.filter(|r| r.objections.len() == self.verdict().len());
        self
    }

    /// The same with the verdicts of samples that the method did not see, by position; they stay when the multiplier
    /// is turned.
    #[must_use]
    pub fn with_unseen(mut self, unseen: Vec<(u32, Verdict)>) -> Self {
        self.unseen = unseen.into();
        match &mut self.gate {
            Some(gate) => put(&self.unseen, &mut gate.verdict),
            None => put(&self.unseen, &mut Arc::make_mut(&mut self.scores).verdict),
        }
        self
    }

    /// The same scores under another multiplier: what [`Judged::gate`] gives, to the last bit. None where the
    /// multiplier does more than gate, or `y` has another length.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the result any more.
    pub fn regated(&self, y: &[f64], k: f64, stop: &Stop) -> Result<Option<Self>, Stopped> {
        let Some(gate) = self.gate.as_ref().filter(|g| g.verdict.len() == y.len()) else { return Ok(None) };
        let mut verdict = gate.verdict.clone();
        let mut still = gate.still.clone();
        // A range that holds no multiplier.
        still.resize(y.len().div_ceil(BLOCK), (f64::INFINITY, 0.0));
        let (expected, scale) = (&self.scores.expected, &self.scores.scale);
        let pieces = verdict.par_chunks_mut(PIECE * BLOCK).zip(still.par_chunks_mut(PIECE)).enumerate();
        pieces.try_for_each(|(piece, (verdict, still))| {
            stop.check()?;
            for (block, (v, still)) in (piece * PIECE..).zip(verdict.chunks_mut(BLOCK).zip(still)) {
                if !(still.0 < k && k < still.1) {
                    let range = block * BLOCK..block * BLOCK + v.len();
                    let record = self.record.as_ref().map(|r| (&r.objections[range.clone()], r.doubt));
                    *still = gate_block(v, &y[range.clone()], &expected[range.clone()], (&scale[range], record), k);
                }
            }
            Ok(())
        })?;
        put(&self.unseen, &mut verdict);
        Ok(Some(Self { gate: Some(Gate { k, verdict, still }), ..self.clone() }))
    }

    /// True when both gate the same scores.
    #[must_use]
    pub fn shares_scores(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scores, &other.scores)
    }

    /// The verdicts; never `Missing`.
    #[must_use]
    #[inline]
    pub fn verdict(&self) -> &[Verdict] {
        self.gate.as_ref().map_or(&self.scores.verdict, |gate| &gate.verdict)
    }

    /// Expected values; NaN where there is none.
    #[must_use]
    #[inline]
    pub fn expected(&self) -> &[f64] {
        &self.scores.expected
    }

    /// The tolerance of the sample at `position`; NaN where there is none.
    #[must_use]
    #[inline]
    pub fn tolerance(&self, position: usize) -> Option<f64> {
        match &self.gate {
            Some(gate) => self.scores.scale.get(position).map(|&scale| tolerance_of(gate.k, scale)),
            None => self.scores.tolerance.get(position).copied(),
        }
    }

    /// The multiplier and the scales, where the multiplier only gates.
    #[must_use]
    #[inline]
    pub fn scales(&self) -> Option<(f64, &[f64])> {
        self.gate.as_ref().map(|gate| (gate.k, self.scores.scale.as_slice()))
    }

    /// Verdicts of the two directions; empty where the method has none.
    #[must_use]
    #[inline]
    pub fn directions(&self) -> &[Directions] {
        &self.scores.directions
    }

    /// Where models were started again.
    #[must_use]
    #[inline]
    pub fn restarts(&self) -> &[Restart] {
        &self.scores.restarts
    }

    /// What the user should know about this result, one line each.
    #[must_use]
    pub fn warnings(&self) -> &[String] {
        &self.scores.warnings
    }

    /// What a method's own repair needs to know of a segment. No verdicts where the multiplier only gates.
    #[must_use]
    pub fn part(&self, range: Range<usize>) -> Part<'_> {
        self.scores.part(range)
    }
}

/// Puts verdicts in their places.
fn put(verdicts: &[(u32, Verdict)], all: &mut [Verdict]) {
    for (position, verdict) in verdicts {
        if let Some(place) = all.get_mut(*position as usize) {
            *place = *verdict;
        }
    }
}

/// Gates a block; gives the multipliers between which its verdicts stay as they are.
fn gate_block(
    verdict: &mut [Verdict],
    y: &[f64],
    expected: &[f64],
    (scale, record): (&[f64], Option<(&[Objection], f64)>),
    k: f64,
) -> (f64, f64) {
    let (mut low, mut high) = (0.0, f64::INFINITY);
    for (i, (((verdict, &y), &p), &s)) in verdict.iter_mut().zip(y).zip(expected).zip(scale).enumerate() {
        let record = record.map(|(objections, doubt)| (objections[i], doubt));
        *verdict = gated(y, p, tolerance_of(k, s), record);
        // Without an expected value, and with a scale of zero, no multiplier flags.
        if p.is_nan() || s.is_nan() || s <= 0.0 {
            continue;
        }
        let distance = (y - p).abs();
        let turns = match record {
            Some((objection, doubt)) => Sample { distance, objection }.turns(s, doubt),
            None => [distance / s; 5],
        };
        if !ORDINARY.contains(&s) || turns.iter().any(|turn| turn.is_nan()) {
            (low, high) = (f64::INFINITY, 0.0);
            continue;
        }
        for turn in turns {
            // A tie reaches a limit, so the verdict at the turn is that below it.
            if k <= turn * (1.0 + MARGIN) {
                high = f64::min(high, turn * (1.0 - MARGIN));
            } else {
                low = f64::max(low, turn * (1.0 + MARGIN));
            }
        }
    }
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bits(values: impl Iterator<Item = f64>) -> Vec<u64> {
        values.map(|v| if v.is_nan() { u64::MAX } else { v.to_bits() }).collect()
    }

    proptest! {
        /// However the multiplier was turned before, the verdicts are those of the plain comparison.
        #[test]
        fn steps_give_what_a_fresh_gate_gives(
            samples in proptest::collection::vec(
                (prop_oneof![-30.0..30.0, (-60..60).prop_map(|i| f64::from(i) * 0.5), Just(1e308)],
                 prop_oneof![Just(0.0), Just(f64::NAN), Just(-1e308), Just(f64::INFINITY)],
                 prop_oneof![5 => Just(1.0), 5 => 0.1..9.0, 1 => Just(0.0), 1 => Just(f64::NAN), 1 => Just(1e-308), 1 => Just(1e308)]),
                0..300),
            steps in proptest::collection::vec(prop_oneof![0.5..9.0, (1..20).prop_map(|i| f64::from(i) * 0.5)], 1..8),
        ) {
            let y: Vec<f64> = samples.iter().map(|s| s.0).collect();
            let (expected, scale): (Vec<f64>, Vec<f64>) = samples.iter().map(|s| (s.1, s.2)).unzip();
            let fresh = |k| Judged::gated(&y, expected.clone(), scale.clone(), k, &Stop::never()).unwrap();
            let mut gated = Gated::new(fresh(3.0), Some(3.0));
            for k in steps {
                gated = gated.regated(&y, k, &Stop::never()).unwrap().unwrap();
                let plain = fresh(k);
                prop_assert_eq!(gated.verdict(), &plain.verdict);
                let tolerance = (0..y.len()).map(|i| gated.tolerance(i).unwrap());
                prop_assert_eq!(bits(tolerance), bits(plain.tolerance.into_iter()));
            }
        }
    }

    proptest! {
        /// The same where the record has a say.
        #[test]
        fn steps_give_what_a_fresh_gate_gives_where_the_record_has_a_say(
            samples in proptest::collection::vec(
                (prop_oneof![-30.0..30.0, (-60..60).prop_map(|i| f64::from(i) * 0.5), Just(f64::NAN)],
                 prop_oneof![5 => Just(1.0), 5 => 0.1..9.0, 1 => Just(0.0), 1 => Just(f64::NAN)],
                 prop_oneof![0.0..30.0, Just(0.0), (0..60).prop_map(|i| f64::from(i) * 0.5)]),
                0..300),
            doubt in prop_oneof![Just(1.0), Just(0.6), 0.1..1.0],
            lower in prop_oneof![Just(1.0), 0.3..1.0],
            decides in proptest::bool::ANY,
            steps in proptest::collection::vec(prop_oneof![0.5..9.0, (1..20).prop_map(|i| f64::from(i) * 0.5)], 1..8),
        ) {
            let n = samples.len();
            let (y, expected) = (vec![0.0; n], samples.iter().map(|s| s.0).collect::<Vec<f64>>());
            let scale: Vec<f64> = samples.iter().map(|s| s.1).collect();
            let objections: Vec<Objection> = samples.iter().map(|s| Objection { outside: s.2, lower, decides }).collect();
            let fresh = |k| {
                let mut judged = Judged { expected: expected.clone(), scale: scale.clone(), ..Judged::default() };
                judged.gate_by(&y, k, Some((&objections, doubt)), &Stop::never()).unwrap();
                judged
            };
            let record = Record { objections: objections.clone().into(), doubt };
            let mut gated = Gated::new(fresh(3.0), Some(3.0)).with_record(Some(record));
            for k in steps {
                gated = gated.regated(&y, k, &Stop::never()).unwrap().unwrap();
                prop_assert_eq!(gated.verdict(), &fresh(k).verdict);
            }
        }
    }

    #[test]
    fn a_block_is_still_between_its_nearest_ratios() {
        let (y, expected, scale) = ([12.0, 4.0, 40.0], [10.0; 3], [1.0, 2.0, 3.0]);
        let mut verdict = [Verdict::Normal; 3];
        let (low, high) = gate_block(&mut verdict, &y, &expected, (&scale, None), 5.0);
        assert_eq!(verdict, [Verdict::Normal, Verdict::Normal, Verdict::Outlier]);
        assert!((low - 3.0).abs() < 1e-5 && (high - 10.0).abs() < 1e-4 && low > 3.0 && high < 10.0);
    }

    #[test]
    fn what_is_said_of_unseen_samples_stays_when_the_multiplier_is_turned() {
        let y = [0.0, 3.5, 9.0];
        let (expected, scale) = (vec![0.0, 0.0, f64::NAN], vec![1.0, 1.0, f64::NAN]);
        let judged = Judged::gated(&y, expected, scale, 4.0, &Stop::never()).unwrap();
        let (n, o, s) = (Verdict::Normal, Verdict::Outlier, Verdict::Suspect);
        let gated = Gated::new(judged.clone(), Some(4.0)).with_unseen(vec![(2, s)]);
        assert_eq!(gated.verdict(), [n, n, s]);
        let turned = gated.regated(&y, 3.0, &Stop::never()).unwrap().unwrap();
        assert_eq!(turned.verdict(), [n, o, s]);
        let plain = Judged { scale: Vec::new(), ..judged };
        assert_eq!(Gated::new(plain, None).with_unseen(vec![(0, s)]).verdict(), [s, n, Verdict::Unchecked]);
    }

    #[test]
    fn only_a_multiplier_that_gates_can_be_turned() {
        let judged = Judged::unchecked(3);
        let gated = Gated::new(judged, Some(3.0));
        assert!(gated.regated(&[0.0; 3], 2.0, &Stop::never()).unwrap().is_none());
        assert_eq!((gated.verdict().len(), gated.tolerance(1).is_some_and(f64::is_nan)), (3, true));
    }

    #[test]
    fn all_that_was_said_is_shown_and_shared_between_steps() {
        use crate::method::{Direction, Way};
        let way = Directions { forward: Some(Direction::Normal), backward: None };
        let judged = Judged {
            scale: vec![1.0; 2],
            directions: vec![way; 2],
            restarts: vec![Restart { at: 1, way: Way::Forward }],
            warnings: vec!["mind the step".into()],
            ..Judged::gated(&[0.0, 9.0], vec![0.0; 2], vec![1.0; 2], 3.0, &Stop::never()).unwrap()
        };
        let gated = Gated::new(judged.clone(), Some(3.0));
        assert_eq!(gated.directions(), [way; 2]);
        assert_eq!(gated.restarts(), judged.restarts);
        assert_eq!(gated.warnings(), ["mind the step"]);
        assert!(gated.shares_scores(&gated.regated(&[0.0, 9.0], 4.0, &Stop::never()).unwrap().unwrap()));
        assert!(!gated.shares_scores(&Gated::new(judged, Some(3.0))));
    }
}
