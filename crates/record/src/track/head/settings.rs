//! Settings of an instrument that stand in columns of their own beside the first rows, as oscilloscopes write them:
//! `Record Length,2500,,-0.0005,0.02`.

use super::super::number::Reading;

/// Rows beside which settings may stand.
const MOST: usize = 64;
/// With fewer rows nothing tells settings from values.
const LEAST: usize = 24;

/// How many columns at the left hold such settings: a word and its values in the first rows, and nothing below them.
pub(super) fn columns(sample: &[Vec<String>], reading: &Reading) -> usize {
    let width = sample.iter().map(Vec::len).min().unwrap_or(0);
    if sample.len() < LEAST {
        return 0;
    }
    let ends = |column: usize| sample.iter().rposition(|row| !row[column].is_empty()).map_or(0, |at| at + 1);
    let short = |column: &usize| ends(*column) <= MOST.min(sample.len() / 2);
    let count = (0..width).take_while(short).count();
    let is_word = |cell: &String| !cell.is_empty() && reading.number(cell.as_bytes()).is_none();
    let words = sample.iter().filter(|row| row.first().is_some_and(is_word)).count();
    // What is empty from the start is no setting, and what is all words has values beside it.
    let valued = (1..count).any(|column| ends(column) > 0);
    if count >= 2 && count < width && words > 0 && valued { count } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn columns_of(row: impl Fn(usize) -> String) -> usize {
        let sample: Vec<Vec<String>> = (0..100).map(|i| row(i).split(',').map(str::to_owned).collect()).collect();
        columns(&sample, &Reading::default())
    }

    #[test]
    fn settings_end_before_the_rows_do() {
        let beside = |i: usize| ["Record Length,2500", "Source,CH1", ",", "Model,T2"].get(i).copied().unwrap_or(",");
        assert_eq!(columns_of(|i| format!("{},,{i},0.5,", beside(i))), 3);
        // Columns of the record that begin late, end early, or hold texts all the way.
        assert_eq!(columns_of(|i| format!("{},{i},0.5", if i > 90 { "3" } else { "" })), 0);
        assert_eq!(
            columns_of(|i| format!("{},{},{i}", if i < 10 { "3" } else { "" }, if i < 10 { "4" } else { "" })),
            0
        );
        assert_eq!(columns_of(|i| format!("a,2,{i}")), 0);
        assert_eq!(columns_of(|i| format!("{},,{i}", if i == 0 { "note" } else { "" })), 0);
    }
}
