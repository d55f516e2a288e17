//! Simulated records whose wild points are known, kind by kind; seeds are fixed.

mod advice;

/// Samples of a record.
const N: usize = 1000;

/// xorshift64*, so that the records are the same everywhere.
struct Random(u64);

impl Random {
    fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        for _ in 0..10 {
            let _ = random.uniform();
        }
        random
    }

    fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let (a, b) = (self.uniform().max(1e-300), self.uniform());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }
}

/// The motion under the noise, in deviations of the noise.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Motion {
    Sine,
    Manoeuvre,
    Ramp,
    Step,
}

/// What a record is like, and what the default method is promised to find in it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kind {
    pub(crate) name: &'static str,
    pub(crate) motion: Motion,
    /// Share of wild samples, in runs of this length; 6 to 20 deviations.
    pub(crate) share: f64,
    pub(crate) run: usize,
    /// Correlation of neighbours.
    pub(crate) correlation: f64,
    /// Step of the grid in deviations; 0: none.
    pub(crate) quantum: f64,
    /// Every second sample repeats the one before.
    pub(crate) held: bool,
    /// The first half at 10 Hz, the second at 1 Hz.
    pub(crate) two_rates: bool,
    /// At least this many wild samples in a hundred are flagged …
    pub(crate) found: f64,
    /// … and at most this many good ones.
    pub(crate) falsely: f64,
}

const ISOLATED: Kind = Kind {
    name: "isolated 5 %, sine",
    motion: Motion::Sine,
    share: 0.05,
    run: 1,
    correlation: 0.0,
    quantum: 0.0,
    held: false,
    two_rates: false,
    found: 95.0,
    falsely: 0.1,
};

/// Every kind.
pub(crate) const KINDS: &[Kind] = &[
    ISOLATED,
    Kind { name: "isolated 5 %, manoeuvre", motion: Motion::Manoeuvre, found: 88.0, ..ISOLATED },
    Kind { name: "isolated 5 %, ramp", motion: Motion::Ramp, ..ISOLATED },
    Kind { name: "isolated 10 %", share: 0.10, ..ISOLATED },
    Kind { name: "isolated 20 %", share: 0.20, found: 87.0, ..ISOLATED },
    Kind { name: "AR(0.9)", correlation: 0.9, ..ISOLATED },
    Kind { name: "quantum 1", quantum: 1.0, ..ISOLATED },
    Kind { name: "quantum 3", quantum: 3.0, found: 76.0, ..ISOLATED },
    Kind { name: "held every second", held: true, found: 75.0, ..ISOLATED },
    Kind { name: "runs of 2", run: 2, found: 95.0, ..ISOLATED },
    Kind { name: "runs of 5", run: 5, found: 75.0, ..ISOLATED },
    Kind { name: "runs of 10", run: 10, found: 50.0, ..ISOLATED },
    Kind { name: "two rates", two_rates: true, ..ISOLATED },
    Kind { name: "a step", motion: Motion::Step, found: 82.0, ..ISOLATED },
    Kind { name: "clean", share: 0.0, found: 0.0, ..ISOLATED },
    Kind { name: "clean, AR(0.9)", share: 0.0, found: 0.0, correlation: 0.9, ..ISOLATED },
];

/// A record with what is wild of it.
pub(crate) struct Record {
    pub(crate) t: Vec<f64>,
    pub(crate) y: Vec<f64>,
    pub(crate) wild: Vec<bool>,
}

impl Kind {
    /// The record of a seed.
    pub(crate) fn record(&self, seed: u64) -> Record {
        let mut random = Random::new(seed * 7919 + self.name.len() as u64);
        let mut now = 0.0;
        let mut step = |i: usize| {
            let at = now;
            now += if self.two_rates && i < N / 2 { 0.1 } else { 1.0 };
            at
        };
        let t: Vec<f64> = (0..N).map(&mut step).collect();
        let (mut noise, mut place, mut speed) = (0.0, 0.0, 5.0);
        let mut sample = |i: usize| {
            let fresh = random.normal();
            noise = self.correlation * noise + (1.0 - self.correlation * self.correlation).sqrt() * fresh;
            speed += if (300..360).contains(&i) {
                0.3
            } else if (600..640).contains(&i) {
                -0.6
            } else {
                0.0
            };
            place += speed;
            noise
                + match self.motion {
                    Motion::Sine => 100.0 * (t[i] * std::f64::consts::TAU / 200.0).sin(),
                    Motion::Manoeuvre => place,
                    Motion::Ramp => 30.0 * t[i],
                    Motion::Step => {
                        if i < N / 2 {
                            0.0
                        } else {
                            40.0
                        }
                    }
                }
        };
        let mut y: Vec<f64> = (0..N).map(&mut sample).collect();
        let wild = self.spoil(&mut y, &mut random);
        let mut record = Record { t, y, wild };
        if self.held {
            (1..N).step_by(2).for_each(|i| (record.y[i], record.wild[i]) = (record.y[i - 1], record.wild[i - 1]));
        }
        if self.quantum > 0.0 {
            record.y.iter_mut().for_each(|y| *y = (*y / self.quantum).round() * self.quantum);
        }
        record
    }

    fn spoil(&self, y: &mut [f64], random: &mut Random) -> Vec<bool> {
        let mut wild = vec![false; N];
        let apart = if self.run > 1 { self.run + 10 } else { 0 };
        let mut left = (self.share * N as f64).round() as usize / self.run;
        while left > 0 {
            let at = 5 + (random.uniform() * (N - self.run - 10) as f64) as usize;
            if wild[at.saturating_sub(apart)..(at + self.run + apart).min(N)].iter().any(|w| *w) {
                continue;
            }
            let size = (6.0 + 14.0 * random.uniform()) * if random.uniform() < 0.5 { -1.0 } else { 1.0 };
            wild[at..at + self.run].fill(true);
            y[at..at + self.run].iter_mut().for_each(|y| *y += size);
            left -= 1;
        }
        wild
    }
}
