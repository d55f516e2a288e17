//! What a format does where a value is taken away, added or not there.

use wildpoint_record::track::{CellChange, Changes, LoadOptions, NewRow, Source, Track, load, rewrite};

fn loaded(text: &str) -> Track {
    load(&Source::BuiltIn { name: "test", bytes: text.as_bytes().into() }, &LoadOptions::default()).unwrap()
}

fn written(track: &Track, channel: &str, row: usize, value: Option<f64>) -> Result<String, String> {
    let column = track.channel(channel).unwrap().column;
    let cells = vec![CellChange { row: u32::try_from(row).unwrap(), column, value }];
    let mut out = Vec::new();
    rewrite(track, &Changes { cells, rows: Vec::new() }, &mut out).map_err(|e| e.to_string())?;
    Ok(String::from_utf8(out).unwrap())
}

const TDM: &str = "CCSDS_TDM_VERS = 2.0\nMETA_START\nTIME_SYSTEM = UTC\nPARTICIPANT_1 = A\nPARTICIPANT_2 = B\nPATH = 1,2,1\nMETA_STOP\nDATA_START\n\
                   RANGE = 2021-03-04T10:00:00 100.25\nRANGE = 2021-03-04T10:01:00 101.50\nANGLE_1 = 2021-03-04T10:01:00 7.5\n\
                   RANGE = 2021-03-04T10:02:00 100.75\nDATA_STOP\n";

#[test]
fn a_value_that_is_taken_away_takes_its_line_along() {
    let track = loaded(TDM);
    assert_eq!((track.rows, track.channels.len()), (3, 2));
    let out = written(&track, "RANGE", 1, None).unwrap();
    assert_eq!(out, TDM.replace("RANGE = 2021-03-04T10:01:00 101.50\n", ""));
}

#[test]
fn a_value_without_a_place_and_a_new_row_are_told() {
    let track = loaded(TDM);
    let e = written(&track, "ANGLE_1", 0, Some(1.0)).unwrap_err();
    assert!(e.contains("line 9: CCSDS TDM has no place for a value of `ANGLE_1`"), "{e}");
    let rows = vec![NewRow { after_row: 1, seconds: 90.0, cells: vec![(1, 1.0)] }];
    let e = rewrite(&track, &Changes { cells: Vec::new(), rows }, &mut Vec::new()).unwrap_err().to_string();
    assert!(e.contains("a new row after row 2"), "{e}");
}

#[test]
fn a_position_is_read_in_degrees_and_written_in_minutes() {
    let text = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\n\
                $GPGGA,123520,4807.040,N,01131.002,E,1,08,0.9,545.5,M,46.9,M,,*41\n\
                $GPGGA,123521,,,,,0,00,,,M,,M,,*66\n";
    let track = loaded(text);
    let latitude = track.channel("latitude").unwrap();
    // 48 degrees and 7.038 minutes.
    assert!((latitude.values[0] - (48.0 + 7.038 / 60.0)).abs() < 1e-9);
    assert_eq!(latitude.unit, "deg");
    let out = written(&track, "latitude", 1, Some(-0.5)).unwrap();
    // The checksum is the exclusive or of the characters between $ and *.
    let body = "GPGGA,123520,0030.000,S,01131.002,E,1,08,0.9,545.5,M,46.9,M,,";
    let sum = body.bytes().fold(0_u8, |sum, b| sum ^ b);
    let old = text.lines().nth(1).unwrap();
    assert_eq!(out, text.replace(old, &format!("${body}*{sum:02X}")));
    // A missing position gets one; one that is taken away leaves its cells empty.
    assert!(written(&track, "latitude", 2, Some(48.5)).unwrap().contains("$GPGGA,123521,4830.0000,N,,,0,00,"));
    assert!(written(&track, "longitude", 0, None).unwrap().contains("4807.038,N,,,1,08,"));
    assert!(track.notes.iter().any(|n| n.contains("no sentence tells the date")), "{:?}", track.notes);
}

#[test]
fn a_checksum_that_does_not_fit_is_said() {
    let text = "$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*00\n\
                $GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A\n";
    let track = loaded(text);
    assert!(
        track.notes.iter().any(|n| n.starts_with("1 sentence has a checksum that does not fit")),
        "{:?}",
        track.notes
    );
    assert!(track.time.full_label(0.0).starts_with("1994-03-23 12:35:19"));
}

#[test]
fn columns_of_a_fixed_width_stay() {
    let line =
        |sat: &str, x: &str| format!("P{sat}{x:>14}{:>14}{:>14}{:>14}\n", "20000.250000", "-5000.500000", "12.000000");
    let text = format!(
        "#cP2021  3  4  0  0  0.00000000       2 ORBIT IGS14 FIT  IGS\n*  2021  3  4  0  0  0.00000000\n{}*  2021  3  4  0 15  0.00000000\n{}EOF\n",
        line("G01", "-15000.123456"),
        line("G01", "0.123456")
    );
    let track = loaded(&text);
    let out = written(&track, "x@G01", 1, Some(-15001.5)).unwrap();
    assert_eq!(out, text.replace(&line("G01", "0.123456"), &line("G01", "-15001.500000")));
    let out = written(&track, "x@G01", 0, None).unwrap();
    assert_eq!(out, text.replace(&line("G01", "-15000.123456"), &line("G01", "0.000000")));
}
