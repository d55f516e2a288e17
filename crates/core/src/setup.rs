//! What is done to a channel: a method and a repair with their settings.

use crate::error::{Error, Result, nearest};
use crate::method::{self, METHODS, Method};
use crate::param::{Settings, find};
use crate::preparation::Preparation;
use crate::repair;

/// The method when none is named.
pub const DEFAULT_METHOD: &str = "two-sided";

/// Method and repair with their settings.
#[derive(Clone)]
pub struct Setup {
    /// How wild points are found.
    pub method: &'static dyn Method,
    /// Its parameters.
    pub settings: Settings,
    /// Name of the channel that measures the rate, for methods that need one.
    pub rate: Option<String>,
    /// The parameters of repair, [`repair::PARAMS`].
    pub repair: Settings,
    /// What is done with the channel before the method sees it.
    pub preparation: Preparation,
}

impl std::fmt::Debug for Setup {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Setup")
            .field("method", &self.method.about().id)
            .field("settings", &self.settings)
            .field("rate", &self.rate)
            .field("repair", &self.repair)
            .field("preparation", &self.preparation)
            .finish()
    }
}

impl serde::Serialize for Setup {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct as _;
        let mut out = serializer.serialize_struct("Setup", 5)?;
        out.serialize_field("method", self.method.about().id)?;
        out.serialize_field("settings", &self.settings)?;
        out.serialize_field("rate", &self.rate)?;
        out.serialize_field("repair", &self.repair)?;
        out.serialize_field("preparation", &self.preparation)?;
        out.end()
    }
}

impl PartialEq for Setup {
    fn eq(&self, other: &Self) -> bool {
        self.same_detection(other) && self.repair == other.repair
    }
}

/// Which set of values a method starts with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Preset {
    /// Values that work on real tracks.
    #[default]
    Default,
    /// What the source document prescribes.
    Paper,
}

impl Preset {
    /// The values of `method`.
    #[must_use]
    pub fn settings(self, method: &dyn Method) -> Settings {
        match self {
            Self::Default => Settings::defaults(method.about().params),
            Self::Paper => Settings::paper(method.about().params),
        }
    }
}

/// The method with this id.
///
/// # Errors
/// [`Error::Usage`] with the methods there are and the nearest.
pub fn method_of_id(id: &str) -> Result<&'static dyn Method> {
    method::find(id).ok_or_else(|| {
        let ids: Vec<&str> = METHODS.iter().map(|m| m.about().id).collect();
        let hint = nearest(id, ids.iter().copied()).map_or(String::new(), |k| format!("did you mean {k}? "));
        Error::usage(format!("{id}: there is no such method"), format!("{hint}methods: {}", ids.join(", ")))
    })
}

impl Setup {
    /// `method` with a preset and the default repair.
    #[must_use]
    pub fn new(method: &'static dyn Method, preset: Preset) -> Self {
        Self {
            method,
            settings: preset.settings(method),
            rate: None,
            repair: Settings::defaults(repair::PARAMS),
            preparation: Preparation::default(),
        }
    }

    /// The same for samples that are this many seconds apart, which durations are counted in.
    #[must_use]
    pub fn at_interval(&self, seconds: f64) -> Self {
        let mut own = self.clone();
        own.settings = own.settings.at_interval(seconds);
        own.repair = own.repair.at_interval(seconds);
        own.preparation.checks.iter_mut().for_each(|check| check.settings = check.settings.at_interval(seconds));
        own
    }

    /// True when both find the same outliers: they differ in the repair at most.
    #[must_use]
    pub fn same_detection(&self, other: &Self) -> bool {
        self.same_method(other) && self.preparation == other.preparation
    }

    /// True when both ask the same of the same method, whatever is done with their channels before.
    #[must_use]
    pub fn same_method(&self, other: &Self) -> bool {
        self.method.about().id == other.method.about().id && self.settings == other.settings && self.rate == other.rate
    }

    /// The same with another preparation of the channel.
    #[must_use]
    pub fn prepared(self, preparation: &Preparation) -> Self {
        Self { preparation: preparation.clone(), ..self }
    }

    /// True when this channel's detection depends on the other channels that share the setup.
    #[must_use]
    pub fn together(&self) -> bool {
        self.method.together(&self.settings)
    }

    /// The default method with its defaults.
    #[must_use]
    pub fn standard() -> Self {
        let method = method::find(DEFAULT_METHOD).unwrap_or(METHODS[0]);
        Self::new(method, Preset::Default)
    }

    /// Sets a parameter of the method or of repair from text.
    ///
    /// # Errors
    /// [`Error::Usage`] for an unknown key or an illegal value; nothing is changed then.
    pub fn set_text(&mut self, key: &str, text: &str) -> Result<()> {
        let id = self.method.about().id;
        let of_repair = key != repair::METHOD.key && repair::PARAMS.iter().any(|p| p.key == key);
        if of_repair && self.settings.get(key).is_none() {
            return self.repair.set_text("repair", key, text);
        }
        find(self.method.about().params, id, key)?;
        self.settings.set_text(id, key, text)
    }
}
