//! Tracking data of satellites: CRD, TDM, Orekit.

use super::case::{Case, ROWS, case, iso, moment, other};

pub(crate) fn cases() -> Vec<Case> {
    [crd(), tdm(), orekit()].into_iter().flatten().collect()
}

fn crd() -> Vec<Case> {
    fn head(target: &str, hour: usize) -> String {
        format!(
            "h2 YARL       7090  5 13 3\nh3 {target}     9207002 5986    22195 0 1\nh4  1 2021  3  4 {hour} 0 0 2021  3  4 23 59 59  0 0 0 0 1 0 2 0\n\
             c0 0  532.000 std la1 mcp ti1\n60  std 4 1\n40 36000.0 0 std       -1       -1  -1.000   105320.0    -17.0   27.0  -1.000  -1.000   -1.0 2 2 0\n"
        )
    }
    let plain = |v: &dyn Fn(usize) -> String| {
        let rows = (0..ROWS).fold(String::new(), |text, i| {
            let second = 36_000 + 60 * i;
            text + &format!("20 {second}.001  983.{}0 301.40  24. 0\n", i % 9)
                + &format!(
                    "11 {second}.000000000000     {} std 2  120.0     94   57.{}   0.183  -0.5{}6      -1.0  15.{} 0\n",
                    v(i),
                    i % 9,
                    i % 7,
                    i % 8
                )
        });
        format!("h1 CRD  1 2021  3  4 14\n{}{rows}h8\nh9\n", head("lageos2", 10))
    };
    // Upper case, version 2, two targets, over midnight, `na`.
    let awkward = |v: &dyn Fn(usize) -> String| {
        let of = |target: &str, cell: &dyn Fn(usize) -> String| {
            let rows = (0..ROWS).fold(String::new(), |text, i| {
                let second = (86_390 + i) % 86_400;
                text + &format!("11 {second}.25 {} std 2 120.0 {} na na na na {:.1} 0 na\n", cell(i), 20 + i, other(i))
            });
            format!(
                "H2 YARL 7090 5 13 3 ILRS\nH3 {target} 9207002 5986 22195 0 1 1\nH4 1 2021 3 4 23 59 50 2021 3 5 0 10 0 0 0 0 0 1 0 2 0\n{rows}H8\n"
            )
        };
        let lower = |i: usize| format!("{:.3}", other(i));
        format!("H1 CRD 2 2021 3 4 14\n00 a comment of the station\n{}{}H9\n", of("lageos1", v), of("etalon1", &lower))
    };
    vec![
        Case {
            channel: "time_of_flight",
            unit: "s",
            asides: &["epoch_event", "detector"],
            missing: ("bin_peak_mean", ROWS),
            ..case("normal points", "CRD", plain)
        },
        Case {
            channel: "time_of_flight@lageos1",
            unit: "s",
            start: "2021-03-04 23:59:50.25",
            step: 1.0,
            missing: ("bin_rms", 2 * ROWS),
            windows: true,
            ..case("two targets over midnight", "CRD", awkward)
        },
    ]
}

fn orekit() -> Vec<Case> {
    let time = |i: usize| iso(i).replace(' ', "T");
    let plain = move |v: &dyn Fn(usize) -> String| {
        let rows = (0..ROWS)
            .fold(String::new(), |text, i| text + &format!("{}.3851   RANGE       Uralla  {}\n", time(i), v(i)));
        format!("# ranges of one station\n\n{rows}")
    };
    // Two stations, angles of one between the ranges of the other, a value beyond the ends of the kinds in a comment.
    let awkward = move |v: &dyn Fn(usize) -> String| {
        let rows = (0..ROWS).fold(String::new(), |text, i| {
            text + &format!("{} AZ_EL Kumsan {} {:.4}\n", time(i), v(i), 10.0 + other(i))
                + &format!("{}.5\tRANGE\tUralla\t{:.4}\n# {}\n", time(i), other(i), time(i))
        });
        format!("#\n# RANGE in km\n{rows}")
    };
    vec![
        Case { channel: "range", unit: "km", ..case("one station", "Orekit measurements", plain) },
        Case {
            channel: "azimuth@Kumsan",
            unit: "deg",
            missing: ("range", ROWS),
            windows: true,
            ..case("two stations, two kinds", "Orekit measurements", awkward)
        },
    ]
}

fn tdm() -> Vec<Case> {
    let plain = |v: &dyn Fn(usize) -> String| {
        let rows = (0..ROWS).fold(String::new(), |text, i| {
            let time = iso(i).replace(' ', "T");
            text + &format!("RANGE = {time} {}\nDOPPLER_INSTANTANEOUS = {time} -{:.4}\n", v(i), other(i))
        });
        format!(
            "CCSDS_TDM_VERS = 2.0\nCREATION_DATE = 2021-03-05T00:00:00\nORIGINATOR = US\n\nMETA_START\nTIME_SYSTEM = UTC\nPARTICIPANT_1 = DSS-25\n\
             PARTICIPANT_2 = SAT\nMODE = SEQUENTIAL\nPATH = 1,2,1\nRANGE_UNITS = km\nMETA_STOP\n\nDATA_START\nCOMMENT a note\n{rows}DATA_STOP\n"
        )
    };
    // Two stations, whose segments lie one after the other; days of the year; angles beside the range, of fewer epochs.
    let awkward = |v: &dyn Fn(usize) -> String| {
        let segment = |station: &str, rows: String| {
            format!(
                "META_START\nCOMMENT of {station}\nTIME_SYSTEM = TAI\nPARTICIPANT_1={station}\nPARTICIPANT_2  =  SAT\nPATH = 2,1\nMETA_STOP\nDATA_START\n{rows}DATA_STOP\n\n"
            )
        };
        let time = |i: usize| {
            let [y, _, d, h, m, s] = moment(60 * i);
            format!("{y}-{:03}T{h:02}:{m:02}:{s:02}.000", 59 + d)
        };
        let first = (0..ROWS).fold(String::new(), |text, i| text + &format!("RANGE\t= {}   {}\n", time(i), v(i)));
        let second = (0..ROWS).fold(String::new(), |text, i| {
            let angle = if i % 4 == 0 { format!("ANGLE_1 = {} {:.3}\n", time(i), other(i)) } else { String::new() };
            text + &format!("RANGE = {} {:.3}\n{angle}", time(i), other(i))
        });
        format!("CCSDS_TDM_VERS = 1.0\n{}{}", segment("DSS-63", first), segment("DSS-14", second))
    };
    vec![
        Case { channel: "RANGE", unit: "km", ..case("one station", "CCSDS TDM", plain) },
        Case {
            channel: "RANGE@DSS-63",
            unit: "km",
            missing: ("ANGLE_1", 70),
            windows: true,
            ..case("two stations", "CCSDS TDM", awkward)
        },
    ]
}
