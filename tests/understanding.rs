//! Files of the kinds that analysts have are understood without an option, and what is assumed is said.

use std::fmt::Write as _;

use wildpoint::track::{Aside, ColumnKind, LoadOptions, Source, Track, load};

/// What must be understood of a file of [`ROWS`] rows.
struct Kind {
    name: &'static str,
    text: String,
    /// How the label of the first time begins; empty where the file tells none.
    start: &'static str,
    /// Seconds between two rows.
    step: f64,
    /// A column that is a channel.
    channel: &'static str,
}

const ROWS: usize = 60;

/// A smooth curve with a little noise, the same in every run.
fn value(row: usize) -> f64 {
    let noise = (row * 7919 % 101) as f64 / 500.0;
    100.0 + 10.0 * (row as f64 / 9.0).sin() + noise
}

/// 2021-03-04 10:00:00 UTC and `seconds` more, as year, month, day, hour, minute, second.
fn moment(seconds: usize) -> [usize; 6] {
    let all = 10 * 3600 + seconds;
    [2021, 3, 4 + all / 86_400, all / 3600 % 24, all / 60 % 60, all % 60]
}

/// A file with `head` above rows of a time and a value.
fn rows(head: &str, row: impl Fn(usize) -> String) -> String {
    let mut text = head.to_owned();
    (0..ROWS).for_each(|i| {
        let _ = writeln!(text, "{}", row(i));
    });
    text
}

/// The rows of a file whose times are written by `time`, a minute apart.
fn minutes(head: &str, delimiter: char, time: impl Fn([usize; 6]) -> String) -> String {
    rows(head, |i| format!("{}{delimiter}{:.2}", time(moment(60 * i)), value(i)))
}

fn kind(name: &'static str, start: &'static str, step: f64, channel: &'static str, text: String) -> Kind {
    Kind { name, text, start, step, channel }
}

const START: &str = "2021-03-04 10:00:00";

fn spellings() -> Vec<Kind> {
    vec![
        kind(
            "month by name",
            START,
            60.0,
            "Wert",
            minutes("Datum;Wert\n", ';', |[y, _, d, h, m, s]| format!("{d:02}-Mar-{y} {h:02}:{m:02}:{s:02}")),
        ),
        kind(
            "day of the year",
            START,
            60.0,
            "v",
            minutes("epoch,v\n", ',', |[y, _, d, h, m, _]| format!("{y}-{:03}T{h:02}:{m:02}:00", 59 + d)),
        ),
        kind(
            "colons all along",
            START,
            60.0,
            "v",
            minutes("irig,v\n", ',', |[y, _, d, h, m, _]| format!("{y}:{:03}:{h:02}:{m:02}:00.000", 59 + d)),
        ),
        kind(
            "AM and PM with a zone",
            "2021-03-04 15:00:00",
            60.0,
            "v",
            minutes("Time,v\n", ',', |[y, mo, d, h, m, _]| {
                format!("{mo:02}/{d:02}/{y} {:02}:{m:02} {} EST", (h + 11) % 12 + 1, if h < 12 { "AM" } else { "PM" })
            }),
        ),
        kind(
            "digits",
            START,
            60.0,
            "v",
            minutes("stamp;v\n", ';', |[y, mo, d, h, m, s]| format!("{y}{mo:02}{d:02}{h:02}{m:02}{s:02}")),
        ),
        kind(
            "points under a name that says nothing",
            START,
            60.0,
            "v",
            minutes("wann;v\n", ';', |[y, mo, d, h, m, _]| format!("{d:02}.{mo:02}.{y} {h:02}:{m:02}")),
        ),
        kind(
            "order by the steps",
            "2021-02-01 00:00:00",
            86_400.0,
            "v",
            rows("t,v\n", |i| format!("{}/{}/21,{:.2}", 2 + i / 28, 1 + i % 28, value(i)))
                .lines()
                .take(29)
                .map(|l| format!("{l}\n"))
                .collect(),
        ),
        kind(
            "a zone behind the clock",
            "2021-03-04 09:00:00",
            60.0,
            "v",
            minutes("time,v\n", ',', |[y, mo, d, h, m, _]| format!("{y}-{mo:02}-{d:02} {h:02}:{m:02}:00 CET")),
        ),
        kind(
            "days of a spreadsheet",
            START,
            600.0,
            "v",
            rows("Date,v\n", |i| format!("{:.9},{:.2}", 44_259.0 + 10.0 / 24.0 + i as f64 / 144.0, value(i))),
        ),
        kind(
            "modified Julian days",
            "2021-03-04 12:00:00",
            86_400.0,
            "v",
            rows("MJD,v\n", |i| format!("{}.5,{:.2}", 59_277 + i, value(i))),
        ),
        kind(
            "GPS seconds",
            "2021-03-04 10:00:00",
            1.0,
            "v",
            rows("gps_time,v\n", |i| format!("{},{:.2}", 1_298_887_200 + i, value(i))),
        ),
        kind(
            "hours beyond 24",
            "98:00:00",
            60.0,
            "v",
            rows("Elapsed;v\n", |i| format!("{}:{:02}:00;{:.2}", 98 + i / 60, i % 60, value(i))),
        ),
        kind(
            "minutes and seconds over an hour",
            "00:59:30",
            1.0,
            "v",
            rows("t,v\n", |i| format!("{:02}:{:02}.0,{:.2}", (3570 + i) / 60 % 60, (3570 + i) % 60, value(i))),
        ),
        kind(
            "a counter of 32 bits that begins again",
            "4294964296",
            0.1,
            "v",
            rows("millis,v\n", |i| format!("{},{:.2}", (4_294_964_296_u64 + 100 * i as u64) % 4_294_967_296, value(i))),
        ),
    ]
}

fn columns() -> Vec<Kind> {
    vec![
        kind(
            "year, month, day, hour, minute",
            START,
            60.0,
            "v",
            minutes("year,month,day,hour,minute,v\n", ',', |[y, mo, d, h, m, _]| format!("{y},{mo},{d},{h},{m}")),
        ),
        kind(
            "parts without names",
            START,
            60.0,
            "column_6",
            minutes("", ' ', |[y, mo, d, h, m, _]| format!("{y} {mo:02} {d:02} {h:02} {m:02}")),
        ),
        kind(
            "date and time as digits",
            START,
            60.0,
            "v",
            minutes("date,time,v\n", ',', |[y, mo, d, h, m, s]| format!("{y}{mo:02}{d:02},{h:02}{m:02}{s:02}")),
        ),
        kind(
            "hours from 1 to 24 beside a date",
            "2021-03-04 01:00:00",
            3600.0,
            "v",
            rows("STN,YYYYMMDD,HH,v\n", |i| format!("240,202103{:02},{},{:.2}", 4 + i / 24, 1 + i % 24, value(i))),
        ),
        kind(
            "seconds and nanoseconds",
            START,
            0.1,
            "v",
            rows("header.stamp.secs,header.stamp.nsecs,v\n", |i| {
                format!("{},{},{:.2}", 1_614_852_000 + i / 10, i % 10 * 100_000_000, value(i))
            }),
        ),
        kind(
            "week and seconds of the week",
            "2021-03-06 23:59:30",
            1.0,
            "v",
            rows("GPS Week;iTOW(ms);v\n", |i| {
                format!("{};{};{:.2}", 2147 + (604_770 + i) / 604_800, (604_770 + i) % 604_800 * 1000, value(i))
            }),
        ),
        kind(
            "day of the year and seconds of the day",
            START,
            60.0,
            "v",
            rows("year doy sod v\n", |i| format!("2021 63 {} {:.2}", 36_000 + 60 * i, value(i))),
        ),
        kind(
            "the finer of two stamps",
            "0",
            0.1,
            "v",
            rows("utc,ms,v\n", |i| format!("2021-03-04 10:00:{:02},{},{:.2}", i / 10, i * 100, value(i))),
        ),
    ]
}

fn tables() -> Vec<Kind> {
    let iso = |i: usize| {
        let [y, mo, d, h, m, _] = moment(60 * i);
        format!("{y}-{mo:02}-{d:02} {h:02}:{m:02}")
    };
    let plain = |head: &str| rows(head, |i| format!("{},{:.2}", iso(i), value(i)));
    let words = |n: usize| {
        (0..n).fold(String::new(), |text, i| text + &format!("Text {i} of the operator, with commas, and words.\n"))
    };
    vec![
        kind(
            "keys and values above",
            START,
            60.0,
            "Temp",
            plain("Latitude,52.2\nLongitude,8.1\nSerial,12345\n\nDate,Temp\n"),
        ),
        kind(
            "a long preamble",
            START,
            60.0,
            "Wert",
            rows(&format!("{}Zeit;Wert\n", words(300)), |i| format!("{};{:.2}", iso(i), value(i)).replace('.', ",")),
        ),
        kind(
            "comments with another mark",
            START,
            60.0,
            "depth",
            rows(&format!("{}!time;depth\n", "! a line; of text\n".repeat(60)), |i| {
                format!("{};{:.2}", iso(i), value(i))
            }),
        ),
        kind(
            "units that nobody knows",
            START,
            60.0,
            "Level",
            rows("Date/Time\tLevel\tTemp\nUTC\tfathoms\t°C\n", |i| {
                format!("{}\t{:.2}\t3.{}", iso(i), value(i), i % 9)
            }),
        ),
        kind(
            "names, units, types",
            START,
            60.0,
            "AirT_Avg",
            rows(
                "\"TOA5\",\"S\",\"CR1\",\"x\"\n\"TIMESTAMP\",\"RECORD\",\"Batt_Min\",\"AirT_Avg\"\n\"TS\",\"RN\",\"Volts\",\"Deg C\"\n\"\",\"\",\"Min\",\"Avg\"\n",
                |i| format!("\"{}:00\",{i},12.{},{:.2}", iso(i), i % 7, value(i)),
            ),
        ),
        kind(
            "a ruler",
            START,
            60.0,
            "Level",
            rows("Date       Time  Level\n---------- ----- ------\n", |i| format!("{} {:.2}", iso(i), value(i))),
        ),
        kind(
            "a name less than cells",
            START,
            60.0,
            "v",
            rows("time,v\n", |i| format!("{i},{},{:.2}", iso(i), value(i))),
        ),
        kind("a footer", START, 60.0, "Temp", plain("Time,Temp\n") + "Total,\nEnd of report\n"),
        kind(
            "headers that come again",
            START,
            60.0,
            "Temp",
            rows("", |i| format!("{}{},{:.2}", if i % 20 == 0 { "Time,Temp\n" } else { "" }, iso(i), value(i))),
        ),
        kind(
            "a smaller table above",
            START,
            60.0,
            "x",
            format!(
                "a,b\n{}\n{}",
                (0..20).fold(String::new(), |t, i| t + &format!("{i},{}.5\n", i * i % 7)),
                rows("Time,x,y\n", |i| format!("{},{:.2},{}.5", iso(i), value(i), i * i % 17))
            ),
        ),
        kind("newest first", START, 60.0, "v", rows("time,v\n", |i| format!("{},{:.2}", iso(ROWS - 1 - i), value(i)))),
        kind("units in cells", START, 60.0, "v", rows("time,v\n", |i| format!("{},{:.2} m", iso(i), value(i)))),
        kind(
            "thousands of Germans",
            START,
            60.0,
            "v",
            rows("time;v\n", |i| format!("{};{}.{:03},50", iso(i), 10 + i % 3, i * 37 % 1000)),
        ),
        kind(
            "texts of a spreadsheet",
            START,
            60.0,
            "v",
            rows("time,v\n", |i| format!("{},=\"{:.2}\"", iso(i), value(i))),
        ),
        kind(
            "exponents of Fortran",
            START,
            60.0,
            "v",
            rows("time,v\n", |i| format!("{},{:.4}D+02", iso(i), value(i) / 100.0)),
        ),
        kind(
            "limits of detection",
            START,
            60.0,
            "v",
            rows("time,v\n", |i| format!("{},{}{:.1}", iso(i), if i % 9 == 0 { "<" } else { "" }, value(i))),
        ),
    ]
}

fn loaded(text: &str, options: &LoadOptions) -> wildpoint::error::Result<Track> {
    load(&Source::BuiltIn { name: "test", bytes: text.as_bytes().into() }, options)
}

/// What is understood wrongly; none where all is right.
fn wrong(kind: &Kind) -> Option<String> {
    let track = match loaded(&kind.text, &LoadOptions::default()) {
        Ok(track) => track,
        Err(e) => return Some(e.to_string()),
    };
    let rows = kind.text.lines().count().min(ROWS).min(track.rows);
    let Some(channel) = track.channel(kind.channel) else {
        let names: Vec<&str> = track.channels.iter().map(|c| c.name.as_str()).collect();
        return Some(format!("no channel {}: {names:?}", kind.channel));
    };
    let series = channel.series(&track.time);
    let first = track.time.full_label(series.t.first().copied().unwrap_or(f64::NAN));
    let least = rows.min(28);
    let right = first.starts_with(kind.start)
        && (series.interval - kind.step).abs() < 1e-5 * kind.step
        && series.len() >= least;
    let told = format!("{} samples, {first}, {} s", series.len(), series.interval);
    (!right).then(|| format!("{told}; notes: {:?}", track.notes))
}

#[test]
fn files_of_every_kind_are_understood_without_an_option() {
    let kinds = spellings().into_iter().chain(columns()).chain(tables());
    let wrong: Vec<String> = kinds.filter_map(|k| Some(format!("{}: {}", k.name, wrong(&k)?))).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn one_wild_stamp_loses_one_row_wherever_it_stands() {
    for place in 0..ROWS {
        for wild in ["2040-01-01 00:00", "1999-01-01 00:00"] {
            let text = rows("time,v\n", |i| {
                let [y, mo, d, h, m, _] = moment(60 * i);
                let time = if i == place { wild.to_owned() } else { format!("{y}-{mo:02}-{d:02} {h:02}:{m:02}") };
                format!("{time},{:.2}", value(i))
            });
            let track = loaded(&text, &LoadOptions::default()).unwrap();
            let usable = track.time.seconds.iter().filter(|t| t.is_finite()).count();
            assert_eq!(usable, ROWS - 1, "{wild} in row {place}");
        }
    }
}

#[test]
fn columns_that_are_no_measurements_are_left_aside_with_the_reason() {
    let text = rows("record,time,station_id,valid,year,v,cal\n", |i| {
        let [y, mo, d, h, m, _] = moment(60 * i);
        format!("{},{y}-{mo:02}-{d:02} {h:02}:{m:02},44,{},{y},{:.2},7", i + 5, i % 2, value(i))
    });
    let track = loaded(&text, &LoadOptions::default()).unwrap();
    assert_eq!(track.channels.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(), ["v"]);
    let kinds: Vec<ColumnKind> = track.columns.iter().map(|c| c.kind).collect();
    let aside = |a| ColumnKind::Aside(a);
    assert_eq!(
        kinds,
        [
            aside(Aside::Counter),
            ColumnKind::Time,
            aside(Aside::Id),
            aside(Aside::Flag),
            aside(Aside::Time),
            ColumnKind::Number,
            aside(Aside::Constant)
        ]
    );
    // What is asked for is a channel.
    let asked = LoadOptions { channels: vec!["record".into(), "cal".into()], ..LoadOptions::default() };
    assert_eq!(loaded(&text, &asked).unwrap().channels.len(), 2);
}

#[test]
fn tracks_are_recognised_side_by_side_and_one_after_the_other() {
    let beside = |i: usize| format!("{},{},{:.2}", i / 3, ["DLH1", "BAW22", "AFR3"][i % 3], value(i));
    let after = |i: usize| format!("{},{},{:.2}", i % 20, 4 + i / 20, value(i));
    for (text, count) in [(rows("t,callsign,alt\n", beside), 3), (rows("t,beacon,alt\n", after), 3)] {
        let track = loaded(&text, &LoadOptions::default()).unwrap();
        assert_eq!(track.channels.len(), count, "{:?}", track.notes);
        let samples: usize = track.channels.iter().map(|c| c.series(&track.time).len()).sum();
        assert_eq!(samples, ROWS);
        assert!(track.notes.iter().any(|n| n.contains("tells 3 tracks apart")), "{:?}", track.notes);
    }
}

#[test]
fn what_cannot_be_found_can_be_said() {
    let text = "x y z\nwhatever stands here\nu v w\n0 1 5\n1 4 6\n2 9 7\n";
    let options = |change: fn(&mut LoadOptions)| {
        let mut options = LoadOptions::default();
        change(&mut options);
        loaded(text, &options).unwrap().columns.iter().map(|c| c.name.clone()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(options(|o| o.header_line = Some(1)), "x y z");
    assert_eq!(options(|o| o.skip = Some(2)), "u v w");
    assert_eq!(options(|o| o.names = vec!["a".into(), String::new(), "c".into()]), "a v c");
    let ambiguous = "when,v\n04.05.06 10:00,1\n04.05.06 11:00,2\n04.05.06 12:00,3\n";
    let told = LoadOptions {
        time_format: Some(wildpoint::track::Pattern::new("%y.%m.%d %H:%M").unwrap()),
        time_zone: Some("Europe/Berlin".into()),
        ..LoadOptions::default()
    };
    let track = loaded(ambiguous, &told).unwrap();
    assert_eq!(track.time.full_label(0.0), "2004-05-06 08:00:00 UTC");
}

#[test]
fn a_load_that_loses_most_rows_is_an_error_with_the_way_out() {
    let text = rows("time,v\n", |i| {
        if i % 10 == 0 { format!("2021-03-04 10:{i:02},1.{i}") } else { format!("noon and {i},1.{i}") }
    });
    let told = LoadOptions { time: Some("time".into()), ..LoadOptions::default() };
    let e = loaded(&text, &told).unwrap_err().to_string();
    assert!(e.contains("--time-format") || e.contains("times are"), "{e}");
}
