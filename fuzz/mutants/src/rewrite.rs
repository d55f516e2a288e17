//! A file with all its mutants in it: every unit becomes a choice between its body and the body with one mutant.
//!
//! ```text
//! fn gate(r: f64, h: f64) -> bool {
//! { match crate::mutant::at(3) {
//! __mutant if !matches!(__mutant, 17 | 18) => { { r >= h } },
//! 17 => { { r < h } },
//! 18 => { { true } },
//! _ => unreachable!(), } }
//! }
//! ```

use std::ops::Range;

use crate::list::{Mutant, offset};
use crate::unit::{Unit, units};

/// A mutant that takes part, with the number that switches it on (from 1) and the unit it lies in.
#[derive(Clone, PartialEq, Debug)]
pub struct Switched {
    /// Place in the list of mutants.
    pub index: usize,
    /// Number of its unit, from 0, through all files.
    pub unit: usize,
}

/// Lines of a rewritten file (from 1, both included) that belong to one mutant.
#[derive(Clone, PartialEq, Debug)]
pub struct Arm {
    /// Place in the list of mutants.
    pub index: usize,
    /// First and last line.
    pub lines: (usize, usize),
}

/// A rewritten file.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Rewritten {
    /// Its text.
    pub text: String,
    /// Where each mutant is in it.
    pub arms: Vec<Arm>,
    /// Lines of each unit, with its mutants: where an error that lies in no arm belongs.
    pub units: Vec<(Vec<usize>, (usize, usize))>,
    /// Mutants that are in the program.
    pub switched: Vec<Switched>,
    /// Mutants that lie in no unit: no variable can switch them.
    pub apart: Vec<usize>,
}

/// Units with their mutants, and the mutants that lie in none.
pub type Grouped = (Vec<(Unit, Vec<usize>)>, Vec<usize>);

/// The units of `text` that have mutants, with these. `mutants` are those of the file, with their place in the list.
///
/// # Errors
/// Words that say where the text is no Rust.
pub fn grouped(text: &str, mutants: &[(usize, &Mutant)]) -> Result<Grouped, String> {
    let mut groups: Vec<(Unit, Vec<usize>)> = units(text)?.into_iter().map(|unit| (unit, Vec::new())).collect();
    let mut apart = Vec::new();
    for (index, mutant) in mutants {
        let span = bytes(text, mutant);
        let inside = |unit: &Unit| unit.body.start <= span.start && span.end <= unit.body.end;
        match groups.iter_mut().find(|(unit, _)| inside(unit)) {
            Some((_, members)) => members.push(*index),
            None => apart.push(*index),
        }
    }
    groups.retain(|(_, members)| !members.is_empty());
    Ok((groups, apart))
}

/// Range of a mutant's replaced text in its file.
#[must_use]
pub fn bytes(text: &str, mutant: &Mutant) -> Range<usize> {
    offset(text, mutant.span.0)..offset(text, mutant.span.1)
}

/// `text` with `mutants` in it; units get numbers from `first_unit` on, the number that switches a mutant is its
/// place in the list plus 1.
///
/// # Errors
/// Words that say where the text is no Rust.
pub fn rewrite(text: &str, mutants: &[(usize, &Mutant)], first_unit: usize) -> Result<Rewritten, String> {
    let (groups, apart) = grouped(text, mutants)?;
    let mut out = Rewritten { apart, ..Rewritten::default() };
    let mut done = 0;
    for (n, (unit, members)) in groups.iter().enumerate() {
        let copy = |out: &mut Rewritten, from: usize, to: usize| out.text.push_str(text.get(from..to).unwrap_or(""));
        if let Some(constant) = &unit.constant {
            copy(&mut out, done, constant.start);
            done = constant.end;
        }
        if let Some(opaque) = &unit.opaque {
            copy(&mut out, done, opaque.start);
            let bounds = text.get(opaque.clone()).unwrap_or("").trim_start_matches("impl");
            out.text.push_str(&format!("Box<dyn {}>", bounds.trim()));
            done = opaque.end;
        }
        copy(&mut out, done, unit.body.start);
        done = unit.body.end;
        let member = |index: &usize| mutants.iter().find(|(i, _)| i == index).copied();
        let members: Vec<(usize, &Mutant)> = members.iter().filter_map(member).collect();
        choice(&mut out, text, unit, &members, first_unit + n);
        out.switched.extend(members.iter().map(|&(index, _)| Switched { index, unit: first_unit + n }));
    }
    out.text.push_str(text.get(done..).unwrap_or(""));
    Ok(out)
}

/// Writes the choice that takes the place of the body of `unit`.
fn choice(out: &mut Rewritten, text: &str, unit: &Unit, members: &[(usize, &Mutant)], number: usize) {
    let line = |out: &Rewritten| out.text.matches('\n').count() + 1;
    let boxed = |body: &str| if unit.opaque.is_some() { format!("Box::new({body})") } else { body.to_owned() };
    let body = text.get(unit.body.clone()).unwrap_or("");
    let first = line(out);
    let switches: Vec<String> = members.iter().map(|(index, _)| (index + 1).to_string()).collect();
    out.text.push_str(&format!(
        "{{ match crate::mutant::at({number}) {{\n__mutant if !matches!(__mutant, {}) => {{ {} }},\n",
        switches.join(" | "),
        boxed(body)
    ));
    for (index, mutant) in members {
        let span = bytes(text, mutant);
        let before = text.get(unit.body.start..span.start).unwrap_or("");
        let after = text.get(span.end..unit.body.end).unwrap_or("");
        let from = line(out);
        let changed = boxed(&format!("{before}{}{after}", mutant.replacement));
        out.text.push_str(&format!("{} => {{ {changed} }},\n", index + 1));
        out.arms.push(Arm { index: *index, lines: (from, line(out) - 1) });
    }
    out.text.push_str("_ => unreachable!(), } }");
    out.units.push((members.iter().map(|(index, _)| *index).collect(), (first, line(out))));
}

#[cfg(test)]
mod tests;
