//! The methods that can judge from the past alone, each as an [`Online`].

use std::ops::Range;

use super::judge::{Event, Online, Said};
use super::setup::Plan;
use super::template::Template;
use crate::method::adaptive::AdaptiveLine;
use crate::method::alpha_beta_gamma::Tracker;
use crate::method::five_point::Line;
use crate::method::kalman::{Measured, Single, Tuning};
use crate::method::predictor::{Answer, Engine, Model, Prediction, Rules, Sink};
use crate::method::two_sided::{Bounded, Candidates, Closest};
use crate::method::{Verdict, shared};
use crate::param::{Choice, Settings};

/// The ids of the methods that can judge a stream.
pub(super) const METHODS: [&str; 6] = ["five-point", "alpha-beta-gamma", "adaptive", "template", "kalman", "two-sided"];

/// A new segment of the stream. The plan names one of [`METHODS`].
pub(super) fn online(plan: &Plan, interval: f64) -> Box<dyn Online> {
    let settings = &plan.settings;
    let (sigma, floor) = scales(settings);
    let max_run = settings.get(shared::MAX_RUN.key).map_or(0, |_| settings.whole(shared::MAX_RUN.key));
    match plan.method.about().id {
        "five-point" => Fed::new(Line::new(sigma, &Rules::of(settings)), interval, max_run, |y| y, Says),
        "alpha-beta-gamma" => {
            let tracker = Tracker::new(sigma, settings.real("alpha"), &Rules::of(settings));
            Fed::new(tracker, interval, max_run, |y| y, Says)
        }
        "adaptive" => {
            let line = AdaptiveLine::new(sigma, floor, settings, &Rules::of(settings));
            Fed::new(line, interval, max_run, |y| y, Says)
        }
        "kalman" => {
            let filter = Single::new(Tuning::of(settings, sigma, interval));
            Fed::new(filter, interval, max_run, |y| Measured { y, filled: false }, Says)
        }
        "template" => Box::new(Template::new(settings, floor)),
        _ => {
            let delta = match settings.choice("delta") {
                Choice::Number(delta) => delta,
                Choice::Word(_) => settings.real(shared::K.key) * sigma,
            };
            let candidates = Candidates::new(settings, sigma, interval);
            Fed::new(candidates, interval, max_run, move |y| Bounded { y, delta }, Forward { delta })
        }
    }
}

/// Noise scale (at least the floor) and floor, as numbers; 0 where the method has no such setting.
fn scales(settings: &Settings) -> (f64, f64) {
    let number = |key: &str| match settings.get(key).map(|_| settings.choice(key)) {
        Some(Choice::Number(x)) => x,
        _ => 0.0,
    };
    let floor = number(shared::FLOOR.key);
    (number(shared::SIGMA.key).max(floor), floor)
}

/// Turns what an engine says into events.
trait Words<P>: Copy {
    /// Of a sample that was predicted.
    fn of(&self, answer: Answer, prediction: &P) -> Said;
    /// Of the samples of a run at which the model was lost; none when what was said of them stands.
    fn of_lost(&self) -> Option<Said>;
}

/// The words of the predictors of section 4 and of the innovation test.
#[derive(Clone, Copy)]
struct Says;

impl Words<Prediction> for Says {
    fn of(&self, answer: Answer, prediction: &Prediction) -> Said {
        Said { verdict: verdict(answer), expected: prediction.expected, tolerance: prediction.tolerance }
    }

    fn of_lost(&self) -> Option<Said> {
        Some(Said::UNCHECKED)
    }
}

/// The words of the forward direction of the two-sided test.
#[derive(Clone, Copy)]
struct Forward {
    delta: f64,
}

impl Words<Closest> for Forward {
    fn of(&self, answer: Answer, closest: &Closest) -> Said {
        let tolerance = if closest.expected.is_nan() { f64::NAN } else { self.delta };
        Said { verdict: verdict(answer), expected: closest.expected, tolerance }
    }

    fn of_lost(&self) -> Option<Said> {
        // They stay abnormal as the lost model left them, as far as no new one gets hold of them (section 6, step 4).
        None
    }
}

fn verdict(answer: Answer) -> Verdict {
    if answer == Answer::Accepts { Verdict::Normal } else { Verdict::Outlier }
}

/// A model that an engine feeds.
struct Fed<M: Model, F, W> {
    engine: Engine<M>,
    sample: F,
    words: W,
}

impl<M, F, W> Fed<M, F, W>
where
    M: Model + 'static,
    F: Fn(f64) -> M::Sample + 'static,
    W: Words<M::Prediction> + 'static,
{
    #[expect(clippy::new_ret_no_self, reason = "only ever used behind the trait")]
    fn new(model: M, interval: f64, max_run: usize, sample: F, words: W) -> Box<dyn Online> {
        Box::new(Self { engine: Engine::new(model, interval, max_run), sample, words })
    }
}

impl<M, F, W> Online for Fed<M, F, W>
where
    M: Model,
    F: Fn(f64) -> M::Sample,
    W: Words<M::Prediction>,
{
    fn push(&mut self, t: f64, y: f64, events: &mut Vec<Event>) {
        let mut sink = Into { events, words: self.words };
        self.engine.push(t, (self.sample)(y), &mut sink);
    }
}

struct Into<'a, W> {
    events: &'a mut Vec<Event>,
    words: W,
}

impl<P, W: Words<P>> Sink<P> for Into<'_, W> {
    fn started(&mut self, group: Range<usize>, again: bool) {
        for at in group.clone() {
            // A restart must leave a trace: the target may have changed its course, or a patch was too long.
            let suspect = again && at == group.start;
            let verdict = if suspect { Verdict::Suspect } else { Verdict::Normal };
            self.events.push(Event::Says(at, Said { verdict, ..Said::UNCHECKED }));
        }
    }

    fn judged(&mut self, at: usize, answer: Answer, _: usize, prediction: &P) {
        self.events.push(Event::Says(at, self.words.of(answer, prediction)));
    }

    fn lost(&mut self, run: Range<usize>) {
        self.events.push(Event::Lost(run.start));
        if let Some(said) = self.words.of_lost() {
            self.events.extend(run.map(|at| Event::Says(at, said)));
        }
    }
}
