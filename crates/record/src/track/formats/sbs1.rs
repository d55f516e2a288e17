//! SBS-1 (BaseStation): messages of aircraft, a line each, without a header.

use super::{Format, name};
use crate::track::{Delimiter, LoadOptions};

pub(super) const FORMAT: Format = Format {
    name: "SBS-1 (BaseStation)",
    about: "positions of aircraft from ADS-B receivers",
    known: |text| text.lines().take(5).any(|l| l.starts_with("MSG,") && l.matches(',').count() == 21),
    complete,
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

fn complete(_: &str, options: &mut LoadOptions) {
    options.delimiter.get_or_insert(Delimiter::Byte(b','));
    options.header.get_or_insert(false);
    name(options, &NAMES);
    options.time.get_or_insert_with(|| "DateGenerated,TimeGenerated".to_owned());
    options.track.get_or_insert_with(|| "HexIdent".to_owned());
}
