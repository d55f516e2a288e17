//! Fuzzy matching of short names: the letters that were typed, in their order, anywhere in the name.
//!
//! Own, since a hundred names of twenty letters need neither speed nor a table of Unicode classes: what a crate for
//! this would bring (and one of them under the MPL) is more than these lines.

/// A letter that continues the run before it.
const RUN: i32 = 5;
/// A letter that starts a word.
const START: i32 = 4;
/// A letter that starts the name.
const FIRST: i32 = 6;

/// How well `typed` fits `name`, larger for better; none when its letters do not all occur in their order. Blanks
/// that were typed mean nothing; upper and lower case are the same.
#[must_use]
pub(super) fn score(typed: &str, name: &str) -> Option<i32> {
    let name: Vec<char> = name.to_lowercase().chars().collect();
    let bonus = |j: usize| match j.checked_sub(1) {
        None => FIRST,
        Some(i) if !name[i].is_alphanumeric() => START,
        Some(_) => 0,
    };
    // For each letter of the name: the best score of what was typed so far, with its last letter there.
    let mut best: Option<Vec<Option<i32>>> = None;
    for letter in typed.to_lowercase().chars().filter(|c| !c.is_whitespace()) {
        let mut next = vec![None; name.len()];
        let mut before = None;
        for j in 0..name.len() {
            let at = |i: usize| best.as_ref().and_then(|best| best.get(i).copied().flatten());
            let run = j.checked_sub(1).and_then(at).map(|s| s + RUN);
            let from = if best.is_none() { Some(0) } else { run.max(before) };
            if name[j] == letter {
                next[j] = from.map(|s| s + 1 + bonus(j));
            }
            before = before.max(at(j));
        }
        best = Some(next);
    }
    let most = best.map_or(Some(0), |best| best.into_iter().flatten().max());
    // Of equal matches the one in the shorter name is meant.
    let length = i32::try_from(name.len()).unwrap_or(i32::MAX / 2).min(63);
    most.map(|score| score * 64 - length)
}

/// The indices of the items that fit `typed`, the best first and equal ones in their order. An item fits by its
/// name or, after all that do, where every word typed occurs in its help.
#[must_use]
pub(super) fn ranked<'a>(typed: &str, items: impl IntoIterator<Item = (&'a str, &'a str)>) -> Vec<usize> {
    let words: Vec<String> = typed.split_whitespace().map(str::to_lowercase).collect();
    // One or two letters are in every help.
    let long = words.iter().all(|w| w.chars().count() > 2);
    let by_help = |help: &str| {
        let help = help.to_lowercase();
        (long && words.iter().all(|w| help.contains(w.as_str()))).then_some(i32::MIN)
    };
    let fits = |(index, (name, help)): (usize, (&str, &str))| {
        score(typed, name).or_else(|| by_help(help)).map(|score| (index, score))
    };
    let mut found: Vec<(usize, i32)> = items.into_iter().enumerate().filter_map(fits).collect();
    if !words.is_empty() {
        found.sort_by_key(|(_, score)| std::cmp::Reverse(*score));
    }
    found.into_iter().map(|(index, _)| index).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 6] =
        ["next-flag", "next-channel", "no-flag-needed", "zoom-flag", "previous-unreviewed", "after-n"];

    fn best(typed: &str) -> &'static str {
        NAMES[ranked(typed, NAMES.map(|name| (name, "")))[0]]
    }

    #[test]
    fn starts_of_words_and_runs_of_letters_count_most() {
        for (typed, name) in [
            ("nf", "next-flag"),
            ("next", "next-flag"),
            ("nextc", "next-channel"),
            ("pu", "previous-unreviewed"),
            ("zf", "zoom-flag"),
            ("zoom flag", "zoom-flag"),
            ("UNREV", "previous-unreviewed"),
            ("n", "next-flag"),
        ] {
            assert_eq!(best(typed), name, "{typed}");
        }
    }

    #[test]
    fn letters_that_are_not_there_in_order_do_not_fit() {
        assert_eq!(score("galf", "flag"), None);
        assert_eq!(score("flagx", "next-flag"), None);
        assert!(score("", "flag").is_some());
        assert_eq!(score("x", ""), None);
    }

    #[test]
    fn help_is_searched_after_names_and_nothing_typed_keeps_the_order() {
        let items = [("undo", "take the last change back"), ("redo", "undo an undo"), ("save", "undo nothing")];
        assert_eq!(ranked("undo", items), [0, 1, 2]);
        assert_eq!(ranked("last change", items), [0]);
        assert_eq!(ranked("ch", items), [0; 0]);
        assert_eq!(ranked("", items), [0, 1, 2]);
    }
}
