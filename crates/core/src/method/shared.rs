//! Parameters that several methods share, each declared once.

use crate::param::{Choice, Kind, Paper, Param, Settings, Step, Value, always};

/// The multiplier of the scale; sections give it their own default.
pub const K: Param = Param {
    key: "k",
    help: "threshold in sigma: flagged when |y - expected| reaches k * scale",
    unit: "sigma",
    kind: Kind::Real { min: 0.5, max: 1000.0, step: Step::Add(0.1) },
    default: Value::Real(3.0),
    paper: None,
    matters: always,
};

/// Where a channel is cut into segments.
pub const MAX_GAP: Param = Param {
    key: "max_gap",
    help: "cut where more than this many samples are lost in a row (off: never cut)",
    unit: "samples",
    kind: Kind::WholeOrOff { min: 0, max: 1_000_000 },
    default: Value::Whole(5),
    paper: None,
    matters: always,
};

/// Lower bound on any scale.
pub const FLOOR: Param = Param {
    key: "floor",
    help: "lower bound on any scale; noise: where the residuals of this record exceed its noise (calibration), for each \
           sample; record: the same by the rules of earlier versions; auto: half the smallest step or third difference \
           of the data other than 0",
    unit: "channel units",
    kind: Kind::RealOr { words: &[NOISE, RECORD, "auto"], min: 0.0, max: 1e300 },
    default: Value::Word(NOISE),
    paper: Some(Paper::open(
        Value::Word("auto"),
        "the documents know no calibration: real records are no white noise, and without it they are flagged all over",
    )),
    matters: always,
};

/// The word of [`FLOOR`] that asks for the calibration of the record, by
/// [`Rules::Noise`](crate::calibration::Rules::Noise).
pub const NOISE: &str = "noise";

/// The word of [`FLOOR`] that asks for it by [`Rules::Record`](crate::calibration::Rules::Record).
pub const RECORD: &str = "record";

/// Where suspects begin.
pub const DOUBT: Param = Param {
    key: "doubt",
    help: "with floor = noise: a sample that reaches this share of the tolerance is suspect (a smaller share if the \
           noise has heavy tails), where both sides object; 1: only what the method itself doubts",
    unit: "",
    kind: Kind::Real { min: 0.1, max: 1.0, step: Step::Add(0.05) },
    default: Value::Real(0.6),
    paper: None,
    matters: doubt_matters,
};

/// How the noise scale is found.
pub const SIGMA: Param = Param {
    key: "sigma",
    help: "noise scale: auto or difference (robust; underestimates correlated noise: AR(1) 0.3/0.6/0.9 gives \
           0.77/0.54/0.25 of the deviation), spline (eq. (2) of [000]; outliers inflate it), or a number",
    unit: "channel units",
    kind: Kind::RealOr { words: &["auto", "difference", "spline"], min: f64::MIN_POSITIVE, max: 1e300 },
    default: Value::Word("auto"),
    paper: None,
    matters: always,
};

/// The family of the criteria that judge a whole segment at once.
pub const WHOLE_SEGMENT: &str = "whole segment";

/// The family of the methods that compare a sample with a window around it.
pub const SLIDING_WINDOW: &str = "sliding window";

/// How many samples a window holds.
pub const WINDOW: Param = Param {
    key: "window",
    help: "samples in the window around the judged one; even lengths reach one further back",
    unit: "samples",
    kind: Kind::Whole { min: 3, max: 1001, step: 2 },
    default: Value::Whole(21),
    paper: Some(Paper::printed(
        Value::Whole(10),
        "a residual test whose scale holds the tested sample reaches no 3 sigma in a window of 10",
    )),
    matters: always,
};

/// How a window's scale is found.
pub const SCALE: Param = Param {
    key: "scale",
    help: "mad: 1.4826 * median |x - median(x)|, robust; rms: root mean square about the expected value [003]",
    unit: "",
    kind: Kind::Choice(&["mad", "rms"]),
    default: Value::Word("mad"),
    paper: Some(Paper::printed(Value::Word("rms"), RMS_SWELLS)),
    matters: always,
};

const RMS_SWELLS: &str = "a root mean square is swollen by the outliers it is to find";

/// How the scale of a window around a sample is found.
pub const AROUND_SCALE: Param = Param {
    help: "mad: 1.4826 * median |x - median(x)|, robust; rms: root mean square about the expected value of the middle; \
           residuals: root mean square of the samples less their own expected values [003]",
    kind: Kind::Choice(&["mad", "rms", "residuals"]),
    paper: Some(Paper::printed(Value::Word("residuals"), RMS_SWELLS)),
    ..SCALE
};

/// Whether flagged samples are replaced before the window moves on.
pub const FEEDBACK: Param = Param {
    key: "feedback",
    help: "a flagged sample is replaced by its expected value before the window moves on",
    unit: "",
    kind: Kind::Switch,
    default: Value::Switch(true),
    paper: None,
    matters: always,
};

/// What windows hold beyond the ends.
pub const EDGE: Param = Param {
    key: "edge",
    help: "beyond the ends of a segment: shrink the window, reflect the samples about the end one, or zeros [003]",
    unit: "",
    kind: Kind::Choice(&["shrink", "reflect", "zero"]),
    default: Value::Word("shrink"),
    paper: Some(Paper::printed(
        Value::Word("zero"),
        "zeros beyond the ends are no samples: far from 0 they swamp the first and last windows",
    )),
    matters: always,
};

/// Whether the local slope is taken off first.
pub const DETREND: Param = Param {
    key: "detrend",
    help: "slope: subtract a local-slope baseline first, so that the scale measures noise and not the track's slope",
    unit: "",
    kind: Kind::Choice(&["slope", "off"]),
    default: Value::Word("slope"),
    paper: Some(Paper::printed(
        Value::Word("off"),
        "deviations from a window's middle measure the slope of a steep track and hide the outliers in it",
    )),
    matters: always,
};

/// The bound on the scales of single windows.
pub const NOISE_FLOOR: Param = Param {
    key: "noise_floor",
    help: "pooled: no window's scale is below the median scale of all windows of the segment",
    unit: "",
    kind: Kind::Choice(&["pooled", "off"]),
    default: Value::Word("pooled"),
    paper: Some(Paper::printed(
        Value::Word("off"),
        "the scale of a single window is noisy: four times the false alarms at a window of 21",
    )),
    matters: always,
};

/// Order of the trend that whole-segment criteria take off.
pub const TREND_ORDER: Param = Param {
    key: "trend_order",
    help: "order of the least-squares trend that is subtracted first (0: only the mean)",
    unit: "",
    kind: Kind::Whole { min: 0, max: 8, step: 1 },
    default: Value::Whole(2),
    paper: None,
    matters: always,
};

/// Whether the trend is fitted again on the survivors of a pass.
pub const REFIT: Param = Param {
    key: "refit",
    help: "fit the trend again after each pass, on the samples that survived it ([002] fits once)",
    unit: "",
    kind: Kind::Switch,
    default: Value::Switch(true),
    paper: Some(Paper::printed(
        Value::Switch(false),
        "the first trend is bent by the outliers that are flagged against it",
    )),
    matters: refit_matters,
};

/// How often whole-segment criteria go over the survivors.
pub const MAX_PASSES: Param = Param {
    key: "max_passes",
    help: "passes over the survivors at most (0: until nothing new is found)",
    unit: "passes",
    kind: Kind::Whole { min: 0, max: 1000, step: 1 },
    default: Value::Whole(0),
    paper: Some(Paper::printed(Value::Whole(3), SMALLER_LATER)),
    matters: always,
};

const SMALLER_LATER: &str = "smaller outliers show only when the larger ones are gone";

/// [`MAX_PASSES`] of the criteria of \[001\], which does not say how often they go over the data.
pub const MAX_PASSES_OPEN: Param = MAX_PASSES.with_paper(Some(Paper::open(Value::Whole(3), SMALLER_LATER)));

/// Length of the blocks that have a trend of their own.
pub const BLOCK: Param = Param {
    key: "block",
    help: "consecutive blocks of this many samples, each with a trend of its own (0: the whole segment)",
    unit: "samples",
    kind: Kind::Whole { min: 0, max: 100_000_000, step: 10 },
    default: Value::Whole(0),
    paper: None,
    matters: always,
};

/// The significance level of a test.
pub const ALPHA: Param = Param {
    key: "alpha",
    help: "significance level of the test",
    unit: "",
    kind: Kind::Real { min: 1e-9, max: 0.5, step: Step::Times(1.122) },
    default: Value::Real(0.01),
    paper: None,
    matters: always,
};

/// Only a calibrated record has limits for what is doubtful.
fn doubt_matters(settings: &Settings) -> bool {
    matches!(settings.choice(FLOOR.key), Choice::Word(NOISE | RECORD))
}

/// A mean is not changed by fitting it again, and after the only pass there is nothing to fit.
fn refit_matters(settings: &Settings) -> bool {
    settings.whole(TREND_ORDER.key) > 0 && settings.whole(MAX_PASSES.key) != 1
}

/// How many outliers in a row a predictor stands; sections give it their own default.
pub const MAX_RUN: Param = Param {
    key: "max_run",
    help: "more outliers in a row than this end the model: it starts again at the first of them (0: never)",
    unit: "samples",
    kind: Kind::Whole { min: 0, max: 1000, step: 1 },
    default: Value::Whole(12),
    paper: Some(Paper::printed(
        Value::Whole(0),
        "a model that a real change has left behind would reject all that follows",
    )),
    matters: always,
};

/// The first-difference plausibility check of the predictors.
pub const MAX_RATE: Param = Param {
    key: "max_rate",
    help: "a faster change since the last accepted sample is an outlier at once (0: no such check)",
    unit: "channel units per second",
    kind: Kind::Real { min: 0.0, max: 1e300, step: Step::Add(1.0) },
    default: Value::Real(0.0),
    paper: None,
    matters: always,
};

/// Whether predictors judge the beginning of a segment by a run backwards.
pub const LOOK_BACK: Param = Param {
    key: "look_back",
    help: "judge the first start group and all before it by a run over the reversed segment",
    unit: "",
    kind: Kind::Switch,
    default: Value::Switch(true),
    paper: Some(Paper::printed(Value::Switch(false), "an outlier in the start group, or before it, would not be seen")),
    matters: always,
};

/// Limit of the fourth difference of a start group in noise scales: m1 of eq. (21) of \[001\].
pub const START_LIMIT: f64 = 17.0;

/// The gate of innovation tests.
pub const C: Param = Param {
    key: "c",
    help: "gate: flagged when the innovation exceeds c of its deviations ([004]: 2 or 3, or 3 to 5)",
    unit: "sigma",
    kind: Kind::Real { min: 0.5, max: 1000.0, step: Step::Add(0.1) },
    default: Value::Real(3.0),
    paper: None,
    matters: always,
};

/// What stands for the multiplier of criteria that have none, where a floor or a limit is one scale times it.
const NO_MULTIPLIER: f64 = 4.0;

/// The multiplier of these settings, [`K`] or [`C`]; 4 for criteria that have none.
#[must_use]
pub fn multiplier(settings: &Settings) -> f64 {
    match settings.get(K.key).or_else(|| settings.get(C.key)) {
        Some(Value::Real(k)) => k,
        _ => NO_MULTIPLIER,
    }
}

#[cfg(test)]
mod tests {
    use crate::method::find;
    use crate::param::Settings;

    fn matters(id: &str, key: &str, changes: &[(&str, &str)]) -> bool {
        let params = find(id).unwrap().about().params;
        let mut settings = Settings::defaults(params);
        changes.iter().for_each(|(key, text)| settings.set_text(id, key, text).unwrap());
        (params.iter().find(|p| p.key == key).unwrap().matters)(&settings)
    }

    #[test]
    fn doubt_matters_where_the_record_is_calibrated() {
        for (floor, wanted) in [("noise", true), ("record", true), ("auto", false), ("2.5", false)] {
            assert_eq!(matters("two-sided", "doubt", &[("floor", floor)]), wanted, "floor {floor}");
        }
    }

    #[test]
    fn fitting_again_matters_to_a_trend_and_to_further_passes() {
        for (order, passes, wanted) in [("2", "0", true), ("2", "3", true), ("2", "1", false), ("0", "0", false)] {
            let changes = [("trend_order", order), ("max_passes", passes)];
            assert_eq!(matters("trend-wright", "refit", &changes), wanted, "order {order}, {passes} passes");
        }
    }

    #[test]
    fn which_order_is_taken_matters_where_there_are_several_candidates() {
        for (order, two_point, wanted) in [("2", "false", true), ("1", "true", true), ("1", "false", false)] {
            let changes = [("order", order), ("two_point", two_point)];
            assert_eq!(matters("two-sided", "variable_order", &changes), wanted, "order {order}, {two_point}");
        }
    }
}
