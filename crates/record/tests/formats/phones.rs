//! Logs of Android phones: GnssLogger and GPSTest.

use super::case::{Case, ROWS, case, other};

pub(crate) fn cases() -> Vec<Case> {
    vec![fixes(), measurements(), sensors()]
}

/// Milliseconds after 1970 of 2021-03-04 10:00:00 UTC.
const START_MS: usize = 1_614_852_000_000;

/// Positions among other rows; the names have blanks.
fn fixes() -> Case {
    let text = |v: &dyn Fn(usize) -> String| {
        let head = "# \n# Header Description:\n# \n# Version: v2.0.0.1 Platform: 8.0.0\n# \n\
                    # Raw,ElapsedRealtimeMillis,TimeNanos,Svid,Cn0DbHz\n# \n\
                    # Fix,Provider,Latitude,Longitude,Altitude,Speed,Accuracy,(UTC)TimeInMs\n# \n\
                    # Nav,Svid,Type,Status,MessageId,Sub-messageId,Data(Bytes)\n# \n";
        (0..ROWS).fold(head.to_owned(), |text, i| {
            let nav = if i % 9 == 0 { format!("Nav,3,257,1,{i},2,-117,11,-86\n") } else { String::new() };
            let raw = if i % 2 == 0 {
                format!("Raw,{},{}000000,7,3{}.5\n", 5000 + i, 1000 * i, i % 9)
            } else {
                String::new()
            };
            text + &nav
                + &raw
                + &format!("Fix,gps,37.42{i:02},-122.08{i:02},{},0.{},3.0,{}\n", v(i), i % 9, START_MS + 1000 * i)
        })
    };
    Case {
        channel: "Altitude",
        unit: "m",
        step: 1.0,
        asides: &["Provider"],
        ..case("positions among other rows", "Android GNSS log", text)
    }
}

/// Measurements of two satellites, one of which sends two signals: tracks in turn, in GPS time.
fn measurements() -> Case {
    let text = |v: &dyn Fn(usize) -> String| {
        let head = "#   Raw,utcTimeMillis,TimeNanos,LeapSecond,FullBiasNanos,BiasNanos, Svid,State,Cn0DbHz,CarrierFrequencyHz,\
                    ConstellationType,CodeType\n# Fix,Provider,LatitudeDegrees,LongitudeDegrees,UnixTimeMillis\n";
        (0..ROWS).fold(head.to_owned(), |text, i| {
            // 2021-03-04 10:00:18 in GPS time, since 1980-01-06: the clock of the receiver starts anew in the middle.
            let gps = 1_298_887_218_000_000_000_i64 + 1_000_000_000 * i as i64;
            let clock = 77_000_000_i64 + 1_000_000_000 * if i < 20 { i } else { i - 20 } as i64;
            let row = |svid: usize, cell: String, hertz: &str, code: &str| {
                format!(
                    "Raw,{},{clock},18,{},0.25,{svid},16431,{cell},{hertz},1,{code}\n",
                    START_MS + 1000 * i,
                    clock - gps
                )
            };
            text + &row(3, v(i), "1575420030", "C")
                + &row(3, format!("{:.2}", other(i)), "1176450050", "Q")
                + &row(14, format!("{:.2}", 30.0 + other(i)), "1575420030", "C")
        })
    };
    Case {
        channel: "Cn0DbHz@G03 1575 MHz",
        unit: "dB-Hz",
        start: "2021-03-04 10:00:18",
        step: 1.0,
        rows: ROWS,
        asides: &["TimeNanos", "utcTimeMillis", "State", "Svid", "ConstellationType"],
        ..case("signals in turn", "Android GNSS log", text)
    }
}

/// A sensor whose rows are closer than milliseconds tell.
fn sensors() -> Case {
    let text = |v: &dyn Fn(usize) -> String| {
        let head = "# Raw,utcTimeMillis,TimeNanos,Svid,Cn0DbHz\n\
                    # UncalGyro,utcTimeMillis,elapsedRealtimeNanos,UncalGyroXRadPerSec,DriftXRadPerSec\n\
                    # Fix,Provider,LatitudeDegrees,LongitudeDegrees,UnixTimeMillis\n";
        (0..ROWS).fold(head.to_owned(), |text, i| {
            text + &format!("UncalGyro,{},{},{},0.0\n", START_MS + i / 2, 5_000_000_000_u64 + 500_000 * i as u64, v(i))
        })
    };
    Case {
        channel: "UncalGyroXRadPerSec",
        unit: "rad/s",
        start: "",
        step: 5e-4,
        asides: &["utcTimeMillis"],
        ..case("a sensor", "Android GNSS log", text)
    }
}
