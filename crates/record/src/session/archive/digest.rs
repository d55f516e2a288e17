//! The digest of a result that does not depend on who made it, nor on how the rows were cut into files and batches.
//!
//! Session files and archives hold these sums: what is computed here must never change. `docs/session-format.md`
//! describes it.

use std::fmt::Write as _;

use sha2::{Digest as _, Sha256};

use super::judged::Samples;
use super::rows::finite;
use crate::method::Verdict;
use crate::session::Counts;
use crate::track::hex;

/// The columns of a summary, in order.
pub const SUMMARY_COLUMNS: [&str; 11] = [
    "track",
    "channel",
    "rows",
    "present",
    "flagged",
    "suspects",
    "unchecked",
    "repaired",
    "removed",
    "filled",
    "digest",
];

/// Counts and digest of a channel of a track.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Summary {
    /// Id of the track.
    pub track: String,
    /// Name of the channel.
    pub channel: String,
    /// How many samples are what.
    pub counts: Counts,
    /// SHA-256 over its samples, in lower-case hexadecimal.
    pub digest: String,
}

impl Summary {
    /// The counts, in the order of [`SUMMARY_COLUMNS`].
    #[must_use]
    pub fn numbers(&self) -> [usize; 8] {
        let c = &self.counts;
        [c.rows, c.present, c.flagged, c.suspects, c.unchecked, c.repaired, c.removed, c.filled]
    }

    /// The line that the digest of the archive is made of: the columns with a tab between them, a line feed at its end.
    /// A tab, a line feed and a backslash in a name are written `\t`, `\n` and `\\`.
    #[must_use]
    pub fn line(&self) -> String {
        let name = |text: &str| text.replace('\\', "\\\\").replace('\t', "\\t").replace('\n', "\\n");
        let mut line = format!("{}\t{}", name(&self.track), name(&self.channel));
        for number in self.numbers() {
            let _ = write!(line, "\t{number}");
        }
        let _ = writeln!(line, "\t{}", self.digest);
        line
    }
}

/// The digest of an archive: SHA-256 over the lines of its summaries in the order of their bytes.
#[must_use]
pub fn archive_digest(mut lines: Vec<String>) -> String {
    lines.sort_unstable();
    let mut hash = Sha256::new();
    lines.iter().for_each(|line| hash.update(line));
    hex(&hash.finalize())
}

/// The number of a verdict in the digest.
fn code(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Normal => 0,
        Verdict::Outlier => 1,
        Verdict::Suspect => 2,
        Verdict::Unchecked => 3,
        Verdict::Missing => 4,
    }
}

/// Bytes of a sample: moment, measured value, cleaned value, verdict.
const SAMPLE: usize = 25;

/// SHA-256 over the samples of a channel, whose moments ascend.
pub(super) fn digest_of(moments: &[i64], raw: &[f64], samples: &Samples) -> String {
    let mut texts: Vec<[u8; SAMPLE]> = Vec::with_capacity(moments.len());
    for (row, moment) in moments.iter().enumerate() {
        let mut text = [0; SAMPLE];
        text[..8].copy_from_slice(&moment.to_le_bytes());
        text[8..16].copy_from_slice(&bits(raw[row]));
        text[16..24].copy_from_slice(&bits(samples.clean[row]));
        text[24] = code(samples.verdicts[row]);
        texts.push(text);
    }
    // The order of rows of one moment is that of the values of all channels; here the channel stands alone.
    let mut start = 0;
    while start < moments.len() {
        let same = moments[start..].iter().take_while(|moment| **moment == moments[start]).count();
        texts[start..start + same].sort_unstable();
        start += same;
    }
    let mut hash = Sha256::new();
    texts.iter().for_each(|text| hash.update(text));
    hex(&hash.finalize())
}

fn bits(value: f64) -> [u8; 8] {
    finite(value).to_bits().to_le_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_computed_never_changes() {
        // Made apart with Python: hashlib.sha256(struct.pack('<qddB', ...) of each sample, one after another).
        let samples = Samples {
            verdicts: vec![Verdict::Normal, Verdict::Outlier, Verdict::Missing],
            clean: vec![1.5, 2.0, f64::NAN],
        };
        let digest = digest_of(&[0, 1_000_000_000, 2_000_000_000], &[1.5, 99.0, f64::INFINITY], &samples);
        assert_eq!(digest, "5476927c017c20d02ece8201ffb5b660e8397faa3f87b0be244a3a7090780c91");
        let counts = Counts { rows: 3, present: 2, flagged: 1, repaired: 1, ..Counts::default() };
        let summary = Summary { track: "a\tb".into(), channel: "v\\".into(), counts, digest: "00".into() };
        assert_eq!(summary.line(), "a\\tb\tv\\\\\t3\t2\t1\t0\t0\t1\t0\t0\t00\n");
        let one = archive_digest(vec!["b\n".into(), "a\n".into()]);
        assert_eq!(one, "911169ddaaf146aff539f58c26c489af3b892dff0fe283c1c264c65ae5aa59a2");
    }

    #[test]
    fn the_order_of_rows_of_one_moment_plays_no_part() {
        let samples = |clean: &[f64]| Samples { verdicts: vec![Verdict::Normal; 2], clean: clean.to_vec() };
        let one = digest_of(&[5, 5], &[1.0, 2.0], &samples(&[1.0, 2.0]));
        assert_eq!(one, digest_of(&[5, 5], &[2.0, 1.0], &samples(&[2.0, 1.0])));
        assert_ne!(one, digest_of(&[5, 6], &[1.0, 2.0], &samples(&[1.0, 2.0])));
    }
}
