//! Lines between the names of columns and the first row: units, types, statistics, rulers.

use super::super::names;

/// What stands in a line above the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Names of columns, as far as it can be told.
    Names,
    /// Their units.
    Units,
    /// Types of their values, or how they were averaged.
    Types,
    /// Dashes and their like.
    Ruler,
}

/// Words for types and statistics, in lower case.
const TYPES: [&str; 32] = [
    "smp",
    "avg",
    "min",
    "max",
    "std",
    "tot",
    "med",
    "cov",
    "wvc",
    "int",
    "float",
    "double",
    "string",
    "str",
    "char",
    "bool",
    "date",
    "datetime",
    "timestamp",
    "real",
    "integer",
    "text",
    "float64",
    "int64",
    "float32",
    "int32",
    "mean",
    "sum",
    "count",
    "inst",
    "sample",
    "number",
];

/// Units that are no ends of names.
const UNITS: [&str; 40] = [
    "ts",
    "rn",
    "volts",
    "volt",
    "deg c",
    "degc",
    "deg f",
    "degf",
    "yr",
    "mo",
    "dy",
    "hr",
    "mn",
    "yyyy",
    "mm",
    "dd",
    "hh",
    "%",
    "degt",
    "degrees",
    "percent",
    "none",
    "unitless",
    "-",
    "utc",
    "gmt",
    "counts",
    "count",
    "1",
    "celsius",
    "meters",
    "metres",
    "degrees_north",
    "degrees_east",
    "nmi",
    "ft",
    "nd",
    "n/a",
    "#",
    "(-)",
];

/// What the cells of a line are.
pub(super) fn kind_of(cells: &[String]) -> Kind {
    let filled: Vec<String> = cells.iter().filter(|c| !c.is_empty()).map(|c| c.to_lowercase()).collect();
    if filled.iter().all(|c| c.chars().all(|c| !c.is_alphanumeric() && c != '%')) {
        return Kind::Ruler;
    }
    let most = |fits: &dyn Fn(&String) -> bool| filled.iter().filter(|c| fits(c)).count() * 2 > filled.len();
    let widths = |c: &String| {
        // The types of USGS: 5s, 20d, 14n.
        c.len() <= 4
            && c.ends_with(['s', 'd', 'n'])
            && c[..c.len() - 1].bytes().all(|b| b.is_ascii_digit())
            && c.len() > 1
    };
    if most(&widths) || most(&|c| TYPES.contains(&c.as_str())) {
        Kind::Types
    } else if most(&|c| is_unit(c)) {
        Kind::Units
    } else {
        Kind::Names
    }
}

/// True for a line of types or statistics.
pub(super) fn are_types(cells: &[String]) -> bool {
    kind_of(cells) == Kind::Types
}

/// Is this text, in lower case, a unit?
pub(super) fn is_unit(text: &str) -> bool {
    let bare = text.trim_matches(['(', ')', '[', ']']).trim();
    let bracketed = bare.len() + 2 <= text.len() && text.starts_with(['(', '[']);
    let marked = text.contains(['°', 'µ', 'μ', '²', '³', '^', '%'])
        || (text.contains('/') && text.len() <= 12 && !text.contains(' '));
    let powers = text.contains("-1") || text.contains("-2") || text.contains("**");
    bracketed || marked || powers || UNITS.contains(&bare) || names::is_unit(bare)
}
