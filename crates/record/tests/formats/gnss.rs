//! Positions of GNSS stations and receivers: PBO, tenv3, RTKLIB, NMEA, SP3.

use super::case::{Case, ROWS, case, moment, other, table};

pub(crate) fn cases() -> Vec<Case> {
    [pbo(), tenv3(), rtklib(), nmea(), sp3()].into_iter().flatten().collect()
}

const DAY: f64 = 86_400.0;

/// Month and day of days after 2021-03-01.
fn day(i: usize) -> [usize; 2] {
    [3 + i / 31, 1 + i % 31]
}

fn pbo() -> Vec<Case> {
    let csv = |v: &dyn Fn(usize) -> String| {
        table(
            "PBO Station Position Time Series.\nFormat Version, 1.2.0\nReference Frame, IGS14\n4-character ID, P123\nStation name, Brook\n\
             Begin Date, 2005-01-01\nEnd Date, 2021-05-01\nSource file, P123.pos\n\
             Date,North (mm),East (mm),Vertical (mm),North Std. Deviation (mm),East Std. Deviation (mm),Vertical Std. Deviation (mm),Quality,\n",
            |i| {
                let [m, d] = day(i);
                format!(
                    "2021-{m:02}-{d:02},{},{:.2},{:.2},1.{},1.{},4.{},final,",
                    v(i),
                    other(i),
                    -other(i),
                    i % 9,
                    i % 7,
                    i % 8
                )
            },
        )
    };
    let pos = |v: &dyn Fn(usize) -> String| {
        table(
            "PBO Station Position Time Series. Reference Frame : IGS14\nFormat Version: 1.1.0\n4-character ID: P123\nStation name  : Brook\n\
             First Epoch   : 20050101 120000\nStart Field Description\nYYYYMMDD      Year, month, day for the given position epoch\n\
             dU            Difference in vertical component, meters\nEnd Field Description\n\
             *YYYYMMDD HHMMSS JJJJJ.JJJJ         NLat         dN        dU      Sn     Rne  Soln\n",
            |i| {
                let [m, d] = day(i);
                format!(
                    " 2021{m:02}{d:02} 120000 {}.5000 {:14.10} {:9.5} {:>9} {:7.5} {:6.3} {}",
                    59_274 + i,
                    35.5 + i as f64 * 1e-9,
                    other(i) / 1e3,
                    v(i),
                    0.001 + (i % 7) as f64 * 1e-4,
                    (i % 9) as f64 / 100.0,
                    if i < 30 { "repro" } else { "rapid" }
                )
            },
        )
    };
    vec![
        Case {
            channel: "North (mm)",
            unit: "mm",
            start: "2021-03-01",
            step: DAY,
            asides: &["Quality"],
            ..case("CSV", "PBO", csv)
        },
        Case {
            channel: "dU",
            unit: "m",
            start: "2021-03-01 12:00:00",
            step: DAY,
            asides: &["JJJJJ.JJJJ", "Soln"],
            windows: true,
            ..case(".pos", "PBO", pos)
        },
    ]
}

fn tenv3() -> Vec<Case> {
    const NAMES: &str = "site YYMMMDD yyyy.yyyy __MJD week d reflon _e0(m) __east(m) ____n0(m) _north(m) u0(m) ____up(m) _ant(m) sig_e(m)";
    let row = |i: usize, v: String, jump: usize| {
        let [m, d] = day(i);
        format!(
            "00NA 21{}{d:02} {:.4} {} {} {}  130.8   {}  {:.6}  -1378706 -0.28{:04}   104 {v:>9}  0.0000 0.00{}",
            ["MAR", "APR"][m - 3],
            2021.1608 + i as f64 / 365.25,
            59_274 + i,
            2147 + (i + 1) / 7,
            (i + 1) % 7,
            4781 + jump,
            0.8 + other(i) / 1e4,
            6000 + i * i % 900,
            1100 + i % 9
        )
    };
    let plain = move |v: &dyn Fn(usize) -> String| table(&format!("{NAMES}\n"), |i| row(i, v(i), 0));
    // A day without a solution; the whole metre changes.
    let awkward =
        move |v: &dyn Fn(usize) -> String| table(&format!("{NAMES}\n"), |i| row(i, v(i), usize::from(i > 20)));
    let asides = &["site", "yyyy.yyyy", "__MJD", "week", "d", "reflon", "_e0(m)", "____n0(m)", "u0(m)"];
    vec![
        Case {
            channel: "____up(m)",
            unit: "m",
            start: "2021-03-01",
            step: DAY,
            asides,
            ..case("days", "tenv3", plain)
        },
        Case {
            channel: "____up(m)",
            unit: "m",
            start: "2021-03-01",
            step: DAY,
            asides,
            windows: true,
            ..case("a whole metre that changes", "tenv3", awkward)
        },
    ]
}

fn rtklib() -> Vec<Case> {
    let clock = |i: usize| {
        let [y, mo, d, h, m, s] = moment(i);
        format!("{y}/{mo:02}/{d:02} {h:02}:{m:02}:{s:02}.000")
    };
    let plain = move |v: &dyn Fn(usize) -> String| {
        table(
            "% program   : RTKPOST ver.2.4.3\n% inp file  : rover.obs\n% obs start : 2021/03/04 10:00:00.0 GPST (week2147 381600.0s)\n%\n\
             % (lat/lon/height=WGS84/ellipsoidal,Q=1:fix,2:float,3:sbas,4:dgps,5:single,6:ppp,ns=# of satellites)\n\
             %  GPST                  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m) age(s)  ratio\n",
            |i| {
                format!(
                    "{}   47.{:09}    8.{:09} {:>10} {:>3} {:>3} {:8.4} {:8.4} {:6.2} {:6.1}",
                    clock(i),
                    100 + i * i % 77,
                    200 + i * 3 % 55,
                    v(i),
                    1 + i % 2,
                    9 + i % 3,
                    0.01 + other(i) / 1e4,
                    0.02 + other(i) / 1e4,
                    i % 3,
                    50.0 + other(i)
                )
            },
        )
    };
    // Week and seconds of the week, which end in the middle; a baseline.
    let week = |v: &dyn Fn(usize) -> String| {
        table("% program   : RTKLIB\n%  GPST          e-baseline(m)  n-baseline(m)  u-baseline(m)   Q  ns\n", |i| {
            let second = 604_780 + i;
            format!(
                "{} {:>10}.000 {:>14} {:14.4} {:14.4} {:>3} {:>3}",
                2147 + second / 604_800,
                second % 604_800,
                v(i),
                other(i),
                -other(i),
                1,
                8
            )
        })
    };
    vec![
        Case {
            channel: "height(m)",
            unit: "m",
            step: 1.0,
            asides: &["Q", "ns"],
            ..case("calendar", "RTKLIB .pos", plain)
        },
        Case {
            channel: "e-baseline(m)",
            unit: "m",
            start: "2021-03-06 23:59:40",
            step: 1.0,
            asides: &["Q", "ns"],
            windows: true,
            ..case("GPS weeks that roll over", "RTKLIB .pos", week)
        },
    ]
}

/// A sentence with its checksum, as NMEA 0183 defines it.
fn sentence(body: &str) -> String {
    format!("${body}*{:02X}\n", body.bytes().fold(0_u8, |sum, byte| sum ^ byte))
}

fn nmea() -> Vec<Case> {
    let plain = |v: &dyn Fn(usize) -> String| {
        (0..ROWS).fold(String::new(), |text, i| {
            let [_, _, _, h, m, s] = moment(i);
            let clock = format!("{h:02}{m:02}{s:02}.00");
            let place = format!("4807.{:04},N,01131.{:04},E", 380 + i * 3, 5000 + i);
            text + &sentence(&format!("GNRMC,{clock},A,{place},0.0{},65.1{},040321,13.06,E,F", i % 9, i % 7))
                + &sentence(&format!("GNVTG,65.1{},T,52.07,M,0.02{},N,0.05{},K,D", i % 7, i % 9, i % 8))
                + &sentence(&format!("GNGGA,{clock},{place},1,{},0.9,{},M,46.9,M,,", 8 + i % 3, v(i)))
                + &sentence("GPGSA,A,3,17,02,06,28,12,13,15,24,19,,,,1.48,0.76,1.27")
                + &sentence(&format!("GNGST,{clock},1.{},,,,2.1,1.{},3.5", i % 9, i % 4))
        })
    };
    // South and west, over midnight, no fix for a while, a date in few sentences, comments, another order.
    let awkward = |v: &dyn Fn(usize) -> String| {
        (0..ROWS).fold("# a logger\n".to_owned(), |text, i| {
            let second = 86_380 + i;
            let clock = format!("{:02}{:02}{:02}", second / 3600 % 24, second / 60 % 60, second % 60);
            let day = 4 + second / 86_400;
            let place =
                if i == 11 { ",,,".to_owned() } else { format!("3725.58{:03},S,12205.61{:03},W", i * 5, i * 9) };
            let date =
                if i % 10 == 5 { sentence(&format!("GPZDA,{clock},{day:02},03,2021,00,00")) } else { String::new() };
            text + &sentence(&format!("GPGGA,{clock},{place},1,08,0.9,{},M,46.9,M,,", v(i)))
                + &date
                + &sentence(&format!("GPVTG,,T,,M,{:.2},N,{:.2},K", other(i), other(i) * 1.852))
        })
    };
    vec![
        Case {
            channel: "altitude",
            unit: "m",
            step: 1.0,
            asides: &["quality", "satellites"],
            ..case("five sentences an epoch", "NMEA 0183", plain)
        },
        Case {
            channel: "altitude",
            unit: "m",
            start: "2021-03-04 23:59:40",
            step: 1.0,
            missing: ("latitude", 1),
            windows: true,
            ..case("over midnight", "NMEA 0183", awkward)
        },
    ]
}

fn sp3() -> Vec<Case> {
    const HEAD: &str = "#cP2021  3  4 10  0  0.00000000      40 ORBIT IGS14 FIT  IGS\n## 2147 381600.00000000   900.00000000 59277 0.4166666666667\n\
                        +    2   G01G02  0  0  0  0  0  0  0  0  0  0  0  0  0  0  0\n++         2  2  0  0  0  0  0  0  0  0  0  0  0  0  0  0  0\n\
                        %c G  cc GPS ccc cccc cccc cccc cccc ccccc ccccc ccccc ccccc\n%f  1.2500000  1.025000000  0.00000000000  0.000000000000000\n\
                        /* a comment\n";
    fn epoch(i: usize, step: usize) -> String {
        let [y, mo, d, h, m, s] = moment(i * step);
        format!("*  {y} {mo:2} {d:2} {h:2} {m:2} {s:2}.00000000\n")
    }
    // The channel is the y of G02; all values have two decimals, that a repaired one can be told.
    let plain = |v: &dyn Fn(usize) -> String| {
        let rows = (0..ROWS).fold(HEAD.to_owned(), |text, i| {
            let clock = if i % 10 == 1 { 999_999.99 } else { 12.0 + other(i) };
            text + &epoch(i, 900)
                + &format!(
                    "PG01{:14.2}{:14.2}{:14.2}{clock:14.2}  7  8  6  95\n",
                    -15_000.0 - other(i),
                    20_000.0 + other(i),
                    -5_000.5
                )
                + &format!("PG02{:14.2}{:>14}{:14.2}{:14.2}\n", 11_000.0 + other(i), v(i), -7_000.25, 30.0 - other(i))
        });
        rows + "EOF\n"
    };
    let velocities = |v: &dyn Fn(usize) -> String| {
        let rows = (0..ROWS).fold(HEAD.replace("#cP", "#dV"), |text, i| {
            let position =
                if i == 5 { [0.0; 3] } else { [-15_000.0 - other(i), 20_000.0 + other(i), -5_000.5 + other(i)] };
            let [x, y, z] = position;
            text + &epoch(i, 300)
                + &format!("PL51{x:14.2}{y:14.2}{z:14.2}{:14.2}\nEP  55   55   55     222\n", 999_999.99)
                + &format!("VL51{:14.2}{:>14}{:14.2}{:14.2}\n", 100.0 * other(i), v(i), -other(i), 999_999.99)
        });
        rows + "EOF\n"
    };
    vec![
        Case {
            channel: "y@G02",
            unit: "km",
            step: 900.0,
            missing: ("clock", 4),
            asides: &["satellite", "x_sdev"],
            ..case("two satellites", "SP3", plain)
        },
        Case {
            channel: "vy@L51",
            unit: "dm/s",
            step: 300.0,
            missing: ("x", 1),
            windows: true,
            ..case("velocities", "SP3", velocities)
        },
    ]
}
