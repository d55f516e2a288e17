//! The whole program with all mutants in it: which are in, which rustc rejects, which no variable can switch.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use crate::compile::{Built, Fault, Program, cargo};
use crate::list::Mutant;
use crate::rewrite::{Rewritten, rewrite};
use crate::switch;
use crate::tree::{Tree, fault};

/// The program with its mutants. Mutants are given by their place in the list.
#[derive(Clone, PartialEq, Debug)]
pub struct Scheme {
    /// The test programs.
    pub programs: Vec<Program>,
    /// The unit each mutant is in.
    pub unit: BTreeMap<usize, usize>,
    /// Mutants that are no program.
    pub unviable: BTreeSet<usize>,
    /// Mutants that can only be built one by one.
    pub apart: BTreeSet<usize>,
}

/// Writes all mutants but those in `unviable` into the copy and builds its tests, as often as it takes until rustc
/// has nothing more to reject.
///
/// # Errors
/// Words: a file that cannot be read or written, or an error of rustc that belongs to no mutant.
pub fn build(tree: &Tree, list: &[Mutant], unviable: BTreeSet<usize>, tests: &[String]) -> Result<Scheme, String> {
    let check: Vec<String> = ["check", "--lib"].map(str::to_owned).to_vec();
    let programs = ["test", "--no-run", "--lib"].map(str::to_owned).into_iter();
    let programs: Vec<String> = programs.chain(tests.iter().flat_map(|t| ["--test".to_owned(), t.clone()])).collect();
    let mut scheme = Scheme { programs: Vec::new(), unit: BTreeMap::new(), unviable, apart: BTreeSet::new() };
    for round in 1.. {
        let files = files(tree, list, &mut scheme)?;
        let texts: Vec<(String, String)> = files.iter().map(|(name, file)| (name.clone(), file.text.clone())).collect();
        tree.write(&with_switch(tree, texts, &scheme)?)?;
        let left = list.len() - scheme.unviable.len() - scheme.apart.len();
        println!("round {round}: {left} mutants, {} unviable, {} apart", scheme.unviable.len(), scheme.apart.len());
        let faults = match cargo(tree, &check)? {
            Built::Faults(faults) => faults,
            Built::Programs(_) => match cargo(tree, &programs)? {
                Built::Faults(faults) => faults,
                Built::Programs(programs) => {
                    scheme.programs = programs;
                    break;
                }
            },
        };
        for fault in faults {
            blame(&fault, &files, &mut scheme)?;
        }
    }
    Ok(scheme)
}

/// The rewritten files; what is apart and which unit a mutant is in are noted in `scheme`.
fn files(tree: &Tree, list: &[Mutant], scheme: &mut Scheme) -> Result<BTreeMap<String, Rewritten>, String> {
    let mut by_file: BTreeMap<String, Vec<(usize, &Mutant)>> = BTreeMap::new();
    for (index, mutant) in list.iter().enumerate() {
        let of_file = by_file.entry(mutant.file.clone()).or_default();
        if !scheme.unviable.contains(&index) && !scheme.apart.contains(&index) {
            of_file.push((index, mutant));
        }
    }
    scheme.unit.clear();
    let mut files = BTreeMap::new();
    let mut units = 0;
    for (name, mutants) in by_file {
        let path = tree.root.join(&name);
        let text = fs::read_to_string(&path).map_err(fault(&path))?;
        let file = rewrite(&text, &mutants, units).map_err(|e| format!("{name}: {e}"))?;
        units += file.units.len();
        scheme.apart.extend(&file.apart);
        scheme.unit.extend(file.switched.iter().map(|switched| (switched.index, switched.unit)));
        files.insert(name, file);
    }
    Ok(files)
}

/// The crate that holds the switch, and the one that takes it from there.
const CORE: &str = "crates/core/src/lib.rs";
const RECORD: &str = "crates/record/src/lib.rs";

/// `texts` with the module of the switch and the lines that take it in.
fn with_switch(
    tree: &Tree,
    mut texts: Vec<(String, String)>,
    scheme: &Scheme,
) -> Result<Vec<(String, String)>, String> {
    let units = scheme.unit.values().max().map_or(1, |last| last + 1);
    for (root, line) in [(CORE, "pub mod mutant;"), (RECORD, "use wildpoint_core::mutant;")] {
        let path = tree.root.join(root);
        let text = fs::read_to_string(&path).map_err(fault(&path))?;
        texts.push((root.to_owned(), format!("{text}\n{line}\n")));
    }
    texts.push(("crates/core/src/mutant.rs".to_owned(), switch::module(units)));
    Ok(texts)
}

/// Takes out what rustc rejects: the mutant it points at; all of a unit when it points at the unit's own body.
fn blame(fault: &Fault, files: &BTreeMap<String, Rewritten>, scheme: &mut Scheme) -> Result<(), String> {
    for (file, line) in &fault.spots {
        let arms = files.get(file).into_iter().flat_map(|file| &file.arms);
        if let Some(arm) = arms.into_iter().find(|arm| (arm.lines.0..=arm.lines.1).contains(line)) {
            scheme.unviable.insert(arm.index);
            return Ok(());
        }
    }
    for (file, line) in &fault.spots {
        let units = files.get(file).into_iter().flat_map(|file| &file.units);
        if let Some((members, _)) = units.into_iter().find(|(_, lines)| (lines.0..=lines.1).contains(line)) {
            scheme.apart.extend(members);
            return Ok(());
        }
    }
    Err(format!("rustc objects to what no mutant is in:\n{}", fault.words))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rewrite::Arm;

    fn scheme() -> Scheme {
        Scheme { programs: Vec::new(), unit: BTreeMap::new(), unviable: BTreeSet::new(), apart: BTreeSet::new() }
    }

    fn blamed(line: usize) -> Result<Scheme, String> {
        let arms = vec![Arm { index: 3, lines: (5, 7) }, Arm { index: 4, lines: (8, 8) }];
        let file = Rewritten { arms, units: vec![(vec![3, 4], (2, 9))], ..Rewritten::default() };
        let files = BTreeMap::from([("src/a.rs".to_owned(), file)]);
        let mut scheme = scheme();
        blame(&Fault { spots: vec![("src/a.rs".into(), line)], words: "E".into() }, &files, &mut scheme)?;
        Ok(scheme)
    }

    #[test]
    fn an_error_in_an_arm_takes_its_mutant_out() {
        assert_eq!(blamed(8).unwrap().unviable, BTreeSet::from([4]));
        assert_eq!(blamed(7).unwrap().unviable, BTreeSet::from([3]));
    }

    #[test]
    fn an_error_in_the_body_as_it_was_takes_the_unit_out() {
        assert_eq!(blamed(3).unwrap().apart, BTreeSet::from([3, 4]));
    }

    #[test]
    fn an_error_elsewhere_is_told() {
        assert!(blamed(20).unwrap_err().contains("no mutant"));
    }
}
