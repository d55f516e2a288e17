//! SBS-1 (BaseStation): messages of aircraft, a line each, without a header.

use super::{Format, Known, PLAIN};
use crate::track::Delimiter;

pub(super) const FORMAT: Format = Format {
    name: "SBS-1 (BaseStation)",
    about: "positions of aircraft from ADS-B receivers",
    known_by: "lines `MSG,` of 22 cells",
    maps: "date and time generated, a track for each `HexIdent`",
    known: |text| text.lines().take(5).any(|l| l.starts_with("MSG,") && l.matches(',').count() == 21),
    complete,
    closed: true,
    ..PLAIN
};

/// The 22 fields of a message, as BaseStation documents them.
const NAMES: [&str; 22] = [
    "MessageType",
    "TransmissionType",
    "SessionID",
    "AircraftID",
    "HexIdent",
    "FlightID",
    "DateGenerated",
    "TimeGenerated",
    "DateLogged",
    "TimeLogged",
    "Callsign",
    "Altitude",
    "GroundSpeed",
    "Track",
    "Latitude",
    "Longitude",
    "VerticalRate",
    "Squawk",
    "Alert",
    "Emergency",
    "SPI",
    "IsOnGround",
];

fn complete(_: &str, known: &mut Known) {
    known.options.delimiter.get_or_insert(Delimiter::Byte(b','));
    known.options.header.get_or_insert(false);
    known.name(NAMES);
    known.options.time.get_or_insert_with(|| "DateGenerated,TimeGenerated".to_owned());
    known.options.track.get_or_insert_with(|| "HexIdent".to_owned());
}
