//! The key map in force as a configuration.

use std::fmt::Write as _;

use crate::tui::keys::{Context, Keys};

/// The key map as TOML: what the configuration would have to say to get it. Each action with what it does.
#[must_use]
pub fn listing(keys: &Keys) -> String {
    let mut out = String::from(
        "# The keys of wildpoint. In a configuration, only what is to be different need stand;\n\
         # [] takes the keys of an action away.\n",
    );
    for context in Context::ALL {
        let _ = writeln!(out, "\n[keys.{}]", context.word());
        for bound in keys.of(context) {
            let list: Vec<String> = bound.keys.iter().map(|k| toml::Value::from(k.as_str()).to_string()).collect();
            let entry = format!("{} = [{}]", bound.row.action.name(), list.join(", "));
            let _ = writeln!(out, "{entry:44} # {}", bound.row.help);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::tui::config::Config;

    #[test]
    fn the_listing_is_a_configuration_that_gives_the_same_keys() {
        let listed = listing(&Keys::default());
        let config = Config::of_text(&listed, Path::new("listed.toml"));
        assert_eq!(listing(&config.unwrap().keys), listed);
        let other = Config::of_text("[keys]\nnext-flag = [\"f6\"]\n", Path::new("other.toml")).unwrap();
        let again = Config::of_text(&listing(&other.keys), Path::new("again.toml")).unwrap();
        assert_eq!(listing(&again.keys), listing(&other.keys));
        assert_ne!(listing(&again.keys), listed);
    }
}
