//! Mutation testing of the program in one build: the program holds every mutant that `cargo mutants` would build
//! by itself, and an environment variable says which is in force. See `fuzz/README.md`.

mod arguments;
mod compile;
mod group;
mod judge;
mod list;
mod outcome;
mod plan;
mod pool;
mod reach;
mod rewrite;
mod run;
mod scheme;
mod survivors;
mod switch;
mod table;
mod tree;
mod unit;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::process::ExitCode;
use std::time::Instant;

use arguments::Arguments;
use list::Mutant;
use outcome::Outcome;
use tree::{Tree, fault};

/// All mutants, with what is known of each.
struct Known {
    list: Vec<Mutant>,
    /// Key of each, in the order of `list`.
    keys: Vec<u64>,
    /// How the list of survivors would name each.
    rows: Vec<survivors::Row>,
    outcomes: BTreeMap<u64, Outcome>,
}

impl Known {
    /// The mutants of the checkout and the outcomes that are remembered.
    fn new(tree: &Tree) -> Result<Self, String> {
        let list = list::list(&tree.root)?;
        let (mut keys, mut rows) = (Vec::new(), Vec::new());
        for of_file in list.chunk_by(|a, b| a.file == b.file) {
            let Some(first) = of_file.first() else { continue };
            let path = tree.root.join(&first.file);
            let text = fs::read_to_string(&path).map_err(fault(&path))?;
            let mutants: Vec<&Mutant> = of_file.iter().collect();
            keys.extend(outcome::keys(&text, &mutants).map_err(|e| format!("{}: {e}", first.file))?);
            rows.extend(of_file.iter().map(|mutant| survivors::row(&text, mutant)));
        }
        Ok(Self { list, keys, rows, outcomes: outcome::read(&tree.outcomes) })
    }

    fn outcome(&self, index: usize) -> Option<Outcome> {
        self.outcomes.get(&self.keys[index]).copied()
    }
}

/// Builds the program with its mutants and judges those that `arguments` ask for.
fn judge_all(tree: &Tree, known: &mut Known, arguments: &Arguments) -> Result<(), String> {
    let begin = Instant::now();
    let due = |known: &Known, index: usize| match known.outcome(index) {
        None => true,
        Some(Outcome::Survived) => arguments.again,
        Some(_) => false,
    };
    let unviable = (0..known.list.len()).filter(|&i| known.outcome(i) == Some(Outcome::Unviable));
    let tests = configured(tree)?;
    let scheme = scheme::build(tree, &known.list, unviable.collect(), &tests)?;
    for &index in &scheme.unviable {
        if known.outcome(index) != Some(Outcome::Unviable) {
            outcome::append(&tree.outcomes, known.keys[index], Outcome::Unviable, "", &known.list[index])?;
        }
    }
    println!("built after {:.0} s", begin.elapsed().as_secs_f64());
    let tests = reach::tests(tree, &scheme.programs, arguments.jobs)?;
    println!("{} tests run alone, after {:.0} s", tests.len(), begin.elapsed().as_secs_f64());
    let wanted = |index: &usize| arguments.wants(&known.list[*index].file) && !scheme.unviable.contains(index);
    let due: Vec<usize> = (0..known.list.len()).filter(wanted).filter(|&index| due(known, index)).collect();
    println!("{} mutants to judge", due.len());
    let results = pool::pool(&due, arguments.jobs, |worker, &index| {
        let mutant = &known.list[index];
        let (outcome, by) = judge::judge(tree, &scheme, &tests, worker, (index, mutant))?;
        outcome::append(&tree.outcomes, known.keys[index], outcome, &by, mutant)
    });
    results.into_iter().collect::<Result<(), String>>()?;
    // A mutant may have spoiled a file that tests read: what is killed after that is killed by nothing.
    reach::tests(tree, &scheme.programs, arguments.jobs).map_err(|e| format!("a mutant spoiled the copy: {e}"))?;
    println!("{} mutants judged, after {:.0} s", due.len(), begin.elapsed().as_secs_f64());
    known.outcomes = outcome::read(&tree.outcomes);
    Ok(())
}

/// The files of `tests` that `.cargo/mutants.toml` names.
fn configured(tree: &Tree) -> Result<Vec<String>, String> {
    let path = tree.root.join(".cargo/mutants.toml");
    let text = fs::read_to_string(&path).map_err(fault(&path))?;
    let list = text.split_once("\nadditional_cargo_test_args").and_then(|(_, rest)| rest.split(']').next());
    let list = list.ok_or_else(|| format!("{}: no additional_cargo_test_args", path.display()))?;
    let words: Vec<&str> = list.split('"').skip(1).step_by(2).collect();
    Ok(words.windows(2).filter(|pair| pair[0] == "--test").map(|pair| pair[1].to_owned()).collect())
}

/// Prints the survivors that are not listed, then the figures; whether there are such.
fn report(known: &Known, listed: &BTreeSet<survivors::Row>, arguments: &Arguments) -> bool {
    let open = |i: usize| matches!(known.outcome(i), Some(Outcome::Survived | Outcome::Apart));
    let asked: Vec<usize> = (0..known.list.len()).filter(|&i| arguments.wants(&known.list[i].file)).collect();
    let mut any = false;
    for &i in asked.iter().filter(|&&i| open(i) && !listed.contains(&known.rows[i])) {
        any = true;
        println!("{}", survivors::written(&known.rows[i], &format!("line {}", known.list[i].span.0.line)));
    }
    // What was not judged may survive.
    let may = |i: usize| open(i) || known.outcome(i).is_none();
    let alive: BTreeSet<&survivors::Row> = (0..known.list.len()).filter(|&i| may(i)).map(|i| &known.rows[i]).collect();
    for row in listed.iter().filter(|row| arguments.wants(&row.file) && !alive.contains(row)) {
        println!("listed, but does not survive: {}", survivors::written(row, ""));
    }
    let rows = asked.iter().map(|&i| {
        let listed = open(i) && listed.contains(&known.rows[i]);
        (known.list[i].file.as_str(), known.outcome(i), listed)
    });
    println!("\n{}", table::table(rows));
    any
}

fn work() -> Result<bool, String> {
    let arguments = Arguments::read(std::env::args().skip(1))?;
    let tree = Tree::new()?;
    if arguments.fresh && tree.outcomes.exists() {
        fs::remove_file(&tree.outcomes).map_err(fault(&tree.outcomes))?;
    }
    fs::create_dir_all(&tree.copy).map_err(fault(&tree.copy))?;
    let mut known = Known::new(&tree)?;
    if !arguments.list {
        judge_all(&tree, &mut known, &arguments)?;
    }
    Ok(report(&known, &survivors::read(&tree.root.join("fuzz/SURVIVORS.md")), &arguments))
}

fn main() -> ExitCode {
    match work() {
        Ok(false) => ExitCode::SUCCESS,
        Ok(true) => ExitCode::from(1),
        Err(words) => {
            eprintln!("{words}");
            ExitCode::from(2)
        }
    }
}
