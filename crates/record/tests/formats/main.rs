//! Every format of the registry: recognised without an option, understood, and written again with nothing but the repaired
//! cell changed. The inputs are written here from public descriptions of the formats, two of each and more.

#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]

mod beside;
mod case;
mod edges;
mod gnss;
mod hostile;
mod loggers;
mod logs;
mod phones;
mod records;
mod weather;

use case::{Case, wrong};
use wildpoint_record::track::FORMATS;

fn cases() -> Vec<Case> {
    [loggers::cases(), weather::cases(), gnss::cases(), records::cases(), logs::cases(), phones::cases()]
        .into_iter()
        .flatten()
        .collect()
}

#[test]
fn files_of_every_format_are_understood_and_written_again() {
    let wrong: Vec<String> = cases().iter().filter_map(|c| Some(format!("{}: {}", c.name, wrong(c)?))).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn columns_beside_are_read_again_or_refused() {
    let wrong: Vec<String> =
        cases().iter().filter_map(|c| Some(format!("{}: {}", c.name, beside::wrong(c)?))).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn broken_inputs_are_read_or_refused() {
    cases().iter().for_each(hostile::walked);
}

/// Formats whose inputs stand in other tests (`tests/understanding.rs`, the registry itself).
const ELSEWHERE: [&str; 8] =
    ["Sea-Bird CNV", "CCSDS OEM", "STK ephemeris", "IAGA-2002", "SBS-1 (BaseStation)", "NDBC", "DWD", "SURFRAD"];

#[test]
fn every_format_has_a_plain_input_and_an_awkward_one() {
    let cases = cases();
    for format in FORMATS.iter().filter(|f| !ELSEWHERE.contains(&f.name)) {
        let count = cases.iter().filter(|c| c.format == format.name).count();
        assert!(count >= 2, "{}: {count}", format.name);
    }
}
