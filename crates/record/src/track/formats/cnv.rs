//! Sea-Bird CNV: names and units in comments, numbers in columns of a fixed width.

use super::{Format, Known, Label, PLAIN};
use crate::track::Aside;

pub(super) const FORMAT: Format = Format {
    name: "Sea-Bird CNV",
    about: "profiles and moorings of Sea-Bird instruments",
    known_by: "`* Sea-Bird` at the start, or `# name 0 =` above `*END*`",
    maps: "names and units from `# name N`, `bad_flag` is no value, `flag` is no channel",
    known: |text| text.starts_with("* Sea-Bird") || (text.contains("\n# name 0 = ") && text.contains("*END*")),
    complete,
    label,
    ..PLAIN
};

fn complete(text: &str, known: &mut Known) {
    let head = text.split("*END*").next().unwrap_or(text);
    let value = |line: &str, key: &str| line.strip_prefix(key)?.split_once('=').map(|(_, v)| v.trim().to_owned());
    if known.options.names.is_empty() && known.options.header_line.is_none() {
        let names = head.lines().filter_map(|l| value(l, "# name "));
        known.options.names = names.map(|n| n.split(':').next().unwrap_or("").trim().to_owned()).collect();
    }
    known.options.comment.get_or_insert_with(|| "*".to_owned());
    if let Some(bad) = head.lines().find_map(|l| value(l, "# bad_flag")) {
        known.missing([bad.as_str()]);
    }
}

/// The unit in the brackets of `# name 1 = t090C: Temperature [ITS-90, deg C]`.
fn label(text: &str, name: &str) -> Label {
    if name == "flag" {
        return Label::aside(Aside::Flag);
    }
    let of = |line: &str| {
        let (_, rest) = line.strip_prefix("# name ")?.split_once('=')?;
        let (short, long) = rest.split_once(':')?;
        let unit = long.trim().strip_suffix(']')?.rsplit_once('[')?.1;
        (short.trim() == name).then(|| unit.rsplit(',').next().unwrap_or(unit).trim().to_owned())
    };
    Label { unit: text.lines().find_map(of), aside: None }
}
