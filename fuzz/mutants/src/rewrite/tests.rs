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
fn every_mutant_has_its_arm_and_the_body_stays() {
    let text = "/// Σ.\nfn f(a: f64) -> bool {\n    // σ\n    a + 1.0 >= 2.0 + a\n}\nfn g() {}\n";
    let out = rewritten(text, &[mutant(text, "+", 1, "-"), mutant(text, ">=", 0, "<")]);
    assert_eq!(arm(&out, 0), "1 => { {\n    // σ\n    a + 1.0 >= 2.0 - a\n} },");
    assert_eq!(arm(&out, 1), "2 => { {\n    // σ\n    a + 1.0 < 2.0 + a\n} },");
    assert!(
        out.text.contains("at(7) {\n__mutant if !matches!(__mutant, 1 | 2) => { {\n    // σ\n    a + 1.0 >= 2.0 + a\n")
    );
    assert!(out.text.starts_with("/// Σ.\nfn f(a: f64) -> bool {"));
    assert!(out.text.ends_with("}\nfn g() {}\n"));
    assert_eq!(out.units[0].0, [0, 1]);
}

#[test]
fn mutants_of_a_nested_function_switch_the_outermost() {
    let text = "fn f() -> u8 { fn g() -> u8 { 1 + 2 } let h = || 3 + 4; g() + h() }";
    let out = rewritten(text, &[mutant(text, "+", 0, "-"), mutant(text, "+", 1, "*")]);
    assert_eq!(out.text.matches("mutant::at").count(), 1);
    assert!(arm(&out, 0).contains("{ fn g() -> u8 { 1 - 2 } let h = || 3 + 4; g() + h() }"));
    assert!(arm(&out, 1).contains("let h = || 3 * 4;"));
}

#[test]
fn a_const_function_is_one_no_more() {
    let text = "impl A {\n    pub const fn f() -> u8 {\n        1 + 2\n    }\n}\n";
    let out = rewritten(text, &[mutant(text, "+", 0, "-")]);
    assert!(out.text.contains("    pub  fn f() -> u8 "));
}

#[test]
fn an_opaque_type_is_boxed() {
    let text = "fn f<'a>() -> impl Iterator<Item = u8> + 'a { Some(1).into_iter() }";
    let out = rewritten(text, &[mutant(text, "{ Some(1).into_iter() }", 0, "{ std::iter::empty() }")]);
    assert!(out.text.contains("-> Box<dyn Iterator<Item = u8> + 'a> { match"));
    assert!(arm(&out, 0).contains("Box::new({ std::iter::empty() })"));
}

#[test]
fn a_closure_of_a_static_is_switched_and_a_plain_constant_is_apart() {
    let text = "static S: fn(u8) -> bool = |n| n > 4;\nconst C: usize = 1 << 20;\n";
    let out = rewritten(text, &[mutant(text, ">", 1, "<"), mutant(text, "<<", 0, ">>")]);
    assert!(out.text.contains("|n| { match crate::mutant::at(7)"));
    assert!(out.text.contains("const C: usize = 1 << 20;"));
    assert_eq!(out.apart, [1]);
    assert_eq!(out.switched, [Switched { index: 0, unit: 7 }]);
}
