//! Known wild points for a real record, so that methods can be compared on one's own data.

use super::Random;
use crate::error::{Error, Result};
use crate::method::noise;
use crate::stop::Stop;
use crate::track::Series;

mod text;

/// What is put in. Sizes are in noise scales `difference` of the channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Seed of the random numbers.
    pub seed: u64,
    /// Wild points that stand alone.
    pub isolated: Amount,
    /// Wild points in patches.
    pub patches: Patches,
    /// Lasting changes of the level, which are real and not wild.
    pub steps: Vec<Step>,
    /// Smallest and largest size of a wild point, either way.
    pub amplitude: Span,
    /// The noise scale in the channel's units; measured when there is none.
    pub sigma: Option<f64>,
}

/// This many samples, or such a part of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Amount {
    /// `20`.
    Count(usize),
    /// `1%`, as 0.01.
    Part(f64),
}

/// This many patches of `shortest..longest` samples each: `5x3..8`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Patches {
    /// How many.
    pub count: usize,
    /// Samples of the shortest, 2 at least.
    pub shortest: usize,
    /// Samples of the longest.
    pub longest: usize,
}

/// From a smallest to a largest size: `5..20`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// The smallest, positive.
    pub low: f64,
    /// The largest.
    pub high: f64,
}

/// A lasting change of the level: `10` or `10@1239.5`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Its size, up or down.
    pub size: f64,
    /// The first sample at or after this many seconds from the start of the record has it; a random one when none.
    pub at: Option<f64>,
}

/// What was put in.
#[derive(Debug, Clone, PartialEq)]
pub struct Injection {
    /// The noise scale, in the channel's units.
    pub sigma: f64,
    /// What is added to each present sample; 0 for most.
    pub added: Vec<f64>,
    /// Positions of the wild samples, ascending.
    pub wild: Vec<usize>,
    /// How many stand alone.
    pub isolated: usize,
    /// How many patches there are.
    pub patches: usize,
    /// Positions of the first samples of the steps, in the order of the plan.
    pub steps: Vec<usize>,
}

/// Draws wild points for `series`. Events keep one untouched sample between them, lie inside a segment, and stay
/// clear of the positions that are `already` wild.
///
/// # Errors
/// [`Error::Usage`] when the channel has no noise to measure by, or no room.
pub fn inject(series: &Series<'_>, already: &[usize], plan: &Plan) -> Result<Injection> {
    let sigma = scale(series, plan)?;
    let mut random = Random::new(plan.seed);
    let mut places = Places::new(series, already);
    let mut injection = Injection {
        sigma,
        added: vec![0.0; series.len()],
        wild: Vec::new(),
        isolated: plan.isolated.of(series.len()),
        patches: plan.patches.count,
        steps: Vec::new(),
    };
    for step in &plan.steps {
        let at = step.position(series, &mut random)?;
        injection.added[at..].iter_mut().for_each(|a| *a += step.size * sigma);
        injection.steps.push(at);
    }
    // The long ones first: they find room more easily.
    let patches = (0..plan.patches.count).map(|_| (plan.patches.shortest, plan.patches.longest));
    let singles = (0..injection.isolated).map(|_| (1, 1));
    for (shortest, longest) in patches.chain(singles) {
        let length = random.whole(shortest, longest);
        let start = places.take(length, &mut random)?;
        let level = random.sign() * random.between(plan.amplitude.low, plan.amplitude.high);
        for position in start..start + length {
            // The errors of a patch are about the same: a tenth of the level and never below the smallest size.
            let shape = if length == 1 { 0.0 } else { 0.1 * level * random.uniform() };
            injection.added[position] += (level + shape) * sigma;
            injection.wild.push(position);
        }
    }
    injection.wild.sort_unstable();
    Ok(injection)
}

fn scale(series: &Series<'_>, plan: &Plan) -> Result<f64> {
    if let Some(sigma) = plan.sigma {
        return Ok(sigma);
    }
    let whole = 0..series.len();
    let whole = std::slice::from_ref(&whole);
    let stop = Stop::never();
    let measured = [noise::by_difference(series, whole, &stop)?, noise::auto_floor(series, whole, &stop)?];
    let sigma = measured.concat().into_iter().fold(0.0, f64::max);
    if sigma > 0.0 {
        return Ok(sigma);
    }
    Err(Error::usage(
        "the channel has no noise by which wild points could be sized",
        "give its noise scale in the channel's units with --sigma, or name another channel",
    ))
}

impl Step {
    fn position(&self, series: &Series<'_>, random: &mut Random) -> Result<usize> {
        let n = series.len();
        let at = match (self.at, series.t.first()) {
            (Some(seconds), Some(start)) => series.before(start + seconds),
            _ => random.whole(1.min(n), n.saturating_sub(1)),
        };
        if at < n {
            return Ok(at);
        }
        let length = series.t.last().copied().unwrap_or(0.0) - series.t.first().copied().unwrap_or(0.0);
        Err(Error::usage(
            format!("a step at {} s lies behind the record", self.at.unwrap_or(0.0)),
            format!("times of steps count from the start of the record, which lasts {length} s"),
        ))
    }
}

impl Amount {
    fn of(self, samples: usize) -> usize {
        match self {
            Self::Count(n) => n,
            #[expect(
                clippy::cast_precision_loss,
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a part of a number of samples"
            )]
            Self::Part(part) => (part * samples as f64).round() as usize,
        }
    }
}

/// Where there is room.
struct Places<'a> {
    series: &'a Series<'a>,
    /// Wild ones and their neighbours.
    taken: Vec<bool>,
}

/// Random draws before a place is looked for one by one.
const DRAWS: usize = 200;

impl<'a> Places<'a> {
    fn new(series: &'a Series<'a>, already: &[usize]) -> Self {
        let mut places = Self { series, taken: vec![false; series.len()] };
        already.iter().for_each(|&at| places.close(at, 1));
        places
    }

    fn close(&mut self, start: usize, length: usize) {
        let end = (start + length + 1).min(self.taken.len());
        self.taken[start.saturating_sub(1)..end].fill(true);
    }

    fn is_free(&self, start: usize, length: usize) -> bool {
        let whole = start + length <= self.taken.len();
        whole
            && !self.taken[start..start + length].contains(&true)
            && (start + 1..start + length).all(|i| self.series.lost_before(i) == 0)
    }

    fn take(&mut self, length: usize, random: &mut Random) -> Result<usize> {
        let last = self.taken.len().checked_sub(length);
        let drawn = last.and_then(|last| (0..DRAWS).map(|_| random.whole(0, last)).find(|&s| self.is_free(s, length)));
        // A crowded record: go round from a random place.
        let found = drawn.or_else(|| {
            let last = last?;
            let from = random.whole(0, last);
            (from..=last).chain(0..from).find(|&s| self.is_free(s, length))
        });
        let Some(start) = found else {
            return Err(Error::usage(
                format!("there is no room for another {length} wild samples with a good one on each side"),
                "ask for fewer or shorter ones",
            ));
        };
        self.close(start, length);
        Ok(start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan() -> Plan {
        Plan {
            seed: 3,
            isolated: Amount::Part(0.01),
            patches: Patches { count: 5, shortest: 3, longest: 8 },
            steps: Vec::new(),
            amplitude: Span { low: 5.0, high: 20.0 },
            sigma: Some(2.0),
        }
    }

    fn clock(n: usize) -> Vec<f64> {
        (0..n).map(|i| if i < 500 { i as f64 } else { i as f64 + 40.0 }).collect()
    }

    #[test]
    fn what_was_asked_for_is_put_in_with_a_good_sample_between() {
        let (t, y) = (clock(1000), vec![0.0; 1000]);
        let series = Series::new(&t, &y);
        let injection = inject(&series, &[100], &plan()).unwrap();
        assert_eq!((injection.isolated, injection.patches, injection.sigma), (10, 5, 2.0));
        let runs: Vec<&[usize]> = injection.wild.chunk_by(|a, b| a + 1 == *b).collect();
        assert_eq!(runs.len(), 15, "events do not touch");
        assert_eq!(runs.iter().filter(|r| r.len() == 1).count(), 10);
        assert!(runs.iter().all(|r| r.len() <= 8 && r.len() != 2));
        assert!(runs.iter().all(|r| !r[1..].contains(&500)), "none over the gap");
        assert!(injection.wild.iter().all(|i| !(99..=101).contains(i)), "none beside one that was there");
        for (i, added) in injection.added.iter().enumerate() {
            let size = added.abs() / 2.0;
            assert_eq!(injection.wild.contains(&i), *added != 0.0);
            assert!(*added == 0.0 || (5.0..=22.0).contains(&size), "{size}");
        }
        assert_eq!(inject(&series, &[100], &plan()).unwrap(), injection);
        assert_ne!(inject(&series, &[100], &Plan { seed: 4, ..plan() }).unwrap(), injection);
    }

    #[test]
    fn a_step_lasts_and_is_not_wild() {
        let (t, y) = (clock(400), vec![0.0; 400]);
        let none = Plan { isolated: Amount::Count(0), patches: Patches::default(), ..plan() };
        let steps = vec![Step { size: -10.0, at: Some(299.5) }];
        let injection = inject(&Series::new(&t, &y), &[], &Plan { steps, ..none.clone() }).unwrap();
        assert!(injection.wild.is_empty() && injection.steps == [300]);
        assert!(injection.added[..300].iter().all(|a| *a == 0.0) && injection.added[300..].iter().all(|a| *a == -20.0));
        let late = vec![Step { size: 1.0, at: Some(1000.0) }];
        let e = inject(&Series::new(&t, &y), &[], &Plan { steps: late, ..none }).unwrap_err().to_string();
        assert!(e.contains("lasts 399 s"), "{e}");
    }

    #[test]
    fn a_wild_sample_that_was_there_keeps_its_neighbours() {
        let (t, y) = (clock(7), vec![0.0; 7]);
        for seed in 0..50 {
            let two = Plan { seed, isolated: Amount::Count(2), patches: Patches::default(), ..plan() };
            let wild = inject(&Series::new(&t, &y), &[3], &two).unwrap().wild;
            assert!(wild[0] < 2 && wild[1] > 4, "{wild:?}");
        }
    }

    #[test]
    fn a_record_without_noise_or_room_is_refused() {
        let (t, y) = (clock(40), vec![7.0; 40]);
        let series = Series::new(&t, &y);
        let e = inject(&series, &[], &Plan { sigma: None, ..plan() }).unwrap_err().to_string();
        assert!(e.contains("no noise") && e.contains("--sigma"), "{e}");
        let full = Plan { isolated: Amount::Count(30), ..plan() };
        assert!(inject(&series, &[], &full).unwrap_err().to_string().contains("no room"));
        // 14 single ones and a half fit: every second sample.
        let half = Plan { isolated: Amount::Count(14), patches: Patches::default(), ..plan() };
        assert_eq!(inject(&series, &[], &half).unwrap().wild.len(), 14);
    }
}
