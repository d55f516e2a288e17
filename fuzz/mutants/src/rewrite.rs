//! A file with all its mutants in it: every unit that has some becomes a choice between what it was and what it would
//! be with one of them.
//!
//! ```text
//! fn gate(r: f64, h: f64) -> bool {
//! match crate::mutant::at(3) { __mutant if !matches!(__mutant, 18) => { {
//!     (match crate::mutant::at(4) { __mutant if !matches!(__mutant, 17) => { r >= h },
//! 17 => { r < h },
//! _ => unreachable!(), })
//! } },
//! 18 => { { true } },
//! _ => unreachable!(), } }
//! ```

use crate::group::{bytes, smallest};
use crate::list::Mutant;
use crate::unit::{Kind, Unit, units};

/// A mutant that takes part.
#[derive(Clone, PartialEq, Debug)]
pub struct Switched {
    /// Place in the list of mutants; the number that switches it on is one more.
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
    /// Lines of each unit, with its mutants, inner ones first: where an error that lies in no arm belongs.
    pub units: Vec<(Vec<usize>, (usize, usize))>,
    /// Mutants that are in the program.
    pub switched: Vec<Switched>,
    /// Mutants that lie in no unit: no variable can switch them.
    pub apart: Vec<usize>,
}

/// A unit with its mutants, each with its place in the list.
struct Group<'a> {
    unit: &'a Unit,
    number: usize,
    members: Vec<(usize, &'a Mutant)>,
}

/// `text` with `mutants` in it, which are those of the file, each with its place in the list; units get numbers from
/// `first_unit` on.
///
/// # Errors
/// Words that say where the text is no Rust.
pub fn rewrite(text: &str, mutants: &[(usize, &Mutant)], first_unit: usize) -> Result<Rewritten, String> {
    let units = units(text)?;
    let mut out = Rewritten::default();
    let mut members: Vec<Vec<(usize, &Mutant)>> = vec![Vec::new(); units.len()];
    for &(index, mutant) in mutants {
        match smallest(&units, &bytes(text, mutant)) {
            Some(at) => members[at].push((index, mutant)),
            None => out.apart.push(index),
        }
    }
    let taken = units.iter().zip(members).filter(|(_, members)| !members.is_empty()).enumerate();
    let mut groups: Vec<Group<'_>> =
        taken.map(|(n, (unit, members))| Group { unit, number: first_unit + n, members }).collect();
    groups.sort_by_key(|group| (group.unit.range.start, std::cmp::Reverse(group.unit.range.end)));
    for group in &groups {
        out.switched.extend(group.members.iter().map(|&(index, _)| Switched { index, unit: group.number }));
    }
    Writer { text, out: &mut out }.pieces(0, text.len(), &groups);
    Ok(out)
}

struct Writer<'a> {
    text: &'a str,
    out: &'a mut Rewritten,
}

impl Writer<'_> {
    fn line(&self) -> usize {
        self.out.text.matches('\n').count() + 1
    }

    fn copy(&mut self, from: usize, to: usize) {
        self.out.text.push_str(self.text.get(from..to).unwrap_or(""));
    }

    /// Writes the text between two offsets, in which `groups` lie, outer ones before those inside them.
    fn pieces(&mut self, from: usize, to: usize, groups: &[Group<'_>]) {
        let (mut done, mut rest) = (from, groups);
        while let Some((group, later)) = rest.split_first() {
            let range = &group.unit.range;
            let inside = later.iter().take_while(|other| other.unit.range.start < range.end).count();
            let (inner, after) = later.split_at(inside);
            if let Some(constant) = &group.unit.constant {
                self.copy(done, constant.start);
                done = constant.end;
            }
            if let Some(opaque) = &group.unit.opaque {
                self.copy(done, opaque.start);
                let bounds = self.text.get(opaque.clone()).unwrap_or("").trim_start_matches("impl");
                self.out.text.push_str(&format!("Box<dyn {}>", bounds.trim()));
                done = opaque.end;
            }
            self.copy(done, range.start);
            self.choice(group, inner);
            done = range.end;
            rest = after;
        }
        self.copy(done, to);
    }

    /// Writes the choice that takes the place of a unit, in which the groups `inner` lie.
    fn choice(&mut self, group: &Group<'_>, inner: &[Group<'_>]) {
        let range = group.unit.range.clone();
        let (open, close) = if group.unit.kind == Kind::Body { ("{", "}") } else { ("(", ")") };
        let (begin, end) = if group.unit.opaque.is_some() { ("{ Box::new(", ") }") } else { ("{ ", " }") };
        let first = self.line();
        let switches: Vec<String> = group.members.iter().map(|(index, _)| (index + 1).to_string()).collect();
        self.out.text.push_str(&format!(
            "{open}match crate::mutant::at({}) {{\n__mutant if !matches!(__mutant, {}) => {begin}",
            group.number,
            switches.join(" | ")
        ));
        self.pieces(range.start, range.end, inner);
        self.out.text.push_str(&format!("{end},\n"));
        for (index, mutant) in &group.members {
            let span = bytes(self.text, mutant);
            let from = self.line();
            self.out.text.push_str(&format!("{} => {begin}", index + 1));
            self.copy(range.start, span.start);
            self.out.text.push_str(&mutant.replacement);
            self.copy(span.end, range.end);
            self.out.text.push_str(&format!("{end},\n"));
            self.out.arms.push(Arm { index: *index, lines: (from, self.line() - 1) });
        }
        self.out.text.push_str(&format!("_ => unreachable!(), }}{close}"));
        let members = group.members.iter().map(|(index, _)| *index).collect();
        self.out.units.push((members, (first, self.line())));
    }
}

#[cfg(test)]
mod tests;
