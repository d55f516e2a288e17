use std::path::Path;

use super::super::{LoadOptions, Source, Standing, for_each_row, load};
use super::*;
use crate::error::{Error, Result};

/// What the usual programs made of `t,x\n0,1\n1,2\n2,3\n`: gzip 1.12, zstd 1.5, xz 5.4, bzip2 1.0.8 and, for zip, the
/// module `zipfile` of Python 3: packed, stored, and packed into a pipe, with the sizes after the data.
const FIRST: [(&str, &str); 7] = [
    ("gzip", "1f8b08000000000000032bd1a9e032d031e432d431e232d231e60200e41db67e10000000"),
    ("zstd", "28b52ffd2410810000742c780a302c310a312c320a322c330a05f62282"),
    (
        "xz",
        "fd377a585a000004e6d6b4460200210116000000742fe5a301000f742c780a302c310a312c320a322c330a0069b83eee8b9b8bb7000128\
         10e50b6c601fb6f37d010000000004595a",
    ),
    (
        "bzip2",
        "425a6839314159265359bc6f9833000007588000100004780004402000221ea68c8430226f369470003c5dc914e14242f1be60cc",
    ),
    (
        "zip",
        "504b030414000000080000002100e41db67e120000001000000005000000612e6373762bd1a9e032d031e432d431e232d231e60200504b\
         0102140314000000080000002100e41db67e1200000010000000050000000000000000000000800100000000612e637376504b05060000\
         00000100010033000000350000000000",
    ),
    (
        "zip",
        "504b030414000000000000002100e41db67e100000001000000005000000612e637376742c780a302c310a312c320a322c330a504b0102\
         140314000000000000002100e41db67e1000000010000000050000000000000000000000800100000000612e637376504b050600000000\
         0100010033000000330000000000",
    ),
    (
        "zip",
        "504b03041400080008000000210000000000000000000000000005000000612e6373762bd1a9e032d031e432d431e232d231e60200504b\
         0708e41db67e1200000010000000504b0102140314000800080000002100e41db67e120000001000000005000000000000000000000080\
         0100000000612e637376504b0506000000000100010033000000450000000000",
    ),
];

/// What they made of `3,4\n`.
const SECOND: [(&str, &str); 4] = [
    ("gzip", "1f8b080000000000000333d631e102003e2d72a904000000"),
    ("zstd", "28b52ffd2404210000332c340aaf867ee4"),
    (
        "xz",
        "fd377a585a000004e6d6b4460200210116000000742fe5a3010003332c340a003e5cc34b57693c0a00011c046f2c9cc11fb6f37d010000\
         000004595a",
    ),
    ("bzip2", "425a68393141592653592d9fe7360000015800001000040c002000219a68334d173c5dc914e14240b67f9cd8"),
];

fn bytes(hex: &str) -> Vec<u8> {
    (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16).unwrap()).collect()
}

fn source(bytes: &[u8]) -> Source {
    Source::BuiltIn { name: "test", bytes: bytes.into() }
}

fn failure(bytes: &[u8]) -> String {
    load(&source(bytes), &LoadOptions::default()).unwrap_err().to_string()
}

/// What `packing` makes of a text.
fn packed(packing: &Packing, text: &[u8]) -> Vec<u8> {
    let mut out = Vec::new();
    let mut packer = packing.pack(&mut out, "in").unwrap();
    packer.write_all(text).unwrap();
    packer.finish().unwrap();
    out
}

/// A zip archive of these files.
fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = ::zip::ZipWriter::new(io::Cursor::new(Vec::new()));
    for (name, text) in files {
        archive.start_file(*name, ::zip::write::SimpleFileOptions::default()).unwrap();
        archive.write_all(text).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn what_the_usual_programs_pack_is_read() {
    for (name, hex) in FIRST {
        let track = load(&source(&bytes(hex)), &LoadOptions::default()).unwrap();
        assert_eq!(track.dialect.packing.map(|p| p.name), Some(name));
        assert_eq!((track.rows, track.channels[0].values.as_slice()), (3, &[1.0, 2.0, 3.0][..]), "{name}");
        let mut cells = Vec::new();
        for_each_row(&track, |_, row| {
            cells.push(row.text(1).into_owned());
            Ok(())
        })
        .unwrap();
        assert_eq!(cells, ["1", "2", "3"], "{name}: read again");
    }
}

#[test]
fn packed_files_one_after_the_other_are_one_and_grow() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.packed");
    for ((name, first), (_, second)) in FIRST.into_iter().zip(SECOND) {
        std::fs::write(&path, bytes(first)).unwrap();
        let track = load(&Source::File(path.clone()), &LoadOptions::default()).unwrap();
        std::fs::write(&path, [bytes(first), bytes(second)].concat()).unwrap();
        assert_eq!(Standing::of(&track), Standing::Grown { rows: 1 }, "{name}");
        let track = load(&Source::File(path.clone()), &LoadOptions::default()).unwrap();
        assert_eq!(track.rows, 4, "{name}");
    }
    let skipped = [&b"\x50\x2a\x4d\x18\x03\0\0\0abc"[..], &bytes(FIRST[1].1)].concat();
    assert_eq!(load(&source(&skipped), &LoadOptions::default()).unwrap().rows, 3, "a frame to be skipped");
}

#[test]
fn nothing_can_be_appended_to_an_archive() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.zip");
    std::fs::write(&path, bytes(FIRST[4].1)).unwrap();
    let track = load(&Source::File(path.clone()), &LoadOptions::default()).unwrap();
    std::fs::write(&path, [bytes(FIRST[4].1), bytes(FIRST[5].1)].concat()).unwrap();
    assert_eq!(Standing::of(&track), Standing::Lost(super::super::Lost::Replaced));
}

#[test]
fn what_is_broken_is_named_and_no_text() {
    for (name, hex) in FIRST {
        let whole = bytes(hex);
        let e = failure(&whole[..whole.len() - 9]);
        assert!(e.contains(&format!("the {name} stream is broken")) && e.contains("fetch the file again"), "{e}");
        // One bit of the data in the middle.
        let mut spoilt = whole.clone();
        let at = match name {
            "zip" => 30 + 5 + 4,
            "xz" => 12 + 12 + 8,
            _ => whole.len() / 2,
        };
        spoilt[at] ^= 0x10;
        assert!(load(&source(&spoilt), &LoadOptions::default()).is_err(), "{name}");
    }
}

#[test]
fn a_text_of_many_pieces_comes_back_and_always_packs_alike() {
    let mut text = String::from("t,x\n");
    (0..120_000).for_each(|i| text += &format!("{i},{}\n", i * 7 % 1013));
    assert!(text.len() > 1 << 20, "more than a frame of zstd");
    for packing in PACKINGS.iter().filter(|packing| !packing.is_columnar()) {
        let small = packed(packing, &text.as_bytes()[..100_000]);
        assert_eq!(small, packed(packing, &text.as_bytes()[..100_000]), "{packing:?}");
        let out = packed(packing, text.as_bytes());
        assert!(out.len() < text.len() / 2, "{packing:?}: {}", out.len());
        assert_eq!(Packing::of(&out), Some(packing));
        let mut again = Vec::new();
        let opened = packing.unpack(Box::new(io::Cursor::new(&out)), Box::new(&out[..]), Want::default());
        opened.unwrap().text.read_to_end(&mut again).unwrap();
        assert!(again == text.as_bytes(), "{packing:?}");
        assert!(!packed(packing, b"").is_empty(), "{packing:?}: nothing is a file too");
    }
}

#[test]
fn an_archive_is_of_one_file() {
    let text = &b"t,x\n0,1\n1,2\n2,3\n"[..];
    let of_a_mac =
        archive(&[("r/", b""), ("r/a.csv", text), ("__MACOSX/r/._a.csv", b"\0\x05\x16"), ("r/.DS_Store", b"")]);
    assert_eq!(load(&source(&of_a_mac), &LoadOptions::default()).unwrap().rows, 3);
    let e = failure(&archive(&[("a.csv", text), ("b\x1b.csv", text)]));
    assert!(e.contains("a zip archive of 2 files: a.csv, b") && e.contains("unzip"), "{e}");
    assert!(!e.contains('\x1b'), "{e:?}");
    let many: Vec<String> = (0..20).map(|i| format!("{i}.csv")).collect();
    let e = failure(&archive(&many.iter().map(|name| (name.as_str(), text)).collect::<Vec<_>>()));
    assert!(e.contains("of 20 files: 0.csv, 1.csv,") && e.contains("7.csv, …") && !e.contains("8.csv"), "{e}");
    assert!(failure(&archive(&[])).contains("without a file"));
    let e = failure(&archive(&[("[Content_Types].xml", b"<"), ("xl/workbook.xml", b"<")]));
    assert!(e.contains("spreadsheet") && e.contains("soffice"), "{e}");
}

#[test]
fn what_of_an_archive_cannot_be_read_is_told() {
    // `zip -P` of Info-ZIP 3.0, and the module `zipfile` of Python 3 with `ZIP_BZIP2`.
    let with_a_password = "504b03040a00090000007a787e5de41db67e1c0000001000000005000000612e637376b0acee7d170c5945cac2254ca2\
         77cc2668e00f2e64f76f8a2c8bc4fe504b0708e41db67e1c00000010000000504b01021e030a00090000007a787e5de41db67e1c000000\
         10000000050000000000000001000000a48100000000612e637376504b05060000000001000100330000004f0000000000";
    let by_bzip2 = "504b03042e0000000c0000002100e41db67e340000001000000005000000612e637376425a6839314159265359bc6f983300\
         0007588000100004780004402000221ea68c8430226f369470003c5dc914e14242f1be60cc504b01022e032e0000000c0000002100e41d\
         b67e3400000010000000050000000000000000000000800100000000612e637376504b0506000000000100010033000000570000000000";
    let e = failure(&bytes(with_a_password));
    assert!(e.contains("with a password: a.csv") && e.contains("unzip"), "{e}");
    let e = failure(&bytes(by_bzip2));
    assert!(e.contains("which is not read") && e.contains("unzip"), "{e}");
}

#[test]
fn what_is_inside_is_looked_at_too() {
    let gzip = &PACKINGS[0];
    let e = failure(&packed(gzip, &bytes(FIRST[2].1)));
    assert!(e.contains("packed twice: xz in gzip") && e.contains("gunzip"), "{e}");
    let mut tar = vec![0; 512];
    tar[..5].copy_from_slice(b"a.csv");
    tar[257..262].copy_from_slice(b"ustar");
    let e = failure(&packed(gzip, &tar));
    assert!(e.contains("a tar archive") && e.contains("tar -xf"), "{e}");
}

#[test]
fn names_tell_how_an_output_is_packed() {
    for (name, expected) in [
        ("a.csv.gz", ("a.csv", Some("gzip"))),
        ("a.CSV.XZ", ("a.CSV", Some("xz"))),
        ("a.zip", ("a", Some("zip"))),
        (".gz", (".gz", None)),
        ("é.bz2", ("é", Some("bzip2"))),
        ("a.csv", ("a.csv", None)),
    ] {
        let (rest, packing) = unpacked_name(name);
        assert_eq!((rest, packing.map(|p| p.name)), expected);
    }
}

#[test]
fn a_file_that_is_not_there_stays_an_error_of_the_system() {
    let e = load(&Source::File(Path::new("nowhere.csv.xz").into()), &LoadOptions::default());
    assert!(matches!(e, Result::Err(Error::Io { .. })));
}
