use parquet::basic::Type;

use super::*;

/// The columns of a file: name, physical and logical type.
fn columns(bytes: &[u8]) -> Vec<(String, Type, String)> {
    let reader = SerializedFileReader::new(Bytes::copy_from_slice(bytes)).unwrap();
    let descriptor = reader.metadata().file_metadata().schema_descr_ptr();
    let column = |c: &parquet::schema::types::ColumnDescPtr| {
        (c.name().to_owned(), c.physical_type(), format!("{:?}", c.logical_type_ref()))
    };
    descriptor.columns().iter().map(column).collect()
}

#[test]
fn the_columns_of_a_text_have_the_types_that_they_are_understood_to_have() {
    let mut text = String::from("# kept nowhere\nzeit;x_m;n;id;wer\n");
    (0..30).for_each(|i| {
        text += &format!(
            "04.03.2021 10:00:{i:02},25;{};{};007;\"a;{i}\"\n",
            if i == 4 { "-".into() } else { format!("{i},5") },
            i % 2
        );
    });
    let copy = copy_of(text.as_bytes(), &changed(&[(7, 1, Some(1.25))]));
    let told = columns(&copy);
    let names: Vec<(&str, Type)> = told.iter().map(|(name, physical, _)| (name.as_str(), *physical)).collect();
    let (whole, bytes) = (Type::INT64, Type::BYTE_ARRAY);
    assert_eq!(names, [("zeit", whole), ("x_m", Type::DOUBLE), ("n", whole), ("id", bytes), ("wer", bytes)]);
    assert!(told[0].2.contains("Timestamp") && told[0].2.contains("MICROS") && told[0].2.contains("false"), "{told:?}");
    let lines: Vec<String> = as_text(&copy).lines().map(str::to_owned).collect();
    assert_eq!(lines[0], "zeit,x_m,n,id,wer");
    assert_eq!(lines[4 + 1], "2021-03-04T10:00:04.250000,,0,007,a;4");
    // With the decimals of its column, as in text.
    assert_eq!(lines[7 + 1], "2021-03-04T10:00:07.250000,1.2,1,007,a;7");
}

#[test]
fn times_are_moments_where_the_text_says_so() {
    let rows = |time: &dyn Fn(u32) -> String| {
        let lines: String = (0..30).map(|i| format!("{},{}\n", time(i), i * i % 7)).collect();
        format!("time,x\n{lines}")
    };
    let zoned = columns(&copy_of(rows(&|i| format!("2021-03-04T10:00:{i:02}+01:00")).as_bytes(), &Changes::default()));
    assert!(zoned[0].2.contains("true"), "{zoned:?}");
    let fine = rows(&|i| format!("2021-03-04T10:00:{i:02}.123456789Z"));
    let copy = copy_of(fine.as_bytes(), &Changes::default());
    assert!(columns(&copy)[0].2.contains("NANOS"), "{:?}", columns(&copy));
    assert!(as_text(&copy).contains("2021-03-04T10:00:07.123456789Z"));
    let seconds = rows(&|i| format!("{}.25", 100 + i));
    let copy = copy_of(seconds.as_bytes(), &Changes::default());
    assert_eq!(columns(&copy)[0].1, Type::DOUBLE);
    assert!(as_text(&copy).contains("\n103.25,2\n"));
    // A time that comes again is still the time of its row.
    let again = rows(&|i| format!("2021-03-04T10:00:{:02}Z", i / 2));
    let copy = copy_of(again.as_bytes(), &Changes::default());
    assert_eq!(as_text(&copy).matches("2021-03-04T10:00:05.000000Z").count(), 2);
}

#[test]
fn new_rows_and_tracks_of_a_text_are_rows_of_the_table() {
    let text = "time,x\n0,1\n1,2\n3,4\n4,5\n";
    let rows = vec![NewRow { after_row: 1, seconds: 2.0, cells: vec![(1, 3.0)] }];
    let copy = copy_of(text.as_bytes(), &Changes { cells: Vec::new(), rows });
    assert_eq!(as_text(&copy), "time,x\n0,1\n1,2\n2,3\n3,4\n4,5\n");
    let mut tracks = String::from("time,sat,range_m\n");
    (0..40).for_each(|i| tracks += &format!("{},{},{}\n", i / 2, ["G01", "G02"][i % 2], 100 * (i % 2 + 1) + i));
    let options = LoadOptions { track: Some("sat".into()), ..LoadOptions::default() };
    let track = load(&source(tracks.as_bytes()), &options).unwrap();
    let mut out = Vec::new();
    write_columns(&track, &changed(&[(3, 2, Some(7.0))]), None, &mut out).unwrap();
    assert_eq!(as_text(&out), tracks.replace("1,G02,203", "1,G02,7"));
}
