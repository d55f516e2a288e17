//! Services of weather, water and fluxes: RDB, KNMI, FLUXNET, EddyPro, WISKI, DINO, TMY3.

use super::case::{Case, case, iso, minute, other, table};

pub(crate) fn cases() -> Vec<Case> {
    [rdb(), knmi(), fluxnet(), eddypro(), wiski(), dino(), tmy3()].into_iter().flatten().collect()
}

const HOUR: f64 = 3600.0;
const DAY: f64 = 86_400.0;

/// Year, month, day and hour of hours after 2021-03-04 00:00.
fn hour(row: usize) -> [usize; 4] {
    [2021, 3, 4 + row / 24, row % 24]
}

fn rdb() -> Vec<Case> {
    let plain = |v: &dyn Fn(usize) -> String| {
        table(
            "# ---- WARNING ----\n# Some of the data that you have obtained may not have received approval.\n#\n\
             # Data provided for site 01646500\n#            TS   parameter     Description\n\
             #         69928       00060     Discharge, cubic feet per second\n\
             #         69930       00010     Temperature, water, degrees Celsius\n#\n\
             agency_cd\tsite_no\tdatetime\ttz_cd\t69928_00060\t69928_00060_cd\t69930_00010\t69930_00010_cd\n\
             5s\t15s\t20d\t6s\t14n\t10s\t14n\t10s\n",
            |i| format!("USGS\t01646500\t{}\tEST\t{}\tA\t{:.1}\tP", &iso(i)[..16], v(i), other(i)),
        )
    };
    let awkward = |v: &dyn Fn(usize) -> String| {
        table(
            "#\n#    01    00065    00003     Gage height, feet (Mean)\n#    02    00060    00003     Discharge, cubic feet per second (Mean)\n\
             agency_cd\tsite_no\tdatetime\t01_00065_00003\t01_00065_00003_cd\t02_00060_00003\t02_00060_00003_cd\n5s\t15s\t20d\t14n\t10s\t14n\t10s\n",
            |i| {
                let flow = ["Ice", "Eqp", "", "12.5"][i % 4];
                format!(
                    "USGS\t01646500\t2021-{:02}-{:02}\t{}\tA:e\t{flow}\t{}",
                    3 + i / 31,
                    1 + i % 31,
                    v(i),
                    if i % 2 == 0 { "P" } else { "A" }
                )
            },
        )
    };
    vec![
        Case {
            channel: "69928_00060",
            unit: "ft3/s",
            // Ten o'clock of `EST`.
            start: "2021-03-04 15:00",
            asides: &["site_no", "69928_00060_cd", "69930_00010_cd"],
            ..case("unit values", "USGS RDB", plain)
        },
        Case {
            channel: "01_00065_00003",
            unit: "ft",
            start: "2021-03-01",
            step: DAY,
            missing: ("02_00060_00003", 30),
            windows: true,
            ..case("daily values with remarks", "USGS RDB", awkward)
        },
    ]
}

fn knmi() -> Vec<Case> {
    let plain = |v: &dyn Fn(usize) -> String| {
        table(
            "# BRON: KONINKLIJK NEDERLANDS METEOROLOGISCH INSTITUUT (KNMI)\n# Opmerking: door stationsverplaatsingen zijn deze reeksen inhomogeen.\n\
             # STN      LON(east)   LAT(north)  ALT(m)      NAME\n# 260      5.180       52.100      1.90        De Bilt\n\
             # FH         : Hourly mean wind speed (in 0.1 m/s)\n# T          : Temperature (in 0.1 degrees Celsius) at 1.50 m at the time of observation\n\
             # U          : Relative atmospheric humidity (in percents)\n# WW         : Present weather code (00-99)\n\
             # STN,YYYYMMDD,   HH,   FH,    T,    U,   WW\n#\n",
            |i| {
                let [y, mo, d, h] = hour(i);
                format!("  260,{y}{mo:02}{d:02},{:>5},{:>5},{:>8},{:>5},{:>5}", h + 1, i * i % 90, v(i), 80 + i % 9, "")
            },
        )
    };
    let awkward = |v: &dyn Fn(usize) -> String| {
        table(
            "SOURCE OF DATA: ROYAL NETHERLANDS METEOROLOGICAL INSTITUTE (KNMI)\n\nYYYYMMDD = Date (YYYY=year MM=month DD=day)\n\
             TG       = Daily mean temperature in (0.1 degrees Celsius)\nRH = Daily precipitation amount (in 0.1 mm) (-1 for <0.05 mm)\n\n\
             STN,YYYYMMDD,   TG,   RH\n\n",
            |i| {
                format!(
                    "  310,2021{:02}{:02},{:>8},{:>5}",
                    3 + i / 31,
                    1 + i % 31,
                    v(i),
                    if i % 5 == 2 { "".into() } else { format!("{}", i * i % 50) }
                )
            },
        )
    };
    vec![
        Case {
            channel: "T",
            unit: "0.1 degC",
            start: "2021-03-04 01:00:00",
            step: HOUR,
            asides: &["STN", "WW"],
            ..case("hours from 1 to 24", "KNMI", plain)
        },
        Case {
            channel: "TG",
            start: "2021-03-01",
            step: DAY,
            missing: ("RH", 8),
            asides: &["STN"],
            windows: true,
            unit: "0.1 degC",
            ..case("days, blanks for missing values", "KNMI", awkward)
        },
    ]
}

fn fluxnet() -> Vec<Case> {
    let stamp = |i: usize| format!("20210304{:02}{:02}", i / 2, i % 2 * 30);
    let next = move |i: usize| stamp(i + 1);
    let plain = move |v: &dyn Fn(usize) -> String| {
        table("TIMESTAMP_START,TIMESTAMP_END,TA_F,TA_F_QC,SW_IN_F,NEE_VUT_REF,NEE_VUT_REF_QC,NIGHT\n", |i| {
            let sun = if i % 8 == 1 { "-9999".to_owned() } else { format!("{:.3}", other(i)) };
            format!("{},{},{},{},{sun},{:.4},{},{}", stamp(i), next(i), v(i), i % 3, -other(i), i % 4, i % 2)
        })
    };
    let awkward = |v: &dyn Fn(usize) -> String| {
        table("# Site: US-XYZ\n# Version: 5-5\nTIMESTAMP,P_F,VPD_F,VPD_F_QC,LE_F_MDS\n", |i| {
            format!(
                "2021{:02}{:02},{:.1},{},{:.3},-9999",
                3 + i / 31,
                1 + i % 31,
                other(i),
                v(i),
                (i % 10) as f64 / 10.0
            )
        })
    };
    vec![
        Case {
            channel: "TA_F",
            unit: "degC",
            start: "2021-03-04 00:00:00",
            step: 1800.0,
            asides: &["TIMESTAMP_END", "TA_F_QC", "NEE_VUT_REF_QC", "NIGHT"],
            missing: ("SW_IN_F", 5),
            ..case("half hours", "FLUXNET", plain)
        },
        Case {
            channel: "VPD_F",
            unit: "hPa",
            start: "2021-03-01",
            step: DAY,
            asides: &["VPD_F_QC"],
            missing: ("LE_F_MDS", 40),
            windows: true,
            ..case("days below comments, a column of nothing", "FLUXNET", awkward)
        },
    ]
}

fn eddypro() -> Vec<Case> {
    let names = "filename,date,time,DOY,daytime,file_records,Tau,qc_Tau,H,qc_H,co2_flux\n,[yyyy-mm-dd],[HH:MM],[ddd.ddd],[1=daytime],[#],[kg+1m-1s-2],[#],[W+1m-2],[#],[µmol+1s-1m-2]\n";
    let rows = |i: usize, v: String| {
        let [y, mo, d, h, m, _] = minute(i * 30);
        let flux = if i % 10 == 5 { "-9999".to_owned() } else { format!("{:.4}", other(i)) };
        format!(
            "{y}{mo:02}{d:02}-{h:02}{m:02}.ghg,{y}-{mo:02}-{d:02},{h:02}:{m:02},{:.3},1,{},-0.0{},{},{v},{},{flux}",
            63.4 + i as f64 / 48.0,
            18_000 - i % 5,
            11 + i,
            i % 3,
            (i + 1) % 3
        )
    };
    let full = move |v: &dyn Fn(usize) -> String| {
        table(&format!("file_info,,,,,,corrected_fluxes_and_quality_flags,,,,\n{names}"), |i| rows(i, v(i)))
    };
    let bare = move |v: &dyn Fn(usize) -> String| table(names, |i| rows(i, v(i)));
    let asides = &["DOY", "file_records", "qc_Tau", "qc_H"];
    vec![
        Case {
            channel: "H",
            unit: "W+1m-2",
            step: 1800.0,
            asides,
            missing: ("co2_flux", 4),
            ..case("groups above the names", "EddyPro", full)
        },
        Case {
            channel: "H",
            unit: "W+1m-2",
            step: 1800.0,
            asides,
            windows: true,
            ..case("no groups", "EddyPro", bare)
        },
    ]
}

fn wiski() -> Vec<Case> {
    let digits = |i: usize| {
        let [y, mo, d, h, m, s] = minute(15 * i);
        format!("{y}{mo:02}{d:02}{h:02}{m:02}{s:02}")
    };
    let zrxp = move |v: &dyn Fn(usize) -> String| {
        table(
            "#ZRXPVERSION2300.100|*|ZRXPCREATORKiIOSystem.ZRXPV2R2_E|*|\n#SANR2769510|*|SNAMEBrook|*|SWATERRhine|*|CNRW|*|CNAMEWaterlevel|*|\n\
             #TZUTC+1|*|CUNITcm|*|RINVAL-777|*|\n#LAYOUT(timestamp,value,status)|*|\n",
            |i| format!("{} {} {}", digits(i), v(i), 40 + i % 3),
        )
    };
    // A second series with the same times, and values that are not there.
    let two = move |v: &dyn Fn(usize) -> String| {
        let head = |number: &str, name: &str, unit: &str| {
            format!("## comment\n#REXCHANGE{number}|*|SNAMEBrook|*|CNAME{name}|*|CUNIT{unit}|*|RINVAL-999.0|*|\n")
        };
        let gauge = |i: usize| if i % 8 == 7 { "-999.0".to_owned() } else { format!("{:.1}", other(i)) };
        table(&head("1", "W", "m"), |i| format!("{} {}", digits(i), v(i)))
            + &table(&head("2", "N", "mm"), |i| format!("{} {}", digits(i), gauge(i)))
    };
    let service = |v: &dyn Fn(usize) -> String| {
        table(
            "#station_no;2769510\n#station_name;Brook\n#ts_id;123\n#ts_unitsymbol;m³/s\n#rows;40\n#Timestamp;Value;Quality Code\n",
            |i| format!("{}.000+01:00;{};{}", iso(i).replace(' ', "T"), v(i), [40, 80, 200][i % 3]),
        )
    };
    let awkward = |v: &dyn Fn(usize) -> String| {
        table("#ts_id\t9\n#rows\t40\n#Timestamp\tValue\tInterpolation Type\tQuality Code\n", |i| {
            format!("{}.000Z\t{}\t{}\t40", iso(i).replace(' ', "T"), v(i), 100 + i % 2)
        })
    };
    vec![
        Case {
            channel: "value",
            unit: "cm",
            step: 900.0,
            asides: &["status"],
            ..case("ZRXP with a layout", "WISKI (ZRXP)", zrxp)
        },
        Case {
            channel: "value@1/W",
            unit: "m",
            step: 900.0,
            missing: ("value", 5),
            windows: true,
            ..case("two series in one file", "WISKI (ZRXP)", two)
        },
        Case {
            channel: "Value",
            unit: "m³/s",
            start: "2021-03-04 09:00:00",
            asides: &["Quality Code"],
            ..case("the answer of a service", "WISKI (KiWIS CSV)", service)
        },
        Case {
            channel: "Value",
            asides: &["Quality Code", "Interpolation Type"],
            windows: true,
            ..case("tabs", "WISKI (KiWIS CSV)", awkward)
        },
    ]
}

fn dino() -> Vec<Case> {
    let day = |i: usize| format!("{:02}-{:02}-2021", 1 + i % 12, 1 + i / 12);
    let plain = move |v: &dyn Fn(usize) -> String| {
        let days = |i: usize| format!("{:02}-{:02}-2021", 1 + i % 28, 1 + i / 28);
        table(
            "Titel:,,,,,,,,,,,\nGebruikersnaam:,,,,,,,,,,,\nPeriode aangevraagd:,01-01-1800,tot:,04-03-2021,,,,,,,,\n,,,,,,,,,,,\n\
             Locatie,Filternummer,Externe aanduiding,X-coordinaat,Y-coordinaat,Maaiveld (cm t.o.v. NAP),Datum maaiveld gemeten,Startdatum,Einddatum\n\
             B33F0080,001,33FP80,206800,454700,1194,01-01-1990,14-10-1981,28-03-2011\n,,,,,,,,,,,\n\
             Locatie,Filternummer,Peildatum,Stand (cm t.o.v. MP),Stand (cm t.o.v. NAP),Bijzonderheid,Opmerking,,,\n",
            |i| format!("B33F0080,001,{},{},{:.0},,,,,", days(i), v(i), 1000.0 + other(i) * 10.0),
        )
    };
    let awkward = move |v: &dyn Fn(usize) -> String| {
        // No day is later than the twelfth: only the format tells that it stands first.
        table("\"Locatie\",\"Filternummer\",\"Peildatum\",\"Stand (cm t.o.v. NAP)\",\"Opmerking\"\n", |i| {
            format!("\"B33F0080\",\"002\",\"{}\",{},\"{}\"", day(i), v(i), if i == 3 { "droog, leeg" } else { "" })
        })
    };
    vec![
        Case {
            channel: "Stand (cm t.o.v. MP)",
            unit: "cm",
            start: "2021-01-01",
            step: DAY,
            asides: &["Filternummer", "Locatie"],
            ..case("two tables", "DINO", plain)
        },
        Case {
            channel: "Stand (cm t.o.v. NAP)",
            unit: "cm",
            start: "2021-01-01",
            step: DAY,
            asides: &["Filternummer"],
            windows: true,
            ..case("quotes, early days of the month", "DINO", awkward)
        },
    ]
}

fn tmy3() -> Vec<Case> {
    const HEAD: &str = "723815,\"DAGGETT BARSTOW-DAGGETT AP\",CA,-8.0,34.850,-116.800,588\n";
    const NAMES: &str =
        "Date (MM/DD/YYYY),Time (HH:MM),GHI (W/m^2),GHI source,GHI uncert (%),Dry-bulb (C),Dry-bulb source\n";
    let row = |i: usize, year: usize, month: usize, v: String| {
        let sun = if i % 10 == 9 { "-9900".to_owned() } else { format!("{}", i * i % 700) };
        format!("{month:02}/{:02}/{year},{:02}:00,{sun},{},{},{v},A", 30 + i / 24, 1 + i % 24, 1 + i % 2, 8 + i % 3)
    };
    let plain = move |v: &dyn Fn(usize) -> String| table(&format!("{HEAD}{NAMES}"), |i| row(i, 1988, 1, v(i)));
    // January is of 2001, February of 1997; the names stand in another order.
    let typical = |v: &dyn Fn(usize) -> String| {
        let names = "Date (MM/DD/YYYY),Time (HH:MM),Wspd (m/s),Wspd source,GHI (W/m^2)\n";
        table(&format!("{HEAD}{names}"), |i| {
            let (month, day, year) = if i < 24 { (1, 31, 2001) } else { (2, 1, 1997) };
            format!(
                "{month:02}/{day:02}/{year},{:02}:00,{},A,{}",
                1 + i % 24,
                v(i),
                if i < 4 { -9900 } else { 10 + i as i32 }
            )
        })
    };
    vec![
        Case {
            channel: "Dry-bulb (C)",
            unit: "C",
            start: "1988-01-30 01:00:00",
            step: HOUR,
            asides: &["GHI source", "GHI uncert (%)", "Dry-bulb source"],
            missing: ("GHI (W/m^2)", 4),
            ..case("one year", "TMY3", plain)
        },
        Case {
            channel: "Wspd (m/s)",
            unit: "m/s",
            start: "2001-01-31 01:00:00",
            step: HOUR,
            missing: ("GHI (W/m^2)", 4),
            windows: true,
            ..case("months of two years", "TMY3", typical)
        },
    ]
}
