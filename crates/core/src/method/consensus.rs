//! The consensus: an outlier is what a number of methods agree on.

use rayon::prelude::*;

use super::noise::by_noise;
use super::shared::{DOUBT, FLOOR, MAX_GAP, SIGMA, multiplier};
use super::{About, Judged, METHODS, Method, Own, Segment, Verdict, judge_segment};
use crate::math::order::median_of_many;
use crate::math::pieces;
use crate::param::{Kind, Param, Settings, Value, Words, always};
use crate::stop::{Stop, Stopped};

/// The method `consensus` of section 8d of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct Consensus;

/// The methods that may vote: all that need no second channel. A session names those that do, so that a method that is
/// added here changes none.
pub const VOTERS: &[&str] = &[
    "wright",
    "trend-wright",
    "chauvenet",
    "romanovsky",
    "grubbs",
    "gesd",
    "odd-even",
    "mean-window",
    "median-window",
    "hampel",
    "poly-window",
    "template",
    "five-point",
    "alpha-beta-gamma",
    "adaptive",
    "diff-median",
    "two-sided",
    "kalman",
];

/// This many methods run at the same time: what bounds the memory.
const AT_ONCE: usize = 4;

/// How many must agree: half of all.
pub const VOTES: Param = Param {
    key: "votes",
    help: "a sample is an outlier when at least this many of the methods flag it",
    unit: "methods",
    kind: Kind::Whole { min: 1, max: 64, step: 1 },
    default: Value::Whole(9),
    paper: None,
    matters: always,
};

/// Who votes.
pub const VOTING: Param = Param {
    key: "methods",
    help: "the methods that vote, each with its default values",
    unit: "",
    kind: Kind::Words(VOTERS),
    default: Value::Words(Words::all(VOTERS)),
    paper: None,
    matters: always,
};

static PARAMS: [Param; 6] = [VOTES, VOTING, SIGMA, MAX_GAP, FLOOR.with_paper(None), DOUBT];

static ABOUT: About = About {
    id: "consensus",
    name: "consensus of several methods",
    family: "consensus",
    source: "beyond",
    advice: "Flags a sample when at least this many of several methods flag it (votes), each with its default values. It is suspect when this many flag or suspect it, and unchecked when fewer can judge it. No single method decides. It takes the time of all its methods together. Choose methods of different kinds: those that flag the same samples count twice.",
    params: &PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Consensus {
    /// The settings under which half of these methods must agree; those that cannot vote are left out.
    ///
    /// # Errors
    /// [`crate::Error::Usage`] where none of them can vote.
    pub fn majority_of<'a>(ids: impl IntoIterator<Item = &'a str>) -> crate::error::Result<Settings> {
        let can: Vec<&str> = ids.into_iter().filter(|id| VOTERS.contains(id)).collect();
        let mut settings = Settings::defaults(&PARAMS);
        let Some(words) = Words::of(VOTERS, can.iter().copied()) else {
            return Err(crate::error::Error::usage(
                "none of these methods can vote",
                "see `wildpoint methods consensus`",
            ));
        };
        settings.set(ABOUT.id, VOTING.key, Value::Words(words))?;
        let half = i64::try_from(can.len().div_ceil(2)).unwrap_or(i64::MAX);
        settings.set(ABOUT.id, VOTES.key, Value::Whole(half))?;
        Ok(settings)
    }

    /// How many methods must agree under these settings, and how many vote.
    #[must_use]
    pub fn votes(settings: &Settings) -> (usize, usize) {
        (settings.whole(VOTES.key), voters(settings).len())
    }
}

impl Method for Consensus {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn asks_others(&self) -> bool {
        true
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        let mut polls = vec![Poll::default(); segment.len()];
        let judge = |method: &&'static dyn Method| {
            let own = of_voter(*method, settings);
            Scaled::of(*method, segment, (&own, settings), stop)?.judge(*method, segment, &own, stop)
        };
        for voters in voters(settings).chunks(AT_ONCE) {
            let said: Vec<Judged> = voters.par_iter().map(judge).collect::<Result<_, Stopped>>()?;
            // In their order, whoever is ready first.
            for judged in &said {
                pieces::over(&mut polls, &|| stop.check(), |first, polls| {
                    for (i, poll) in (first..).zip(polls) {
                        poll.count(segment.y[i], judged, i);
                    }
                })?;
            }
        }
        let votes = settings.whole(VOTES.key);
        let mut judged = Judged::unchecked_many(segment.len(), stop)?;
        for (i, poll) in polls.iter().enumerate() {
            stop.check_at(i)?;
            let verdict = verdict_of([poll.flagged, poll.suspected, poll.checked].map(usize::from), votes);
            judged.verdict[i] = verdict;
            if let Some(decisive) = poll.decisive(verdict) {
                (judged.expected[i], judged.tolerance[i]) = (decisive.expected, decisive.tolerance);
            }
        }
        Ok(judged)
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        let (votes, voters) = Self::votes(settings);
        if votes <= voters {
            return Vec::new();
        }
        vec![format!("votes = {votes}, but {voters} methods vote: nothing can be flagged; lower votes or add methods")]
    }
}

/// The methods that vote under these settings.
fn voters(settings: &Settings) -> Vec<&'static dyn Method> {
    let named = settings.words(VOTING.key);
    let votes = |method: &&&'static dyn Method| named.iter().any(|id| id == method.about().id);
    METHODS.iter().filter(votes).copied().collect()
}

/// The settings of a method that votes: its defaults, with the scales of the consensus.
fn of_voter(method: &dyn Method, settings: &Settings) -> Settings {
    let about = method.about();
    let mut own = Settings::defaults(about.params);
    for key in [SIGMA.key, FLOOR.key, DOUBT.key] {
        if let (Some(value), Some(_)) = (settings.get(key), own.get(key)) {
            // A word that the method does not know leaves it with its own.
            let _ = own.set(about.id, key, value);
        }
    }
    own
}

/// The scales of a segment for a method that votes: what [`noise::scales`](super::noise::scales) gives it when it runs by
/// itself, to the last bit.
struct Scaled {
    sigma: f64,
    floor: f64,
    floors: Vec<f64>,
}

impl Scaled {
    fn of(
        method: &dyn Method,
        segment: &Segment<'_>,
        (own, settings): (&Settings, &Settings),
        stop: &Stop,
    ) -> Result<Self, Stopped> {
        // Floors are limits over the usual multiplier. That of the consensus is a power of two, so nothing is lost.
        let (mine, usual) = (multiplier(settings), multiplier(&Settings::defaults(method.about().params)));
        let floors: Vec<f64> =
            pieces::collect(segment.floors.len(), &|| stop.check(), |i| segment.floors[i] * mine / usual)?;
        let floor = if floors.is_empty() {
            segment.floor
        } else {
            median_of_many(floors.len(), |i| floors[i], &|| stop.check())?
        };
        // No multiplier is usually larger than that of the consensus, so its floor never hides a scale.
        let sigma = match own.get(SIGMA.key) {
            None => 0.0,
            Some(Value::Word(_)) if !by_noise(own) => floor,
            Some(_) => segment.sigma.max(floor),
        };
        Ok(Self { sigma, floor, floors })
    }

    fn judge(
        &self,
        method: &dyn Method,
        segment: &Segment<'_>,
        own: &Settings,
        stop: &Stop,
    ) -> Result<Judged, Stopped> {
        let segment = Segment { sigma: self.sigma, floor: self.floor, floors: &self.floors, ..*segment };
        judge_segment(method, &segment, own, stop)
    }
}

/// What the methods say of a sample.
#[derive(Debug, Clone, Copy, Default)]
struct Poll {
    flagged: u8,
    suspected: u8,
    checked: u8,
    /// What the last of the methods that flag it expected.
    flags: Option<Case>,
    /// What the last of the others expected: of those that find it within their tolerance, where one does.
    keeps: Option<Case>,
}

/// What a method expected of a sample.
#[derive(Debug, Clone, Copy)]
struct Case {
    expected: f64,
    tolerance: f64,
    /// True where the sample lies within the tolerance.
    within: bool,
}

impl Poll {
    fn count(&mut self, y: f64, judged: &Judged, i: usize) {
        let (verdict, expected, tolerance) = (judged.verdict[i], judged.expected[i], judged.tolerance[i]);
        if verdict == Verdict::Unchecked {
            return;
        }
        self.checked += 1;
        self.flagged += u8::from(verdict == Verdict::Outlier);
        self.suspected += u8::from(verdict == Verdict::Suspect);
        if expected.is_nan() || tolerance.is_nan() {
            return;
        }
        let case = Case { expected, tolerance, within: (y - expected).abs() <= tolerance };
        // The later of the list follow a moving target best; whole-segment criteria come first.
        if verdict == Verdict::Outlier {
            self.flags = Some(case);
        } else if case.within || self.keeps.is_none_or(|known| !known.within) {
            self.keeps = Some(case);
        }
    }

    /// What a method with whom the verdict agrees expected.
    fn decisive(&self, verdict: Verdict) -> Option<Case> {
        match verdict {
            Verdict::Outlier => self.flags,
            Verdict::Normal | Verdict::Suspect => self.keeps.or(self.flags),
            Verdict::Unchecked | Verdict::Missing => None,
        }
    }
}

/// The verdict on a sample that this many methods flag, suspect and can judge, when `votes` of them must agree: suspect
/// where this many flag or suspect it, unchecked where so few can judge it that they cannot agree.
#[must_use]
pub fn verdict_of([flagged, suspected, checked]: [usize; 3], votes: usize) -> Verdict {
    if flagged >= votes {
        Verdict::Outlier
    } else if flagged + suspected >= votes {
        Verdict::Suspect
    } else if checked < votes {
        Verdict::Unchecked
    } else {
        Verdict::Normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Random;
    use crate::method::{find, judge_channel, voting};
    use crate::series::Series;

    /// Noise of two sizes on an arc with outliers, runs and steps; stretches of all lengths between gaps.
    fn record(step: f64) -> (Vec<f64>, Vec<f64>) {
        let mut random = Random::new(7);
        let (mut t, mut y, mut now) = (Vec::new(), Vec::new(), 0.0);
        for i in 0..1200_u32 {
            now += if [3, 40, 90, 95, 700].contains(&i) { 30.0 } else { 1.0 };
            let noise = if i < 600 { 1.0 } else { 4.0 } * random.normal();
            let wild = match i {
                150 | 300 | 801 => 25.0,
                400..405 => -40.0,
                900..909 => 60.0,
                1000.. => 200.0,
                _ if i % 37 == 0 => 9.0,
                _ => 0.0,
            };
            let value = 0.002 * f64::from(i * i) + noise + wild;
            t.push(now);
            y.push(if step > 0.0 { (value / step).round() * step } else { value });
        }
        (t, y)
    }

    fn settings(changes: &[(&str, &str)]) -> Settings {
        let mut settings = Settings::defaults(&PARAMS);
        changes.iter().for_each(|(key, text)| settings.set_text("consensus", key, text).unwrap());
        settings
    }

    #[test]
    fn it_is_what_the_votes_of_the_methods_come_to() {
        let never = Stop::never();
        for (step, floor) in [(0.0, "record"), (5.0, "record"), (0.0, "auto"), (0.0, "2.5")] {
            let (t, y) = record(step);
            let series = Series::new(&t, &y);
            let mut all = Vec::new();
            for id in VOTERS {
                let method = find(id).unwrap();
                let mut own = Settings::defaults(method.about().params);
                own.set_text(id, "floor", floor).unwrap();
                let judged = judge_channel(method, &series, None, &own, &never).unwrap();
                all.push(judged.verdict);
            }
            for votes in [1, 5, 9, 18] {
                let votes_text = votes.to_string();
                let settings = settings(&[("votes", &votes_text), ("floor", floor)]);
                let judged = judge_channel(&Consensus, &series, None, &settings, &never).unwrap();
                let count = |i: usize, wanted: &[Verdict]| all.iter().filter(|v| wanted.contains(&v[i])).count();
                for (i, verdict) in judged.verdict.iter().enumerate() {
                    let flagged = count(i, &[Verdict::Outlier]);
                    let doubted = count(i, &[Verdict::Outlier, Verdict::Suspect]);
                    let checked = count(i, &[Verdict::Outlier, Verdict::Suspect, Verdict::Normal]);
                    let expected = match (flagged >= votes, doubted >= votes, checked >= votes) {
                        (true, _, _) => Verdict::Outlier,
                        (_, true, _) => Verdict::Suspect,
                        (_, _, false) => Verdict::Unchecked,
                        _ => Verdict::Normal,
                    };
                    assert_eq!(*verdict, expected, "{i}, {votes} votes, step {step}, floor {floor}");
                }
                assert!(judged.verdict.contains(&Verdict::Outlier) || floor == "2.5" || votes == 18, "{votes} {floor}");
            }
        }
    }

    #[test]
    fn an_outlier_lies_beyond_its_tolerance() {
        let (t, y) = record(0.0);
        let settings = settings(&[("votes", "2"), ("methods", "hampel,kalman,two-sided")]);
        let judged = judge_channel(&Consensus, &Series::new(&t, &y), None, &settings, &Stop::never()).unwrap();
        let outliers = (0..y.len()).filter(|&i| judged.verdict[i] == Verdict::Outlier);
        let mut count = 0;
        for i in outliers {
            count += 1;
            let distance = (y[i] - judged.expected[i]).abs();
            assert!(distance >= judged.tolerance[i] * (1.0 - 1e-9), "{i}: {distance} of {}", judged.tolerance[i]);
        }
        assert!(count > 10, "{count}");
        // Of the good samples on the smooth part nearly all lie within theirs.
        let kept = (5..145).filter(|&i| judged.verdict[i] == Verdict::Normal && i % 37 != 0);
        let beyond = kept.filter(|&i| (y[i] - judged.expected[i]).abs() > judged.tolerance[i]).count();
        assert!(beyond <= 2, "{beyond}");
    }

    #[test]
    fn every_method_without_a_second_channel_may_vote() {
        let all: Vec<&str> = voting().map(|m| m.about()).filter(|a| !a.needs_rate).map(|a| a.id).collect();
        assert_eq!(all, VOTERS);
        assert_eq!(VOTES.default, Value::Whole(VOTERS.len() as i64 / 2), "half of them");
        // What `Scaled` relies on.
        let mine = multiplier(&Settings::defaults(&PARAMS));
        assert!(
            mine.log2().fract() == 0.0 && voting().all(|m| multiplier(&Settings::defaults(m.about().params)) <= mine)
        );
    }

    #[test]
    fn more_votes_than_methods_are_warned_of() {
        assert!(Consensus.warnings(&settings(&[])).is_empty());
        let few = settings(&[("methods", "hampel,kalman"), ("votes", "3")]);
        assert!(Consensus.warnings(&few)[0].contains("nothing can be flagged"));
    }
}
