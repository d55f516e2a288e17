//! Sea-Bird CNV: names and units in comments, numbers in columns of a fixed width.

use super::{Format, missing};
use crate::track::LoadOptions;

pub(super) const FORMAT: Format = Format {
    name: "Sea-Bird CNV",
    about: "profiles and moorings of Sea-Bird instruments",
    known: |text| text.starts_with("* Sea-Bird") || (text.contains("\n# name 0 = ") && text.contains("*END*")),
    complete,
};

fn complete(text: &str, options: &mut LoadOptions) {
    let head = text.split("*END*").next().unwrap_or(text);
    let value = |line: &str, key: &str| line.strip_prefix(key)?.split_once('=').map(|(_, v)| v.trim().to_owned());
    if options.names.is_empty() && options.header_line.is_none() {
        let names = head.lines().filter_map(|l| value(l, "# name "));
        options.names = names.map(|n| n.split(':').next().unwrap_or("").trim().to_owned()).collect();
    }
    options.comment.get_or_insert_with(|| "*".to_owned());
    if let Some(bad) = head.lines().find_map(|l| value(l, "# bad_flag")) {
        missing(options, &[&bad]);
    }
}
