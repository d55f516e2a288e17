//! What column names tell: units, times, truth; and finding a column by what a user typed.

use std::collections::HashSet;

use super::calendar::{DAY, SECOND};
use crate::error::{Error, Result, nearest};

pub(crate) mod earlier;

/// Ends of names that are units, and the units as people write them.
const UNITS: [(&str, &str); 56] = [
    ("m", "m"),
    ("km", "km"),
    ("cm", "cm"),
    ("mm", "mm"),
    ("ft", "ft"),
    ("nmi", "nmi"),
    ("mi", "mi"),
    ("s", "s"),
    ("sec", "s"),
    ("secs", "s"),
    ("seconds", "s"),
    ("ms", "ms"),
    ("millis", "ms"),
    ("milliseconds", "ms"),
    ("us", "us"),
    ("micros", "us"),
    ("microseconds", "us"),
    ("ns", "ns"),
    ("nanos", "ns"),
    ("nanoseconds", "ns"),
    ("min", "min"),
    ("minutes", "min"),
    ("h", "h"),
    ("hours", "h"),
    ("days", "d"),
    ("mjd", "d"),
    ("mps", "m/s"),
    ("mps2", "m/s2"),
    ("kmh", "km/h"),
    ("kmps", "km/s"),
    ("fps", "ft/s"),
    ("fpm", "ft/min"),
    ("kt", "kt"),
    ("kts", "kt"),
    ("mph", "mph"),
    ("deg", "deg"),
    ("rad", "rad"),
    ("dps", "deg/s"),
    ("pa", "Pa"),
    ("hpa", "hPa"),
    ("kpa", "kPa"),
    ("mbar", "mbar"),
    ("c", "degC"),
    ("degc", "degC"),
    ("k", "K"),
    ("v", "V"),
    ("mv", "mV"),
    ("hz", "Hz"),
    ("khz", "kHz"),
    ("mhz", "MHz"),
    ("db", "dB"),
    ("dbhz", "dB-Hz"),
    ("ntu", "NTU"),
    ("mgl", "mg/L"),
    ("uscm", "uS/cm"),
    ("psu", "psu"),
];

/// Those that the rules of [`super::Rules::Second`] know besides.
const MORE_UNITS: [(&str, &str); 20] = [
    ("second", "s"),
    ("millisecond", "ms"),
    ("msec", "ms"),
    ("msecs", "ms"),
    ("microsecond", "us"),
    ("usec", "us"),
    ("usecs", "us"),
    ("nanosecond", "ns"),
    ("nsec", "ns"),
    ("minute", "min"),
    ("mins", "min"),
    ("hour", "h"),
    ("hrs", "h"),
    ("hr", "h"),
    ("day", "d"),
    ("d", "d"),
    ("knots", "kt"),
    ("meter", "m"),
    ("metre", "m"),
    ("degrees", "deg"),
];

/// True for a unit that names may end with.
pub(crate) fn is_unit(text: &str) -> bool {
    known_unit(text).is_some()
}

fn known_unit(text: &str) -> Option<&'static str> {
    UNITS.iter().chain(&MORE_UNITS).find(|(end, _)| text.eq_ignore_ascii_case(end)).map(|(_, unit)| *unit)
}

/// The unit that a name ends with (`alt_ft`, `east(m)`, `salt [psu]`); empty where it does not.
pub(crate) fn unit_of(name: &str) -> String {
    let name = name.trim();
    let bracketed =
        |open, close| name.strip_suffix(close).and_then(|n: &str| n.rsplit_once(open)).map(|(_, unit)| unit.trim());
    if let Some(unit) = bracketed('[', ']') {
        // A device (`[X16-5]`) or a station is no unit.
        let device = unit.contains(|c: char| c.is_ascii_digit()) && !unit.contains(['/', '^', '²', '³', '-', '*', '°']);
        let device = device
            || unit.split(['-', ' ']).any(|w| {
                w.len() > 1 && w.contains(|c: char| c.is_ascii_digit()) && w.contains(|c: char| c.is_ascii_uppercase())
            });
        return if device && known_unit(unit).is_none() { String::new() } else { unit.to_owned() };
    }
    if let Some(unit) = bracketed('(', ')') {
        return known_unit(unit).or(unit.contains('/').then_some(unit)).unwrap_or_default().to_owned();
    }
    // A name that is nothing but a unit (`v`, `hPa`) is a quantity.
    if known_unit(name).is_some() {
        return String::new();
    }
    let end = name.rsplit_once(['_', ' ']).map(|(_, end)| end);
    if let Some(end) = end.filter(|e| e.contains('/') || e.starts_with('°') && e.chars().count() <= 3) {
        return end.to_owned();
    }
    // `PRES.hPa` ends with hectopascals, `TimeNanos` with nanoseconds.
    let dotted = name
        .rsplit(|c: char| !c.is_alphanumeric())
        .next()
        .filter(|end| end.len() < name.len() && known_unit(end).is_some());
    let end = end.or(dotted).or_else(|| words(name).get(1..)?.last().copied());
    // `igniter_c` counts igniters, `Batt_Min` is the least of a battery's voltages.
    let lower = name.to_lowercase();
    let of_temperature = lower.contains("temp");
    let of_time =
        time_rank_of(&lower) || ["duration", "interval", "age", "delay", "elapsed"].iter().any(|w| lower.contains(w));
    let fits = |e: &&str| match e.to_ascii_lowercase().as_str() {
        "c" | "k" => of_temperature,
        "min" | "mins" | "d" | "day" | "hour" | "hr" | "second" | "minute" => of_time,
        _ => true,
    };
    end.filter(fits).and_then(known_unit).unwrap_or_default().to_owned()
}

/// True where the first word of a name, in lower case, says time.
fn time_rank_of(lower: &str) -> bool {
    let first = words(lower).first().map_or("", |w| *w);
    TIMES.contains(&first) || first == "t"
}

/// The words of a name: parts between punctuation, and `camelCase` parts.
pub(crate) fn words(name: &str) -> Vec<&str> {
    let mut words = Vec::new();
    for part in name.split(|c: char| !c.is_alphanumeric()) {
        let mut start = 0;
        let mut before = ' ';
        for (at, c) in part.char_indices() {
            if c.is_uppercase() && before.is_lowercase() {
                words.push(&part[start..at]);
                start = at;
            }
            before = c;
        }
        words.push(&part[start..]);
    }
    words.retain(|w| !w.is_empty());
    words
}

/// Words for times, in lower case, in the languages that records are written in.
const TIMES: [&str; 31] = [
    "time",
    "times",
    "timestamp",
    "timestamps",
    "datetime",
    "utc",
    "utctime",
    "datetimes",
    "tmstamp",
    "timestmp",
    "gpst",
    "gpstime",
    "时间",
    "时刻",
    "日時",
    "時刻",
    "zeit",
    "zeitstempel",
    "uhrzeit",
    "temps",
    "heure",
    "horodatage",
    "fecha",
    "hora",
    "tiempo",
    "tijd",
    "tijdstip",
    "czas",
    "tid",
    "время",
    "ora",
];

/// Words for dates and for what is counted from one.
const DATES: [&str; 18] = [
    "epoch",
    "date",
    "unix",
    "unixtime",
    "datum",
    "mjd",
    "jd",
    "julian",
    "datenum",
    "dates",
    "dato",
    "дата",
    "日期",
    "decyear",
    "yyyymmdd",
    "yyyymmddhhmm",
    "yyyymmddhh",
    "yymmdd",
];

/// Words in the names of years with decimals.
const YEARS: [&str; 8] = ["year", "yyyy", "decimal", "dec", "fractional", "frac", "years", "fraction"];

/// Names that are times where nothing else stands in them, and their values go forward.
const SHORT_TIMES: [&str; 25] = [
    "ms",
    "msec",
    "milliseconds",
    "microseconds",
    "nanoseconds",
    "us",
    "usec",
    "micros",
    "t",
    "ts",
    "tow",
    "sec",
    "secs",
    "seconds",
    "elapsed",
    "stamp",
    "hours",
    "days",
    "day",
    "millis",
    "itow",
    "sow",
    "met",
    "hhmmss",
    "year",
];

/// Words in the names of columns that tell tracks apart.
const IDS: [&str; 17] = [
    "id", "flight", "station", "svid", "sv", "prn", "sat", "beacon", "bird", "callsign", "icao24", "series", "sensor",
    "target", "track", "object", "channel",
];

/// True for a word that tells tracks apart.
pub(crate) fn is_id_word(word: &str) -> bool {
    IDS.iter().any(|id| word.eq_ignore_ascii_case(id))
}

/// Words for what tells how well another column is known.
const SPREADS: [&str; 22] = [
    "sig",
    "sigma",
    "std",
    "stdev",
    "stddev",
    "sd",
    "sdev",
    "stderr",
    "err",
    "error",
    "uncertainty",
    "unc",
    "precision",
    "accuracy",
    "rms",
    "rmse",
    "variance",
    "cov",
    "dop",
    "hdop",
    "vdop",
    "pdop",
];

/// True for the name of a column that tells how well another is known: `sig_e(m)`, `alt_std`.
#[must_use]
pub fn is_spread(name: &str) -> bool {
    words(name).iter().any(|word| SPREADS.iter().any(|spread| word.eq_ignore_ascii_case(spread)))
}

/// True for a name that says "id" and nothing else: `flight_id`, `SVID`, `sensor no`, but not `target_range_m`.
#[must_use]
pub fn is_id(name: &str) -> bool {
    let counts = |word: &str| ["no", "nr", "number"].iter().any(|n| word.eq_ignore_ascii_case(n));
    let words = words(name);
    words.iter().any(|word| is_id_word(word)) && words.iter().all(|word| is_id_word(word) || counts(word))
}

/// True for names of stations and devices in other spellings: `STATIONS_ID`, `MMSI`, `device_id`.
pub(crate) fn is_id_name(name: &str) -> bool {
    const MORE: [&str; 24] = [
        "stations",
        "stationid",
        "stationsid",
        "stn",
        "mmsi",
        "imei",
        "imo",
        "serial",
        "node",
        "device",
        "vehicle",
        "tag",
        "individual",
        "site",
        "buoy",
        "float",
        "platform",
        "norad",
        "mac",
        "hex",
        "icao",
        "icao24",
        "ident",
        "squawk",
    ];
    let words = words(name);
    let known = |w: &&str| is_id_word(w) || MORE.iter().any(|m| w.eq_ignore_ascii_case(m));
    let counts = |w: &&str| {
        ["no", "nr", "number", "code", "name", "local", "identifier"].iter().any(|n| w.eq_ignore_ascii_case(n))
    };
    // `device_id`, but not `device_temp`.
    !words.is_empty() && words.iter().any(known) && words.iter().all(|w| known(w) || counts(w))
}

/// True for the name of GPS time, of its weeks or of their seconds.
pub(crate) fn is_gps_time(name: &str) -> bool {
    let lower: String = name.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect();
    lower.contains("tow") && (lower.contains("gps") || lower.len() <= 6) || lower == "gpsweek" || lower == "gpssec"
}

/// How much a name says "time": 4 certainly, 0 not at all.
pub(crate) fn time_rank(name: &str) -> u8 {
    let words: Vec<String> = words(name).iter().map(|w| w.to_lowercase()).collect();
    let Some(first) = words.first() else { return 0 };
    let is_time = |w: &str| TIMES.contains(&w);
    let is_date = |w: &str| DATES.contains(&w);
    let without_unit = match words.split_last() {
        Some((last, rest)) if !rest.is_empty() && known_unit(last).is_some() => rest,
        _ => &words[..],
    };
    let last = without_unit.last().unwrap_or(first);
    let of_year = words.len() > 1
        && words.iter().any(|w| matches!(w.as_str(), "year" | "yyyy"))
        && words.iter().all(|w| YEARS.contains(&w.as_str()));
    if is_time(first) {
        4
    } else if is_time(last) || is_date(first) || is_date(last) || of_year {
        3
    } else if name.eq_ignore_ascii_case("x_value")
        || words.iter().any(|w| is_time(w))
        || (without_unit.len() == 1 && SHORT_TIMES.contains(&first.as_str()))
    {
        2
    } else {
        0
    }
}

/// True for `truth`, `truth_outlier`, `do_truth`, ….
pub(crate) fn is_truth(name: &str) -> bool {
    earlier::is_truth(name) || name.eq_ignore_ascii_case("is_outlier")
}

/// Nanoseconds in one unit of time of this name.
pub(crate) fn time_unit_ns(unit: &str) -> Option<i64> {
    nanoseconds_in(known_unit(unit).unwrap_or(unit))
}

fn nanoseconds_in(unit: &str) -> Option<i64> {
    Some(match unit {
        "ns" => 1,
        "us" => 1_000,
        "ms" => 1_000_000,
        "s" => SECOND,
        "min" => 60 * SECOND,
        "h" => 3_600 * SECOND,
        "d" => DAY,
        _ => return None,
    })
}

/// The names made unique (`altitude`, `altitude_2`), and the nameless named `column_3`.
pub(crate) fn unique(names: Vec<String>) -> Vec<String> {
    let mut taken: HashSet<String> = names.iter().cloned().collect();
    let mut seen = HashSet::new();
    let fresh = |stem: &str, first: usize, taken: &HashSet<String>| {
        (first..).map(|n| format!("{stem}_{n}")).find(|n| !taken.contains(n)).unwrap_or_default()
    };
    let mut unique = Vec::with_capacity(names.len());
    for (index, name) in names.into_iter().enumerate() {
        let name = if name.is_empty() {
            fresh("column", index + 1, &taken)
        } else if seen.contains(&name) {
            fresh(&name, 2, &taken)
        } else {
            name
        };
        taken.insert(name.clone());
        seen.insert(name.clone());
        unique.push(name);
    }
    unique
}

/// Where the column stands that `wanted` means: its name, or `#` and its number from 1.
pub(crate) fn place<'a>(mut names: impl Iterator<Item = &'a str> + Clone, wanted: &str) -> Option<usize> {
    let count = names.clone().count();
    names.position(|n| n == wanted).or_else(|| numbered(wanted)?.checked_sub(1).filter(|index| *index < count))
}

fn numbered(wanted: &str) -> Option<usize> {
    wanted.strip_prefix('#')?.parse().ok()
}

/// The column that a user named: by its name, or as `#3` counted from 1.
///
/// # Errors
/// [`Error::Usage`] with the names there are and the nearest.
pub(crate) fn find<'a>(names: impl Iterator<Item = &'a str> + Clone, wanted: &str) -> Result<usize> {
    if let Some(index) = place(names.clone(), wanted) {
        return Ok(index);
    }
    let count = names.clone().count();
    if numbered(wanted).is_some() {
        return Err(Error::usage(format!("there is no column {wanted}"), format!("columns are #1 to #{count}")));
    }
    let mut help = match nearest(wanted, names.clone()) {
        Some(near) => format!("did you mean `{}`? ", super::printable(near)),
        None => String::new(),
    };
    const SHOWN: usize = 30;
    let shown: Vec<String> = names.take(SHOWN).map(super::printable).collect();
    help.push_str(&format!("the columns are {}", shown.join(", ")));
    if count > SHOWN {
        help.push_str(&format!(" and {} more", count - SHOWN));
    }
    Err(Error::usage(format!("there is no column `{}`", super::printable(wanted)), help))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_a_place_and_a_name_goes_before_it() {
        let names = ["t", "#1", "x"].into_iter();
        assert_eq!(place(names.clone(), "#1"), Some(1));
        assert_eq!(place(names.clone(), "#3"), Some(2));
        for none in ["#0", "#4", "y", "#", "#x"] {
            assert_eq!(place(names.clone(), none), None, "{none}");
        }
    }

    #[test]
    fn units_are_the_ends_of_names() {
        for (name, unit) in [
            ("alt_ft", "ft"),
            ("vx_mps", "m/s"),
            ("_latitude(deg)", "deg"),
            ("sandi.790.A.CTD [psu]", "psu"),
            ("CO(GT)", ""),
            ("temperature", ""),
            ("speed (km/h)", "km/h"),
            ("v", ""),
            ("TimeNanos", "ns"),
            ("ph", ""),
            ("igniter_c", ""),
            ("baro_temp_c", "degC"),
        ] {
            assert_eq!(unit_of(name), unit, "{name}");
        }
    }

    #[test]
    fn names_of_times_are_known() {
        for (name, rank) in [
            ("time", 4),
            ("time_s", 4),
            ("time PST", 4),
            ("TimeNanos", 4),
            ("timestamp", 4),
            ("gps_time", 3),
            ("date", 3),
            ("epoch_ms", 3),
            ("t", 2),
            ("t_s", 2),
            ("timer", 0),
            ("altitude", 0),
            ("ElapsedRealtimeMillis", 0),
            ("", 0),
        ] {
            assert_eq!(time_rank(name), rank, "{name}");
        }
    }

    #[test]
    fn names_become_unique_without_taking_one_that_is_there() {
        let names = ["a", "a", "a_2", "", "a"].map(String::from).to_vec();
        assert_eq!(unique(names), ["a", "a_3", "a_2", "column_4", "a_4"]);
    }

    #[test]
    fn columns_are_found_by_name_or_number() {
        let names = ["time", "alt_m"];
        assert_eq!(find(names.into_iter(), "alt_m").unwrap(), 1);
        assert_eq!(find(names.into_iter(), "#2").unwrap(), 1);
        let e = find(names.into_iter(), "alt").unwrap_err().to_string();
        assert!(e.contains("no column `alt`") && e.contains("the columns are time, alt_m"), "{e}");
        assert!(find(names.into_iter(), "tine").unwrap_err().to_string().contains("did you mean `time`"));
        assert!(find(names.into_iter(), "#3").is_err() && find(names.into_iter(), "#0").is_err());
    }
}
