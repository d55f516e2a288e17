//! Clocks whose zone a column tells, or nothing does; counters whose unit their values tell.

use wildpoint_record::track::{
    Changes, Clocks, ColumnKind, LoadOptions, NewRow, Source, TimeFormat, Track, load, rewrite,
};

fn with(text: &str, options: &LoadOptions) -> Track {
    let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
    load(&source, options).unwrap_or_else(|e| panic!("{e}"))
}

fn loaded(text: &str) -> Track {
    with(text, &LoadOptions::default())
}

fn says(track: &Track, words: &str) -> bool {
    track.notes.iter().any(|n| n.contains(words))
}

fn first(track: &Track) -> String {
    track.time.full_label(track.time.seconds[0])
}

/// All steps between times, in seconds.
fn steps(track: &Track) -> Vec<f64> {
    let mut steps: Vec<f64> = track.time.seconds.windows(2).map(|w| w[1] - w[0]).collect();
    steps.dedup();
    steps
}

/// Hours from 2021-03-13 12:00 in New York, where clocks were set forward from 2:00 to 3:00 the day after: date, clock, zone.
fn new_york(hour: usize) -> [String; 3] {
    let local = 12 + hour + usize::from(hour >= 14);
    let zone = if hour >= 14 { "EDT" } else { "EST" };
    [format!("2021-03-{}", 13 + local / 24), format!("{:02}:00", local % 24), zone.to_owned()]
}

fn level(hour: usize) -> String {
    format!("{}.{:02}", 3 + hour % 4, hour * 37 % 100)
}

/// A table of the USGS.
fn rdb() -> String {
    let head = "# retrieved\n#    12345    00065    Gage height, feet\nagency_cd\tsite_no\tdatetime\ttz_cd\t12345_00065\t12345_00065_cd\n5s\t15s\t20d\t6s\t14n\t10s\n";
    let row = |hour: usize| {
        let [date, clock, zone] = new_york(hour);
        format!("USGS\t01646500\t{date} {clock}\t{zone}\t{}\tP\n", level(hour))
    };
    (0..40).fold(head.to_owned(), |text, hour| text + &row(hour))
}

/// The week of 2024-03-03 is 2304; the last samples of a week and the first of the next.
#[test]
fn a_unit_in_the_name_of_the_seconds_of_the_week_hides_them_from_nobody() {
    for name in ["tow_s", "tow", "sow_s", "tow (s)", "tow_ms"] {
        let unit = if name == "tow_ms" { 1000 } else { 1 };
        let row = |i: u32| format!("{},{},{}.5\n", 2304 + i / 30, (604_770 + i) % 604_800 * unit, i * i % 7);
        let track = loaded(&format!("week,{name},range_m\n{}", (0..60).map(row).collect::<String>()));
        assert!(first(&track).starts_with("2024-03-09 23:59:30"), "{name}: {}", first(&track));
        assert!(steps(&track).iter().all(|step| (step - 1.0).abs() < 1e-9), "{name}");
    }
}

#[test]
fn a_column_of_zones_moves_the_clock_of_each_row() {
    let track = loaded(&rdb());
    assert_eq!((first(&track).as_str(), steps(&track)), ("2021-03-13 17:00:00 UTC", vec![3600.0]));
    assert!(says(&track, "`tz_cd` (EDT, EST)"), "{:?}", track.notes);
    assert_eq!(track.columns[3].kind, ColumnKind::Time);
    // Date and clock apart, and the zone without a name that says so.
    let table = |row: &dyn Fn(usize) -> String| (0..40).fold(String::new(), |text, hour| text + &row(hour));
    let apart = table(&|hour| format!("{};{}\n", new_york(hour).join(";"), level(hour)));
    let track = loaded(&format!("Date;Clock;Code;Level\n{apart}"));
    assert_eq!((first(&track).as_str(), steps(&track)), ("2021-03-13 17:00:00 UTC", vec![3600.0]));
    // Hours ahead of UTC.
    let hours = table(&|hour| {
        let [date, clock, zone] = new_york(hour);
        format!("{date} {clock},{},{}\n", if zone == "EST" { "-5" } else { "-4" }, level(hour))
    });
    let track = loaded(&format!("time,utc_offset,level\n{hours}"));
    assert_eq!((first(&track).as_str(), steps(&track)), ("2021-03-13 17:00:00 UTC", vec![3600.0]));
}

#[test]
fn what_is_told_or_written_in_the_cells_goes_before_a_column_of_zones() {
    let options = LoadOptions { time_zone: Some("-05:00".into()), ..LoadOptions::default() };
    let track = with(&rdb(), &options);
    assert_eq!((first(&track).as_str(), steps(&track).len()), ("2021-03-13 17:00:00 UTC", 3));
    let text = (0..30)
        .fold("time,tz,x\n".to_owned(), |text, i| text + &format!("2021-03-04T10:{i:02}:00Z,EST,{}\n", level(i)));
    assert_eq!(first(&loaded(&text)), "2021-03-04 10:00:00 UTC");
    // The name of a time scale is no zone, and what no zone has is none.
    for (name, cell) in [("source", "GPS"), ("mode", "ABC"), ("tz", "XYZ")] {
        let head = format!("time,{name},x\n");
        let text = (0..30).fold(head, |text, i| text + &format!("2021-03-04 10:{i:02}:00,{cell},{}\n", level(i)));
        let track = loaded(&text);
        assert_eq!(
            (first(&track).as_str(), track.columns[1].kind),
            ("2021-03-04 10:00:00", ColumnKind::Text),
            "{name}"
        );
    }
}

#[test]
fn a_new_row_has_the_clock_of_the_zone_of_the_row_before() {
    let track = loaded(&rdb());
    // Half an hour after the last hour of winter, and after the first of summer.
    for (after, clock) in [(13_u32, "2021-03-14 01:30\tEST"), (14, "2021-03-14 03:30\tEDT")] {
        let seconds = track.time.seconds[after as usize] + 1800.0;
        let changes =
            Changes { cells: Vec::new(), rows: vec![NewRow { after_row: after, seconds, cells: vec![(4, 3.5)] }] };
        let mut out = Vec::new();
        rewrite(&track, &changes, &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        assert!(text.contains(clock), "{clock}: {text}");
    }
}

#[test]
fn clocks_of_an_unknown_zone_are_not_called_utc() {
    let rows = |cell: &dyn Fn(usize) -> String| {
        (0..30).fold("time,x\n".to_owned(), |text, i| text + &format!("{},{}\n", cell(i), level(i)))
    };
    for (text, label, clocks) in [
        (rows(&|i| format!("2021-03-04 10:{i:02}:00")), "2021-03-04 10:00:00", Clocks::Unstated),
        (rows(&|i| format!("04.03.2021 10:{i:02}")), "2021-03-04 10:00:00", Clocks::Unstated),
        (rows(&|i| format!("2021-03-04T10:{i:02}:00Z")), "2021-03-04 10:00:00 UTC", Clocks::Stated),
        (rows(&|i| format!("2021-03-04T10:{i:02}:00+01:00")), "2021-03-04 09:00:00 UTC", Clocks::Stated),
        (rows(&|i| format!("{}", 1_614_852_000 + i)), "2021-03-04 10:00:00 UTC", Clocks::Stated),
        (
            rows(&|i| format!("2021-03-04 10:{i:02}:00")).replace("time", "time (UTC)"),
            "2021-03-04 10:00:00 UTC",
            Clocks::Stated,
        ),
        (
            rows(&|i| format!("2021-03-04 10:{i:02}:00")).replace("time", "Zeit (UTC+1)"),
            "2021-03-04 09:00:00 UTC",
            Clocks::Stated,
        ),
    ] {
        let track = loaded(&text);
        assert_eq!((first(&track).as_str(), track.time.clocks), (label, clocks), "{text:.60}");
        // What is written stays as it was.
        assert!(track.time.exact_label(0.0).ends_with('Z'));
    }
    let berlin = LoadOptions { time_zone: Some("Europe/Berlin".into()), ..LoadOptions::default() };
    let track = with(&rows(&|i| format!("2021-03-04 10:{i:02}:00")), &berlin);
    assert_eq!(first(&track), "2021-03-04 09:00:00 UTC");
}

/// Rows whose times are read from a clock, which is a little late now and then.
fn counted(name: &str, start: u64, step: u64, late: u64) -> Track {
    let row = |i: u64| format!("{},{},{}\n", start + i * step + i * 13 % 7 * late, level(i as usize), i * i % 11);
    loaded(&(0..40).fold(format!("{name},x,y\n"), |text, i| text + &row(i)))
}

#[test]
fn counters_of_microseconds_are_told_by_their_steps() {
    for (start, step, late) in [(5_012_345, 4_003, 11), (87_654_321_012, 20_001, 37), (1_000_003, 999_983, 101)] {
        let track = counted("timestamp", start, step, late);
        assert_eq!(track.time.format, TimeFormat::Elapsed { unit_ns: 1_000 }, "{step}");
        assert!(says(&track, "`timestamp` is read as microseconds"), "{:?}", track.notes);
    }
    // Seconds of every hour and every day, those of a clock of milliseconds below, and round steps.
    for (name, start, step, late) in [
        ("time", 3_600_000, 3_600, 0),
        ("time", 86_400_000, 86_400, 0),
        ("time", 100, 1, 0),
        ("depth", 5_012_345, 4_003, 11),
        ("time", 5_000_000, 4_000, 0),
    ] {
        assert_ne!(
            counted(name, start, step, late).time.format,
            TimeFormat::Elapsed { unit_ns: 1_000 },
            "{name} {step}"
        );
    }
    assert_eq!(
        counted("timestamp", 1_614_852_000, 4_003, 11).time.format,
        TimeFormat::Epoch { unit_ns: 1_000_000_000 }
    );
    assert_eq!(counted("time_ms", 5_012_345, 4_003, 11).time.format, TimeFormat::Elapsed { unit_ns: 1_000_000 });
}
