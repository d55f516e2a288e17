//! Files that store a table by columns: Parquet.
//!
//! Such a file is read as the CSV text that says the same ([`text`]), so that everything that is done with text is done
//! with it. Its cleaned copy is such a file again ([`copy`]), in which what no repair touches stays byte for byte.

mod access;
mod copy;
mod encode;
mod errors;
mod flags;
mod kind;
mod pages;
mod parse;
mod recode;
mod schema;
mod settle;
mod table;
mod text;
mod value;
mod write;

pub(crate) use settle::{refuse_layout, settle, with_layout};
pub(crate) use text::{known, unpack};
pub use write::{FlagForm, is_columns_name, names_columns, write_columns};

#[cfg(test)]
mod tests;
