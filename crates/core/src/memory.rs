//! The memory that the program may use. What is large is counted before it is taken, so that a file that unpacks to a
//! thousand times its size ends with an error and not with the machine.
//!
//! What is counted: the bytes and the text of a file that is read whole, columns, what a method keeps of each sample,
//! and session files. The rest of the program takes some ten megabytes.

use std::sync::atomic::{AtomicU64, Ordering};

/// Bytes that may be used; 0 until that is known.
static LIMIT: AtomicU64 = AtomicU64::new(0);
/// Bytes that are counted now.
static TAKEN: AtomicU64 = AtomicU64::new(0);

/// The limit where the system does not tell what it has.
const UNKNOWN: u64 = 4 << 30;

/// There is no room for so much.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Full {
    /// Bytes that may be used.
    pub limit: u64,
}

/// Memory that is counted for as long as this lives.
#[derive(Debug, Default)]
pub struct Share(u64);

impl Share {
    /// This many bytes.
    ///
    /// # Errors
    /// [`Full`] when they would pass the limit.
    pub fn of(bytes: u64) -> Result<Self, Full> {
        let mut share = Self::default();
        share.set(bytes).map(|()| share)
    }

    /// Makes it this many bytes; where they would pass the limit, it stays what it was.
    ///
    /// # Errors
    /// [`Full`] when they would.
    pub fn set(&mut self, bytes: u64) -> Result<(), Full> {
        let limit = limit();
        let before = self.0;
        let change = |taken: u64| {
            let now = taken.saturating_sub(before).saturating_add(bytes);
            (bytes <= before || now <= limit).then_some(now)
        };
        TAKEN.fetch_update(Ordering::Relaxed, Ordering::Relaxed, change).map_err(|_| Full { limit })?;
        self.0 = bytes;
        Ok(())
    }

    /// Adds this many bytes.
    ///
    /// # Errors
    /// As [`Share::set`].
    pub fn add(&mut self, bytes: u64) -> Result<(), Full> {
        self.set(self.0.saturating_add(bytes))
    }

    /// How many bytes it is.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        self.0
    }
}

impl Drop for Share {
    fn drop(&mut self) {
        let mine = self.0;
        let _ = TAKEN.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |taken| Some(taken.saturating_sub(mine)));
    }
}

/// Sets the limit, in bytes.
pub fn set_limit(bytes: u64) {
    LIMIT.store(bytes.max(1), Ordering::Relaxed);
}

/// The limit, in bytes: the one that was set, or half of what the machine (or the container) has.
#[must_use]
pub fn limit() -> u64 {
    match LIMIT.load(Ordering::Relaxed) {
        0 => {
            let half = machine().map_or(UNKNOWN, |bytes| bytes / 2);
            LIMIT.store(half, Ordering::Relaxed);
            half
        }
        set => set,
    }
}

/// What the machine has, or what the group of processes may use of it.
fn machine() -> Option<u64> {
    let number = |path: &str| std::fs::read_to_string(path).ok()?.trim().parse::<u64>().ok();
    let about = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = about.lines().find_map(|line| line.strip_prefix("MemTotal:"))?;
    let total = line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()?.checked_mul(1024)?;
    let groups = ["/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"];
    Some(groups.into_iter().filter_map(number).fold(total, u64::min))
}

/// A size as a user types it: a number of bytes, or of `K`, `M`, `G` or `T` (powers of 1024), as in `500M` and `1.5G`.
#[must_use]
pub fn parse(text: &str) -> Option<u64> {
    let text = text.trim();
    let text = text.strip_suffix("iB").or_else(|| text.strip_suffix('B')).unwrap_or(text);
    let unit = |c: char| "KMGT".find(c.to_ascii_uppercase()).map(|at| 1_u64 << (10 * (at + 1)));
    let (number, unit) = match text.char_indices().next_back().and_then(|(at, c)| Some((at, unit(c)?))) {
        Some((at, unit)) => (text.get(..at)?, unit),
        None => (text, 1),
    };
    let number: f64 = number.trim().parse().ok().filter(|n: &f64| n.is_finite() && *n > 0.0)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "positive, and a cast saturates")]
    #[expect(clippy::cast_precision_loss, reason = "a power of two")]
    Some((number * unit as f64) as u64).filter(|bytes| *bytes > 0)
}

/// A size for people, to three digits: `1.5 GB` (of 1024 MB).
#[must_use]
pub fn words(bytes: u64) -> String {
    let mut left = bytes;
    let mut units = ["B", "KB", "MB", "GB", "TB"].into_iter().peekable();
    while let Some(unit) = units.next() {
        if left < 1024 || units.peek().is_none() {
            return format!("{left} {unit}");
        }
        if left < 10 * 1024 {
            let tenths = left * 10 / 1024;
            return format!("{}.{} {}", tenths / 10, tenths % 10, units.next().unwrap_or(unit));
        }
        left /= 1024;
    }
    format!("{bytes} B")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_and_written() {
        let sizes = ["1", "2k", "500M", "1.5G", "3 GiB", "1T"].map(parse);
        assert_eq!(sizes, [1, 2048, 500 << 20, 3 << 29, 3 << 30, 1 << 40].map(Some));
        assert!(["", "G", "-1", "0", "x", "1e400", "nan"].iter().all(|text| parse(text).is_none()));
        let words = [0, 1023, 1536, 500 << 20, 3 << 29, 12 << 30].map(words);
        assert_eq!(words, ["0 B", "1023 B", "1.5 KB", "500 MB", "1.5 GB", "12 GB"]);
    }

    #[test]
    fn the_machine_is_known() {
        assert!(!cfg!(target_os = "linux") || machine().is_some_and(|bytes| bytes > 1 << 20));
    }

    #[test]
    fn a_share_is_counted_until_it_is_gone() {
        // Other tests run beside this one: more than the limit is refused whatever they take.
        assert_eq!(Share::of(u64::MAX).map(|s| s.bytes()), Err(Full { limit: limit() }));
        let mut share = Share::of(1000).unwrap();
        assert_eq!(share.set(u64::MAX), Err(Full { limit: limit() }));
        assert_eq!(share.bytes(), 1000);
        share.add(24).unwrap();
        assert_eq!(share.bytes(), 1024);
    }
}
