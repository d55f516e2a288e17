use super::*;
use crate::error::Error;

fn failure(bytes: &[u8]) -> String {
    load(&source(bytes), &LoadOptions::default()).unwrap_err().to_string()
}

fn small() -> Vec<u8> {
    let schema = "message m { required double t; required double x; }";
    let numbers = Put::F64((0..50).map(f64::from).collect());
    file(schema, &[vec![numbers.clone(), numbers]], plain())
}

#[test]
fn what_cannot_be_read_is_said() {
    let whole = small();
    let mut locked = whole.clone();
    locked[..4].copy_from_slice(b"PARE");
    for (bytes, words) in [
        (&whole[..whole.len() / 2], "damaged or cut off"),
        (&whole[..whole.len() - 1], "damaged or cut off"),
        (&locked, "an encrypted Parquet file"),
    ] {
        let e = failure(bytes);
        assert!(e.contains(words) && e.contains("again"), "{e}");
    }
    let schema = "message m { required double t; required double x; }";
    let e = failure(&file(schema, &[], plain()));
    assert!(e.contains("no rows in them"), "{e}");
    let schema = "message m { required double t; required binary s (STRING); }";
    let e = failure(&file(schema, &[vec![Put::F64(vec![1.0, 2.0]), Put::texts(&["a", "b"])]], plain()));
    assert!(e.contains("no column of numbers besides the time"), "{e}");
    let schema = "message m { repeated double v; }";
    let e = failure(&file(schema, &[vec![Put::At(Box::new(Put::F64(vec![1.0])), vec![1], vec![0])]], plain()));
    assert!(e.contains("nested columns alone: v"), "{e}");
}

#[test]
fn encrypted_columns_are_named_though_the_footer_can_be_read() {
    // A group of the columns `a` and `b\u{1b}`, the second of which has a key of its own.
    let plain = [0x3c, 0x39, 0x18, 1, b'a', 0, 0];
    let locked = [0x8c, 0x2c, 0x19, 0x18, 2, b'b', 0x1b, 0, 0, 0];
    let footer = [&[0x49, 0x1c, 0x19, 0x2c][..], &plain, &locked, &[0, 0]].concat();
    let length = u32::try_from(footer.len()).unwrap().to_le_bytes();
    let e = failure(&[&b"PAR1"[..], &[0; 8], &footer, &length, b"PAR1"].concat());
    assert!(e.contains("a Parquet file with encrypted columns: `b") && e.contains("without encryption"), "{e}");
    assert!(!e.contains('\u{1b}'), "{e:?}");
}

#[test]
fn no_change_of_a_byte_is_more_than_an_error() {
    let whole = small();
    for at in 0..whole.len() {
        for bit in [0x01, 0x40, 0x80] {
            let mut spoilt = whole.clone();
            spoilt[at] ^= bit;
            let _ = load(&source(&spoilt), &LoadOptions::default());
        }
    }
    for end in 0..whole.len() {
        let _ = load(&source(&whole[..end]), &LoadOptions::default());
    }
}

#[test]
fn options_about_text_are_refused() {
    let options = LoadOptions { skip: Some(1), ..LoadOptions::default() };
    let e = load(&source(&small()), &options).unwrap_err();
    assert!(matches!(e, Error::Usage { .. }) && e.to_string().contains("--skip"), "{e}");
}

#[test]
fn a_text_that_begins_like_a_parquet_file_is_text() {
    let track = track(b"PAR1,x\n0,1\n1,2\n2,3\n");
    assert!(track.dialect.packing.is_none() && track.rows == 3);
}

#[test]
fn values_that_a_column_cannot_hold_are_refused() {
    let schema = "message m { required double t; optional group pos { optional double x; } }";
    let x = Put::At(Box::new(Put::F64(vec![1.0, 3.0])), vec![2, 0, 2], Vec::new());
    let bytes = file(schema, &[vec![Put::F64(vec![0.0, 1.0, 2.0]), x]], plain());
    let filled = write_columns(&track(&bytes), &changed(&[(1, 1, Some(2.0))]), None, &mut Vec::new());
    let e = filled.unwrap_err().to_string();
    assert!(e.contains("`pos.x`") && e.contains("group that is null") && e.contains(".csv"), "{e}");
}
