//! Van Essen Diver: MON files, with the channels in sections above `[Data]`.

use super::{Format, Known, Label, PLAIN, line_where};
use crate::track::Delimiter;

pub(super) const FORMAT: Format = Format {
    name: "Van Essen Diver (MON)",
    about: "water pressure and temperature of Diver loggers",
    known_by: "`Data file for DataLogger` or `[Logger settings]` above `[Data]`",
    maps: "names and units from the sections `[Channel N]`, the line with the count below `[Data]` is not a row",
    known: |text| {
        let logger = text.contains("Data file for DataLogger") || text.contains("[Logger settings]");
        logger && data(text).is_some()
    },
    complete,
    label: |text, name| Label {
        unit: channels(text).into_iter().find(|c| c.name == name).map(|c| c.unit),
        aside: None,
    },
    closed: true,
    ..PLAIN
};

/// A channel of the logger.
struct Channel {
    name: String,
    unit: String,
}

fn data(text: &str) -> Option<usize> {
    line_where(text, |l| l.trim() == "[Data]")
}

fn complete(text: &str, known: &mut Known) {
    let Some(data) = data(text) else { return };
    let counted = text.lines().nth(data + 1).is_some_and(|l| l.trim().parse::<u64>().is_ok());
    let options = &mut known.options;
    if options.header_line.is_none() {
        options.skip.get_or_insert(data + 1 + usize::from(counted));
        options.header.get_or_insert(false);
        options.delimiter.get_or_insert(Delimiter::Blanks);
    }
    let channels = channels(text);
    known.name(["Date", "Time"].into_iter().chain(channels.iter().map(|c| c.name.as_str())));
}

/// The channels that the sections describe, each once.
fn channels(text: &str) -> Vec<Channel> {
    let mut channels: Vec<Channel> = Vec::new();
    let mut within = false;
    for line in text.lines().map(str::trim).take_while(|l| *l != "[Data]") {
        if line.starts_with('[') {
            // `[Channel 1 from data header]` says the same again.
            within = line.starts_with("[Channel ") && !line.contains("from");
            if within {
                channels.push(Channel { name: String::new(), unit: String::new() });
            }
        }
        let (Some(channel), Some((key, value))) = (channels.last_mut().filter(|_| within), line.split_once('=')) else {
            continue;
        };
        match key.trim() {
            "Identification" => value.trim().clone_into(&mut channel.name),
            // `50.00  cmH2O`
            "Reference level" | "Range" => {
                if let Some((_, unit)) = value.trim().split_once(char::is_whitespace) {
                    unit.trim().clone_into(&mut channel.unit);
                }
            }
            _ => {}
        }
    }
    channels
}
