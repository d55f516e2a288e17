//! Units below names in columns of a fixed width, where some columns have none.

use super::super::{Delimiter, names};
use super::{Heading, Line, Lines};

/// A word of a line: where it begins and ends.
struct Word<'a> {
    from: usize,
    to: usize,
    text: &'a str,
}

/// `heading` with the units of the line between its names and the first row, each below the name it stands under.
pub(super) fn with_units(heading: Heading, lines: &[Line], first: usize, of: &Lines<'_>) -> Heading {
    let Some(names_at) = heading.names_at.filter(|_| of.layout.delimiter == Delimiter::Blanks) else { return heading };
    if heading.units_at.is_some() {
        return heading;
    }
    let text = |line: &Line| std::str::from_utf8(&of.body[line.start..line.start + line.length]).ok();
    let above = text(&lines[names_at]).map(words).filter(|w| w.len() == heading.names.len());
    let Some(above) = above else { return heading };
    let units = |at: usize| Some((at, below(&above, &words(text(&lines[at])?))?));
    match (names_at + 1..first).find_map(units) {
        Some((at, units)) => Heading { units_at: Some(at), units, ..heading },
        None => heading,
    }
}

fn words(line: &str) -> Vec<Word<'_>> {
    let mut words = Vec::new();
    let mut at = 0;
    for part in line.split(|c: char| c.is_ascii_whitespace()) {
        let to = at + part.len();
        if !part.is_empty() {
            words.push(Word { from: at, to, text: part });
        }
        at = to + 1;
    }
    words
}

/// A unit for each name, where all words are units and each stands under a name of its own.
fn below(names: &[Word<'_>], units: &[Word<'_>]) -> Option<Vec<String>> {
    if units.is_empty() || units.len() >= names.len() || !units.iter().all(|w| is_unit(w.text)) {
        return None;
    }
    let mut cells = vec![String::new(); names.len()];
    for unit in units {
        let column = names.iter().position(|n| n.from < unit.to && unit.from < n.to)?;
        if !cells[column].is_empty() {
            return None;
        }
        unit.text.clone_into(&mut cells[column]);
    }
    Some(cells)
}

fn is_unit(text: &str) -> bool {
    super::units::is_unit(&text.to_lowercase()) || names::is_unit(text)
}
