//! Units of a file: the pieces that are written out once for each of their mutants.
//!
//! A piece is as small as its mutants allow, for what it holds is compiled once for each: for an operator the
//! expression of operators it is in (whose grouping the replaced operator may change), for a deleted arm the `match`,
//! for a replaced body the function. In a `static` or `const`, whose value no variable can switch, only what lies in a
//! closure can be one.

use std::ops::Range;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// What a unit is.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Kind {
    /// Operators and what they are applied to, or the guard of an arm.
    Operators,
    /// A `match` or the making of a struct.
    Whole,
    /// The body of a function, or of a closure that is in none.
    Body,
}

/// A piece that can be switched. All ranges are offsets in bytes of the text of the file.
#[derive(Clone, PartialEq, Debug)]
pub struct Unit {
    /// What it is.
    pub kind: Kind,
    /// Where it is: a body with its braces.
    pub range: Range<usize>,
    /// The word `const` of a function, which such a body cannot keep.
    pub constant: Option<Range<usize>>,
    /// The type `impl Trait` that the function returns, of which every written-out body would have its own.
    pub opaque: Option<Range<usize>>,
}

/// All that can be switched in the text of a file.
///
/// # Errors
/// Words that say where the text is no Rust.
pub fn units(text: &str) -> Result<Vec<Unit>, String> {
    let file = syn::parse_file(text).map_err(|e| {
        let at = e.span().start();
        format!("line {}, column {}: {e}", at.line, at.column + 1)
    })?;
    let mut found = Found { units: Vec::new(), depth: 0 };
    found.visit_file(&file);
    Ok(found.units)
}

struct Found {
    units: Vec<Unit>,
    /// How many bodies the visited place lies in.
    depth: usize,
}

fn range(span: Span) -> Range<usize> {
    span.byte_range()
}

impl Found {
    fn add(&mut self, kind: Kind, span: Span) {
        if self.depth > 0 {
            self.units.push(Unit { kind, range: range(span), constant: None, opaque: None });
        }
    }

    fn function(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let opaque = match &signature.output {
            syn::ReturnType::Type(_, kind) if matches!(**kind, syn::Type::ImplTrait(_)) => Some(range(kind.span())),
            _ => None,
        };
        let constant = signature.constness.map(|word| range(word.span));
        self.units.push(Unit { kind: Kind::Body, range: range(block.span()), constant, opaque });
        self.depth += 1;
        self.visit_block(block);
        self.depth -= 1;
    }

    /// What an operator is applied to: further operators belong to the same expression.
    fn operand(&mut self, operand: &syn::Expr) {
        match operand {
            syn::Expr::Binary(binary) => {
                self.operand(&binary.left);
                self.operand(&binary.right);
            }
            other => self.visit_expr(other),
        }
    }
}

/// Whether an expression is `let`, alone or among conditions: such a one cannot stand in brackets.
fn binds(expression: &syn::Expr) -> bool {
    match expression {
        syn::Expr::Let(_) => true,
        syn::Expr::Binary(binary) => binds(&binary.left) || binds(&binary.right),
        _ => false,
    }
}

impl<'ast> Visit<'ast> for Found {
    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        self.function(&function.sig, &function.block);
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        self.function(&function.sig, &function.block);
    }

    fn visit_trait_item_fn(&mut self, function: &'ast syn::TraitItemFn) {
        match &function.default {
            Some(block) => self.function(&function.sig, block),
            None => visit::visit_trait_item_fn(self, function),
        }
    }

    fn visit_expr_closure(&mut self, closure: &'ast syn::ExprClosure) {
        self.depth += 1;
        self.add(Kind::Body, closure.body.span());
        self.visit_expr(&closure.body);
        self.depth -= 1;
    }

    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        if binds(&binary.left) || binds(&binary.right) {
            return visit::visit_expr_binary(self, binary);
        }
        self.add(Kind::Operators, binary.span());
        self.operand(&binary.left);
        self.operand(&binary.right);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        if !matches!(unary.op, syn::UnOp::Deref(_)) {
            self.add(Kind::Operators, unary.span());
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        if let Some((_, guard)) = &arm.guard
            && !binds(guard)
        {
            self.add(Kind::Operators, guard.span());
        }
        visit::visit_arm(self, arm);
    }

    fn visit_expr_match(&mut self, choice: &'ast syn::ExprMatch) {
        self.add(Kind::Whole, choice.span());
        visit::visit_expr_match(self, choice);
    }

    fn visit_expr_struct(&mut self, made: &'ast syn::ExprStruct) {
        self.add(Kind::Whole, made.span());
        visit::visit_expr_struct(self, made);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str, kind: Kind) -> Vec<&str> {
        let units = units(text).unwrap().into_iter();
        units.filter(|unit| unit.kind == kind).map(|unit| &text[unit.range]).collect()
    }

    #[test]
    fn functions_methods_and_closures_are_bodies() {
        let text = "fn f() { 1 }\ntrait T { fn g(&self) -> u8 { 2 } fn n(&self); }\nimpl A { fn h() { 3 } }\n\
                    static S: fn(f64) -> bool = |σ| σ > 4.0;\nmod m { fn i() { 5 } }";
        assert_eq!(found(text, Kind::Body), ["{ 1 }", "{ 2 }", "{ 3 }", "σ > 4.0", "{ 5 }"]);
    }

    #[test]
    fn operators_that_may_group_anew_are_one_unit_and_a_call_or_bracket_begins_another() {
        let text = "fn f() { let x = a - b * g(c + d) / (e - -h); }";
        assert_eq!(found(text, Kind::Operators), ["a - b * g(c + d) / (e - -h)", "c + d", "e - -h", "-h"]);
    }

    #[test]
    fn a_let_among_conditions_stays_where_it_is() {
        let text = "fn f() { if let Some(x) = y && x > z { *x } }";
        assert_eq!(found(text, Kind::Operators), ["x > z"]);
    }

    #[test]
    fn what_is_constant_is_no_unit() {
        assert_eq!(found("const C: usize = 1 << 20; static S: A = A { b: 2 + 3 };", Kind::Operators), [""; 0]);
    }

    #[test]
    fn const_and_an_opaque_type_are_found() {
        let text = "pub const fn f() -> u8 { 1 }\nfn g<'a>() -> impl Iterator<Item = u8> + 'a { None.into_iter() }";
        let found = units(text).unwrap();
        assert_eq!(found[0].constant.clone().map(|r| &text[r]), Some("const"));
        assert_eq!(found[1].opaque.clone().map(|r| &text[r]), Some("impl Iterator<Item = u8> + 'a"));
    }

    #[test]
    fn what_is_no_rust_is_refused_with_its_place() {
        assert!(units("fn f( {").unwrap_err().starts_with("line 1"));
    }
}
