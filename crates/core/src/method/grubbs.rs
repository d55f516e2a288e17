//! Grubbs' test of the most deviant sample, one at a time.

use super::trend::{self, Chance, Criterion, Critical, OneAtATime};
use super::{About, Filter, Judged, Method, Own, Segment, shared};
use crate::param::{Kind, Paper, Param, Settings, Value, always};
use crate::stop::{Stop, Stopped};

/// The method `grubbs` of section 2 of `docs/methods.md`.
#[derive(Debug, Clone, Copy)]
pub struct Grubbs;

const SIDES: Param = Param {
    key: "sides",
    help: "two: alpha is shared by the largest and the smallest (alpha / 2n each); one: each is tested at alpha / n, as the \
           table of [001] has it (2.41 for 15 samples at 0.05; 2.55 with two), so that both together come to 2 alpha",
    unit: "",
    kind: Kind::Choice(&["two", "one"]),
    default: Value::Word("two"),
    paper: Some(Paper::printed(
        Value::Word("one"),
        "outliers lie on either side, and alpha is to be the chance of a false alarm on both together",
    )),
    matters: always,
};

static PARAMS: [Param; 9] = [
    shared::ALPHA,
    SIDES,
    shared::TREND_ORDER,
    shared::REFIT,
    shared::MAX_PASSES_OPEN,
    shared::BLOCK,
    shared::MAX_GAP,
    shared::FLOOR,
    shared::DOUBT,
];

static ABOUT: About = About {
    id: "grubbs",
    name: "Grubbs",
    family: shared::WHOLE_SEGMENT,
    source: "[001] s.2",
    advice: "Removes the most deviant sample repeatedly, until it is no larger than clean data of this size would show. alpha is the chance of one false alarm in a whole block (sides = one: on either side). For 20 to 100 samples with few wild points ([001] calls it the best of its criteria); if there are many, they mask each other and it finds hardly any: use gesd.",
    params: &PARAMS,
    own: Own::Remove,
    needs_rate: false,
};

impl Method for Grubbs {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn judge(&self, segment: &Segment<'_>, settings: &Settings, stop: &Stop) -> Result<Judged, Stopped> {
        trend::judge(&criterion(settings), segment, settings, stop)
    }

    fn filter(&self, settings: &Settings) -> Option<&'static dyn Filter> {
        trend::filter(settings)
    }

    fn warnings(&self, settings: &Settings) -> Vec<String> {
        trend::warnings(&criterion(settings), settings)
    }
}

fn criterion(settings: &Settings) -> impl Criterion {
    let chance = if settings.word(SIDES.key) == "one" { Chance::OneSide } else { Chance::Block };
    OneAtATime(Critical::new(settings.real(shared::ALPHA.key), chance))
}
