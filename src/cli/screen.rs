//! What the command line says about the screen.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// Which configuration to take.
#[derive(Debug, Clone, Default, Args)]
pub struct ConfigArgs {
    /// Keys, theme and screen from this file [default: $XDG_CONFIG_HOME/wildpoint/config.toml, else the same in
    /// ~/.config].
    #[arg(long, value_name = "FILE", conflicts_with = "no_config")]
    pub config: Option<PathBuf>,
    /// Ignore the configuration file.
    #[arg(long)]
    pub no_config: bool,
}

/// Colours of the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Color {
    /// What the terminal says it can; none with `NO_COLOR`.
    Auto,
    /// None: bold, reverse and underline only.
    Never,
    /// The 16 colours of the terminal.
    #[value(name = "16")]
    Sixteen,
    /// 256 colours.
    #[value(name = "256")]
    Indexed,
    /// 24-bit colours.
    True,
}

/// Glyphs of the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Glyphs {
    /// Unicode where the locale is UTF-8.
    Auto,
    /// Braille, blocks and markers.
    Unicode,
    /// Braille only: for terminals in which other symbols are two cells wide.
    Braille,
    /// Plain ASCII.
    Ascii,
}
