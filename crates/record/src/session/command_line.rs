//! The command that does without a screen what a session says.

use std::fmt::Write as _;
use std::path::Path;

use super::{DEFAULT_METHOD, OutputValue, Plan, Preparation, Preset, Session, Setup, suggested};
use crate::param::Settings;
use crate::repair;
use crate::track::{LoadOptions, Pattern, Rules, Source, Track, Worded, is_shown};

/// The command for a POSIX shell that writes to `output` what `session` gives: `wildpoint clean` with what differs
/// from the preset in force. None where no `clean` says the same, and only the saved session does: with decisions,
/// with channels that are set up differently, for the built-in record, or when loading takes an option that only
/// sessions have.
#[must_use]
pub fn clean_command(session: &Session, track: &Track, output: &Path) -> Option<String> {
    let first = session.plans.first()?;
    let like_first = |p: &Plan| p.setup.clone().prepared(&first.setup.preparation) == first.setup;
    let alike = session.plans.iter().all(|p| p.decisions.is_empty() && like_first(p));
    let Source::File(record) = &session.data.source else { return None };
    if !alike {
        return None;
    }
    let mut line = format!("wildpoint clean {}", path_quoted(record));
    loading(&mut line, &session.data.options)?;
    for Plan { channel, .. } in &session.plans {
        option(&mut line, "channel", channel);
    }
    let preset = judging(&mut line, &first.setup);
    preparing(&mut line, session, track, preset)?;
    if let Some(word) = session.value.word().filter(|_| session.value != OutputValue::default()) {
        option(&mut line, "output-value", word);
    }
    let _ = write!(line, " -o {}", path_quoted(output));
    Some(line)
}

/// The command that writes to `output` what the session file `session` gives.
#[must_use]
pub fn replay_command(session: &Path, output: &Path) -> String {
    format!("wildpoint replay {} -o {}", path_quoted(session), path_quoted(output))
}

/// The options of loading; none when there is one that the command line cannot say.
fn loading(line: &mut String, options: &LoadOptions) -> Option<()> {
    let only_in_sessions =
        options.decimal_comma == Some(false) || options.header == Some(true) || options.quotes == Some(true);
    // By other rules the command would understand another record.
    let only_in_sessions = only_in_sessions || options.rules != Rules::default();
    if only_in_sessions {
        return None;
    }
    for (name, value) in [("time", &options.time), ("track", &options.track), ("truth", &options.truth)] {
        if let Some(value) = value {
            option(line, name, value);
        }
    }
    options.missing.iter().for_each(|text| option(line, "missing", text));
    let words = [
        ("delimiter", options.delimiter.map(Worded::word)),
        ("encoding", options.encoding.map(Worded::word)),
        ("time-unit", options.time_unit.map(Worded::word)),
    ];
    for (name, word) in words.into_iter().filter_map(|(name, word)| Some((name, word?))) {
        option(line, name, word?);
    }
    let switches = [
        ("decimal-comma", options.decimal_comma == Some(true)),
        ("no-header", options.header == Some(false)),
        ("no-quotes", options.quotes == Some(false)),
    ];
    for (name, _) in switches.into_iter().filter(|(_, on)| *on) {
        let _ = write!(line, " --{name}");
    }
    let numbers = [
        ("header-line", options.header_line),
        ("skip", options.skip),
        ("units-line", options.units_line),
        ("table", options.table),
    ];
    for (name, number) in numbers.into_iter().filter_map(|(name, number)| Some((name, number?))) {
        let _ = write!(line, " --{name} {number}");
    }
    let texts = [
        ("time-format", options.time_format.as_ref().map(Pattern::text)),
        ("time-zone", options.time_zone.as_deref()),
        ("comment", options.comment.as_deref()),
    ];
    for (name, text) in texts.into_iter().filter_map(|(name, text)| Some((name, text?))) {
        option(line, name, text);
    }
    if !options.names.is_empty() {
        option(line, "names", &options.names.join(","));
    }
    if let Some(day_first) = options.day_first {
        option(line, "dates", if day_first { "day-first" } else { "month-first" });
    }
    Some(())
}

/// Method and repair, with the preset that leaves least to say.
fn judging(line: &mut String, setup: &Setup) -> Preset {
    let differing = |preset: Preset| differences(&setup.settings, &preset.settings(setup.method));
    let (default, paper) = (differing(Preset::Default), differing(Preset::Paper));
    if setup.method.about().id != DEFAULT_METHOD {
        option(line, "method", setup.method.about().id);
    }
    let (preset, least) = if paper.len() < default.len() {
        option(line, "preset", "paper");
        (Preset::Paper, paper)
    } else {
        (Preset::Default, default)
    };
    if let Some(rate) = &setup.rate {
        option(line, "rate", rate);
    }
    least.iter().for_each(|pair| option(line, "set", pair));
    let of_repair = differences(&setup.repair, &Settings::defaults(repair::PARAMS));
    for pair in &of_repair {
        match pair.strip_prefix(repair::METHOD.key).and_then(|rest| rest.strip_prefix('=')) {
            Some(id) => option(line, "repair", id),
            None => option(line, "set", pair),
        }
    }
    preset
}

/// What is done with the channels before: nothing need be said of what `clean` does by itself. None where it is not the
/// same for all channels, or names channels in a way that the command line cannot.
fn preparing(line: &mut String, session: &Session, track: &Track, preset: Preset) -> Option<()> {
    let by_itself = |plan: &Plan| match (preset, track.channel(&plan.channel)) {
        (Preset::Default, Some(channel)) => suggested(channel),
        _ => Preparation::default(),
    };
    // Without decisions there are none to exclude.
    let done = |plan: &Plan| Preparation { exclude_decided: false, ..plan.setup.preparation.clone() };
    let all: Vec<(Preparation, Preparation)> = session.plans.iter().map(|p| (done(p), by_itself(p))).collect();
    if all.iter().any(|(done, own)| done.checks != own.checks) {
        let checks = all.first().map(|(done, _)| done.checks.as_slice()).unwrap_or_default();
        let sayable = |name: &String| !name.contains([',', '=']);
        let plain = checks.iter().all(|c| c.on && c.channels.iter().all(sayable));
        if !plain || all.iter().any(|(done, _)| done.checks != checks) {
            return None;
        }
        if checks.is_empty() {
            option(line, "check", "none");
        }
        checks.iter().for_each(|check| option(line, "check", &check.to_string()));
    }
    if all.iter().any(|(done, own)| done.period != own.period) {
        let period = |done: &Preparation| done.period.map_or("off".to_owned(), |p| format!("{p:?}"));
        let first = all.first().map(|(done, _)| period(done))?;
        if all.iter().any(|(done, _)| period(done) != first) {
            return None;
        }
        option(line, "period", &first);
    }
    Some(())
}

/// `key=value` for each value that is another one.
fn differences(settings: &Settings, from: &Settings) -> Vec<String> {
    let other = settings.iter().zip(from.iter()).filter(|((_, a), (_, b))| a != b);
    other.map(|((param, value), _)| format!("{}={value}", param.key)).collect()
}

fn option(line: &mut String, name: &str, value: &str) {
    // A value that begins like an option is told from one by the sign before it.
    let sign = if value.starts_with('-') { '=' } else { ' ' };
    let _ = write!(line, " --{name}{sign}{}", quoted(value));
}

/// A path as a word of the shell, bytes that are no UTF-8 included.
fn path_quoted(path: &Path) -> String {
    let path = if path.as_os_str().as_encoded_bytes().starts_with(b"-") { &Path::new(".").join(path) } else { path };
    if let Some(text) = path.to_str() {
        return quoted(text);
    }
    let octal = |bytes: &[u8]| bytes.iter().map(|byte| format!("\\{byte:03o}")).collect::<String>();
    let part = |chunk: std::str::Utf8Chunk<'_>| {
        chunk.valid().chars().map(escaped).collect::<String>() + &octal(chunk.invalid())
    };
    format!("$'{}'", path.as_os_str().as_encoded_bytes().utf8_chunks().map(part).collect::<String>())
}

/// A text as one word of a POSIX shell, in characters that a terminal shows as they are: with any other in it, in the
/// form `$'...'` (POSIX.1-2024; bash, zsh, ksh, busybox). A shell that does not know that form takes the word for
/// another name, but runs nothing in it.
#[must_use]
pub fn quoted(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_./:=,+@%-".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        return text.to_owned();
    }
    if text.chars().all(is_shown) {
        return format!("'{}'", text.replace('\'', "'\\''"));
    }
    format!("$'{}'", text.chars().map(escaped).collect::<String>())
}

/// A character between `$'` and `'`: what ends the word, begins an escape or is not shown is written as its bytes in
/// octal digits. Three of them, since no digit after those can belong to them.
fn escaped(c: char) -> String {
    if is_shown(c) && !"'\\".contains(c) {
        return c.to_string();
    }
    c.encode_utf8(&mut [0; 4]).bytes().map(|byte| format!("\\{byte:03o}")).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::LazyLock;

    use super::*;
    use crate::track::load;

    static TRACK: LazyLock<Track> = LazyLock::new(|| load(&Source::demo(), &LoadOptions::default()).unwrap());

    #[test]
    fn words_of_the_shell_stay_one_word() {
        for (text, word) in [
            ("alt_m", "alt_m"),
            ("", "''"),
            ("speed [m/s]", "'speed [m/s]'"),
            ("it's $HOME", "'it'\\''s $HOME'"),
            ("高度", "'高度'"),
            ("~/a", "'~/a'"),
            ("#3", "'#3'"),
        ] {
            assert_eq!(quoted(text), word);
        }
        assert_eq!(path_quoted(Path::new("-rf")), "./-rf");
    }

    #[test]
    fn what_a_terminal_would_obey_or_hide_is_written_in_digits() {
        for (text, word) in [
            ("a\x15touch b\r\n", "$'a\\025touch b\\015\\012'"),
            ("\x1b]52;it's\\", "$'\\033]52;it\\047s\\134'"),
            ("\u{202e}csv", "$'\\342\\200\\256csv'"),
            ("\u{9b}1", "$'\\302\\2331'"),
            ("e\u{301}", "'e\u{301}'"),
        ] {
            assert_eq!(quoted(text), word);
        }
    }

    proptest::proptest! {
        /// Whatever the names are, nothing in the command is obeyed by a terminal or ends the line.
        #[test]
        fn no_command_has_a_control_character(names in proptest::array::uniform6(".{0,12}"), bytes: [u8; 4]) {
            let hostile = |name: &String| format!("{name}{}", String::from_utf8_lossy(&bytes));
            let [record, output, channel, time, missing, rate] = names.each_ref().map(hostile);
            let mut setup = Setup::standard();
            setup.rate = Some(rate);
            let options = LoadOptions { time: Some(time.clone()), track: Some(time.clone()), truth: Some(time),
                missing: vec![missing], ..LoadOptions::default() };
            let data = super::super::Data { source: Source::File(record.clone().into()), sha256: String::new(), bytes: None, record_was: None, rows: 1,
                row_check: None, options };
            let plan = Plan { channel, setup, decisions: crate::review::Decisions::default() };
            let session = Session { data, plans: vec![plan], value: OutputValue::Clean, result: None };
            let output = Path::new(&output);
            for line in [clean_command(&session, &TRACK, output).unwrap(), replay_command(Path::new(&record), output)] {
                proptest::prop_assert!(line.chars().all(is_shown), "{line:?}");
            }
        }
    }
}
