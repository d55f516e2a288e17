//! Awkward files of kinds that people hold: what is understood of each without an option.

use std::fmt::Write as _;

use wildpoint_record::track::{Aside, ColumnKind, LoadOptions, Pattern, Source, Track, load};

const ROWS: usize = 60;

fn loaded(text: &str) -> Track {
    loaded_bytes(text.as_bytes())
}

fn loaded_bytes(bytes: &[u8]) -> Track {
    let source = Source::BuiltIn { name: "test", bytes: bytes.into() };
    load(&source, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn value(row: usize) -> f64 {
    20.0 + 5.0 * (row as f64 / 9.0).sin() + (row * 7919 % 101) as f64 / 500.0
}

fn comma(value: f64) -> String {
    format!("{value:.2}").replace('.', ",")
}

fn table(head: &str, row: impl Fn(usize) -> String) -> String {
    (0..ROWS).fold(head.to_owned(), |mut text, i| {
        let _ = writeln!(text, "{}", row(i));
        text
    })
}

/// Minute `i` after 2021-03-04 10:00, as day, hour and minute.
fn minute(i: usize) -> [usize; 3] {
    [4 + (600 + i) / 1440, (600 + i) / 60 % 24, i % 60]
}

fn first(track: &Track) -> String {
    track.time.full_label(track.time.seconds[0])
}

fn usable(track: &Track) -> usize {
    track.time.seconds.iter().filter(|t| t.is_finite()).count()
}

fn names(track: &Track) -> Vec<&str> {
    track.channels.iter().map(|c| c.name.as_str()).collect()
}

fn kind_of(track: &Track, name: &str) -> ColumnKind {
    track.columns.iter().find(|c| c.name == name).unwrap_or_else(|| panic!("no column {name}")).kind
}

fn says(track: &Track, words: &str) -> bool {
    track.notes.iter().any(|n| n.contains(words))
}

#[test]
fn zones_in_names_are_taken_and_said() {
    for (name, start) in [
        ("Zeit (UTC+1)", "2021-03-04 09:00:00"),
        ("Date Time, GMT-07:00", "2021-03-04 17:00:00"),
        ("time PST", "2021-03-04 18:00:00"),
        ("Time (Europe/Berlin)", "2021-03-04 09:00:00"),
        ("Time [UTC]", "2021-03-04 10:00:00"),
        ("Time", "2021-03-04 10:00:00"),
    ] {
        let text = table(&format!("\"{name}\";x\n"), |i| {
            let [d, h, m] = minute(i);
            format!("2021-03-{d:02} {h:02}:{m:02};{:.2}", value(i))
        });
        let track = loaded(&text);
        assert!(first(&track).starts_with(start), "{name}: {}", first(&track));
        assert_eq!(says(&track, "--time-zone"), !start.ends_with("10:00:00"), "{name}: {:?}", track.notes);
    }
    // What a cell says holds.
    let text = table("Zeit (UTC+1);x\n", |i| format!("2021-03-04T10:{i:02}:00+03:00;{:.2}", value(i)));
    assert!(first(&loaded(&text)).starts_with("2021-03-04 07:00:00"));
}

#[test]
fn clocks_that_are_set_back_are_said() {
    // 2021-10-31 in Berlin: 02:00 to 02:50 comes twice.
    let text = table("Datum;Pegel\n", |i| {
        let minutes = 30 + 10 * i;
        let local = if minutes < 180 { minutes } else { minutes - 60 };
        format!("31.10.2021 {:02}:{:02};{}", local / 60, local % 60, comma(value(i)))
    });
    let track = loaded(&text);
    assert!(says(&track, "--time-zone tells both hours apart"), "{:?}", track.notes);
    let zone = LoadOptions { time_zone: Some("Europe/Berlin".into()), ..LoadOptions::default() };
    let track = load(&Source::BuiltIn { name: "test", bytes: text.as_bytes().into() }, &zone).unwrap();
    assert_eq!(usable(&track), ROWS);
    let gap = table("Datum;Pegel\n", |i| format!("31.10.2021 {:02}:{:02};{}", i / 6, 10 * (i % 6), comma(value(i))));
    assert!(!says(&loaded(&gap), "both hours"));
}

#[test]
fn the_order_of_dates_is_told_by_what_else_is_written() {
    let french = table("Date et heure;Niveau\n", |i| format!("04/03/2021 10:{i:02};{}", comma(value(i))));
    let track = loaded(&french);
    assert!(first(&track).starts_with("2021-03-04") && says(&track, "--dates month-first"), "{:?}", track.notes);
    let twelve = table("Date\tTime\tTemp\n", |i| {
        let minutes = 600 + 15 * i;
        let (hour, half) = (minutes / 60 % 24, if minutes / 60 % 24 < 12 { 'a' } else { 'p' });
        format!("3/{}/21\t{}:{:02}{half}\t{:.1}", 4 + minutes / 1440, (hour + 11) % 12 + 1, minutes % 60, value(i))
    });
    let track = loaded(&twelve);
    assert!(first(&track).starts_with("2021-03-04 10:00:00"), "{}", first(&track));
    assert_eq!((usable(&track), track.time.seconds[ROWS - 1]), (ROWS, 900.0 * (ROWS - 1) as f64));
    let hourly = table("date_time,stage\n", |i| {
        format!("03/{:02}/2021 {:02}:00 EST,{:.2}", 4 + (10 + i) / 24, (10 + i) % 24, value(i))
    });
    let track = loaded(&hourly);
    assert!(first(&track).starts_with("2021-03-04 15:00:00"), "{}", first(&track));
    assert_eq!(track.time.seconds[ROWS - 1], 3600.0 * (ROWS - 1) as f64);
}

#[test]
fn a_pattern_of_dates_leaves_clocks_in_their_column() {
    let text = table("Date,Time,Depth\n", |i| format!("21/03/04,10:{i:02}:00,{:.2}", value(i)));
    let source = Source::BuiltIn { name: "test", bytes: text.as_bytes().into() };
    let e = load(&source, &LoadOptions::default()).unwrap_err().to_string();
    assert!(e.contains("--time-format '%y/%m/%d'"), "{e}");
    let pattern = Pattern::new("%y/%m/%d").unwrap();
    let track = load(&source, &LoadOptions { time_format: Some(pattern), ..LoadOptions::default() }).unwrap();
    assert!(first(&track).starts_with("2021-03-04 10:00:00"), "{}", first(&track));
    assert_eq!(usable(&track), ROWS);
}

#[test]
fn times_in_parts_without_names_or_with_other_names() {
    let irig = table("IRIG Time,ALT\nDDD:HH:MM:SS,ft\n", |i| format!("063:10:00:{i:02}.500,{:.1}", value(i)));
    let track = loaded(&irig);
    assert_eq!((usable(&track), track.time.seconds[ROWS - 1], names(&track)), (ROWS, 59.0, vec!["ALT"]));
    // The array of a logger: its number, year, day of the year, hours and minutes.
    let array = table("", |i| format!("101,2021,63,{},{:.2},12.5{}", 1000 + i, value(i), i % 3));
    let track = loaded(&array);
    assert!(first(&track).starts_with("2021-03-04 10:00:00"), "{}", first(&track));
    assert_eq!(names(&track), ["column_5", "column_6"]);
    // In January the day could be a month.
    let january = table("", |i| format!("101,2021,5,{},{:.2}", 1000 + i, value(i)));
    assert!(first(&loaded(&january)).starts_with("2021-01-05 10:00:00"));
    let gps =
        table("GPSWeek,GPSSeconds,Height\n", |i| format!("2147,{:.3},{:.3}", 381_618.0 + i as f64 * 0.2, value(i)));
    let track = loaded(&gps);
    // Week 2147 begins on 2021-02-28.
    assert!(first(&track).starts_with("2021-03-04 10:00:18"), "{}", first(&track));
    assert_eq!(names(&track), ["Height"]);
}

#[test]
fn units_stand_below_the_names_of_fixed_columns() {
    let head = "  DATE     TIME   PRES   HGHT   TEMP   DRCT\n                   hPa      m      C    deg\n\
                -------- ------ ------ ------ ------ ------\n";
    let text = table(head, |i| {
        format!("20210304 1000{i:02} {:6.1} {:6} {:6.1} {:6}", 1000.0 - 3.0 * i as f64, 25 * i, value(i), i * 7 % 360)
    });
    let track = loaded(&text);
    let units: Vec<&str> = track.columns.iter().map(|c| c.unit.as_str()).collect();
    assert_eq!(units, ["", "", "hPa", "m", "C", "deg"]);
    assert!(first(&track).starts_with("2021-03-04 10:00:00"));
}

#[test]
fn tracks_in_turn_are_told_apart_though_times_go_forward() {
    let mut text = String::from("hex,timestamp,lat,alt,gs\n");
    for i in 0..ROWS {
        for (k, hex) in ["3c6444", "4ca1b2", "a0b1c2"].iter().enumerate() {
            let t = 1_614_852_000.0 + 5.0 * i as f64 + 0.3 * k as f64;
            let _ = writeln!(text, "{hex},{t:.1},{:.4},{},{}", 50 + k, 30_000 - 9_000 * k + 20 * i, 430 + i % 3);
        }
    }
    let track = loaded(&text);
    assert_eq!(kind_of(&track, "hex"), ColumnKind::Track);
    assert!(says(&track, "`hex` tells 3 tracks apart"), "{:?}", track.notes);
    // A station that measures at two heights in turn is one record as long as the values go on.
    let same = table("node,time,x\n", |i| format!("{},{i},{:.3}", 1 + i % 2, value(i)));
    assert_eq!(kind_of(&loaded(&same), "node"), ColumnKind::Aside(Aside::Id));
}

#[test]
fn columns_of_markers_settings_and_codes() {
    let asos = table("station,valid,tmpf,mslp\n", |i| {
        let pressure = if i % 3 == 0 { format!("{:.2}", 1000.0 + value(i)) } else { "M".to_owned() };
        format!("ALO,2021-03-04 10:{i:02},{:.2},{pressure}", value(i))
    });
    let track = loaded(&asos);
    assert_eq!(names(&track), ["tmpf", "mslp"]);
    assert!(says(&track, "`mslp`: 40 cells hold M"), "{:?}", track.notes);
    assert_eq!(track.columns.iter().find(|c| c.name == "station").map(|c| c.missing), Some(0));
    // Classes beside a few numbers are texts all the same.
    let classes = table("t,x,class\n", |i| format!("{i},{:.2},{}", value(i), ["A", "B", "1"][i % 3]));
    assert_eq!(kind_of(&loaded(&classes), "class"), ColumnKind::Text);
    let scope =
        table("Sequence,Volt,Start\n", |i| format!("{i},{:.2},{}", value(i), if i == 0 { "-1.2e-3" } else { "" }));
    assert_eq!(kind_of(&loaded(&scope), "Start"), ColumnKind::Aside(Aside::Constant));
    let polish = table("Czas;Temperatura;Kod jakości\n", |i| {
        format!("2021-03-04 10:{i:02};{};{}", comma(value(i)), 100 + i % 3)
    });
    assert_eq!(names(&loaded(&polish)), ["Temperatura"]);
}

#[test]
fn hard_blanks_between_thousands_are_read_in_windows_1252() {
    let mut bytes = Vec::new();
    bytes.extend(b"Zeit;D\xe9bit (m\xb3/h)\n");
    for i in 0..ROWS {
        bytes.extend(format!("04.03.2021 10:{i:02};1").bytes());
        bytes.extend(b"\xa0");
        bytes.extend(format!("{:03},5\n", 200 + i * 7 % 99).bytes());
    }
    let track = loaded_bytes(&bytes);
    assert_eq!((names(&track), track.channels[0].values[1]), (vec!["Débit (m³/h)"], 1207.5));
}

#[test]
fn days_of_the_year_of_sea_bird_are_those_of_its_start() {
    let head = "* Sea-Bird SBE 37 Data File:\n# name 0 = timeJ: Julian Days\n# name 1 = tv290C: Temperature [ITS-90, deg C]\n\
                # start_time = Mar 04 2021 10:00:00 [Instrument's time stamp, header]\n# bad_flag = -9.990e-29\n*END*\n";
    let text = table(head, |i| format!("{:11.6}{:11.4}", 63.5 + i as f64 / 8.0, value(i)));
    let track = loaded(&text);
    assert!(first(&track).starts_with("2021-03-04 12:00:00"), "{}", first(&track));
    assert_eq!(track.time.seconds[ROWS - 1], 10_800.0 * (ROWS - 1) as f64);
}

#[test]
fn settings_beside_the_first_rows_are_no_channels() {
    let settings = [
        "Record Length,2.5e+03",
        "Sample Interval,4e-07",
        "Source,CH1",
        ",",
        "Vertical Units,V",
        "Model Number,TDS2014B",
    ];
    let beside = |i: usize| settings.get(i).copied().unwrap_or(",");
    let seconds = |i: usize| format!("{:018.12}", -5e-4 + i as f64 * 4e-7);
    // Tektronix: no names at all.
    let track = loaded(&table("", |i| format!("{},,{},  {:9.5},", beside(i), seconds(i), value(i))));
    assert_eq!((names(&track), track.time.name.as_str()), (vec!["column_5"], "column_4"));
    assert!((track.time.seconds[10] - 4e-6).abs() < 1e-12 && says(&track, "settings"), "{:?}", track.notes);
    // With names above.
    let track = loaded(&table("Record Length,600,Points,Time,CH1\n", |i| {
        let beside = ["Sample Interval,4e-07,s", "Trigger,300,Points"].get(i).copied().unwrap_or(",,");
        format!("{beside},{:.8},{:.4}", i as f64 * 4e-7, value(i))
    }));
    assert_eq!((names(&track), track.time.name.as_str()), (vec!["CH1"], "Time"));
    // Rigol: units below the names, and settings where no row has a value.
    let track = loaded(&table("X,CH1,Start,Increment,\nSequence,Volt,-3.000000e-03,1.000000e-05\n", |i| {
        format!("{i},{:.3e},,", value(i))
    }));
    assert_eq!((names(&track), track.channels[0].unit.as_str()), (vec!["CH1"], "Volt"));
    // Names that are numbers stay names.
    let depths =
        loaded(&table("profile,a,b,c\ntime,10,20,30\n", |i| format!("{i},{:.2},{:.2},{i}.5", value(i), value(i + 1))));
    assert_eq!(names(&depths)[..2], ["10", "20"]);
}

#[test]
fn moments_are_no_channel_whatever_they_are_called() {
    let stamp = |i: usize| 1_614_852_000_000_000_000_u64 + i as u64 * 20_000_000;
    let ros = table("%time,field.header.seq,field.header.stamp,field.x\n", |i| {
        format!("{},{i},{},{:.3}", stamp(i) + (i as u64 * 7919) % 90_001, stamp(i), value(i))
    });
    let track = loaded(&ros);
    assert_eq!(names(&track), ["field.x"]);
    assert_eq!(kind_of(&track, "field.header.stamp"), ColumnKind::Aside(Aside::Time));
}
