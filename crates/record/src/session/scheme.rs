//! Schemes of flags: what a column of flags beside a channel says about each of its cells.

/// What is known about a cell of a channel in the cleaned file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quality {
    /// As it was measured, and nobody objects.
    Normal,
    /// As it was measured; there was too little to judge it by, or it has no time.
    Unchecked,
    /// As it was measured; one direction objects.
    Suspect,
    /// An outlier, in whose place stands another value.
    Repaired,
    /// An outlier, whose cell is empty.
    Removed,
    /// A missing sample, in whose place stands a value.
    Filled,
    /// No value.
    Missing,
}

impl Quality {
    /// All of them, in the order of their codes in the tables.
    pub const ALL: [Self; 7] =
        [Self::Normal, Self::Unchecked, Self::Suspect, Self::Repaired, Self::Removed, Self::Filled, Self::Missing];
}

/// A scheme of flags.
#[derive(Debug, PartialEq, Eq)]
pub struct Scheme {
    /// Its word on the command line.
    pub id: &'static str,
    /// Its flags with what each means in a word.
    pub flags: &'static [(&'static str, &'static str)],
    /// Its flag for each [`Quality`], in the order of [`Quality::ALL`].
    codes: [&'static str; 7],
}

/// All of them.
pub static SCHEMES: [Scheme; 3] = [
    // IOOS: Manual for the Use of Real-Time Oceanographic Data Quality Control Flags, version 1.2 (2020). The flag is
    // that of the observation: what was missing is missing, whatever fills it.
    Scheme {
        id: "qartod",
        flags: &[("1", "good"), ("2", "not_evaluated"), ("3", "suspect"), ("4", "bad"), ("9", "missing")],
        codes: ["1", "2", "3", "4", "4", "9", "9"],
    },
    // Argo user's manual, reference table 2. A bad value that is taken out keeps the flag 4 beside its fill value.
    Scheme {
        id: "argo",
        flags: &[
            ("0", "not_judged"),
            ("1", "good"),
            ("3", "probably_bad"),
            ("4", "bad_and_removed"),
            ("8", "interpolated"),
            ("9", "missing"),
        ],
        codes: ["1", "0", "3", "8", "4", "8", "9"],
    },
    Scheme {
        id: "words",
        flags: &[
            ("normal", "normal"),
            ("unchecked", "unchecked"),
            ("suspect", "suspect"),
            ("repaired", "repaired"),
            ("removed", "removed"),
            ("filled", "filled"),
            ("missing", "missing"),
        ],
        codes: ["normal", "unchecked", "suspect", "repaired", "removed", "filled", "missing"],
    },
];

impl Scheme {
    /// The scheme of this id.
    #[must_use]
    pub fn of(id: &str) -> Option<&'static Self> {
        SCHEMES.iter().find(|scheme| scheme.id == id)
    }

    /// What its flags mean, in a line.
    #[must_use]
    pub fn about(&self) -> String {
        let word = |(flag, meaning): &(&str, &str)| {
            if flag == meaning { (*flag).to_owned() } else { format!("{flag} {}", meaning.replace('_', " ")) }
        };
        self.flags.iter().map(word).collect::<Vec<_>>().join(", ")
    }

    /// True where its flags are whole numbers.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.flags.iter().all(|(flag, _)| flag.parse::<i8>().is_ok())
    }

    /// What a column of flags says of itself, by the conventions of CF (section 3.5, flags), as names of attributes with
    /// their values.
    #[must_use]
    pub fn attributes(&self) -> [(&'static str, String); 3] {
        let joined = |part: fn(&(&'static str, &'static str)) -> &'static str, between| {
            self.flags.iter().map(part).collect::<Vec<_>>().join(between)
        };
        [
            ("standard_name", "status_flag".to_owned()),
            ("flag_values", joined(|flag| flag.0, ", ")),
            ("flag_meanings", joined(|flag| flag.1, " ")),
        ]
    }

    /// The flag of a cell.
    #[must_use]
    pub fn code(&self, quality: Quality) -> &'static str {
        self.codes[quality as usize]
    }
}

/// The flags of all schemes as a table in Markdown.
#[must_use]
pub fn schemes_table() -> String {
    let row = |cells: &[&str]| format!("| {} |\n", cells.join(" | "));
    let words = SCHEMES[SCHEMES.len() - 1].codes;
    let mut table = row(&[&["scheme"][..], &words].concat());
    table += &row(&["---"; 8]);
    for scheme in &SCHEMES[..SCHEMES.len() - 1] {
        let id = format!("`{}`", scheme.id);
        table += &row(&[&[id.as_str()][..], &scheme.codes].concat());
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_stand_in_the_order_of_the_qualities() {
        let code = |id: &str, quality| Scheme::of(id).unwrap().code(quality);
        assert!(Quality::ALL.iter().enumerate().all(|(i, quality)| *quality as usize == i));
        for (quality, qartod, argo, word) in [
            (Quality::Normal, "1", "1", "normal"),
            (Quality::Unchecked, "2", "0", "unchecked"),
            (Quality::Suspect, "3", "3", "suspect"),
            (Quality::Repaired, "4", "8", "repaired"),
            (Quality::Removed, "4", "4", "removed"),
            (Quality::Filled, "9", "8", "filled"),
            (Quality::Missing, "9", "9", "missing"),
        ] {
            assert_eq!([code("qartod", quality), code("argo", quality), code("words", quality)], [qartod, argo, word]);
        }
        assert!(Scheme::of("QARTOD").is_none());
    }

    #[test]
    fn each_flag_that_is_given_says_what_it_means() {
        for scheme in &SCHEMES {
            let told: Vec<&str> = scheme.flags.iter().map(|(flag, _)| *flag).collect();
            assert!(scheme.codes.iter().all(|code| told.contains(code)), "{}", scheme.id);
            assert!(told.iter().all(|flag| scheme.codes.contains(flag)), "{}", scheme.id);
            let [_, (_, values), (_, meanings)] = scheme.attributes();
            assert_eq!(values.split(", ").count(), meanings.split(' ').count(), "{}", scheme.id);
        }
        assert_eq!(SCHEMES[0].about(), "1 good, 2 not evaluated, 3 suspect, 4 bad, 9 missing");
        assert_eq!((SCHEMES[0].is_whole(), SCHEMES[2].is_whole()), (true, false));
    }
}
