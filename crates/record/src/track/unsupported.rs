//! Files that are text and no table: refused by name, with the way out.

use std::path::Path;

use super::head::Head;
use crate::error::{Error, Result};

/// Refuses what is clearly another kind of file, from its first bytes.
///
/// # Errors
/// [`Error::Input`] naming what the file seems to be.
pub(crate) fn refuse_other_formats(body: &[u8], path: &Path) -> Result<()> {
    let start = body.trim_ascii_start();
    let line = 1 + body[..body.len() - start.len()].iter().filter(|b| **b == b'\n').count() as u64;
    let refuse = |what: &str, help: &str| {
        Err(Error::Input { path: path.to_path_buf(), line: Some(line), what: what.into(), help: help.into() })
    };
    match start {
        [] => Err(Error::input(path, "the file is empty", "name a file with a header and rows of numbers")),
        [b'$' | b'!', talker @ ..] if is_nmea(talker) => refuse(
            "NMEA sentences, not a table",
            "convert it first, for example: gpsbabel -i nmea -f IN -o unicsv -F OUT.csv",
        ),
        [b'h' | b'H', b'1', b' ' | b'\t', rest @ ..] if rest.trim_ascii_start().starts_with(b"CRD") => refuse(
            "a laser ranging file (CRD), which has records of many kinds, not a table",
            "write the normal points (records 11: seconds of day, time of flight) as a CSV file: awk '$1 == 11 {print $2 \",\" $3}'",
        ),
        [b'<', ..] => refuse("markup (XML or HTML), not a table", "export the record as CSV"),
        [b'{', ..] => refuse("JSON, not a table", "export the record as CSV, one row for each time"),
        _ if is_mesh(start) => refuse("a mesh, not a table", "export the record as CSV"),
        _ => Ok(()),
    }
}

/// The first lines of PLY, or of STL in text.
fn is_mesh(start: &[u8]) -> bool {
    let mut lines = start.split(|b| *b == b'\n').map(<[u8]>::trim_ascii);
    match (lines.next(), lines.next()) {
        (Some(b"ply"), Some(format)) => format.starts_with(b"format "),
        (Some(solid), Some(facet)) => solid.starts_with(b"solid") && facet.starts_with(b"facet normal"),
        _ => false,
    }
}

/// A kind of file that is not a text file: how its bytes begin (after this many others), what it is, and what converts
/// it.
struct Binary {
    at: usize,
    begins: &'static [u8],
    name: &'static str,
    help: &'static str,
    /// True where this build reads it.
    read: bool,
}

/// True in a build that reads files of arrays.
const ARRAYS: bool = cfg!(feature = "hdf5");
const NETCDF_HELP: &str = "a build with --features hdf5 reads it; or write its variables as text: ncdump -v NAME FILE, or in Python: xarray.open_dataset('FILE').to_dataframe().to_csv('OUT.csv')";

/// What analysts have besides text.
const BINARIES: [Binary; 20] = [
    Binary {
        at: 0,
        begins: b"\xd0\xcf\x11\xe0",
        name: "an old Excel spreadsheet (xls)",
        help: "export the sheet as CSV: soffice --convert-to csv FILE",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"ARROW1",
        name: "an Arrow (Feather) file",
        help: "write it as CSV, in Python: pandas.read_feather('FILE').to_csv('OUT.csv')",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"\x89HDF\r\n\x1a\n",
        name: "an HDF5 file (NetCDF-4 is also such a file)",
        help: "a build with --features hdf5 reads it; or write the variables as CSV: h5dump -d /NAME FILE, or ncdump -v NAME FILE",
        read: ARRAYS,
    },
    Binary { at: 0, begins: b"CDF\x01", name: "a NetCDF file", help: NETCDF_HELP, read: ARRAYS },
    Binary { at: 0, begins: b"CDF\x02", name: "a NetCDF file (64-bit offsets)", help: NETCDF_HELP, read: ARRAYS },
    Binary { at: 0, begins: b"CDF\x05", name: "a NetCDF file (64-bit sizes)", help: NETCDF_HELP, read: ARRAYS },
    Binary {
        at: 0,
        begins: b"MATLAB 7.3 MAT",
        name: "a MAT file (version 7.3)",
        help: "a build with --features hdf5 reads it; or write the variable as CSV, in Matlab: writematrix(x, 'OUT.csv'); in Python: h5py.File('FILE')",
        read: ARRAYS,
    },
    Binary {
        at: 0,
        begins: b"MATLAB 5.0 MAT-file",
        name: "a MAT file (version 5)",
        help: "write the variable as CSV, in Matlab: writematrix(x, 'OUT.csv'); in Python: scipy.io.loadmat",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"TDSm",
        name: "a TDMS file of LabVIEW",
        help: "write it as CSV, in Python: nptdms.TdmsFile('FILE').as_dataframe().to_csv('OUT.csv')",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"ULog\x01\x12\x35",
        name: "a flight log of PX4 (ULog)",
        help: "write it as CSV files: ulog2csv FILE (pip install pyulog)",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"\x89MCAP0\r\n",
        name: "an MCAP recording",
        help: "write a topic as CSV with the mcap tool: mcap cat --topics TOPIC --json FILE",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"#ROSBAG V",
        name: "a ROS bag",
        help: "write a topic as CSV: rostopic echo -b FILE -p /TOPIC > OUT.csv",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"SQLite format 3\0",
        name: "an SQLite database (ROS 2 bags are also such files)",
        help: "write a table as CSV: sqlite3 -header -csv FILE 'select * from TABLE' > OUT.csv",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"\xa3\x95\x80",
        name: "a binary flight log of ArduPilot",
        help: "write it as text: mavlogdump.py --types GPS --format csv FILE > OUT.csv (pip install pymavlink)",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"MDF     ",
        name: "an MDF measurement file (mf4)",
        help: "write it as CSV, in Python: asammdf.MDF('FILE').export('csv')",
        read: false,
    },
    Binary {
        at: 0,
        begins: b"\xb5\x62",
        name: "messages of a u-blox receiver (UBX)",
        help: "convert them first: convbin or pyubx2 (gnssdump FILE)",
        read: false,
    },
    Binary {
        at: 257,
        begins: b"ustar",
        name: "a tar archive",
        help: "unpack it (tar -xf FILE) and name one of the files in it",
        read: false,
    },
    Binary { at: 0, begins: b"7z\xbc\xaf\x27\x1c", name: "a 7z archive", help: "unpack it: 7z x FILE", read: false },
    Binary {
        at: 0,
        begins: b"%PDF-",
        name: "a PDF document",
        help: "export the record as CSV from the program that printed it",
        read: false,
    },
    Binary {
        at: 8,
        begins: b".FIT",
        name: "a FIT file of a sports watch",
        help: "convert it: gpsbabel -i garmin_fit -f FILE -o unicsv -F OUT.csv",
        read: false,
    },
];

/// What is not a text file and is refused by its name: what it is, and what converts it.
pub fn refused() -> impl Iterator<Item = (&'static str, &'static str)> {
    BINARIES.iter().map(|b| (b.name, b.help)).chain([(ASTERIX, ASTERIX_HELP)])
}

const ASTERIX: &str = "radar messages (ASTERIX)";
const ASTERIX_HELP: &str =
    "convert it first, for example with asterix (pip install asterix_decoder), and write the plots as CSV";

/// ASTERIX: a category, a length of two bytes that leads to the next category, and no text.
fn is_asterix(bytes: &[u8]) -> bool {
    let [category, high, low, ..] = bytes else { return false };
    let length = usize::from(*high) << 8 | usize::from(*low);
    let next = bytes.get(length);
    let known = |c: &u8| matches!(c, 1 | 2 | 8 | 10 | 11 | 19 | 20 | 21 | 23 | 30 | 34 | 48 | 62 | 65 | 247);
    known(category)
        && length > 5
        && (next.is_some_and(known) || bytes.len() == length)
        && bytes[..bytes.len().min(64)].contains(&0)
}

/// Refuses what is not a text file by its name, from its first bytes as they are stored.
///
/// # Errors
/// [`Error::Input`] naming what it is and what converts it.
pub(crate) fn refuse_binaries(stored: &[u8], path: &Path) -> Result<()> {
    let found =
        BINARIES.iter().filter(|b| !b.read).find(|b| stored.get(b.at..).is_some_and(|s| s.starts_with(b.begins)));
    if let Some(binary) = found {
        return Err(Error::input(path, format!("{}, not a table of text", binary.name), binary.help));
    }
    if is_asterix(stored) {
        return Err(Error::input(path, format!("{ASTERIX}, not a table of text"), ASTERIX_HELP));
    }
    Ok(())
}

/// Five letters or digits and a comma: talker and kind of an NMEA 0183 sentence.
fn is_nmea(talker: &[u8]) -> bool {
    talker.len() > 5 && talker[..5].iter().all(u8::is_ascii_alphanumeric) && talker[5] == b','
}

/// Refuses the long form, in which each row names the series that its value belongs to.
///
/// # Errors
/// [`Error::Input`] naming the columns.
pub(crate) fn refuse_long_form(head: &Head, path: &Path) -> Result<()> {
    let place = |wanted: &[&str]| head.names.iter().position(|n| wanted.iter().any(|w| n.eq_ignore_ascii_case(w)));
    let series = place(&["series", "variable", "metric"]);
    let (Some(series), Some(time), Some(value)) = (series, place(&["timestamp", "time"]), place(&["value"])) else {
        return Ok(());
    };
    if head.names.len() > 5 {
        return Ok(());
    }
    let name = |c: usize| super::printable(&head.names[c]);
    Err(Error::Input {
        path: path.to_path_buf(),
        line: Some(head.header_line),
        what: format!("a long table: each row gives one {} of the series in `{}`", name(value), name(series)),
        help: format!(
            "pivot it to one row for each `{}` with a column for each series, for example in pandas: \
             pivot(index='{}', columns='{}', values='{}'); or read each series as a track of its own: --track '{}'",
            name(time),
            name(time),
            name(series),
            name(value),
            name(series)
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_are_no_text_are_named_with_what_converts_them() {
        for binary in BINARIES.iter().filter(|b| !b.read) {
            let mut bytes = vec![b'x'; binary.at];
            bytes.extend_from_slice(binary.begins);
            let e = refuse_binaries(&bytes, Path::new("x")).unwrap_err().to_string();
            assert!(e.contains(binary.name) && e.contains(binary.help), "{e}");
        }
        // Two records of category 48 of eight bytes each.
        let asterix = [48, 0, 8, 0xfd, 1, 2, 0, 3, 48, 0, 8, 0xfd, 1, 2, 0, 4];
        assert!(refuse_binaries(&asterix, Path::new("x")).unwrap_err().to_string().contains("ASTERIX"));
        for text in [&b"time,x\n0,1\n"[..], b"0\t1\n", b"# c\n", b"", b"\x1f\x8b\x08"] {
            assert!(refuse_binaries(text, Path::new("x")).is_ok());
        }
    }

    #[test]
    fn other_formats_are_named() {
        for (text, name) in [
            ("$GNRMC,021417.00,A,3725.58362,N\n", ":1: NMEA"),
            ("\n\nh1 CRD  1 2016  2 13 14\n", ":3: a laser ranging file"),
            ("<?xml version=\"1.0\"?>", "markup"),
            ("{\"a\": 1}", "JSON"),
            ("ply\nformat ascii 1.0\n", "a mesh"),
            ("solid wing\n facet normal 0 0 1\n", "a mesh"),
            (" \n", "the file is empty"),
        ] {
            let e = refuse_other_formats(text.as_bytes(), Path::new("x")).unwrap_err().to_string();
            assert!(e.contains(name), "{e}");
        }
        for table in ["time,x\n", "solid content,time\n1,2\n", "ply,t\n0,1\n", "$1,2\n", "h1 h2\n", "1,2\n"] {
            assert!(refuse_other_formats(table.as_bytes(), Path::new("x")).is_ok(), "{table}");
        }
    }
}
