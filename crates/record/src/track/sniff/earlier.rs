//! What cells looked like by the rules of [`super::Rules::First`]: sessions that were saved then go on meaning what they
//! meant.

use super::super::number::Reading;
use super::super::timestamp;
use super::{Layout, Look, for_records, inner};

/// What a cell looks like that is neither a number nor a marker.
pub(super) fn look_of_text(cell: &[u8]) -> Look {
    let time = timestamp::iso_below_24(cell).is_some()
        || timestamp::clock(cell).is_some()
        || timestamp::year_last_parts(cell).is_some();
    if time { Look::Time } else { Look::Text }
}

/// Are there more numbers with a decimal comma than with a point?
pub(super) fn has_decimal_commas(sample: &[u8], layout: Layout) -> bool {
    let comma = Reading::new(true, &[]);
    let point = Reading::new(false, &[]);
    let (mut commas, mut points) = (0, 0);
    for_records(sample, layout, |cells| {
        for raw in cells {
            let cell = &raw[inner(raw, layout.quote)];
            if cell.contains(&b',') && comma.number(cell).is_some() {
                commas += 1;
            } else if cell.contains(&b'.') && point.number(cell).is_some() {
                points += 1;
            }
        }
    });
    commas > points
}
