use super::*;

const ROWS: usize = 40;

/// Three row groups of a time, doubles with nulls, whole numbers and texts, in pages of a few rows, as no copy has them.
fn three_groups(form: WriterPropertiesBuilder) -> Vec<u8> {
    let form = form.set_data_page_row_count_limit(9).set_write_batch_size(3);
    let schema = "message m { required int64 time (TIMESTAMP(MICROS,true)); optional double x; required int64 n;
        required binary s (STRING); }";
    let group = |first: usize| {
        let rows = first..first + ROWS;
        let x: Vec<Option<f64>> = rows.clone().map(|i| (i % 7 != 3).then_some(i as f64 / 8.0)).collect();
        vec![
            Put::I64(rows.clone().map(|i| 1_614_852_000_000_000 + i as i64 * 500_000).collect()),
            Put::optional(&x),
            Put::I64(rows.clone().map(|i| (1 << 53) + 1 + i as i64).collect()),
            Put::Bytes(rows.map(|i| format!("s{}", i % 3).into_bytes()).collect()),
        ]
    };
    file(schema, &[group(0), group(ROWS), group(2 * ROWS)], form)
}

#[test]
fn only_the_chunks_of_changed_cells_change() {
    let keys = vec![KeyValue::new("owner".to_owned(), "me".to_owned())];
    let forms =
        [Compression::UNCOMPRESSED, Compression::SNAPPY, Compression::GZIP(Default::default()), Compression::LZ4_RAW];
    for form in forms {
        for version in [WriterVersion::PARQUET_1_0, WriterVersion::PARQUET_2_0] {
            for dictionary in [true, false] {
                let properties = plain()
                    .set_compression(form)
                    .set_writer_version(version)
                    .set_dictionary_enabled(dictionary)
                    .set_created_by("somebody else".into())
                    .set_key_value_metadata(Some(keys.clone()));
                let bytes = three_groups(properties);
                let changes = changed(&[(5, 1, Some(-1.5)), (50, 1, None), (50, 2, Some(7.4)), (51, 2, Some(1e30))]);
                let copy = copy_of(&bytes, &changes);
                let (before, after) = (chunks(&bytes), chunks(&copy));
                let differs = |group: usize, leaf: usize| before[group][leaf] != after[group][leaf];
                let differing: Vec<(usize, usize)> =
                    (0..3).flat_map(|g| (0..4).map(move |l| (g, l))).filter(|(g, l)| differs(*g, *l)).collect();
                assert_eq!(differing, [(0, 1), (1, 1), (1, 2)], "{form:?} {version:?}");
                let mut lines: Vec<String> = as_text(&bytes).lines().map(str::to_owned).collect();
                let mut edit = |row: usize, column: usize, text: &str| {
                    let mut cells: Vec<&str> = lines[row + 1].split(',').collect();
                    cells[column] = text;
                    lines[row + 1] = cells.join(",");
                };
                edit(5, 1, "-1.5");
                edit(50, 1, "");
                edit(50, 2, "7");
                edit(51, 2, "9223372036854775807");
                assert_eq!(as_text(&copy), lines.join("\n") + "\n", "{form:?} {version:?}");
                let reader = SerializedFileReader::new(Bytes::from(copy)).unwrap();
                let about = reader.metadata().file_metadata();
                assert_eq!((about.key_value_metadata(), about.created_by()), (Some(&keys), Some("somebody else")));
                let codec = reader.metadata().row_group(1).column(1).compression();
                assert_eq!(std::mem::discriminant(&codec), std::mem::discriminant(&form));
            }
        }
    }
}

#[test]
fn a_copy_without_changes_is_the_same_table_in_the_same_chunks() {
    let bytes = three_groups(plain());
    let copy = copy_of(&bytes, &Changes::default());
    assert!(chunks(&bytes) == chunks(&copy));
    assert_eq!(copy, copy_of(&bytes, &Changes::default()), "and the same bytes each time");
}

/// What pyarrow 26 wrote of t = 0, 1, 2 (int32) and x = 1, null, 3 (double) by Zstandard, in data pages of the first
/// and of the second version.
const BY_PYARROW: [&str; 2] = [
    "504152311500152415362c15061500150615061c00000028b52ffd20129100000200000006010000000001000000020000001500152c153e2c1506\
     1500150615061c00000028b52ffd2016b10000020000000305000000000000f03f00000000000008401504193c35001806736368656d6115040015\
     02250218017400150a2502180178001606191c192c26001c15021925060019180174150c1606164a165c2608491c150015001502003c2906192600\
     0600000026001c150a1925060019180178150c1606165216642664491c150015001502003c290619260204000000169c011606260816a001002820\
     706172717565742d6370702d6172726f772076657273696f6e2032362e302e31192c1c00001c000000b100000050415231",
    "504152311506151c151c5c150615001506150015041500121c00000006010000000001000000020000001506152415245c1506150215061500150\
     41500121c0000000305000000000000f03f00000000000008401504193c35001806736368656d611504001502250218017400150a2502180178001\
     606191c192c26001c15021925060019180174150c1606164c164c2608491c150015001502003c29061926000600000026001c150a1925060019180\
     178150c1606165416542654491c150015001502003c29061926020400000016a0011606260816a001002820706172717565742d6370702d6172726\
     f772076657273696f6e2032362e302e31192c1c00001c000000b100000050415231",
];

#[test]
fn zstandard_is_unpacked_and_packed_without_a_library_of_c() {
    for hex in BY_PYARROW {
        let bytes: Vec<u8> =
            (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect();
        assert_eq!(as_text(&bytes), "t,x\n0,1\n1,\n2,3\n");
        let copy = copy_of(&bytes, &changed(&[(2, 1, Some(9.5))]));
        assert_eq!(as_text(&copy), "t,x\n0,1\n1,\n2,9.5\n");
        assert_eq!(chunks(&copy)[0][0], chunks(&bytes)[0][0]);
        let schema = Schema::of(&access::FileBytes::Memory(&copy)).unwrap();
        assert!(matches!(schema.metadata.row_group(0).column(1).compression(), Compression::ZSTD(_)));
        // A library that knows no Zstandard finds none in it.
        let chunk = schema.chunk(&access::FileBytes::Memory(&copy), 0, 1).unwrap();
        assert!(chunk.bytes.windows(4).any(|w| w == b"\x28\xb5\x2f\xfd") || hex.contains("15041500"), "packed");
    }
}

#[test]
fn the_first_null_of_a_column_makes_it_nullable_and_floats_become_nan() {
    let schema = "message m { required double t; required int32 n (INTEGER(16,true)) = 7; required float f; }";
    let rows = || (0..ROWS).map(|i| i as f64);
    let columns = vec![
        Put::F64(rows().collect()),
        Put::I32((0..ROWS as i32).map(|i| i * i % 11).collect()),
        Put::F32(rows().map(|v| (v / 3.0) as f32).collect()),
    ];
    let bytes =
        file(schema, &[columns.clone(), vec![Put::F64(vec![99.0]), Put::I32(vec![1]), Put::F32(vec![2.0])]], plain());
    let copy = copy_of(&bytes, &changed(&[(2, 1, None), (4, 1, Some(1e9)), (3, 2, None)]));
    let lines: Vec<String> = as_text(&copy).lines().map(str::to_owned).collect();
    assert_eq!(&lines[3..6], ["2,,0.6666667", "3,9,NaN", "4,32767,1.3333334"]);
    let reader = SerializedFileReader::new(Bytes::from(copy.clone())).unwrap();
    let field = |i: usize| reader.metadata().file_metadata().schema().get_fields()[i].clone();
    assert!(field(1).is_optional() && !field(2).is_optional());
    assert_eq!(field(1).get_basic_info().id(), 7);
    assert!(chunks(&copy)[1][2] == chunks(&bytes)[1][2], "the floats of the other group");
}

#[test]
fn new_rows_stand_in_every_column_with_the_time_of_the_file() {
    let bytes = three_groups(plain());
    let new = |after_row, seconds| NewRow { after_row, seconds, cells: vec![(1, 0.5)] };
    let changes = Changes { cells: Vec::new(), rows: vec![new(0, 0.25), new(45, 22.75)] };
    let copy = copy_of(&bytes, &changes);
    let text = as_text(&copy);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[2], "2021-03-04T10:00:00.250000Z,0.5,,");
    assert_eq!(lines[48], "2021-03-04T10:00:22.750000Z,0.5,,");
    assert_eq!(lines.len(), 1 + 3 * ROWS + 2);
    let schema = Schema::of(&access::FileBytes::Memory(&copy)).unwrap();
    let rows: Vec<i64> = schema.metadata.row_groups().iter().map(|g| g.num_rows()).collect();
    assert_eq!(rows, [41, 41, 40]);
    assert!(chunks(&copy)[2][1] == chunks(&bytes)[2][1], "nothing is new in the last group");
}

#[test]
fn signed_zeros_and_nan_stay_beside_a_change() {
    let schema = "message m { required double t; optional double x; }";
    let values = [Some(-0.0), Some(f64::NAN), None, Some(f64::from_bits(0x7ff8_0000_0000_0001)), Some(4.0)];
    let bytes = file(schema, &[vec![Put::F64((0..5).map(f64::from).collect()), Put::optional(&values)]], plain());
    let copy = copy_of(&bytes, &changed(&[(4, 1, Some(5.0))]));
    let file = access::FileBytes::Memory(&copy);
    let schema = Schema::of(&file).unwrap();
    let chunk = schema.chunk(&file, 0, 1).unwrap();
    let ColumnReader::DoubleColumnReader(mut reader) =
        column_reader(chunk, schema.metadata.row_group(0).column(1), 5).unwrap()
    else {
        panic!("doubles");
    };
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    reader.read_records(5, Some(&mut levels), None, &mut values).unwrap();
    let bits: Vec<u64> = values.iter().map(|v| v.to_bits()).collect();
    assert_eq!(levels, [1, 1, 0, 1, 1]);
    assert_eq!(bits, [(-0.0_f64).to_bits(), f64::NAN.to_bits(), 0x7ff8_0000_0000_0001, 5.0_f64.to_bits()]);
}
