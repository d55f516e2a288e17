//! Which tests a mutant meets, and in what order.

use crate::reach::Test;

/// Tests of one program that run together, by their place in the list of tests.
pub type Batch = Vec<usize>;

/// Seconds of the first batches; each further helping is this many times larger.
const FIRST: f64 = 0.05;
const GROWTH: f64 = 4.0;

/// The tests that enter `unit`: those of `module` (`method::window::sorted`) and of what it lies in first, then the
/// cheapest; in batches that grow, as most mutants fall to the first.
#[must_use]
pub fn batches(tests: &[Test], unit: usize, module: &str) -> Vec<Batch> {
    let mut order: Vec<usize> = (0..tests.len()).filter(|&at| tests[at].units.contains(&unit)).collect();
    // A first part alone (`method`) is no nearness.
    let near = |at: usize| shared(&tests[at].name, module).max(1);
    order.sort_by(|&a, &b| near(b).cmp(&near(a)).then(tests[a].cost.total_cmp(&tests[b].cost)));
    let mut batches: Vec<Batch> = Vec::new();
    let mut rest = order.as_slice();
    let mut budget = FIRST;
    while !rest.is_empty() {
        let mut spent = 0.0;
        let within = rest.iter().take_while(|&&at| {
            spent += tests[at].cost;
            spent <= budget
        });
        let (helping, later) = rest.split_at(within.count().max(1));
        let mut helping = helping.to_vec();
        helping.sort_by_key(|&at| tests[at].program);
        batches.extend(helping.chunk_by(|&a, &b| tests[a].program == tests[b].program).map(<[usize]>::to_vec));
        rest = later;
        budget *= GROWTH;
    }
    batches
}

/// How many leading parts of their paths two names share.
fn shared(a: &str, b: &str) -> usize {
    a.split("::").zip(b.split("::")).take_while(|(a, b)| a == b).count()
}

/// The path of the module in a file: `crates/core/src/method/window.rs` is `method::window`.
#[must_use]
pub fn module(file: &str) -> String {
    in_crate(file).trim_end_matches(".rs").replace('/', "::")
}

/// The path of a file below `src` of its crate.
#[must_use]
pub fn in_crate(file: &str) -> &str {
    file.split_once("src/").map_or(file, |(_, inside)| inside)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    fn test(program: usize, name: &str, cost: f64, units: &[usize]) -> Test {
        Test { program, name: name.into(), cost, units: BTreeSet::from_iter(units.iter().copied()) }
    }

    #[test]
    fn only_tests_that_enter_the_unit_and_those_of_the_module_first() {
        let tests = [
            test(0, "math::order::tests::a", 0.01, &[1]),
            test(0, "method::window::tests::b", 0.04, &[1, 2]),
            test(0, "method::trend::tests::c", 0.01, &[2]),
            test(1, "laws", 0.001, &[1]),
            test(0, "method::trend::tests::d", 0.02, &[1]),
        ];
        assert_eq!(batches(&tests, 1, "method::window::sorted"), [vec![1], vec![3], vec![0, 4]]);
        assert_eq!(batches(&tests, 5, "method::window"), Vec::<Batch>::new());
    }

    #[test]
    fn a_dear_test_comes_alone() {
        let tests = [test(0, "a::x", 3.0, &[0]), test(0, "a::y", 2.0, &[0])];
        assert_eq!(batches(&tests, 0, "b::c"), [vec![1], vec![0]]);
    }

    #[test]
    fn the_module_of_a_file() {
        assert_eq!(module("crates/core/src/method/window/sorted.rs"), "method::window::sorted");
    }
}
