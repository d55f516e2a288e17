//! Looks after the file of the record while it is open.

use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime};

use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded};

use super::message::Message;
use crate::track::{Standing, Track};

/// How often the file is looked at.
const PERIOD: Duration = Duration::from_secs(1);

/// This many times as long as the last look into the file took, none is taken: a large record that grows steadily does
/// not keep a core busy.
const REST: u32 = 20;

/// A watch over a file, for as long as it lives.
#[derive(Debug)]
pub struct Watch {
    _ends: Sender<()>,
}

impl Watch {
    /// Over the file of `track`; what it sees is sent. None for a record without a file.
    #[must_use]
    pub fn over(track: &Arc<Track>, results: Sender<Message>) -> Option<Self> {
        track.source.path()?;
        let (ends, ended) = bounded(0);
        let track = Arc::downgrade(track);
        std::thread::spawn(move || {
            let (mut seen, mut said, mut wait) = (None, Standing::Same, PERIOD);
            while still(&ended, wait) {
                let Some(track) = track.upgrade() else { return };
                let about = track.source.path().map(About::of);
                wait = PERIOD;
                // A record that has not been touched since it was loaded is not read.
                if about == seen || (seen.is_none() && about.as_ref().is_some_and(|a| a.bytes == Some(track.bytes))) {
                    seen = about;
                    continue;
                }
                let begun = Instant::now();
                let standing = Standing::of(&track);
                wait = PERIOD.max(begun.elapsed() * REST);
                seen = about;
                if standing != said && results.send(Message::Record(standing)).is_err() {
                    return;
                }
                said = standing;
            }
        });
        Some(Self { _ends: ends })
    }
}

/// Waits; false when the watch has ended.
fn still(ended: &Receiver<()>, wait: Duration) -> bool {
    ended.recv_timeout(wait) == Err(RecvTimeoutError::Timeout)
}

/// What a look at the folder tells of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
struct About {
    bytes: Option<u64>,
    changed: Option<SystemTime>,
}

impl About {
    fn of(path: &Path) -> Self {
        let about = path.metadata().ok();
        Self { bytes: about.as_ref().map(std::fs::Metadata::len), changed: about.and_then(|a| a.modified().ok()) }
    }
}
