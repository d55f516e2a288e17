//! Logs of aircraft: Betaflight, ArduPilot, Mission Planner.

use super::case::{Case, ROWS, case, iso, other, table};

pub(crate) fn cases() -> Vec<Case> {
    [betaflight(), ardupilot(), tlog()].into_iter().flatten().collect()
}

fn betaflight() -> Vec<Case> {
    let decoded = |v: &dyn Fn(usize) -> String| {
        table(
            "loopIteration, time (us), axisP[0], gyroADC[0] (deg/s), vbatLatest (V), flightModeFlags (flags), failsafePhase (flags)\n",
            |i| {
                format!(
                    "{}, {}, {:>5}, {:>8}, {:.3}, ANGLE_MODE, IDLE",
                    32 * i,
                    15_000_000 + 500 * i,
                    i * i % 90,
                    v(i),
                    other(i)
                )
            },
        )
    };
    let explorer = |v: &dyn Fn(usize) -> String| {
        table(
            "\"Product\",\"Blackbox flight data recorder by Nicholas Sherlock\"\n\"firmwareType\",\"Cleanflight\"\n\"rates\",\"100,100,100\"\n\
             \"loopIteration\",\"time\",\"gyroADC[0]\",\"motor[0]\",\"stateFlags\"\n",
            |i| format!("{},{},{},{},{}", i, 15_000_000 + 500 * i, v(i), 1000 + i * i % 900, i % 2),
        )
    };
    vec![
        Case {
            channel: "gyroADC[0] (deg/s)",
            unit: "deg/s",
            start: "",
            step: 5e-4,
            asides: &["loopIteration", "flightModeFlags (flags)"],
            ..case("blackbox_decode", "Betaflight blackbox", decoded)
        },
        Case {
            channel: "gyroADC[0]",
            start: "",
            step: 5e-4,
            asides: &["loopIteration", "stateFlags"],
            windows: true,
            ..case("Blackbox Explorer", "Betaflight blackbox", explorer)
        },
    ]
}

fn ardupilot() -> Vec<Case> {
    const HEAD: &str = "FMT, 128, 89, FMT, BBnNZ, Type,Length,Name,Format,Columns\nFMT, 129, 31, PARM, QNff, TimeUS,Name,Value,Default\n\
                        FMT, 130, 50, GPS, QBBIHBcLLeffffB, TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,Yaw,U\n\
                        FMT, 131, 45, BARO, QBffcf, TimeUS,I,Alt,Press,Temp,CRt\n\
                        FMT, 132, 44, UNIT, QbZ, TimeUS,Id,Label\nFMT, 133, 44, FMTU, QBNN, TimeUS,FmtType,UnitIds,MultIds\n\
                        UNIT, 100, 115, s\nUNIT, 100, 109, m\nUNIT, 100, 80, Pa\nUNIT, 100, 79, degC\nUNIT, 100, 110, m/s\n\
                        FMTU, 101, 131, s#mPOn, F-00B0\n";
    let gps = |i: usize| {
        format!(
            "GPS, {}, 0, 3, {}, 2147, 1{}, 0.8, -35.36{:05}, 149.16{:05}, 584.{}, 1.2, 3.{}, 0.1, 0, 1\n",
            1_000_000 + 200_000 * i,
            381_600_000 + 200 * i,
            i % 4,
            i * i % 999,
            i * 7 % 999,
            10 + i,
            i % 9
        )
    };
    let plain = move |v: &dyn Fn(usize) -> String| {
        (0..ROWS).fold(HEAD.to_owned(), |text, i| {
            let gps = if i % 2 == 0 { gps(i) } else { String::new() };
            text + &format!("PARM, {}, P{i}, {i}, 0\n", 500 + i)
                + &format!(
                    "BARO, {}, 0, {}, 945{:02}.5, 30.{}, 0.0{}\n",
                    1_000_000 + 100_000 * i,
                    v(i),
                    i % 90,
                    i % 9,
                    i % 7
                )
                + &gps
        })
    };
    // Two instances; the table of another message is wanted too.
    let two = move |v: &dyn Fn(usize) -> String| {
        (0..ROWS).fold(HEAD.to_owned(), |text, i| {
            let baro = |instance: usize, cell: String| {
                format!(
                    "BARO, {}, {instance}, {cell}, 945{:02}.5, 30.{}, 0.0{}\n",
                    1_000_000 + 100_000 * i,
                    i % 90,
                    i % 9,
                    i % 7
                )
            };
            text + &gps(i) + &baro(0, format!("{:.3}", other(i))) + &baro(1, v(i))
        })
    };
    let chosen = move |v: &dyn Fn(usize) -> String| {
        (0..ROWS).fold(HEAD.to_owned(), |text, i| {
            let baro = |t: usize| format!("BARO, {t}, 0, 1.{}, 94500.5, 30.1, 0.01\n", i % 9);
            text + &baro(10 * i) + &gps(i).replacen(&format!("584.{}", 10 + i), &v(i), 1) + &baro(10 * i + 5)
        })
    };
    vec![
        Case {
            channel: "Alt",
            unit: "m",
            start: "",
            step: 0.1,
            asides: &["I"],
            ..case("the longest table", "ArduPilot log (text)", plain)
        },
        Case {
            channel: "Alt@1",
            unit: "m",
            start: "",
            step: 0.1,
            windows: true,
            ..case("two instances", "ArduPilot log (text)", two)
        },
        Case {
            channel: "Alt",
            start: "",
            step: 0.2,
            asides: &["Status", "GMS", "GWk", "NSats", "U"],
            table: Some(2),
            ..case("another table", "ArduPilot log (text)", chosen)
        },
    ]
}

fn tlog() -> Vec<Case> {
    let time = |i: usize| format!("{}.123", iso(i).replace(' ', "T"));
    let attitude = move |i: usize, system: &str| {
        format!(
            "{},FE,1C,{i:02X},{system},1,1E,mavlink_attitude_t,time_boot_ms,{},roll,0.0{},pitch,-0.0{},Len,36\n",
            time(i),
            60_000 * i,
            10 + i % 50,
            10 + i * 7 % 50
        )
    };
    let plain = move |v: &dyn Fn(usize) -> String| {
        (0..ROWS).fold(String::new(), |text, i| {
            let attitude = if i % 3 == 0 { attitude(i, "1") } else { String::new() };
            text + &attitude
                + &format!("{},FE,14,{i:02X},1,1,4A,mavlink_vfr_hud_t,airspeed,0.5,groundspeed,1.{},alt,{},climb,0,heading,10,throttle,0,Len,28\n", time(i), i % 9, v(i))
        })
    };
    // Between blanks; a list of values; another system sends the same message.
    let awkward = move |v: &dyn Fn(usize) -> String| {
        (0..ROWS).fold(String::new(), |text, i| {
            let line = |system: &str, cell: String| {
                format!("{} FD 14 {i:02X} {system} 1 4A mavlink_battery_status_t current_battery {cell} voltages 41{:02} 65535 65535 temperature NaN Len 28\n", time(i), i % 90)
            };
            text + &line("1", v(i)) + &line("2", format!("{:.3}", other(i)))
        })
    };
    vec![
        Case {
            channel: "alt",
            start: "2021-03-04 10:00:00.123",
            ..case("CSV", "Mission Planner telemetry (text)", plain)
        },
        Case {
            channel: "current_battery@1",
            start: "2021-03-04 10:00:00.123",
            missing: ("temperature", 2 * ROWS),
            windows: true,
            ..case("two systems, a list", "Mission Planner telemetry (text)", awkward)
        },
    ]
}
