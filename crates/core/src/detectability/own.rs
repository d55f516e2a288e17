//! Which kinds of wild points a record has of its own, and how much each kind weighs for it.

use std::ops::Range;

use super::event::Kind;

/// How much a kind of wild point weighs on a record.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct OfKind {
    /// The kind.
    pub kind: Kind,
    /// Runs of samples of the untouched record that object by their limit or more and are nearest to this kind.
    pub own: usize,
    /// Its share in the recall of a method; the sum over all kinds is 1.
    pub weight: f64,
}

/// Single points weigh as much as all other kinds together on a record that shows none of its own: most wild points are
/// isolated (section 1 of \[001\]).
const OF_SINGLE: f64 = 0.5;

/// What is wild of a record by its calibration alone, before any method.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shown<'a> {
    /// For each sample, whether it objects by its limit or more.
    pub(super) wild: &'a [bool],
    /// Values of all samples.
    pub(super) y: &'a [f64],
    /// The stretches between cuts.
    pub(super) segments: &'a [Range<usize>],
    /// The fill value, where the record has one.
    pub(super) dropout: Option<f64>,
}

impl Shown<'_> {
    /// How much each of `kinds` weighs: the share of the record's own wild points that are of this kind, where as many
    /// more are counted as there are kinds, half of them single points. So a record with none of its own, or few, is
    /// asked as any other, and one with many runs of ten is asked for runs of ten (additive smoothing).
    pub(super) fn weights(&self, kinds: &[Kind]) -> Vec<OfKind> {
        let mut own = vec![0_usize; kinds.len()];
        for run in self.runs() {
            let kind = self.kind(run, kinds);
            if let Some(index) = kinds.iter().position(|k| *k == kind) {
                own[index] += 1;
            }
        }
        weighed(kinds, &own)
    }

    /// The runs of wild samples within the segments.
    fn runs(&self) -> impl Iterator<Item = Range<usize>> {
        self.segments.iter().flat_map(|segment| {
            let mut start = segment.start;
            self.wild[segment.clone()].chunk_by(|a, b| a == b).filter_map(move |run| {
                let range = start..start + run.len();
                start = range.end;
                run[0].then_some(range)
            })
        })
    }

    fn kind(&self, run: Range<usize>, kinds: &[Kind]) -> Kind {
        let values = &self.y[run];
        let same = |value: f64| values.iter().all(|y| y.to_bits() == value.to_bits());
        if kinds.contains(&Kind::Dropout) && self.dropout.is_some_and(same) {
            return Kind::Dropout;
        }
        if kinds.contains(&Kind::Held) && values.len() > 1 && same(values[0]) {
            return Kind::Held;
        }
        // The nearest length by ratio: the limits are the roots of 1 * 2, 2 * 5 and 5 * 10.
        match values.len() {
            1 => Kind::Single,
            2..=3 => Kind::RunOf2,
            4..=7 => Kind::RunOf5,
            _ => Kind::RunOf10,
        }
    }
}

#[expect(clippy::cast_precision_loss, reason = "counts of samples are far below 2^53")]
fn weighed(kinds: &[Kind], own: &[usize]) -> Vec<OfKind> {
    let added = kinds.len() as f64;
    let all = own.iter().sum::<usize>() as f64 + added;
    let of = |(&kind, &own): (&Kind, &usize)| {
        let share = if kind == Kind::Single { OF_SINGLE } else { (1.0 - OF_SINGLE) / (added - 1.0) };
        OfKind { kind, own, weight: (own as f64 + added * share) / all }
    };
    kinds.iter().zip(own).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The kinds of the runs of `wild` in one segment.
    fn own(wild: &str, y: &[f64], kinds: &[Kind], dropout: Option<f64>) -> Vec<usize> {
        let wild: Vec<bool> = wild.chars().map(|c| c == 'w').collect();
        let whole = 0..wild.len();
        let shown = Shown { wild: &wild, y, segments: std::slice::from_ref(&whole), dropout };
        shown.weights(kinds).iter().map(|of| of.own).collect()
    }

    #[test]
    fn a_run_counts_for_the_nearest_length() {
        let y: Vec<f64> = (0..40).map(f64::from).collect();
        let wild = format!("w.ww.www.{}.{}.{}", "w".repeat(4), "w".repeat(7), "w".repeat(8));
        assert_eq!(own(&wild, &y, &Kind::COMMON, None), [1, 2, 2, 1]);
    }

    #[test]
    fn held_values_and_dropouts_are_kinds_of_their_own_where_the_record_has_such() {
        let y = [1.0, 7.0, 7.0, 2.0, 0.0, 0.0, 0.0, 3.0];
        let wild = ".ww.www.";
        assert_eq!(own(wild, &y, &Kind::ALL, Some(0.0)), [0, 0, 0, 0, 1, 1]);
        assert_eq!(own(wild, &y, &Kind::COMMON, None), [0, 2, 0, 0]);
    }

    #[test]
    fn a_cut_ends_a_run() {
        let shown = Shown { wild: &[true; 4], y: &[0.0; 4], segments: &[0..2, 2..4], dropout: None };
        assert_eq!(shown.weights(&Kind::COMMON)[1].own, 2);
    }

    #[test]
    fn what_the_record_shows_moves_the_weights() {
        let weights = |own: &[usize]| weighed(&Kind::COMMON, own).iter().map(|of| of.weight).collect::<Vec<_>>();
        let none = weights(&[0; 4]);
        assert!(
            none.iter().zip([0.5, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0]).all(|(a, b)| (a - b).abs() < 1e-12),
            "{none:?}"
        );
        // Four of the record's own weigh as much as the four that are added.
        let tens = weights(&[0, 0, 0, 4]);
        assert!((tens[3] - (0.5 + 0.5 / 6.0)).abs() < 1e-12 && (tens[0] - 0.25).abs() < 1e-12, "{tens:?}");
        assert!((tens.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }
}
