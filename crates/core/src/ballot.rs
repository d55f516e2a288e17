//! Several methods on one channel: which samples each flags, and how many agree.

use std::ops::Range;

use serde::Serialize;

use crate::math::pieces;
use crate::method::consensus::verdict_of;
use crate::method::{Method, Verdict};
use crate::setup::{Preset, Setup};
use crate::stop::{Stop, Stopped};

/// How many samples this many methods flag.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Agreement {
    /// Number of methods.
    pub methods: usize,
    /// Samples that exactly this many flag.
    pub exactly: usize,
    /// Samples that this many or more flag.
    pub at_least: usize,
}

/// The votes of some methods on the samples of a channel: a method votes for the samples that it flags.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ballot {
    flagged: Vec<u16>,
    suspected: Vec<u16>,
    checked: Vec<u16>,
    /// The methods that voted, and the positions that each flags, ascending.
    voters: Vec<(&'static str, Vec<u32>)>,
}

/// The setups of those of `methods` that can take part, with a preset and without decisions; and the ids of those
/// that cannot, since they need a rate channel and `rate` names none.
#[must_use]
pub fn candidates(
    methods: impl IntoIterator<Item = &'static dyn Method>,
    preset: Preset,
    rate: Option<&str>,
) -> (Vec<Setup>, Vec<&'static str>) {
    let (mut setups, mut left_out) = (Vec::new(), Vec::new());
    for method in methods {
        if method.about().needs_rate && rate.is_none() {
            left_out.push(method.about().id);
            continue;
        }
        setups.push(Setup { rate: rate.map(str::to_owned), ..Setup::new(method, preset) });
    }
    (setups, left_out)
}

impl Ballot {
    /// No votes yet on this many samples.
    #[must_use]
    pub fn new(samples: usize) -> Self {
        Self { flagged: vec![0; samples], suspected: vec![0; samples], checked: vec![0; samples], voters: Vec::new() }
    }

    /// Adds the vote of a method with a verdict for each sample.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for the votes any more; the vote is counted in part then.
    pub fn add(&mut self, method: &'static str, verdicts: &[Verdict], stop: &Stop) -> Result<(), Stopped> {
        let mut own = Vec::new();
        for (i, verdict) in verdicts.iter().enumerate().take(self.flagged.len()) {
            stop.check_at(i)?;
            self.checked[i] += u16::from(*verdict != Verdict::Unchecked);
            self.suspected[i] += u16::from(*verdict == Verdict::Suspect);
            if *verdict == Verdict::Outlier {
                self.flagged[i] += 1;
                own.push(u32::try_from(i).unwrap_or(u32::MAX));
            }
        }
        self.voters.push((method, own));
        Ok(())
    }

    /// How many samples there are.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.flagged.len()
    }

    /// The methods that voted, in their order.
    pub fn ids(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.voters.iter().map(|(id, _)| *id)
    }

    /// How many methods voted.
    #[must_use]
    pub fn methods(&self) -> usize {
        self.voters.len()
    }

    /// How many methods flag the sample at `position`; 0 where there is none.
    #[must_use]
    pub fn votes(&self, position: usize) -> usize {
        self.flagged.get(position).copied().unwrap_or(0).into()
    }

    /// The methods that flag the sample at `position`, in the order in which they voted.
    #[must_use]
    pub fn voters(&self, position: usize) -> Vec<&'static str> {
        self.who(position, true)
    }

    /// The methods that do not flag the sample at `position`, in the order in which they voted.
    #[must_use]
    pub fn others(&self, position: usize) -> Vec<&'static str> {
        self.who(position, false)
    }

    fn who(&self, position: usize, flags: bool) -> Vec<&'static str> {
        let Ok(position) = u32::try_from(position) else { return Vec::new() };
        let found = |own: &[u32]| own.binary_search(&position).is_ok() == flags;
        self.voters.iter().filter(|(_, own)| found(own)).map(|(id, _)| *id).collect()
    }

    /// Methods that flag exactly the same samples, in the order in which they voted; a method that agrees with no other,
    /// and those that flag nothing, are in no group.
    #[must_use]
    pub fn groups(&self) -> Vec<Vec<&'static str>> {
        let mut groups: Vec<(&[u32], Vec<&'static str>)> = Vec::new();
        for (id, own) in self.voters.iter().filter(|(_, own)| !own.is_empty()) {
            match groups.iter_mut().find(|(flagged, _)| *flagged == own.as_slice()) {
                Some((_, group)) => group.push(id),
                None => groups.push((own, vec![id])),
            }
        }
        groups.into_iter().map(|(_, group)| group).filter(|group| group.len() > 1).collect()
    }

    /// The votes that make at least half of the methods.
    #[must_use]
    pub fn half(&self) -> usize {
        self.methods().div_ceil(2).max(1)
    }

    /// The positions that at least this many methods flag, ascending.
    ///
    /// # Errors
    /// [`Stopped`] as soon as nobody waits for them any more.
    pub fn agreed(&self, votes: usize, stop: &Stop) -> Result<Vec<u32>, Stopped> {
        #[expect(clippy::cast_possible_truncation, reason = "the loader refuses files of 2^32 rows and more")]
        let agreed = |piece: Range<usize>| {
            piece.filter(|&i| usize::from(self.flagged[i]) >= votes).map(|i| i as u32).collect::<Vec<u32>>()
        };
        Ok(pieces::map(self.flagged.len(), &|| stop.check(), agreed)?.concat())
    }

    /// How many samples are flagged by this many methods, from one to all.
    #[must_use]
    pub fn agreement(&self) -> Vec<Agreement> {
        let exactly = |k: usize| self.flagged.iter().filter(|f| usize::from(**f) == k).count();
        let mut at_least = 0;
        let mut all: Vec<Agreement> = Vec::new();
        for methods in (1..=self.methods()).rev() {
            let exactly = exactly(methods);
            at_least += exactly;
            all.push(Agreement { methods, exactly, at_least });
        }
        all.reverse();
        all
    }

    /// The verdicts when `votes` methods must agree, as [`verdict_of`] has them.
    #[must_use]
    pub fn verdicts(&self, votes: usize) -> Vec<Verdict> {
        let counts = self.flagged.iter().zip(&self.suspected).zip(&self.checked);
        counts.map(|((f, s), c)| verdict_of([*f, *s, *c].map(usize::from), votes)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::{METHODS, voting};

    #[test]
    fn a_vote_counts_who_flags_and_who_could_judge() {
        use Verdict::{Normal as N, Outlier as O, Suspect as S, Unchecked as U};
        let mut ballot = Ballot::new(5);
        ballot.add("a", &[O, O, N, U, S], &Stop::never()).unwrap();
        ballot.add("b", &[O, N, N, U, N], &Stop::never()).unwrap();
        ballot.add("c", &[O, O, U, O, U], &Stop::never()).unwrap();
        assert_eq!(ballot.verdicts(1), [O, O, N, O, S]);
        assert_eq!(ballot.verdicts(2), [O, O, N, U, N], "one of three judged the fourth sample");
        assert_eq!(ballot.verdicts(3), [O, N, U, U, U]);
        let agreement = ballot.agreement();
        let of = |f: fn(&Agreement) -> usize| agreement.iter().map(f).collect::<Vec<_>>();
        assert_eq!((of(|a| a.exactly), of(|a| a.at_least)), (vec![1, 1, 1], vec![3, 2, 1]));
        assert_eq!((ballot.voters(1), ballot.voters(3), ballot.votes(0)), (vec!["a", "c"], vec!["c"], 3));
        assert_eq!((ballot.half(), ballot.agreed(2, &Stop::never()).unwrap(), ballot.votes(9)), (2, vec![0, 1], 0));
        assert_eq!(ballot.others(1), ["b"]);
        assert!(ballot.groups().is_empty());
        ballot.add("d", &[O, N, N, U, N], &Stop::never()).unwrap();
        ballot.add("e", &[N; 5], &Stop::never()).unwrap();
        ballot.add("f", &[N; 5], &Stop::never()).unwrap();
        assert_eq!(ballot.groups(), [["b", "d"]]);
    }

    #[test]
    fn methods_that_need_a_rate_are_left_out_without_one() {
        let (setups, left_out) = candidates(voting(), Preset::Default, None);
        // Nor does the consensus vote.
        assert_eq!((left_out.as_slice(), setups.len()), (["matched"].as_slice(), METHODS.len() - 2));
        let (setups, left_out) = candidates(voting(), Preset::Paper, Some("v"));
        assert!(left_out.is_empty() && setups.iter().all(|s| s.rate.as_deref() == Some("v")));
        assert!(setups.iter().all(|s| s.settings == Preset::Paper.settings(s.method)));
    }
}
