//! Text broken into lines.

use textwrap::{Options, WordSeparator, WordSplitter};

/// `text` broken between its words into lines of `width` columns at most, of which the first begins with `first` and the
/// others with `next`. A word that is wider than a line, as the path of a file may be, is broken where the line ends.
pub(crate) fn wrapped(text: &str, width: usize, (first, next): (&str, &str)) -> Vec<String> {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let options = Options::new(width.max(1))
        .initial_indent(first)
        .subsequent_indent(next)
        .word_separator(WordSeparator::AsciiSpace)
        .word_splitter(WordSplitter::NoHyphenation);
    textwrap::wrap(&text, options).into_iter().map(std::borrow::Cow::into_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn words_go_on_in_the_next_line_and_nothing_is_lost_of_a_long_one() {
        assert_eq!(wrapped("flags of  a run", 8, ("", "")), ["flags of", "a run"]);
        assert_eq!(
            wrapped("saved /data/of/2026/run-42.csv: vx", 12, (" ", "  ")),
            [" saved", "  /data/of/2", "  026/run-42", "  .csv: vx"]
        );
        // Two columns each.
        assert_eq!(wrapped("記録 高度高度", 6, ("", "")), ["記録", "高度高", "度"]);
        assert_eq!(wrapped("", 6, ("", "")), [""]);
    }
}
