//! Units of a file: the bodies that are written out once for each of their mutants.
//!
//! A unit is the outermost function round a mutant, so that nothing has to be rewritten twice; in a `static` or
//! `const`, whose value no variable can switch, the outermost closure.

use std::ops::Range;

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// A body that can be switched. All ranges are offsets in bytes of the text of the file.
#[derive(Clone, PartialEq, Debug)]
pub struct Unit {
    /// The body: with its braces for a function, an expression for a closure.
    pub body: Range<usize>,
    /// The word `const` of a function, which such a body cannot keep.
    pub constant: Option<Range<usize>>,
    /// The type `impl Trait` that the function returns, of which every written-out body would have its own.
    pub opaque: Option<Range<usize>>,
}

/// The units of the text of a file, in its order.
///
/// # Errors
/// Words that say where the text is no Rust.
pub fn units(text: &str) -> Result<Vec<Unit>, String> {
    let file = syn::parse_file(text).map_err(|e| {
        let at = e.span().start();
        format!("line {}, column {}: {e}", at.line, at.column + 1)
    })?;
    let mut found = Found { units: Vec::new() };
    found.visit_file(&file);
    Ok(found.units)
}

struct Found {
    units: Vec<Unit>,
}

fn range(span: Span) -> Range<usize> {
    span.byte_range()
}

impl Found {
    fn function(&mut self, signature: &syn::Signature, block: &syn::Block) {
        let opaque = match &signature.output {
            syn::ReturnType::Type(_, kind) if matches!(**kind, syn::Type::ImplTrait(_)) => Some(range(kind.span())),
            _ => None,
        };
        let constant = signature.constness.map(|word| range(word.span));
        self.units.push(Unit { body: range(block.span()), constant, opaque });
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
        self.units.push(Unit { body: range(closure.body.span()), constant: None, opaque: None });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bodies(text: &str) -> Vec<&str> {
        units(text).unwrap().into_iter().map(|unit| &text[unit.body]).collect()
    }

    #[test]
    fn functions_methods_and_closures_of_a_static_are_units() {
        let text = "fn f() { 1 }\ntrait T { fn g(&self) -> u8 { 2 } fn n(&self); }\nimpl A { fn h() { 3 } }\n\
                    static S: fn(f64) -> bool = |σ| σ > 4.0;\nmod m { fn i() { 5 } }";
        assert_eq!(bodies(text), ["{ 1 }", "{ 2 }", "{ 3 }", "σ > 4.0", "{ 5 }"]);
    }

    #[test]
    fn what_is_nested_belongs_to_the_outermost_function() {
        assert_eq!(bodies("fn f() { fn g() { 1 } g(); let h = || 2; }"), ["{ fn g() { 1 } g(); let h = || 2; }"]);
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
