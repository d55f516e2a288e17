//! What a file says of an array besides its values.

use super::scalar::Scalar;

/// The value of an attribute.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Attribute {
    Text(String),
    Numbers(Vec<Scalar>),
}

/// Attributes by their names.
#[derive(Debug, Clone, Default)]
pub(super) struct Attributes(pub(super) Vec<(String, Attribute)>);

impl Attributes {
    fn get(&self, name: &str) -> Option<&Attribute> {
        self.0.iter().find(|(own, _)| own == name).map(|(_, value)| value)
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.get(name).is_some()
    }

    /// The text under this name.
    pub(super) fn text(&self, name: &str) -> Option<&str> {
        match self.get(name)? {
            Attribute::Text(text) => Some(text.trim_matches(['\0', ' ', '\n', '\r', '\t'])),
            Attribute::Numbers(_) => None,
        }
    }

    /// The numbers under this name.
    pub(super) fn numbers(&self, name: &str) -> &[Scalar] {
        match self.get(name) {
            Some(Attribute::Numbers(numbers)) => numbers,
            _ => &[],
        }
    }

    /// The unit of an array, under the names that programs use for it; empty where there is none.
    pub(super) fn unit(&self) -> &str {
        let named = ["units", "unit", "Units", "Unit", "UNITS", "UNIT"].into_iter().find_map(|name| self.text(name));
        named.filter(|unit| !matches!(*unit, "1" | "-" | "none" | "None")).unwrap_or("")
    }

    /// True where the values stand for states, by the CF conventions.
    pub(super) fn is_flag(&self) -> bool {
        ["flag_values", "flag_masks", "flag_meanings"].into_iter().any(|name| self.has(name))
            || self.text("standard_name").is_some_and(|name| name.ends_with("status_flag") || name.ends_with("_flag"))
    }
}
