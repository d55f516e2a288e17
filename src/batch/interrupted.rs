//! What a signal does to a command that runs without a screen: it ends as it would by itself, and leaves no hidden file
//! and no commit half done.

/// Catches the signals that end a program, but for those that are to be ignored (`nohup`, and Ctrl-C for what a shell
/// runs in the background): files that are being written are taken away before it ends by that signal.
#[cfg(unix)]
pub fn end_tidily() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let ignored = ignored();
    let caught = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // Where they cannot be caught, the program ends as any other.
    let Ok(mut signals) = signal_hook::iterator::Signals::new(caught) else { return };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            crate::track::take_unfinished_away();
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
}

/// Other systems have no signals.
#[cfg(not(unix))]
pub fn end_tidily() {}

/// The signals this program was started to ignore, one bit each from signal 1 on.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
