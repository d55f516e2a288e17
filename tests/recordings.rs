//! Loading real recordings, held against a plain reading of the same files and against what their description
//! states. Skipped, with a line that says so, where `../shared/data` is absent.

#![expect(clippy::expect_used, clippy::unwrap_used, reason = "a failed expectation is a failed test")]
#![expect(clippy::print_stderr, reason = "a skipped test says so")]

use std::io::Read;
use std::path::{Path, PathBuf};

use wildpoint::track::{Changes, LoadOptions, Rules, Source, TimeFormat, Track, load, rewrite};

fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    if !folder.is_dir() {
        eprintln!("skipped: {} is absent", folder.display());
    }
    folder.is_dir().then_some(folder)
}

/// By the first rules, which leave no column of numbers aside and no row out: what a plain reading has.
fn loaded(file: &Path) -> Track {
    let first = LoadOptions { rules: Rules::First, ..LoadOptions::default() };
    load(&Source::File(file.to_path_buf()), &first).unwrap_or_else(|e| panic!("{e}"))
}

fn unpacked(file: &Path) -> Vec<u8> {
    let bytes = std::fs::read(file).unwrap();
    if file.extension().is_none_or(|e| e != "gz") {
        return bytes;
    }
    let mut text = Vec::new();
    flate2::read::MultiGzDecoder::new(&bytes[..]).read_to_end(&mut text).unwrap();
    text
}

/// A time of the file in seconds since its zero, by other means than the loader's.
fn plain_time(text: &str) -> f64 {
    if let Ok(seconds) = text.parse() {
        return seconds;
    }
    let civil: jiff::civil::DateTime = text.trim_end_matches('Z').parse().expect(text);
    civil.to_zoned(jiff::tz::TimeZone::UTC).unwrap().timestamp().as_nanosecond() as f64 / 1e9
}

/// Every cell of every channel and every time against a plain reading with the csv crate.
fn compare_with_plain_reading(file: &Path, track: &Track) {
    let text = unpacked(file);
    let mut reader = csv::Reader::from_reader(&text[..]);
    let mut last = f64::NEG_INFINITY;
    let mut first = None;
    let mut rows = 0;
    for (row, record) in reader.records().enumerate() {
        let record = record.unwrap();
        for channel in &track.channels {
            let cell = &record[channel.column];
            let expected: f64 = cell.parse().unwrap_or(f64::NAN);
            let value = channel.values[row];
            assert!(
                value == expected || (value.is_nan() && expected.is_nan()),
                "{file:?} row {row}: {cell} is {value}"
            );
        }
        if let Some(column) = track.time.column {
            let now = plain_time(&record[column]);
            let origin = *first.get_or_insert(now);
            let seconds = track.time.seconds[row];
            assert_eq!(seconds.is_nan(), now <= last, "{file:?} row {row}: {}", &record[column]);
            assert!(seconds.is_nan() || (seconds - (now - origin)).abs() < 1e-6, "{file:?} row {row}: {seconds}");
            last = last.max(now);
        }
        rows += 1;
    }
    assert_eq!(rows, track.rows, "{file:?}");
}

#[test]
fn every_recording_is_read_as_a_plain_reading_has_it() {
    let Some(folder) = folder() else { return };
    // Rows as the description states them.
    for (name, rows, channels) in [
        ("spacex_webcast_30hz.csv.gz", 1_218_256, 3),
        ("spacex_iridium3_stage1.csv", 11_845, 2),
        ("rocket_juno3_altimeter.csv", 611, 5),
        ("rocket_juno3_gnss.csv", 444, 5),
        ("rocket_andromeda_altimeter.csv", 1_139, 2),
        ("rocket_astra_gps.csv", 64, 3),
        ("rocket_hedy_baro.csv", 24_564, 2),
        ("rocket_prometheus_telemetrum.csv", 7_081, 13),
        ("adsb_noisy_landing.csv", 848, 7),
        ("adsb_spoofing.csv", 8_681, 7),
        ("adsb_savan.csv.gz", 193_447, 7),
        ("orbit_w3b_range_az_el.csv", 521, 3),
        ("orbit_lageos2_slr_range.csv", 258, 1),
        ("gnss_phone_range_rate.csv", 1_242, 6),
        ("gnss_phone_sv13.csv", 207, 2),
        ("gnss_turin_pos_vel.csv", 6_295, 8),
        ("gnss_turin_reference.csv", 1_260, 8),
        ("gnss_ublox_drive.csv", 1_653, 11),
        ("gnss_daily_kmin.csv", 6_606, 6),
        ("radio_range_plaza1.csv", 3_529, 3),
        ("gps_oystercatcher_2019.csv", 5_263, 7),
        ("water_mainstreet2019.csv", 25_881, 12),
        ("nab_machine_temperature.csv", 22_695, 2),
        ("nab_road_speed_7578.csv", 1_127, 2),
    ] {
        let file = folder.join(name);
        let track = loaded(&file);
        assert_eq!((track.rows, track.channels.len(), track.faults.ragged_rows.count), (rows, channels, 0), "{name}");
        compare_with_plain_reading(&file, &track);
        let mut again = Vec::new();
        rewrite(&track, &Changes::default(), &mut again).unwrap();
        assert!(again == unpacked(&file), "{name}: rewritten with no change, it is another file");
    }
}

#[test]
fn faults_are_those_of_the_description() {
    let Some(folder) = folder() else { return };
    let track = |name: &str| loaded(&folder.join(name));
    let missing = |track: &Track, name: &str| track.columns.iter().find(|c| c.name == name).unwrap().missing;

    let iridium = track("spacex_iridium3_stage1.csv");
    // Row 1 is 0.0; the rows from -0.966 on lie before it until time passes 0.0 again.
    let usable = iridium.time.seconds.iter().skip(1).position(|s| !s.is_nan()).unwrap();
    assert_eq!((iridium.faults.backward_times.count + iridium.faults.repeated_times.count, usable), (29, 29));
    assert_eq!(iridium.faults.backward_times.first[0], (3, "-0.966".into()));

    assert_eq!(track("rocket_astra_gps.csv").faults.repeated_times.count, 2);
    assert_eq!(track("rocket_prometheus_telemetrum.csv").faults.repeated_times.count, 1_369);
    let gnss = track("rocket_juno3_gnss.csv");
    assert!(gnss.notes[0].starts_with("time goes back after row 2 (0.2)"), "{:?}", gnss.notes);
    let altimeter = track("rocket_juno3_altimeter.csv");
    assert_eq!(altimeter.faults.unreadable_cells.first, [(611, "Drogue (temperature_c)".into())]);
    assert_eq!((missing(&altimeter, "temperature_c"), missing(&altimeter, "battery_v")), (21, 21));

    let spoofing = track("adsb_spoofing.csv");
    assert_eq!((missing(&spoofing, "lat_deg"), missing(&spoofing, "alt_ft")), (11, 5));
    let savan = track("adsb_savan.csv.gz");
    assert_eq!([missing(&savan, "lat_deg"), missing(&savan, "alt_ft"), missing(&savan, "gs_kt")], [128, 5_207, 2_352]);
    assert_eq!(missing(&track("gnss_ublox_drive.csv"), "ref_alt_m"), 26);

    let machine = track("nab_machine_temperature.csv");
    assert_eq!(machine.faults.backward_times.first[0].1, "2014-01-07 02:00:00");
    assert_eq!(machine.faults.backward_times.count + machine.faults.repeated_times.count, 12);
    assert!(machine.notes.is_empty(), "{:?}", machine.notes);
    assert_eq!(track("gps_oystercatcher_2019.csv").truth.map(|t| t.iter().filter(|t| **t).count()), Some(4));
    for (name, id) in [("spacex_webcast_30hz.csv.gz", "flight"), ("gnss_phone_range_rate.csv", "svid")] {
        assert!(track(name).notes[0].ends_with(&format!("told apart by `{id}` (then: --track '{id}')")), "{name}");
    }
}

#[test]
fn truth_is_chosen_among_several() {
    let Some(folder) = folder() else { return };
    let file = Source::File(folder.join("water_mainstreet2019.csv"));
    for (name, labelled) in
        [("temp_degc", 198), ("cond_uscm", 519), ("ph", 123), ("do_mgl", 5_674), ("stage_cm", 5_021)]
    {
        let options = LoadOptions {
            channels: vec![name.into()],
            truth: Some(format!("{name}_truth_outlier")),
            missing: vec!["-9999".into()],
            ..LoadOptions::default()
        };
        let track = load(&file, &options).unwrap();
        assert_eq!(track.truth.map(|t| t.iter().filter(|t| **t).count()), Some(labelled), "{name}");
        if name == "temp_degc" {
            assert_eq!(track.columns[1].missing, 30, "raw -9999 in temperature");
        }
    }
}

#[test]
fn originals_are_read_in_their_own_form() {
    let Some(folder) = folder() else { return };
    let folder = folder.join("messy");
    for (name, rows, channels, time) in [
        ("juno3_cots_altimeter.csv", 611, 5, "time"),
        ("prometheus_telemega_head.csv", 299, 77, "time"),
        ("skab_valve1_0.csv", 1_147, 10, "datetime"),
        ("ioos_salinity_head.csv", 2_998, 1, "time PST"),
        ("00NA_head.tenv3", 599, 21, "sample"),
        ("W3B.aer", 521, 2, "column_1"),
        ("gnss_logger_2016_06_30_head.txt", 389, 22, "TimeNanos"),
        ("MainStreet_cond_calib_dates.csv", 45, 1, "start"),
        ("air_quality_us_dates_tail.csv", 286, 13, "Time"),
    ] {
        let file = folder.join(name);
        let track = loaded(&file);
        assert_eq!((track.rows, track.channels.len(), track.time.name.as_str()), (rows, channels, time), "{name}");
        let mut again = Vec::new();
        rewrite(&track, &Changes::default(), &mut again).unwrap();
        assert!(again == unpacked(&file), "{name}: rewritten with no change, it is another file");
    }
    let air = loaded(&folder.join("air_quality_us_dates_tail.csv"));
    assert_eq!(air.time.format, TimeFormat::YearLast { day_first: false });
    assert_eq!(air.time.full_label(7.0 * 3600.0), "2005-03-24 00:00:00");
    let hourly = air.time.seconds.windows(2).all(|w| w[1] - w[0] == 3600.0);
    assert!(hourly && air.faults == wildpoint::track::Faults::default());
    let salinity = loaded(&folder.join("ioos_salinity_head.csv"));
    assert_eq!((salinity.channels[0].values[0], salinity.channels[0].unit.as_str()), (27.37, "psu"));
    let mjd = LoadOptions { time: Some("__MJD".into()), ..LoadOptions::default() };
    let station = load(&Source::File(folder.join("00NA_head.tenv3")), &mjd).unwrap();
    assert_eq!(station.time.seconds[1], 86_400.0);
    let logger = loaded(&folder.join("gnss_logger_2016_06_30_head.txt"));
    // Its 51 rows of positions stand among the 338 of raw measurements.
    assert_eq!(logger.faults.ragged_rows.count, 51);
    assert!(logger.notes.iter().any(|n| n.contains("rows of several kinds")), "{:?}", logger.notes);
}

#[test]
fn originals_of_records_are_read_and_written_again() {
    let Some(folder) = folder() else { return };
    for (name, channel) in [("lageos2_20160214.npt", "returns"), ("ublox_drive_head.nmea", "latitude_RMC")] {
        let file = folder.join("messy").join(name);
        let track = load(&Source::File(file.clone()), &LoadOptions::default()).unwrap();
        assert!(track.channels.iter().any(|c| c.name.starts_with(channel)), "{name}");
        let mut again = Vec::new();
        rewrite(&track, &Changes::default(), &mut again).unwrap();
        assert!(again == std::fs::read(&file).unwrap(), "{name}");
    }
}

#[test]
fn originals_of_another_shape_are_refused() {
    let Some(folder) = folder() else { return };
    let file = Source::File(folder.join("messy").join("trainset_long_labels_head.csv"));
    let message = load(&file, &LoadOptions::default()).unwrap_err().to_string();
    assert!(message.contains(":1: a long table"), "{message}");
}

#[test]
fn no_file_of_the_folder_is_left_out() {
    let Some(folder) = folder() else { return };
    let here = include_str!("recordings.rs");
    // The table of flights that belongs to the webcast: names, and counts for each.
    let tables = ["spacex_flights.csv", "README.md", "messy"];
    assert_eq!(loaded(&folder.join("spacex_flights.csv")).rows, 46);
    for folder in [folder.join("messy"), folder] {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            assert!(tables.contains(&name.as_str()) || here.contains(&format!("\"{name}\"")), "{name} is not tested");
        }
    }
}
