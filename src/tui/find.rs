//! What a jump can look for besides a time and a row: samples by value, by state, by verdict, by note.

use super::model::Model;
use super::update::mark_at;
use crate::method::Verdict;
use crate::plot::{FlagState, state};

/// What is looked for.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Query {
    /// Samples whose quantity compares so with a number.
    Value(Quantity, Comparison, f64),
    /// Flags in this state.
    State(FlagState),
    /// Decisions that the method now contradicts.
    Conflict,
    /// Samples of which the method says this.
    Verdict(Verdict),
    /// Decisions whose note holds this text, in any case.
    Note(String),
}

/// A quantity of a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Quantity {
    /// Its value.
    Y,
    /// The size of its residual, in the units of the residual panel.
    Z,
    /// The size of its difference from the sample before.
    Step,
}

/// How a quantity compares with a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Comparison {
    /// Below it.
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Equal,
}

const QUANTITIES: [(&str, Quantity); 3] = [("y", Quantity::Y), ("z", Quantity::Z), ("step", Quantity::Step)];

/// Longer signs first: `>=` begins with `>`.
const SIGNS: [(&str, Comparison); 5] = [
    ("<=", Comparison::LessOrEqual),
    (">=", Comparison::GreaterOrEqual),
    ("<", Comparison::Less),
    (">", Comparison::Greater),
    ("=", Comparison::Equal),
];

/// The states by the word of the jump.
pub(super) const STATES: [(&str, FlagState); 5] = [
    ("unreviewed", FlagState::Unreviewed),
    ("accepted", FlagState::Accepted),
    ("rejected", FlagState::Rejected),
    ("suspect", FlagState::Suspect),
    ("byhand", FlagState::ByHand),
];

/// The verdicts that can be looked for.
pub(super) const VERDICTS: [Verdict; 4] = [Verdict::Outlier, Verdict::Suspect, Verdict::Unchecked, Verdict::Normal];

impl Query {
    /// Reads `y>8`, `state:suspect`, `verdict:unchecked`, `note:text`; none for a text of another form.
    ///
    /// # Errors
    /// What is wrong with a text of one of these forms.
    pub(super) fn parse(text: &str) -> Result<Option<Self>, String> {
        let text = text.trim();
        if let Some((name, rest)) = text.split_once(':') {
            let rest = rest.trim();
            match name.trim() {
                "state" if rest == "conflict" => return Ok(Some(Self::Conflict)),
                "state" => {
                    let found = STATES.iter().find(|(word, _)| *word == rest).map(|(_, state)| Self::State(*state));
                    let words: Vec<&str> = STATES.iter().map(|(word, _)| *word).collect();
                    let help = format!("{}: states are {}, conflict", crate::track::printable(rest), words.join(", "));
                    return found.map(Some).ok_or(help);
                }
                "verdict" => {
                    let found = VERDICTS.into_iter().find(|v| v.word() == rest).map(Self::Verdict);
                    let help = format!(
                        "{}: verdicts are {}",
                        crate::track::printable(rest),
                        VERDICTS.map(Verdict::word).join(", ")
                    );
                    return found.map(Some).ok_or(help);
                }
                "note" if rest.is_empty() => return Err("note: is followed by words of the note".into()),
                "note" => return Ok(Some(Self::Note(rest.to_lowercase()))),
                _ => {}
            }
        }
        let compared = SIGNS.iter().find_map(|(sign, comparison)| {
            let (name, number) = text.split_once(sign)?;
            let quantity = QUANTITIES.iter().find(|(word, _)| *word == name.trim())?.1;
            Some((quantity, *comparison, number.trim()))
        });
        let Some((quantity, comparison, number)) = compared else { return Ok(None) };
        match number.parse::<f64>() {
            Ok(number) if !number.is_nan() => Ok(Some(Self::Value(quantity, comparison, number))),
            _ => {
                Err(format!("{}: expected a number after the sign, for example y>8.5", crate::track::printable(number)))
            }
        }
    }

    /// The next sample after the cursor for which it holds, and whether the search went over the end of the record.
    #[must_use]
    pub(super) fn next(&self, model: &Model) -> Option<(usize, bool)> {
        let series = model.series();
        let (n, cursor) = (series.len(), model.state().cursor);
        let drawn = model.state().drawn.as_deref();
        let around = |holds: &dyn Fn(usize) -> bool| {
            let after = (cursor + 1..n).find(|i| holds(*i)).map(|i| (i, false));
            after.or_else(|| (0..n.min(cursor + 1)).find(|i| holds(*i)).map(|i| (i, true)))
        };
        let among = |positions: Vec<usize>| {
            let after = positions.iter().find(|p| **p > cursor).map(|p| (*p, false));
            after.or_else(|| positions.first().map(|p| (*p, true)))
        };
        let marked = |holds: &dyn Fn(usize) -> bool| {
            let all = drawn.map(|d| d.positions.as_slice()).unwrap_or_default();
            among(all.iter().map(|p| *p as usize).filter(|p| holds(*p)).collect())
        };
        match self {
            Self::Value(quantity, comparison, number) => {
                let of = |i: usize| match quantity {
                    Quantity::Y => Some(series.y[i]),
                    Quantity::Z => drawn?.residual(&series, i).map(f64::abs),
                    Quantity::Step => Some((series.y[i] - series.y[i.checked_sub(1)?]).abs()),
                };
                around(&|i| of(i).is_some_and(|x| comparison.holds(x, *number)))
            }
            Self::State(wanted) => marked(&|p| mark_at(model, p).as_ref().and_then(state) == Some(*wanted)),
            Self::Conflict => marked(&|p| mark_at(model, p).is_some_and(|m| m.conflict())),
            Self::Verdict(wanted) => {
                let verdict = drawn?.outcome.detection.judged.verdict();
                around(&|i| verdict.get(i) == Some(wanted))
            }
            Self::Note(words) => {
                let noted = model.plan().decisions.iter().filter(|(_, d)| d.note.to_lowercase().contains(words));
                among(noted.filter_map(|(row, _)| series.position(row as usize)).collect())
            }
        }
    }
}

impl Comparison {
    fn holds(self, x: f64, number: f64) -> bool {
        match self {
            Self::Less => x < number,
            Self::LessOrEqual => x <= number,
            Self::Greater => x > number,
            Self::GreaterOrEqual => x >= number,
            #[expect(clippy::float_cmp, reason = "the value that was read is looked for, to the last digit")]
            Self::Equal => x == number,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_are_read_and_others_are_left_alone() {
        let value = |q, c, x| Ok(Some(Query::Value(q, c, x)));
        assert_eq!(Query::parse("y>8"), value(Quantity::Y, Comparison::Greater, 8.0));
        assert_eq!(Query::parse(" z >= -1e3 "), value(Quantity::Z, Comparison::GreaterOrEqual, -1000.0));
        assert_eq!(Query::parse("step<=2"), value(Quantity::Step, Comparison::LessOrEqual, 2.0));
        assert_eq!(Query::parse("y=0.5"), value(Quantity::Y, Comparison::Equal, 0.5));
        assert_eq!(Query::parse("state:suspect"), Ok(Some(Query::State(FlagState::Suspect))));
        assert_eq!(Query::parse("state:conflict"), Ok(Some(Query::Conflict)));
        assert_eq!(Query::parse("verdict:unchecked"), Ok(Some(Query::Verdict(Verdict::Unchecked))));
        assert_eq!(Query::parse("note:Staging"), Ok(Some(Query::Note("staging".into()))));
        for other in ["12:31:07", "2026-03-04T11:49:03", "#5", "+5s", "1239.5", "x>8", ""] {
            assert_eq!(Query::parse(other), Ok(None), "{other}");
        }
    }

    #[test]
    fn what_is_wrong_is_told_with_what_would_be_right() {
        for (text, help) in [
            ("y>", "a number"),
            ("y>nan", "a number"),
            ("state:good", "accepted"),
            ("verdict:bad", "unchecked"),
            ("note:", "words"),
        ] {
            assert!(Query::parse(text).is_err_and(|e| e.contains(help)), "{text}");
        }
    }
}
