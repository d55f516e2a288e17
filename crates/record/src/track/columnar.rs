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
mod thrift;
mod value;
mod write;

#[cfg(feature = "hdf5")]
pub(crate) use kind::{float, quoted, timestamp};
pub(crate) use settle::{refuse_layout, with_layout};
#[cfg(feature = "hdf5")]
pub(crate) use text::{is_comment, name_cell};
pub(crate) use text::{known, unpack};
pub use write::{CopyForm, FlagForm, copy_form, names_arrays, names_columns, write_columns};

#[cfg(test)]
mod tests;
