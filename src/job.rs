//! The worker thread: one job runs, one may wait, the newest wins.
//!
//! Handing in a job replaces the one that waits and tells the one that runs, through its [`Stop`], that nobody
//! waits for it any more. Results come back through a channel, each with the generation of its job, so that a late
//! one can be told from the one that is wanted.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;

use crate::stop::Stop;

/// A thread that does one kind of work.
#[derive(Debug)]
pub struct Worker<Job> {
    desk: Arc<Desk<Job>>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Desk<Job> {
    waiting: Mutex<Waiting<Job>>,
    bell: Condvar,
    newest: Arc<AtomicU64>,
}

#[derive(Debug)]
enum Waiting<Job> {
    Nothing,
    Job(u64, Job),
    Closed,
}

impl<Job: Send + 'static> Worker<Job> {
    /// A worker that does `work` for each job; `work` gets the generation of the job and should look at the
    /// [`Stop`] often.
    #[must_use]
    pub fn new(mut work: impl FnMut(u64, Job, &Stop) + Send + 'static) -> Self {
        let desk = Arc::new(Desk {
            waiting: Mutex::new(Waiting::Nothing),
            bell: Condvar::new(),
            newest: Arc::new(AtomicU64::new(0)),
        });
        let mine = Arc::clone(&desk);
        let thread = std::thread::spawn(move || {
            while let Some((generation, job)) = mine.next() {
                work(generation, job, &Stop::when_superseded(Arc::clone(&mine.newest), generation));
            }
        });
        Self { desk, thread: Some(thread) }
    }

    /// Hands in a job in place of any that waits or runs; gives its generation.
    pub fn submit(&self, job: Job) -> u64 {
        let generation = self.desk.newest.fetch_add(1, Ordering::Relaxed) + 1;
        self.desk.put(Waiting::Job(generation, job));
        generation
    }

    /// Abandons what waits and what runs.
    pub fn cancel(&self) {
        self.desk.newest.fetch_add(1, Ordering::Relaxed);
        self.desk.put(Waiting::Nothing);
    }
}

impl<Job> Desk<Job> {
    fn put(&self, what: Waiting<Job>) {
        *self.waiting.lock().unwrap_or_else(PoisonError::into_inner) = what;
        self.bell.notify_one();
    }

    /// The next job; none when the worker is closed.
    fn next(&self) -> Option<(u64, Job)> {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            match std::mem::replace(&mut *waiting, Waiting::Nothing) {
                Waiting::Job(generation, job) => return Some((generation, job)),
                Waiting::Closed => return None,
                Waiting::Nothing => waiting = self.bell.wait(waiting).unwrap_or_else(PoisonError::into_inner),
            }
        }
    }
}

impl<Job> Drop for Worker<Job> {
    fn drop(&mut self) {
        self.desk.newest.fetch_add(1, Ordering::Relaxed);
        self.desk.put(Waiting::Closed);
        if let Some(thread) = self.thread.take() {
            // A worker that panicked has already said so; there is nothing to add.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crossbeam_channel::{bounded, unbounded};

    #[test]
    fn the_newest_job_wins_and_the_running_one_is_told() {
        let (started, on_start) = unbounded();
        let (results, on_result) = unbounded();
        let (go, wait) = bounded::<()>(0);
        let worker = Worker::new(move |generation, job: &'static str, stop: &Stop| {
            started.send(job).unwrap();
            wait.recv().unwrap();
            results.send((generation, job, stop.requested())).unwrap();
        });
        worker.submit("first");
        assert_eq!(on_start.recv(), Ok("first"));
        worker.submit("second");
        worker.submit("third");
        go.send(()).unwrap();
        assert_eq!(on_result.recv(), Ok((1, "first", true)));
        assert_eq!(on_start.recv(), Ok("third"));
        go.send(()).unwrap();
        assert_eq!(on_result.recv(), Ok((3, "third", false)));
    }

    #[test]
    fn a_worker_ends_with_its_owner_and_a_cancelled_job_is_told() {
        let (started, on_start) = unbounded();
        let (results, on_result) = unbounded();
        let worker = Worker::new(move |_, (): (), stop: &Stop| {
            started.send(()).unwrap();
            while !stop.requested() {
                std::thread::yield_now();
            }
            results.send(()).unwrap();
        });
        worker.submit(());
        on_start.recv().unwrap();
        worker.cancel();
        on_result.recv().unwrap();
        drop(worker);
        assert!(on_result.recv().is_err(), "the thread has ended and dropped its sender");
    }
}
