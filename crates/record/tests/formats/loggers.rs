//! Loggers of weather and water: TOA5, HOBO, Solinst, Diver, EXO, LVM.

use super::case::{Case, case, iso, minute, other, table};

pub(crate) fn cases() -> Vec<Case> {
    [toa5(), hobo(), solinst(), diver(), exo(), lvm()].into_iter().flatten().collect()
}

fn toa5() -> Vec<Case> {
    let plain = |v: &dyn Fn(usize) -> String| {
        table(
            "\"TOA5\",\"Mast\",\"CR1000\",\"1234\",\"CR1000.Std.32\",\"CPU:mast.CR1\",\"5678\",\"Table1\"\n\
             \"TIMESTAMP\",\"RECORD\",\"batt_volt_Min\",\"AirTC_Avg\"\n\"TS\",\"RN\",\"Volts\",\"Deg C\"\n\"\",\"\",\"Min\",\"Avg\"\n",
            |i| format!("\"{}\",{},{:.2},{}", iso(i), 500 + i, if i % 2 == 0 { 12.6 } else { 12.5 }, v(i)),
        )
    };
    let awkward = |v: &dyn Fn(usize) -> String| {
        table(
            "\"TOA5\",\"A, B\",\"CR3000\",\"1\",\"x\",\"CPU:p.CR3\",\"2\",\"Hourly\"\n\
             \"TIMESTAMP\",\"RECORD\",\"WS_ms_S_WVT\",\"SlrkW\",\"Status\"\n\"TS\",\"RN\",\"meters/second\",\"kW/m^2\",\"\"\n\
             \"\",\"\",\"WVc\",\"Avg\",\"Smp\"\n",
            |i| {
                let sun = if i % 9 == 4 { "\"NAN\"".to_owned() } else { format!("{:.3}", other(i)) };
                format!("\"{}\",{},{},{sun},\"ok\"", iso(i), i, v(i))
            },
        )
    };
    let old = |v: &dyn Fn(usize) -> String| {
        table("\"TOACI1\",\"CR10X\",\"Table1\"\n\"TMSTAMP\",\"RECNBR\",\"Level\"\n", |i| {
            format!("\"{}\",{i},{}", iso(i), v(i))
        })
    };
    vec![
        Case { channel: "AirTC_Avg", unit: "Deg C", asides: &["RECORD"], ..case("four header lines", "TOA5", plain) },
        Case {
            channel: "WS_ms_S_WVT",
            unit: "meters/second",
            asides: &["RECORD", "Status"],
            missing: ("SlrkW", 4),
            windows: true,
            ..case("NAN in quotes, Windows", "TOA5", awkward)
        },
        Case { channel: "Level", ..case("TOACI1", "TOA5", old) },
    ]
}

fn hobo() -> Vec<Case> {
    let clock = |i: usize| {
        let [y, mo, d, h, m, s] = minute(i);
        format!(
            "{mo:02}/{d:02}/{:02} {:02}:{m:02}:{s:02} {}",
            y % 100,
            (h + 11) % 12 + 1,
            if h < 12 { "AM" } else { "PM" }
        )
    };
    let plain = move |v: &dyn Fn(usize) -> String| {
        table(
            "\u{feff}\"Plot Title: 10056829\"\n\"#\",\"Date Time, GMT-05:00\",\"Temp, °F (LGR S/N: 10056829, SEN S/N: 10056829)\",\
             \"Intensity, Lux (LGR S/N: 10056829, SEN S/N: 10056829)\",\"Coupler Detached (LGR S/N: 10056829)\"\n",
            |i| format!("{},{},{},{:.1},{}", i + 1, clock(i), v(i), other(i), if i == 0 { "Logged" } else { "" }),
        )
    };
    let awkward = move |v: &dyn Fn(usize) -> String| {
        // The last line notes the end and has no values.
        table(
            "Plot Title: Bach\n#\tDate Time, GMT+01:00\tAbs Pres, kPa (LGR S/N: 1)\tTemp, °C (LGR S/N: 1)\tEnd Of File (LGR S/N: 1)\n",
            |i| format!("{}\t{}\t{}\t{:.3}\t", i + 1, clock(i), v(i), other(i)),
        ) + "41\t03/04/21 10:40:00 AM\t\t\tLogged\n"
    };
    vec![
        Case {
            channel: "Temp, °F (LGR S/N: 10056829, SEN S/N: 10056829)",
            unit: "°F",
            // Clocks five hours behind UTC.
            start: "2021-03-04 15:00:00",
            asides: &["#", "Coupler Detached (LGR S/N: 10056829)"],
            ..case("a byte order mark", "HOBO", plain)
        },
        Case {
            channel: "Abs Pres, kPa (LGR S/N: 1)",
            unit: "kPa",
            start: "2021-03-04 09:00:00",
            asides: &["column_1", "End Of File (LGR S/N: 1)"],
            windows: true,
            latin1: true,
            ..case("tabs, Latin-1, a last line of notes", "HOBO", awkward)
        },
    ]
}

fn solinst() -> Vec<Case> {
    let day = |i: usize| {
        let [y, mo, d, h, m, s] = minute(i);
        (format!("{y}/{mo:02}/{d:02}"), format!("{h:02}:{m:02}:{s:02}"))
    };
    let plain = move |v: &dyn Fn(usize) -> String| {
        table(
            "Serial_number:\n2038372\nProject ID:\nBrook\nLocation:\nWeir\nLEVEL\nUNIT: m\nOffset: 0.000000 m\nTEMPERATURE\nUNIT: °C\n\
             Date,Time,ms,LEVEL,TEMPERATURE\n",
            |i| format!("{},{},0,{},{:.3}", day(i).0, day(i).1, v(i), other(i)),
        )
    };
    let awkward = move |v: &dyn Fn(usize) -> String| {
        table(
            "Serial_number:;;;\n1;;;\nProject ID:;;;\n;;;\nLocation:;;;\n;;;\nLEVEL;;;\nUNIT: kPa;;;\nTEMPERATURE;;;\nUNIT: Deg C;;;\n\
             Date;Time;ms;LEVEL;TEMPERATURE\n",
            |i| format!("{};{};0;{};{}", day(i).0, day(i).1, v(i), format!("{:.3}", other(i)).replace('.', ",")),
        )
    };
    vec![
        Case { channel: "LEVEL", unit: "m", asides: &["ms"], ..case("level and temperature", "Solinst", plain) },
        Case {
            channel: "LEVEL",
            unit: "kPa",
            asides: &["ms"],
            written: "123,46",
            windows: true,
            ..case("decimal commas", "Solinst", awkward)
        },
    ]
}

fn diver() -> Vec<Case> {
    let head = |ids: [&str; 2], units: [&str; 2]| {
        format!(
            "Data file for DataLogger.\n==========\nCOMPANY    :\nLOCATION   : P12\nDATE       : 05/11/2021\nTIME       : 10:39:24\n\n\
             [Logger settings]\n  Instrument type          =Diver=15\n  Serial number            =..00-H3163  208.\n  \
             Number of channels       =2\n\n[Channel 1]\n  Identification           ={}\n  Reference level          =50.00  {}\n  \
             Range                    =2500.00  {}\n\n[Channel 2]\n  Identification           ={}\n  Reference level          =-20.00  {}\n\n\
             [Series settings]\n  Sample period            =M01\n\n[Channel 1 from data header]\n  Identification           ={}\n\n[Data]\n",
            ids[0], units[0], units[0], ids[1], units[1], ids[0]
        )
    };
    let stamp = |i: usize| {
        let [y, mo, d, h, m, s] = minute(i);
        format!("{y}/{mo:02}/{d:02} {h:02}:{m:02}:{s:02}.0")
    };
    let plain = move |v: &dyn Fn(usize) -> String| {
        let head = head(["PRESSURE", "TEMPERATURE"], ["cmH2O", "°C"]) + "40\n";
        table(&head, |i| format!("{}     {:>8}    {:>6.3}", stamp(i), v(i), other(i)))
            + "END OF DATA FILE OF DATALOGGER FOR WINDOWS\n"
    };
    let awkward = move |v: &dyn Fn(usize) -> String| {
        let head = head(["DRUK", "TEMPERATUUR"], ["mH2O", "°C"]);
        table(&head, |i| format!("{}     {:>8}    {}", stamp(i), v(i), format!("{:>6.3}", other(i)).replace('.', ",")))
    };
    let swapped = move |v: &dyn Fn(usize) -> String| {
        table(&head(["DRUK", "TEMPERATUUR"], ["mH2O", "°C"]), |i| {
            format!("{}     {:>8.3}    {:>8}", stamp(i), other(i), v(i))
        })
    };
    vec![
        Case { channel: "PRESSURE", unit: "cmH2O", ..case("counted rows", "Van Essen Diver (MON)", plain) },
        Case {
            channel: "TEMPERATUUR",
            unit: "°C",
            latin1: true,
            ..case("a degree sign in Latin-1", "Van Essen Diver (MON)", swapped)
        },
        Case {
            channel: "DRUK",
            unit: "mH2O",
            written: "123,46",
            latin1: true,
            windows: true,
            ..case("decimal commas, no count", "Van Essen Diver (MON)", awkward)
        },
    ]
}

fn exo() -> Vec<Case> {
    let plain = |v: &dyn Fn(usize) -> String| {
        table(
            "KOR Export File,\n,\nFILE CREATED:,3/4/2021\nMEAN VALUE:,,,,,100.1,9.2\nSTANDARD DEVIATION:,,,,,1.0,0.1\n\
             SENSOR SERIAL NUMBER:,,,,,18K1,18K2\n\
             Date (MM/DD/YYYY),Time (HH:mm:ss),Time (Fract. Sec),Site Name,Fault Code,SpCond µS/cm,ODO % sat\n",
            |i| {
                let [y, mo, d, h, m, s] = minute(i);
                format!("{mo}/{d}/{y},{h:02}:{m:02}:{s:02},0,Weir,0,{},{:.1}", v(i), other(i))
            },
        )
    };
    let awkward = |v: &dyn Fn(usize) -> String| {
        table("Date (DD/MM/YYYY);Time (HH:mm:ss);Time (Fract. Sec);Site Name;Temp °C;Turbidity FNU;pH\n", |i| {
            let [y, mo, d, h, m, s] = minute(i);
            let turbidity = if i % 10 == 3 { String::new() } else { format!("{:.2}", other(i)) };
            format!("{d:02}/{mo:02}/{y};{h:02}:{m:02}:{s:02};0.5;;{};{turbidity};7.{}", v(i), i % 7)
        })
    };
    vec![
        Case {
            channel: "SpCond µS/cm",
            unit: "µS/cm",
            asides: &["Time (Fract. Sec)", "Fault Code", "Site Name"],
            ..case("statistics above the names", "YSI EXO", plain)
        },
        Case {
            channel: "Temp °C",
            unit: "°C",
            asides: &["Time (Fract. Sec)"],
            missing: ("Turbidity FNU", 4),
            windows: true,
            ..case("day first, missing values", "YSI EXO", awkward)
        },
    ]
}

fn lvm() -> Vec<Case> {
    const FILE: &str = "LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\n\
                        Multi_Headings\tYes\nX_Columns\tOne\nTime_Pref\tAbsolute\nDate\t2021/03/04\nTime\t10:00:00\n***End_of_Header***\t\n\t\n";
    fn segment(time: &str) -> String {
        format!(
            "Channels\t2\t\t\nSamples\t20\t20\t\nDate\t2021/03/04\t2021/03/04\t\nTime\t{time}\t{time}\t\nY_Unit_Label\tVolts\tAmps\t\n\
             X_Dimension\tTime\tTime\t\nX0\t0.0000000000000000E+0\t0.0000000000000000E+0\t\nDelta_X\t0.010000\t0.010000\t\n\
             ***End_of_Header***\t\t\t\nX_Value\tVoltage\tCurrent\tComment\n"
        )
    }
    let plain = |v: &dyn Fn(usize) -> String| {
        table(&(FILE.to_owned() + &segment("10:00:00")), |i| {
            format!("{:.6}\t{}\t{:.3}", i as f64 * 0.01, v(i), other(i))
        })
    };
    // Two segments that each begin at 0, a minute apart but for 20 samples of the first.
    let segments = |v: &dyn Fn(usize) -> String| {
        let part = |from: usize| {
            (from..from + 20).fold(String::new(), |t, i| t + &format!("{}\t{}\t{:.3}\n", i - from, v(i), other(i)))
        };
        let (first, second) = (segment("10:00:00.0000000000000000000"), segment("10:00:20.0000000000000000000"));
        FILE.to_owned() + &first + &part(0) + "\n" + &second + &part(20)
    };
    let told = |v: &dyn Fn(usize) -> String| {
        let head = (FILE.to_owned() + &segment("10:00:00")).replace("X_Columns\tOne", "X_Columns\tNo");
        let head = head.replace("Decimal_Separator\t.", "Decimal_Separator\t,").replace("0.010000", "0,010000");
        table(&head, |i| format!("\t{}\t{}", v(i), format!("{:.3}", other(i)).replace('.', ",")))
    };
    vec![
        Case { channel: "Voltage", unit: "Volts", start: "0", step: 0.01, ..case("one segment", "LabVIEW LVM", plain) },
        Case { channel: "Voltage", unit: "Volts", step: 1.0, ..case("two segments", "LabVIEW LVM", segments) },
        Case {
            channel: "Voltage",
            unit: "Volts",
            start: "0",
            step: 0.01,
            written: "123,46",
            windows: true,
            ..case("no column of times, decimal commas", "LabVIEW LVM", told)
        },
    ]
}
