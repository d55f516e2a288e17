//! Tests of the rewriting: that it is Rust, that the right text is replaced, that an arm's lines are its own.

use super::*;
use crate::list::Place;

/// The mutant that replaces the `nth` (from 0) `old` of `text` with `new`.
fn mutant(text: &str, old: &str, nth: usize, new: &str) -> Mutant {
    let at = text.match_indices(old).nth(nth).unwrap().0;
    let place = |at: usize| {
        let before = &text[..at];
        let line = before.matches('\n').count() + 1;
        Place { line, column: before.rsplit('\n').next().unwrap().chars().count() + 1 }
    };
    Mutant {
        file: "src/a.rs".into(),
        name: format!("replace {old} with {new}"),
        span: (place(at), place(at + old.len())),
        replacement: new.into(),
    }
}

fn rewritten(text: &str, mutants: &[Mutant]) -> Rewritten {
    let mutants: Vec<(usize, &Mutant)> = mutants.iter().enumerate().collect();
    let out = rewrite(text, &mutants, 7).unwrap();
    syn::parse_file(&out.text).unwrap_or_else(|e| panic!("{e}:\n{}", out.text));
    out
}

/// The lines of the arm of mutant `index`.
fn arm(out: &Rewritten, index: usize) -> String {
    let (first, last) = out.arms.iter().find(|arm| arm.index == index).unwrap().lines;
    out.text.lines().skip(first - 1).take(last + 1 - first).collect::<Vec<_>>().join("\n")
}

#[test]
fn an_operator_is_switched_in_its_expression_and_a_body_in_its_function() {
    let text = "/// Σ.\nfn f(a: f64) -> bool {\n    // σ\n    a - 1.0 * a >=\n        2.0 + a\n}\nfn g() {}\n";
    let body = "// σ\n    a - 1.0 * a >=\n        2.0 + a";
    let out = rewritten(text, &[mutant(text, "*", 0, "+"), mutant(text, ">=", 0, "<"), mutant(text, body, 0, "true")]);
    // The text decides, as in a file that is changed by hand: (a - 1) + a.
    assert_eq!(arm(&out, 0), "1 => { a - 1.0 + a >=\n        2.0 + a },");
    assert_eq!(arm(&out, 1), "2 => { a - 1.0 * a <\n        2.0 + a },");
    assert_eq!(arm(&out, 2), "3 => { {\n    true\n} },");
    let kept = "__mutant if !matches!(__mutant, 3) => { {\n    // σ\n    (match crate::mutant::at(8) {\n\
                __mutant if !matches!(__mutant, 1 | 2) => { a - 1.0 * a >=\n        2.0 + a },\n";
    assert!(out.text.contains(kept), "{}", out.text);
    assert!(out.text.starts_with("/// Σ.\nfn f(a: f64) -> bool {match crate::mutant::at(7) {\n"));
    assert!(out.text.ends_with("_ => unreachable!(), }}\nfn g() {}\n"));
    // Inner units come first: an error is theirs before it is the function's.
    assert_eq!(out.units.iter().map(|(members, _)| members.clone()).collect::<Vec<_>>(), [vec![0, 1], vec![2]]);
}

#[test]
fn units_inside_one_another_are_each_switched_once() {
    let text = "fn f() -> u8 { fn g() -> u8 { 1 + 2 } let h = || 3 * k(4 - 5); g() / h() }";
    let ops = ["+", "*", "-", "/"].map(|op| mutant(text, op, if op == "-" { 2 } else { 0 }, "%"));
    let out = rewritten(text, &ops);
    assert_eq!(out.text.matches("mutant::at").count(), 4);
    assert_eq!(arm(&out, 1), "2 => { 3 % k(4 - 5) },");
    assert!(arm(&out, 2).contains("3 => { 4 % 5 },"), "{}", out.text);
}

#[test]
fn a_deleted_arm_is_switched_in_its_match_and_a_guard_by_itself() {
    let text = "fn f(n: u8) -> u8 { 1 + match n { 2 if a => 3, 4 => 5, _ => 6 } }";
    let out = rewritten(text, &[mutant(text, "4 => 5,", 0, ""), mutant(text, "a", 1, "true")]);
    assert_eq!(arm(&out, 0), "1 => { match n { 2 if a => 3,  _ => 6 } },");
    assert_eq!(arm(&out, 1), "2 => { true },");
    assert!(out.text.contains("1 + (match crate::mutant::at("));
}

#[test]
fn a_const_function_is_one_no_more() {
    let text = "impl A {\n    pub const fn f() -> u8 {\n        1\n    }\n}\n";
    let out = rewritten(text, &[mutant(text, "1", 0, "0")]);
    assert!(out.text.contains("    pub  fn f() -> u8 "));
}

#[test]
fn an_opaque_type_is_boxed() {
    let text = "fn f<'a>() -> impl Iterator<Item = u8> + 'a { Some(1).into_iter() }";
    let out = rewritten(text, &[mutant(text, "{ Some(1).into_iter() }", 0, "{ std::iter::empty() }")]);
    assert!(out.text.contains("-> Box<dyn Iterator<Item = u8> + 'a> {match"));
    assert!(arm(&out, 0).contains("Box::new({ std::iter::empty() })"));
}

#[test]
fn a_closure_of_a_static_is_switched_and_a_plain_constant_is_apart() {
    let text = "static S: fn(u8) -> bool = |n| n > 4;\nconst C: usize = 1 << 20;\n";
    let out = rewritten(text, &[mutant(text, ">", 1, "<"), mutant(text, "<<", 0, ">>")]);
    assert!(out.text.contains("|n| (match crate::mutant::at(7)"));
    assert!(out.text.contains("const C: usize = 1 << 20;"));
    assert_eq!(out.apart, [1]);
    assert_eq!(out.switched, [Switched { index: 0, unit: 7 }]);
}
