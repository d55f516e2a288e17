//! Inputs of every format, broken: they are read or refused, and never end the program.

use wildpoint_record::track::{CellChange, Changes, LoadOptions, Source, load, rewrite};

use super::case::{Case, bytes_of};

/// Broken variants of each input.
const VARIANTS: usize = 40;

/// Numbers that are the same in every run (a linear congruential generator, Knuth's constants).
struct Dice(u64);

impl Dice {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % most.max(1)
    }
}

/// The bytes with one thing wrong: cut, a stretch left out or doubled, bytes changed.
fn broken(bytes: &[u8], dice: &mut Dice) -> Vec<u8> {
    let (a, b) = (dice.below(bytes.len()), dice.below(bytes.len()));
    let (a, b) = (a.min(b), (a.max(b)).min(a.min(b) + 200));
    let mut out = bytes.to_vec();
    match dice.below(4) {
        0 => out.truncate(a),
        1 => drop(out.drain(a..b)),
        2 => drop(out.splice(a..a, bytes[a..b].iter().copied())),
        _ => (0..1 + dice.below(20)).for_each(|_| {
            let at = dice.below(out.len());
            out[at] = b",;*$ \n\t=#0A-\xff."[dice.below(14)];
        }),
    }
    out
}

/// Loads it and writes it again, with one cell changed and with none.
pub(crate) fn walked(case: &Case) {
    let bytes = bytes_of(case);
    let mut dice = Dice(7);
    for _ in 0..VARIANTS {
        let bytes = broken(&bytes, &mut dice);
        let source = Source::BuiltIn { name: "test", bytes: bytes.as_slice().into() };
        let Ok(track) = load(&source, &LoadOptions::default()) else { continue };
        let mut again = Vec::new();
        rewrite(&track, &Changes::default(), &mut again).unwrap();
        assert!(again == bytes, "{}: written again with no change, it is another file", case.name);
        for (channel, row) in track.channels.iter().zip([0, track.rows - 1, track.rows / 2]) {
            let row = channel.target.as_ref().map_or(row, |t| t.rows[0] as usize);
            let row = u32::try_from(row).unwrap();
            for value in [Some(1.5), Some(-1e9), None] {
                let cells = vec![CellChange { row, column: channel.column, value }];
                // A cell without a place in the file is told.
                let _ = rewrite(&track, &Changes { cells, rows: Vec::new() }, &mut Vec::new());
            }
        }
    }
}
