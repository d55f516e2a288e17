//! Which method to take on a record.

use serde::ser::{Serialize, Serializer};

use super::curve::{Curve, Point, sizes};
use super::event::Kind;
use super::ground::Ground;
use super::own::OfKind;
use super::round::{Found, Tally};
use super::{Alone, EVENTS, Study, Unsuitable};
use crate::setup::Setup;

/// What weighs as much as a recall that is worse by 0.1: one false flag in this many samples.
const FALSE: f64 = 100.0;

/// A method with a larger share of false flags is not recommended while there is another.
const MOST_FALSE: f64 = 0.01;

/// The same for samples that it leaves open: its suspects and what it cannot judge. Somebody has to look at each.
const MOST_OPEN: f64 = 0.05;

/// Methods whose merits differ by less are equally good.
const EQUAL: f64 = 0.01;

/// What is known of methods on a record.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Advice {
    /// Samples of the record.
    pub samples: usize,
    /// Samples on which the methods were tried: fewer than those of a long record.
    pub tried: usize,
    /// The median of the residuals at which noise ends, in channel units; none where the record cannot be asked.
    pub limit: Option<f64>,
    /// Rounds that are done, of all.
    pub rounds: [usize; 2],
    /// The kinds of wild points that are put in, and how much each weighs; empty where the record cannot be asked.
    pub weights: Vec<OfKind>,
    /// A row for each setup, in the order in which they were given.
    pub methods: Vec<Measured>,
    /// The best of them; none before the first round.
    pub recommended: Option<usize>,
    /// The second best.
    pub runner_up: Option<usize>,
    /// Why the record cannot be asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unsuitable: Option<Unsuitable>,
}

/// What is known of a method.
#[derive(Debug, Clone, serde::Serialize)]
pub struct Measured {
    /// The method with its settings.
    #[serde(serialize_with = "settings")]
    pub setup: Setup,
    /// What it finds, kind by kind.
    pub kinds: Vec<Curve>,
    /// What it says of the record as it is.
    pub untouched: Untouched,
    /// Root mean square of its repairs minus the values before, in channel units; none where it repaired nothing.
    pub repair_error: Option<f64>,
    /// Wild samples that it removed.
    pub removed: usize,
    /// The share that it finds, from 0 to 1: the mean over sizes, and over kinds by
    /// [`Advice::weights`].
    pub recall: f64,
    /// The recall less a tenth for each false flag in a hundred samples, and less the share that it misses of what half of
    /// the methods flag on the record as it is.
    pub merit: f64,
    /// Milliseconds for the record as it is, with the calibration known.
    pub milliseconds: f64,
}

/// What a method says of the record as it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Untouched {
    /// Outliers.
    pub flagged: usize,
    /// Those that fewer than half of the methods flag and that object by less than their limit: they are taken for false.
    /// A method counts as much as it finds of what was put in.
    pub alone: usize,
    /// Samples that half of the methods flag, or that object by their limit or more, and that this one does not flag: they
    /// are taken for wild points of the record's own.
    pub missed: usize,
    /// Suspects.
    pub suspects: usize,
    /// Samples that it cannot judge.
    pub unchecked: usize,
}

fn settings<S: Serializer>(setup: &Setup, serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(serde::Serialize)]
    struct Method<'a> {
        method: &'static str,
        settings: &'a crate::param::Settings,
    }
    Method { method: setup.method.about().id, settings: &setup.settings }.serialize(serializer)
}

impl Advice {
    /// What came out of `study` so far.
    pub(super) fn of(study: &Study) -> Self {
        let methods = match &study.ground {
            Ok(ground) => measured(ground, &study.setups, &study.tallies, &study.untouched),
            Err(_) => Vec::new(),
        };
        Self::among(study, methods)
    }

    /// The same about other methods that were measured on the copies of `study`.
    pub(super) fn among(study: &Study, methods: Vec<Measured>) -> Self {
        let rounds = [study.rounds.done, study.rounds.all];
        let (tried, limit, weights) = match &study.ground {
            Ok(ground) => (ground.y.len(), Some(ground.typical_limit()), ground.kinds.clone()),
            Err(_) => (0, None, Vec::new()),
        };
        let order = if rounds[0] > 0 { ranked(&methods, tried) } else { Vec::new() };
        Self {
            samples: study.samples,
            tried,
            limit,
            rounds,
            weights,
            methods,
            recommended: order.first().copied(),
            runner_up: order.get(1).copied(),
            unsuitable: study.unsuitable(),
        }
    }

    /// True when no round is left to do.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.rounds[0] >= self.rounds[1]
    }

    /// The row of the method that is recommended.
    #[must_use]
    pub fn best(&self) -> Option<&Measured> {
        self.methods.get(self.recommended?)
    }
}

impl Measured {
    /// What it finds of wild points of this kind.
    #[must_use]
    pub fn of_kind(&self, kind: Kind) -> Option<&Curve> {
        self.kinds.iter().find(|curve| curve.kind == kind)
    }
}

/// What is known of the methods of `setups`, from what they found and what they say of the record as it is.
pub(super) fn measured(ground: &Ground, setups: &[Setup], tallies: &[Tally], said: &[Alone]) -> Vec<Measured> {
    let (kinds, limit, tried) = (&ground.kinds, ground.typical_limit(), ground.y.len());
    let found: Vec<Vec<Curve>> = tallies.iter().map(|tally| curves(kinds, &tally.found, limit)).collect();
    let recalls: Vec<f64> = found.iter().map(|curves| recall(curves, kinds)).collect();
    let flagged: Vec<&[u32]> = said.iter().map(|said| said.flagged.as_slice()).collect();
    let majority = Majority::of(&flagged, &recalls, &ground.wild);
    let of = |(index, (setup, kinds)): (usize, (&Setup, Vec<Curve>))| {
        let (tally, said, recall) = (&tallies[index], &said[index], recalls[index]);
        let untouched = Untouched {
            flagged: said.flagged.len(),
            alone: majority.alone(&said.flagged),
            missed: majority.missed(&said.flagged),
            suspects: said.suspects,
            unchecked: said.unchecked,
        };
        Measured {
            setup: setup.clone(),
            kinds,
            untouched,
            repair_error: tally.repairs.error(),
            removed: tally.repairs.removed,
            recall,
            merit: recall
                - 0.1 * FALSE * share(untouched.alone, tried)
                - share(untouched.missed, majority.agreed + EVENTS),
            milliseconds: said.milliseconds,
        }
    };
    setups.iter().zip(found).enumerate().map(of).collect()
}

fn curves(kinds: &[OfKind], found: &[Found], limit: f64) -> Vec<Curve> {
    let mut found = found.iter().copied();
    let of_kind = |&OfKind { kind, .. }: &OfKind| {
        let point = |limits: Option<f64>| {
            let Found { events, flagged, seen } = found.next().unwrap_or_default();
            Point { limits, events, found: flagged, seen }
        };
        Curve::new(kind, sizes(kind).map(point).collect(), limit)
    };
    kinds.iter().map(of_kind).collect()
}

/// What is taken for wild of the untouched record: what its calibration says, which asks no method, and the weighted vote of
/// all methods. The weight of a method is its recall of the added points: the silence of a method that finds none of them
/// means nothing.
struct Majority<'a> {
    /// What the calibration says.
    wild: &'a [bool],
    /// For each sample the weight of the methods that flag it.
    votes: Vec<f64>,
    /// What makes half of all weight.
    half: f64,
    /// How many samples are taken for wild.
    agreed: usize,
}

impl<'a> Majority<'a> {
    fn of(flagged: &[&[u32]], weights: &[f64], wild: &'a [bool]) -> Self {
        let mut votes = vec![0.0; wild.len()];
        for (list, weight) in flagged.iter().zip(weights) {
            list.iter().for_each(|&at| votes[at as usize] += weight);
        }
        // Sums in another order may differ in their last bits: what is half of them is no less.
        let half = 0.5 * weights.iter().sum::<f64>() * (1.0 - 1e-9);
        let mut all = Self { wild, votes, half, agreed: 0 };
        all.agreed = (0..wild.len()).filter(|&at| all.flags(at)).count();
        all
    }

    fn flags(&self, at: usize) -> bool {
        self.wild[at] || self.votes[at] > 0.0 && self.votes[at] >= self.half
    }

    /// How many of these are not taken for wild.
    fn alone(&self, flagged: &[u32]) -> usize {
        flagged.iter().filter(|at| !self.flags(**at as usize)).count()
    }

    /// How many that are taken for wild are not among these.
    fn missed(&self, flagged: &[u32]) -> usize {
        self.agreed - (flagged.len() - self.alone(flagged))
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts of samples are far below 2^53")]
fn share(count: usize, samples: usize) -> f64 {
    count as f64 / samples.max(1) as f64
}

/// The share of all that was put in: the mean over the kinds by their weights. A kind for which there was room nowhere says
/// nothing.
fn recall(curves: &[Curve], kinds: &[OfKind]) -> f64 {
    let known = || curves.iter().zip(kinds).filter_map(|(curve, kind)| Some((curve.recall?, kind.weight)));
    let weight: f64 = known().map(|(_, weight)| weight).sum();
    if weight > 0.0 { known().map(|(recall, weight)| recall * weight).sum::<f64>() / weight } else { 0.0 }
}

/// The rows from the best to the worst. Of equally good ones the first is that with the fewest false flags, then that
/// with the best repairs.
fn ranked(methods: &[Measured], samples: usize) -> Vec<usize> {
    let falsely = |m: &Measured| share(m.untouched.alone, samples);
    let mut order: Vec<usize> = (0..methods.len()).collect();
    let open = |m: &Measured| share(m.untouched.suspects + m.untouched.unchecked, samples);
    // What is false is in the results; what is left open costs somebody's time.
    let worse = |m: &Measured| [falsely(m) > MOST_FALSE, open(m) > MOST_OPEN];
    order.sort_by(|&a, &b| {
        let (a, b) = (&methods[a], &methods[b]);
        worse(a).cmp(&worse(b)).then(b.merit.total_cmp(&a.merit))
    });
    let Some(&best) = order.first() else { return order };
    let equal =
        |i: &usize| worse(&methods[*i]) == worse(&methods[best]) && methods[*i].merit > methods[best].merit - EQUAL;
    let count = order.iter().take_while(|i| equal(i)).count();
    let error = |i: usize| methods[i].repair_error.unwrap_or(f64::INFINITY);
    order[..count].sort_by(|&a, &b| {
        let alone = |i: usize| methods[i].untouched.alone;
        alone(a).cmp(&alone(b)).then(error(a).total_cmp(&error(b)))
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_half_of_the_methods_flag_is_not_false() {
        let lists: [&[u32]; 4] = [&[1, 5], &[5], &[5, 7], &[]];
        let majority = Majority::of(&lists, &[1.0; 4], &[false; 10]);
        assert_eq!(lists.map(|list| majority.alone(list)), [1, 0, 1, 0]);
        assert_eq!((majority.agreed, lists.map(|list| majority.missed(list))), (1, [0, 0, 0, 1]));
        let one = Majority::of(&[&[3]], &[0.4], &[false; 10]);
        assert_eq!((one.alone(&[3]), one.missed(&[3])), (0, 0), "one method alone has nobody to disagree with");
    }

    /// A method on 1000 samples with this merit, these numbers of suspects and of false flags.
    fn row(merit: f64, suspects: usize, alone: usize) -> Measured {
        Measured {
            setup: Setup::standard(),
            kinds: Vec::new(),
            untouched: Untouched { flagged: alone, alone, suspects, ..Untouched::default() },
            repair_error: None,
            removed: 0,
            recall: merit,
            merit,
            milliseconds: 1.0,
        }
    }

    #[test]
    fn a_method_that_leaves_many_samples_open_comes_after_those_that_do_not() {
        let rows = [row(0.9, 60, 0), row(0.7, 50, 0), row(0.8, 10, 20), row(0.5, 0, 0)];
        assert_eq!(ranked(&rows, 1000), [1, 3, 0, 2]);
        // Where all do, the merit decides.
        assert_eq!(ranked(&[row(0.5, 80, 0), row(0.9, 60, 0)], 1000), [1, 0]);
    }

    #[test]
    fn methods_that_find_nothing_have_no_say() {
        // Three methods collapse on a record full of wild points; the fourth does not.
        let lists: [&[u32]; 4] = [&[], &[], &[], &[2, 4, 6]];
        assert_eq!(Majority::of(&lists, &[1.0; 4], &[false; 10]).alone(lists[3]), 3);
        let majority = Majority::of(&lists, &[0.0, 0.05, 0.05, 0.8], &[false; 10]);
        assert_eq!((majority.alone(lists[3]), majority.missed(lists[1])), (0, 3));
    }

    #[test]
    fn what_the_calibration_objects_to_is_not_false_and_must_be_found() {
        // A run that one method of four finds, as the calibration does.
        let lists: [&[u32]; 4] = [&[2, 3, 4, 8], &[], &[], &[]];
        let mut wild = [false; 10];
        wild[2..5].fill(true);
        let majority = Majority::of(&lists, &[1.0; 4], &wild);
        assert_eq!(lists.map(|list| majority.alone(list)), [1, 0, 0, 0]);
        assert_eq!(lists.map(|list| majority.missed(list)), [0, 3, 3, 3]);
    }
}
