//! Which unit a mutant is switched in, and which function it is known by.

use std::ops::Range;

use crate::list::{Mutant, offset};
use crate::unit::{Kind, Unit};

/// Range of a mutant's replaced text in its file.
#[must_use]
pub fn bytes(text: &str, mutant: &Mutant) -> Range<usize> {
    offset(text, mutant.span.0)..offset(text, mutant.span.1)
}

fn holds(outer: &Range<usize>, inner: &Range<usize>) -> bool {
    outer.start <= inner.start && inner.end <= outer.end
}

/// The unit of a mutant that replaces `span`: the smallest round it. Its place in the list; none for one that lies in
/// no body.
#[must_use]
pub fn smallest(units: &[Unit], span: &Range<usize>) -> Option<usize> {
    let round = (0..units.len()).filter(|&at| holds(&units[at].range, span));
    round.min_by_key(|&at| (units[at].range.len(), units[at].kind))
}

/// The outermost body round `span`: what a mutant is judged by changes only with it, or with what it calls.
#[must_use]
pub fn outermost(units: &[Unit], span: &Range<usize>) -> Option<Range<usize>> {
    let round = units.iter().filter(|unit| unit.kind == Kind::Body && holds(&unit.range, span));
    round.max_by_key(|unit| unit.range.len()).map(|unit| unit.range.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::unit::units;

    #[test]
    fn an_operator_is_switched_where_it_is_and_known_by_its_function() {
        let text = "fn f() { fn g() { h(|x| y + x * 2) } }";
        let units = units(text).unwrap();
        let star = text.find('*').unwrap();
        let at = smallest(&units, &(star..star + 1)).unwrap();
        assert_eq!(&text[units[at].range.clone()], "y + x * 2");
        assert_eq!(&text[outermost(&units, &(star..star + 1)).unwrap()], "{ fn g() { h(|x| y + x * 2) } }");
        assert_eq!(smallest(&units, &(3..4)), None);
    }
}
