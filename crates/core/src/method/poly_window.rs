//! The sliding polynomial: every sample of a window against a least-squares polynomial over it.

use super::window::{self, PolyRule};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::math::polyfit::Polynomial;
use crate::param::{Kind, Paper, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

/// The method `poly-window` of section 3 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct PolyWindow;

const ORDER: Param = Param {
    key: "order",
    help: "order of the polynomial fitted to each window",
    unit: "",
    kind: Kind::Whole { min: 1, max: 5, step: 1 },
    default: Value::Whole(2),
    paper: None,
    matters: always,
};

const GUARD: Param = Param {
    key: "guard",
    help: "a window of which more than a third is replaced already judges nothing (else the feedback can run away)",
    unit: "",
    kind: Kind::Switch,
    default: Value::Switch(true),
    paper: Some(Paper::printed(
        Value::Switch(false),
        "a window of replaced samples follows itself, and the feedback runs away",
    )),
    matters: window::has_feedback,
};

static PARAMS: [Param; 8] =
    [shared::WINDOW, ORDER, shared::K, shared::FEEDBACK, GUARD, shared::MAX_GAP, shared::FLOOR, shared::DOUBT];

static ABOUT: About = About {
    id: "poly-window",
    name: "sliding polynomial",
    family: shared::SLIDING_WINDOW,
    source: "[003] s.2, polynomial",
    advice: "Fits a polynomial to each window and tests every sample of it. Follows manoeuvres better than a mean or a \
             median; second to the sliding median of [003] on isolated wild points and on runs. At order 2 and \
             k = 3 it needs 12 samples in a window to flag anything and about 21 in noise. A run that fills a third \
             of the window bends the polynomial and is missed.",
    params: &PARAMS,
    own: Own::Expected,
    needs_rate: false,
};

impl Method for PolyWindow {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        let feedback = window::has_feedback(settings);
        let rule = PolyRule {
            width: settings.whole(shared::WINDOW.key),
            order: settings.whole(ORDER.key),
            feedback,
            guard: feedback && settings.switch(GUARD.key),
            k: settings.real(shared::K.key),
        };
        window::judge_polynomials(&rule, segment, stop)
    }

    fn filter(&self, _: &Settings) -> Option<&'static dyn Filter> {
        Some(&window::Middle)
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        let n = settings.whole(shared::WINDOW.key);
        window::of_reach(reach(n, settings.whole(ORDER.key)), settings.real(shared::K.key)).into_iter().collect()
    }
}

/// How many scales a lone spike reaches at most in a window of `n` even steps: `sqrt((n - 1) (1 - leverage))` at the
/// place of the smallest leverage.
fn reach(n: usize, order: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "windows are at most 1001 long")]
    let t: Vec<f64> = (0..n).map(|i| i as f64).collect();
    let fit = Polynomial::fit(&t, &t, order);
    let least = t.iter().map(|&t| fit.variance_at(t)).fold(1.0, f64::min);
    #[expect(clippy::cast_precision_loss, reason = "windows are at most 1001 long")]
    let n = n as f64;
    ((n - 1.0) * (1.0 - least)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reach_is_that_of_the_page() {
        assert!((reach(11, 2) - 2.88).abs() < 0.005, "{}", reach(11, 2));
        // "or 12 (poly, order 2)"
        assert!(reach(11, 2) < 3.0 && reach(12, 2) > 3.0);
        let mut settings = Settings::defaults(&PARAMS);
        assert!(PolyWindow.warnings(&settings).is_empty());
        settings.set("poly-window", "window", Value::Whole(11)).unwrap();
        assert!(PolyWindow.warnings(&settings)[0].contains("cannot flag anything"));
    }
}
