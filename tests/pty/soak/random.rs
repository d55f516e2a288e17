//! What happens by chance.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// The chance of a round.
pub(super) struct Chance(Pcg64Mcg);

impl Chance {
    pub(super) fn of(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// A number below `n`.
    pub(super) fn below(&mut self, n: usize) -> usize {
        self.0.next_u32() as usize % n
    }

    pub(super) fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    pub(super) fn of_list<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// The size of a window.
    pub(super) fn size(&mut self) -> (u16, u16) {
        const EDGES: [(u16, u16); 7] = [(0, 0), (1, 1), (39, 9), (40, 10), (80, 24), (120, 40), (400, 100)];
        match self.below(4) {
            0 => self.of_list(&EDGES),
            1 => (self.below(400) as u16, self.below(120) as u16),
            _ => (40 + self.below(160) as u16, 10 + self.below(50) as u16),
        }
    }
}

/// Keys that decide nothing, open no list and neither save nor quit.
pub(super) const HARMLESS: [&str; 47] = [
    "n",
    "p",
    "N",
    "P",
    "+",
    "-",
    "0",
    "z",
    "Z",
    "y",
    "X",
    "R",
    "L",
    "B",
    "gd",
    "gD",
    "t",
    "b",
    "d",
    ",",
    ".",
    ";",
    "f",
    "i",
    "w",
    "1",
    "2",
    "3",
    "4",
    "5",
    "\t",
    "h",
    "j",
    "k",
    "l",
    "s",
    "gn",
    "gc",
    "\x0c",
    "\x1b[A",
    "\x1b[B",
    "\x1b[C",
    "\x1b[D",
    "\x1b[5~",
    "\x1b[6~",
    ":set k 5\r",
    ":method hampel\r",
];

/// All sorts of keys and what looks like keys, decisions, lists, prompts and torn sequences included; nothing that stops
/// the program or writes outside its folder.
pub(super) const ANYTHING: [&str; 65] = [
    "a",
    "r",
    " ",
    "x",
    "o",
    "u",
    "U",
    "\x12",
    "v",
    "c",
    "glint\r",
    "ga",
    "gr",
    "gx",
    "ge",
    "K",
    "g.",
    "J",
    "\r",
    "\x1b",
    "m",
    "V",
    "e",
    "D",
    "?",
    ":",
    "/",
    "\"",
    "C",
    "gh",
    "gb",
    "gs",
    "Y",
    "M",
    "\x03",
    "\x0f",
    "\x05",
    "\x13",
    "W",
    "q",
    "\t",
    "\x1b[Z",
    "\x7f",
    "\x1b[",
    "\x1b[<0;30;9M",
    "\x1b[<0;30;9m",
    "\x1b[<64;50;12M",
    "\x1b[<32;60;12M",
    "\x1b[200~a r\n\x1b[201~",
    "\x1bO",
    "9",
    "高",
    "\x1b[1;5C",
    "\x1b[H",
    "\x1b[F",
    ":w! wild.toml\r",
    ":export! wild.csv\r",
    ":report! wild.html\r",
    ":nu\r",
    "/#533\r",
    "/y>8\r",
    ":set points 30\r",
    ":method kalman\r",
    ":method grubbs\r",
    ":channel alt_m\r",
];
