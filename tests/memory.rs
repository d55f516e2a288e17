//! Files that are small and want much: the limit of memory is told before it is passed.

#![cfg(unix)]
#![expect(clippy::unwrap_used, reason = "a failed expectation is a failed test")]
#![expect(dead_code, reason = "a module that is shared by test programs")]

mod program;

use std::io::Write as _;

use program::Folder;

/// Rows of which each packs to next to nothing, and a head before them: the first part of a bomb, and one that repeats.
fn parts() -> [Vec<u8>; 2] {
    [b"t,x\n0,1\n1,2\n2,1\n".to_vec(), "3,1\n".repeat(1 << 18).into_bytes()]
}

/// The parts packed by `pack`, the second of them `times` times.
fn joined(pack: impl Fn(&[u8]) -> Vec<u8>, times: usize) -> Vec<u8> {
    let [first, rest] = parts().map(|part| pack(&part));
    [first, rest.repeat(times)].concat()
}

/// The same text as the one file of a zip archive.
fn zipped(times: usize) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    archive.start_file("bomb.csv", zip::write::SimpleFileOptions::default()).unwrap();
    let [first, rest] = parts();
    archive.write_all(&first).unwrap();
    (0..times).for_each(|_| archive.write_all(&rest).unwrap());
    archive.finish().unwrap().into_inner()
}

#[test]
fn whatever_packs_a_text_is_held_to_the_memory() {
    let zstd = |text: &[u8]| ruzstd::encoding::compress_to_vec(text, ruzstd::encoding::CompressionLevel::Fastest);
    let xz = |text: &[u8]| {
        let mut packer = lzma_rust2::XzWriter::new(Vec::new(), lzma_rust2::XzOptions::with_preset(0)).unwrap();
        packer.write_all(text).unwrap();
        packer.finish().unwrap()
    };
    let bzip2 = |text: &[u8]| {
        let mut packer = bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::fast());
        packer.write_all(text).unwrap();
        packer.finish().unwrap()
    };
    for (name, packed) in
        [("zstd", joined(zstd, 32)), ("xz", joined(xz, 32)), ("bzip2", joined(bzip2, 32)), ("zip", zipped(32))]
    {
        assert!(packed.len() < 400_000, "{name}: {}", packed.len());
        let folder = Folder::with(&[("bomb", &packed)]);
        refused(&folder, "inspect bomb --memory 20M");
        let ran = folder.run("inspect bomb --memory 1G");
        assert!(ran.status == 0 && ran.out.contains(name), "{name}: {}{}", ran.out, ran.err);
    }
}

/// Packs `rows` rows of which each packs to next to nothing.
fn bomb(rows: usize) -> Vec<u8> {
    let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    packer.write_all(b"t,x\n0,1\n1,2\n2,1\n").unwrap();
    let block = "3,1\n".repeat(1 << 16);
    for _ in 0..rows >> 16 {
        packer.write_all(block.as_bytes()).unwrap();
    }
    packer.finish().unwrap()
}

fn refused(folder: &Folder, words: &str) {
    let ran = folder.run(words);
    assert_eq!((ran.status, ran.out.as_str()), (2, ""), "{words}: {}", ran.err);
    assert!(
        ran.err.contains("of memory that the program may use") && ran.err.contains("--memory"),
        "{words}: {}",
        ran.err
    );
}

#[test]
fn what_unpacks_to_more_than_there_is_memory_is_refused() {
    let packed = bomb(8 << 20);
    assert!(packed.len() < 200_000, "{}", packed.len());
    let folder = Folder::with(&[("bomb.csv.gz", &packed)]);
    refused(&folder, "inspect bomb.csv.gz --memory 100M");
    // Latin-1 and UTF-16 are read whole.
    refused(&folder, "inspect bomb.csv.gz --memory 20M --encoding latin-1");
    assert_eq!(folder.run("inspect bomb.csv.gz --memory 1G").status, 0);
}

#[test]
fn a_line_longer_than_there_is_memory_is_refused() {
    let folder = Folder::with(&[("long.csv", &vec![b'7'; 40 << 20])]);
    refused(&folder, "inspect long.csv --memory 30M");
    let mut text = b"t,x\n".to_vec();
    (0..100_000).for_each(|i| writeln!(text, "{i},{}", i % 7).unwrap());
    text.extend(vec![b'7'; 40 << 20]);
    std::fs::write(folder.path("long.csv"), text).unwrap();
    refused(&folder, "inspect long.csv --memory 30M");
}

#[test]
fn a_row_of_more_cells_than_tables_have_is_refused_at_once() {
    let folder = Folder::with(&[("wide.csv", "1,".repeat(5_000_000).as_bytes())]);
    let ran = folder.run("inspect wide.csv");
    assert_eq!((ran.status, ran.out.as_str()), (2, ""));
    assert!(ran.err.contains("wide.csv:1: more than 100000 cells in a row"), "{}", ran.err);
}

#[test]
fn a_session_is_refused_by_its_size() {
    let text = format!("format = 2\n# {}\n", "x".repeat(2 << 20));
    let folder = Folder::with(&[("s.toml", text.as_bytes())]);
    refused(&folder, "replay s.toml --memory 100M");
    assert!(folder.run("replay s.toml").err.contains("missing field"), "small enough to be read");
    let file = std::fs::File::create(folder.path("huge.toml")).unwrap();
    file.set_len(1 << 40).unwrap();
    assert!(folder.run("replay huge.toml").err.contains("too many for a session"));
}

#[test]
fn what_a_method_takes_is_counted_too() {
    let mut text = String::from("t,x\n");
    (0..300_000_u64).for_each(|i| text.push_str(&format!("{i},{}\n", i * 7919 % 1000)));
    let folder = Folder::with(&[("a.csv", text.as_bytes())]);
    for words in ["clean a.csv", "sweep a.csv --method hampel", "compare a.csv"] {
        refused(&folder, &format!("{words} --memory 25M"));
    }
    assert_eq!(folder.run("clean a.csv --memory 200M").status, 0);
    let ran = folder.run("inspect a.csv --memory lots");
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("500M or 4G"), "{}", ran.err);
}
