//! Changes faster than the quantity can change.

use super::islands::islands;
use super::{About, Check, Limits, Objection, Own, Subject, shared};
use crate::error::Error;
use crate::method::{Verdict, exceeds};
use crate::param::{Param, Settings};
use crate::stop::{Stop, Stopped};

/// The rate of change.
#[derive(Debug)]
pub struct Rate;

static PARAMS: &[Param] = &[
    shared::limit(shared::SUSPECT, "a faster change is suspect", "channel units per second", f64::MIN_POSITIVE),
    shared::limit(shared::FAIL, "a faster change, and back, fails", "channel units per second", f64::MIN_POSITIVE),
    shared::LONGEST,
];

static ABOUT: About = About {
    id: "rate",
    help: "samples that cannot be reached from neighbouring samples at the largest possible change per second",
    params: PARAMS,
    own: Own::Line,
    channels: None,
};

/// The change from one sample to another, the short way round where the channel is circular.
fn change(subject: &Subject<'_>, a: usize, b: usize) -> f64 {
    let change = subject.y[b] - subject.y[a];
    match subject.period {
        Some(period) => (change - period * (change / period).round()).abs(),
        None => change.abs(),
    }
}

impl Check for Rate {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn examine(&self, subject: &Subject<'_>, settings: &Settings, stop: &Stop) -> Result<Vec<Objection>, Stopped> {
        let rate = |a: usize, b: usize| change(subject, a, b) / (subject.t[b] - subject.t[a]);
        let n = subject.y.len();
        let longest = settings.whole(shared::LONGEST.key);
        let mut verdicts: Vec<Option<Objection>> = Vec::new();
        let Limits { suspect, fail } = Limits::of(settings);
        // The stricter limit comes last and takes the place of what the other said.
        for (limit, beyond) in [(suspect, Verdict::Suspect), (fail, Verdict::Outlier)] {
            let Some(limit) = limit else { continue };
            for island in islands(n, longest, |a, b| exceeds(rate(a, b), limit), stop)? {
                let range = island.range;
                let into = if range.start > 0 { rate(range.start - 1, range.start) } else { 0.0 };
                let out = if range.end < n { rate(range.end - 1, range.end) } else { 0.0 };
                let found = into.max(out);
                let verdict = if island.both_sides { beyond } else { Verdict::Suspect };
                verdicts.resize(n, None);
                for position in range {
                    verdicts[position] = Some(Objection { position, verdict, found, limit });
                }
            }
        }
        Ok(verdicts.into_iter().flatten().collect())
    }

    fn verify(&self, settings: &Settings) -> Result<(), Error> {
        Limits::of(settings).verify("rate", "rate:fail=30")
    }

    fn evidence(&self, o: &Objection) -> String {
        format!("changes by {:.6} per second, at most {}", o.found, o.limit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn examine(y: &[f64], period: Option<f64>, pairs: &[(&str, &str)]) -> Vec<(usize, Verdict)> {
        let mut settings = Settings::defaults(PARAMS);
        pairs.iter().for_each(|(key, value)| settings.set_text("rate", key, value).unwrap());
        let t: Vec<f64> = (0..y.len()).map(|i| i as f64 * 0.5).collect();
        let subject = Subject { t: &t, y, period, channels: &[] };
        let found = Rate.examine(&subject, &settings, &Stop::never()).unwrap();
        found.iter().map(|o| (o.position, o.verdict)).collect()
    }

    #[test]
    fn a_spike_fails_a_smaller_one_is_suspect_and_a_slope_is_neither() {
        let mut y: Vec<f64> = (0..60).map(f64::from).collect();
        y[20] += 30.0;
        y[40] -= 4.0;
        let said = examine(&y, None, &[("suspect", "5"), ("fail", "20")]);
        assert_eq!(said, [(20, Verdict::Outlier), (40, Verdict::Suspect)]);
        assert!(examine(&y, None, &[("fail", "100")]).is_empty());
    }

    #[test]
    fn a_step_to_another_level_is_suspect_at_its_first_sample_only() {
        let y: Vec<f64> = (0..80).map(|i| if i < 45 { 3.0 } else { 90.0 }).collect();
        assert_eq!(examine(&y, None, &[("fail", "20")]), [(45, Verdict::Suspect)]);
    }

    #[test]
    fn a_circular_channel_changes_the_short_way_round() {
        let y: Vec<f64> = (0..60).map(|i| f64::from(330 + i) % 360.0).collect();
        assert!(examine(&y, Some(360.0), &[("fail", "5")]).is_empty());
        assert!(!examine(&y, None, &[("fail", "5")]).is_empty());
    }
}
