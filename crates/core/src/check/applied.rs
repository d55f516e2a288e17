//! A check with its settings, as a plan has it, and its spelling on the command line.

use std::fmt;

use super::{Check, find};
use crate::error::Error;
use crate::param::{Settings, Value};

/// The key under which a check of several channels names them.
const CHANNELS: &str = "channels";

/// A check with its settings. Printed in the form of `--check`: `stuck:suspect=off,fail=20.0`.
#[derive(Clone)]
pub struct Applied {
    /// Which check.
    pub check: &'static dyn Check,
    /// Its parameters.
    pub settings: Settings,
    /// The channels it is about, in their order, for a check of several channels; empty otherwise.
    pub channels: Vec<String>,
    /// False while it is switched off: it is kept and objects to nothing.
    pub on: bool,
}

impl Applied {
    /// A check at its defaults.
    #[must_use]
    pub fn new(check: &'static dyn Check) -> Self {
        Self { check, settings: Settings::defaults(check.about().params), channels: Vec::new(), on: true }
    }

    /// Its id.
    #[must_use]
    pub fn id(&self) -> &'static str {
        self.check.about().id
    }

    /// Sets a parameter, or the channels, from text.
    ///
    /// # Errors
    /// [`Error::Usage`] for an unknown key or an illegal value; nothing is changed then.
    pub fn set_text(&mut self, key: &str, text: &str) -> Result<(), Error> {
        if key == CHANNELS && self.check.about().channels.is_some() {
            self.channels = text.split(',').map(|name| name.trim().to_owned()).collect();
            return Ok(());
        }
        self.settings.set_text(self.id(), key, text)
    }

    /// Sets a parameter.
    ///
    /// # Errors
    /// [`Error::Usage`] for an unknown key or an illegal value; nothing is changed then.
    pub fn set(&mut self, key: &str, value: Value) -> Result<(), Error> {
        let id = self.id();
        self.settings.set(id, key, value)
    }

    /// Reads `ID[:KEY=VALUE,...]`. A part without `=` goes on with the list before it: `missing-values:values=-9999,1e20`.
    ///
    /// # Errors
    /// [`Error::Usage`] for what is not understood, and for settings under which the check objects to nothing.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let (id, rest) = text.split_once(':').unwrap_or((text, ""));
        let mut applied = Self::new(find(id.trim())?);
        let mut pairs: Vec<(String, String)> = Vec::new();
        for part in rest.split(',').filter(|part| !part.trim().is_empty()) {
            match (part.split_once('='), pairs.last_mut()) {
                (Some((key, value)), _) => pairs.push((key.trim().to_owned(), value.trim().to_owned())),
                (None, Some((_, list))) => {
                    list.push(',');
                    list.push_str(part.trim());
                }
                (None, None) => {
                    let what = format!("--check {text}: {part} is not KEY=VALUE");
                    return Err(Error::usage(what, "write --check ID:KEY=VALUE,KEY=VALUE"));
                }
            }
        }
        pairs.iter().try_for_each(|(key, value)| applied.set_text(key, value))?;
        applied.verify()?;
        Ok(applied)
    }

    /// Refuses settings under which it cannot object to anything.
    ///
    /// # Errors
    /// [`Error::Usage`] with what to set.
    pub fn verify(&self) -> Result<(), Error> {
        let id = self.id();
        if let Some((least, most)) = self.check.about().channels {
            let count = self.channels.len();
            if !(least..=most).contains(&count) {
                let wanted = if least == most { least.to_string() } else { format!("{least} or {most}") };
                let what = format!("{id}: it is about {wanted} channels, and {count} are named");
                return Err(Error::usage(what, format!("name them: {id}:{CHANNELS}=lat,lon")));
            }
            if (1..count).any(|i| self.channels[..i].contains(&self.channels[i])) {
                return Err(Error::usage(format!("{id}: a channel is named twice"), "name each channel once"));
            }
        }
        self.check.verify(&self.settings)
    }
}

/// The checks that `--check` names; `none` stands for no check at all.
///
/// # Errors
/// [`Error::Usage`] for what is not understood, and for `none` beside a check.
pub fn parse_all(texts: &[String]) -> Result<Vec<Applied>, Error> {
    if texts.iter().any(|text| text == "none") {
        if texts.len() > 1 {
            return Err(Error::usage("--check none is given with another check", "leave out one of them"));
        }
        return Ok(Vec::new());
    }
    texts.iter().map(|text| Applied::parse(text)).collect()
}

impl serde::Serialize for Applied {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct as _;
        let mut out = serializer.serialize_struct("Applied", 4)?;
        out.serialize_field("check", self.id())?;
        out.serialize_field("settings", &self.settings)?;
        out.serialize_field("channels", &self.channels)?;
        out.serialize_field("on", &self.on)?;
        out.end()
    }
}

impl PartialEq for Applied {
    fn eq(&self, other: &Self) -> bool {
        let same = self.id() == other.id() && self.settings == other.settings;
        same && self.channels == other.channels && self.on == other.on
    }
}

impl fmt::Debug for Applied {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}{}", if self.on { "" } else { " (off)" })
    }
}

impl fmt::Display for Applied {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())?;
        let channels = (!self.channels.is_empty()).then(|| format!("{CHANNELS}={}", self.channels.join(",")));
        let settings = self.settings.iter().map(|(param, value)| format!("{}={value}", param.key));
        for (i, pair) in channels.into_iter().chain(settings).enumerate() {
            write!(f, "{}{pair}", if i == 0 { ':' } else { ',' })?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_check_reads_back_what_it_prints() {
        for text in [
            "missing-values:values=-9999,1e20,99.99",
            "valid-range:low=-40,high=60",
            "stuck:fail=20",
            "rate:suspect=3,fail=9.5",
            "null-island:channels=lat,lon",
            "position:channels=lat,lon,height,speed=80",
        ] {
            let applied = Applied::parse(text).unwrap();
            assert_eq!(Applied::parse(&applied.to_string()).unwrap(), applied, "{applied}");
        }
    }

    #[test]
    fn what_is_not_understood_is_refused_with_the_way_out() {
        for (text, words) in [
            ("stuk:fail=3", "did you mean stuck?"),
            ("stuck", "set fail, suspect or both"),
            ("stuck:20", "KEY=VALUE"),
            ("stuck:fail=many", "fail = many"),
            ("rate:suspect=9,fail=3", "smaller"),
            ("valid-range:low=5,high=1", "low"),
            ("missing-values", "values"),
            ("null-island", "channels=lat,lon"),
            ("position:channels=lat,lat", "twice"),
        ] {
            let message = Applied::parse(text).unwrap_err().to_string();
            assert!(message.contains(words), "{text}: {message}");
        }
        let both = ["none".to_owned(), "stuck:fail=9".to_owned()];
        assert!(parse_all(&both).is_err() && parse_all(&both[..1]).unwrap().is_empty());
    }
}
