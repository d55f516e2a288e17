use super::*;

/// A column of times and one of this type with these values in its first rows.
fn column_text(column: &str, put: Put) -> Vec<String> {
    let rows = match &put {
        Put::Bool(v) => v.len(),
        Put::I32(v) => v.len(),
        Put::I64(v) => v.len(),
        Put::I96(v) => v.len(),
        Put::F32(v) => v.len(),
        Put::F64(v) => v.len(),
        Put::Bytes(v) | Put::Fixed(v) => v.len(),
        Put::At(..) => unreachable!(),
    };
    let times = Put::F64((0..rows).map(|i| i as f64).collect());
    let numbers = Put::F64((0..rows).map(|i| (i * i % 7) as f64).collect());
    let schema = format!("message m {{ required double t; required double x; required {column}; }}");
    let text = as_text(&file(&schema, &[vec![times, numbers, put]], plain()));
    text.lines().skip(1).map(|line| line.splitn(3, ',').nth(2).unwrap().to_owned()).collect()
}

#[test]
fn every_type_has_its_text() {
    let f64s = Put::F64(vec![0.1, -0.0, 1e300, 1e-7, 100.0, f64::NAN, f64::INFINITY]);
    assert_eq!(column_text("double v", f64s), ["0.1", "-0", "1e300", "1e-7", "100", "NaN", "inf"]);
    // The shortest text of a number of 32 bits is not that of the same number in 64.
    assert_eq!(column_text("float v", Put::F32(vec![0.1, 16_777_216.0, 3.4e38])), ["0.1", "16777216", "3.4e38"]);
    let wide = vec![(1 << 53) + 1, i64::MIN, i64::MAX];
    assert_eq!(
        column_text("int64 v", Put::I64(wide)),
        ["9007199254740993", "-9223372036854775808", "9223372036854775807"]
    );
    assert_eq!(column_text("int64 v (UINT_64)", Put::I64(vec![-1, 5])), ["18446744073709551615", "5"]);
    assert_eq!(column_text("int32 v (UINT_32)", Put::I32(vec![-1, 5])), ["4294967295", "5"]);
    assert_eq!(column_text("int32 v (INTEGER(8,true))", Put::I32(vec![-128, 127])), ["-128", "127"]);
    assert_eq!(column_text("boolean v", Put::Bool(vec![true, false])), ["TRUE", "FALSE"]);
    assert_eq!(column_text("int32 v (DECIMAL(9,2))", Put::I32(vec![12345, -5, 0])), ["123.45", "-0.05", "0.00"]);
    assert_eq!(column_text("int64 v (DECIMAL(18,0))", Put::I64(vec![7, -7])), ["7", "-7"]);
    let bytes = vec![vec![0xff, 0x85], vec![0x04, 0xd2]];
    assert_eq!(column_text("fixed_len_byte_array(2) v (DECIMAL(4,2))", Put::Fixed(bytes.clone())), ["-1.23", "12.34"]);
    assert_eq!(column_text("binary v (DECIMAL(4,2))", Put::Bytes(bytes)), ["-1.23", "12.34"]);
    // 1.5 and -2 in IEEE 754 binary16.
    let half = vec![vec![0x00, 0x3e], vec![0x00, 0xc0]];
    assert_eq!(column_text("fixed_len_byte_array(2) v (FLOAT16)", Put::Fixed(half)), ["1.5", "-2"]);
    assert_eq!(
        column_text("int32 v (DATE)", Put::I32(vec![0, -1, 18_690])),
        ["1970-01-01", "1969-12-31", "2021-03-04"]
    );
    assert_eq!(column_text("int32 v (TIME(MILLIS,true))", Put::I32(vec![3_723_004])), ["01:02:03.004"]);
    assert_eq!(column_text("int64 v (TIME(NANOS,false))", Put::I64(vec![86_399_999_999_999])), ["23:59:59.999999999"]);
}

#[test]
fn timestamps_have_all_digits_of_their_unit_and_say_whether_they_are_moments() {
    let at = 1_614_852_000_123_i64;
    for (column, values, text) in [
        ("int64 v (TIMESTAMP(MILLIS,true))", vec![at], "2021-03-04T10:00:00.123Z"),
        ("int64 v (TIMESTAMP(MICROS,false))", vec![at * 1000 + 4], "2021-03-04T10:00:00.123004"),
        ("int64 v (TIMESTAMP(NANOS,true))", vec![at * 1_000_000 + 5], "2021-03-04T10:00:00.123000005Z"),
        ("int64 v (TIMESTAMP_MICROS)", vec![-1], "1969-12-31T23:59:59.999999Z"),
    ] {
        assert_eq!(column_text(column, Put::I64(values)), [text], "{column}");
    }
    // Impala: nanoseconds of the day, and the Julian day; 2,440,588 is 1970-01-01.
    assert_eq!(column_text("int96 v", Put::I96(vec![[1, 0, 2_440_588]])), ["1970-01-01T00:00:00.000000001"]);
}

#[test]
fn texts_are_quoted_where_a_cell_needs_it_and_bytes_are_digits() {
    let texts = Put::texts(&["a", "a,b", "say \"x\"", " pad", ""]);
    let quoted = ["a", "\"a,b\"", "\"say \"\"x\"\"\"", "\" pad\"", ""];
    assert_eq!(column_text("binary v (STRING)", texts.clone()), quoted);
    // Old writers say of no text that it is one.
    assert_eq!(column_text("binary v", texts)[..2], ["a", "\"a,b\""]);
    assert_eq!(column_text("binary v", Put::Bytes(vec![vec![0, 0xff], b"x\0y".to_vec()])), ["0x00ff", "0x780079"]);
    let uuid = vec![(0..16).collect()];
    assert_eq!(
        column_text("fixed_len_byte_array(16) v (UUID)", Put::Fixed(uuid)),
        ["00010203-0405-0607-0809-0a0b0c0d0e0f"]
    );
}

#[test]
fn every_row_is_a_row_whatever_it_holds() {
    let schema = "message m { optional binary s (STRING); optional double t; optional double x; }";
    let texts = Put::At(Box::new(Put::texts(&["#1", "//x", " % y"])), vec![0, 1, 1, 0, 1, 0], Vec::new());
    let there = [None, Some(1.0), Some(2.0), None, Some(4.0), None];
    let bytes = file(schema, &[vec![texts, Put::optional(&there), Put::optional(&there)]], plain());
    let track = track(&bytes);
    assert_eq!((track.rows, track.channels.len()), (6, 1));
    let missing: Vec<usize> = (0..6).filter(|row| track.channels[0].values[*row].is_nan()).collect();
    assert_eq!(missing, [0, 3, 5]);
    assert_eq!(as_text(&bytes), "s,t,x\nNaN,,\n\"#1\",1,1\n\"//x\",2,2\nNaN,,\n\" % y\",4,4\nNaN,,\n");
}

#[test]
fn names_need_not_be_words() {
    let names = ["t", "a, \"b\"", "x", "x", "# n", "two\nlines"];
    let field = |name: &&str| {
        let field = parquet::schema::types::Type::primitive_type_builder(name, parquet::basic::Type::DOUBLE);
        Arc::new(field.with_repetition(parquet::basic::Repetition::REQUIRED).build().unwrap())
    };
    let root = parquet::schema::types::Type::group_type_builder("m").with_fields(names.iter().map(field).collect());
    let mut writer =
        SerializedFileWriter::new(Vec::new(), Arc::new(root.build().unwrap()), Arc::new(plain().build())).unwrap();
    let mut group = writer.next_row_group().unwrap();
    for column in 0..names.len() {
        let mut writer = group.next_column().unwrap().unwrap();
        Put::F64((0..40).map(|i| f64::from(i) + column as f64).collect()).write(writer.untyped(), None);
        writer.close().unwrap();
    }
    group.close().unwrap();
    let bytes = writer.into_inner().unwrap();
    let track = track(&bytes);
    let read: Vec<&str> = track.columns.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(read, ["t", "a, \"b\"", "x", "x_2", "# n", "two lines"]);
    let copy = copy_of(&bytes, &changed(&[(3, 3, Some(-1.0))]));
    assert!(chunks(&copy)[0][2] == chunks(&bytes)[0][2] && chunks(&copy)[0][3] != chunks(&bytes)[0][3]);
}

#[test]
fn groups_are_read_flat_and_lists_are_named() {
    let schema = "message m { required double t; optional group pos { optional double x; required double y; }
        optional group l (LIST) { repeated group list { optional int64 element; } } }";
    let x = Put::At(Box::new(Put::F64(vec![1.0, 2.0])), vec![2, 1, 0, 2], Vec::new());
    let y = Put::At(Box::new(Put::F64(vec![5.0, 6.0, 8.0])), vec![1, 1, 0, 1], Vec::new());
    let list = Put::At(Box::new(Put::I64(vec![1, 2])), vec![3, 3, 1, 0, 2], vec![0, 1, 0, 0, 0]);
    let bytes = file(schema, &[vec![Put::F64(vec![0.0, 1.0, 2.0, 3.0]), x, y, list]], plain());
    assert_eq!(as_text(&bytes), "t,pos.x,pos.y\n0,1,5\n1,,6\n2,,\n3,2,8\n");
    let track = track(&bytes);
    assert!(track.notes.iter().any(|n| n.contains("`l`")), "{:?}", track.notes);
    let copy = copy_of(&bytes, &changed(&[(3, 1, Some(-2.0)), (3, 2, Some(7.0))]));
    assert_eq!(as_text(&copy), "t,pos.x,pos.y\n0,1,5\n1,,6\n2,,\n3,-2,7\n");
    assert_eq!(chunks(&copy)[0][3], chunks(&bytes)[0][3], "the list");
}
