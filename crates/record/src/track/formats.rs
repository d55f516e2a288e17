//! Formats that are known by name: what their files say of themselves in other places than a line of names.

use super::LoadOptions;

mod cnv;
mod dwd;
mod iaga;
mod ndbc;
mod oem;
mod sbs1;
mod stk;
mod surfrad;

/// A format, one row for each.
#[derive(Debug)]
pub struct Format {
    /// Its name.
    pub name: &'static str,
    /// What its files are.
    pub about: &'static str,
    /// True for the first lines of such a file.
    known: fn(&str) -> bool,
    /// Completes what the user told by what such files are known to have.
    complete: fn(&str, &mut LoadOptions),
}

/// All of them, in the order in which they are tried.
pub static FORMATS: [Format; 8] =
    [cnv::FORMAT, oem::FORMAT, stk::FORMAT, iaga::FORMAT, sbs1::FORMAT, ndbc::FORMAT, dwd::FORMAT, surfrad::FORMAT];

/// How much of a file is looked at.
const LOOKED_AT: usize = 64 << 10;

/// The format of a file, by the first bytes of its text.
#[must_use]
pub fn format_of(body: &[u8]) -> Option<(&'static Format, String)> {
    let text = String::from_utf8_lossy(&body[..body.len().min(LOOKED_AT)]).into_owned();
    FORMATS.iter().find(|format| (format.known)(&text)).map(|format| (format, text))
}

/// What the user told, completed by what the format of the file is known to have.
pub(crate) fn completed(body: &[u8], options: &LoadOptions) -> (LoadOptions, Option<&'static Format>) {
    let mut completed = options.clone();
    let Some((format, text)) = format_of(body) else { return (completed, None) };
    (format.complete)(&text, &mut completed);
    (completed, Some(format))
}

/// Names for the columns, unless the user told some.
fn name(options: &mut LoadOptions, names: &[&str]) {
    if options.names.is_empty() && options.header_line.is_none() {
        options.names = names.iter().map(|n| (*n).to_owned()).collect();
    }
}

/// Markers for "no value" besides those that the user told.
fn missing(options: &mut LoadOptions, markers: &[&str]) {
    options.missing.extend(markers.iter().map(|m| (*m).to_owned()));
}

#[cfg(test)]
mod tests {
    use super::super::{Source, Track, load};
    use super::*;

    fn loaded(text: &str) -> Track {
        load(&Source::BuiltIn { name: "test", bytes: text.as_bytes().into() }, &LoadOptions::default()).unwrap()
    }

    fn channels(track: &Track) -> Vec<&str> {
        track.channels.iter().map(|c| c.name.as_str()).collect()
    }

    #[test]
    fn each_format_names_its_columns() {
        let rows = |row: &dyn Fn(usize) -> String| (0..30).map(row).collect::<String>();
        let cnv = "* Sea-Bird SBE 9 Data File:\n# name 0 = timeS: Time, Elapsed [seconds]\n# name 1 = t090C: Temperature [ITS-90, deg C]\n# bad_flag = -9.990e-29\n*END*\n";
        let cnv = loaded(&format!(
            "{cnv}{}",
            rows(&|i| format!(
                "{:11.3} {:>11}\n",
                i as f64 * 0.25,
                if i == 7 { "-9.990e-29".into() } else { format!("{}.5", i * i % 7) }
            ))
        ));
        assert_eq!((cnv.time.name.as_str(), channels(&cnv)), ("timeS", vec!["t090C"]));
        assert_eq!(cnv.columns[1].missing, 1);
        let oem = loaded(&format!(
            "CCSDS_OEM_VERS = 2.0\nMETA_START\nOBJECT_NAME = S\nMETA_STOP\nCOMMENT words of text\n{}",
            rows(&|i| format!(
                "2021-03-04T10:{i:02}:00 {} {}.5 {} 1.{i} 2.{i} 3.{i}\n",
                7000 + i * i,
                i * 3 % 11,
                i * 7 % 13
            ))
        ));
        assert_eq!((oem.rows, &channels(&oem)[..3]), (30, &["X", "Y", "Z"][..]));
        let sbs = loaded(&rows(&|i| {
            format!(
                "MSG,3,1,1,{},1,2021/03/04,10:00:{i:02}.000,2021/03/04,10:00:{i:02}.010,,{},,,51.{i},-1.{i},,,0,,0,0\n",
                if i % 2 == 0 { "4CA1B2" } else { "3C6444" },
                30_000 + i * i
            )
        }));
        assert!(channels(&sbs).contains(&"Altitude@4CA1B2"), "{:?}", channels(&sbs));
        let ndbc = loaded(&format!(
            "#YY  MM DD hh mm WSPD  TIDE\n#yr  mo dy hr mn m/s    ft\n{}",
            rows(&|i| format!("2021 03 04 10 {i:02} {}.5 MM\n", i * i % 9))
        ));
        assert_eq!((channels(&ndbc), ndbc.columns[6].missing), (vec!["WSPD"], 30));
    }
}
