//! The worker: one job is wanted, the newest.
//!
//! Handing in a job replaces the one that waits and tells the one that runs, through its [`Stop`], that nobody
//! waits for it any more. There are two threads: the new job begins at once while the old one puts down what it had in
//! hands, which takes longer than to notice (the memory of ten million samples is given back in some 20 ms). Results
//! come back through a channel, each with the generation of its job, so that a late one can be told from the one that
//! is wanted.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;

use crate::stop::Stop;

/// Threads that do one kind of work.
#[derive(Debug)]
pub struct Worker<Job> {
    desk: Arc<Desk<Job>>,
    threads: Vec<JoinHandle<()>>,
}

/// One for the job that is wanted, one for the job before it.
const THREADS: usize = 2;

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
    pub fn new(work: impl Fn(u64, Job, &Stop) + Send + Sync + 'static) -> Self {
        let desk = Arc::new(Desk {
            waiting: Mutex::new(Waiting::Nothing),
            bell: Condvar::new(),
            newest: Arc::new(AtomicU64::new(0)),
        });
        let work = Arc::new(work);
        let thread = |_| {
            let (desk, work) = (Arc::clone(&desk), Arc::clone(&work));
            std::thread::spawn(move || {
                while let Some((generation, job)) = desk.next() {
                    work(generation, job, &Stop::when_superseded(Arc::clone(&desk.newest), generation));
                }
            })
        };
        let threads = (0..THREADS).map(thread).collect();
        Self { desk, threads }
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
        self.bell.notify_all();
    }

    /// The next job; none when the worker is closed.
    fn next(&self) -> Option<(u64, Job)> {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            match std::mem::replace(&mut *waiting, Waiting::Nothing) {
                Waiting::Job(generation, job) => return Some((generation, job)),
                Waiting::Closed => {
                    *waiting = Waiting::Closed;
                    return None;
                }
                Waiting::Nothing => waiting = self.bell.wait(waiting).unwrap_or_else(PoisonError::into_inner),
            }
        }
    }
}

impl<Job> Drop for Worker<Job> {
    fn drop(&mut self) {
        self.desk.newest.fetch_add(1, Ordering::Relaxed);
        self.desk.put(Waiting::Closed);
        for thread in self.threads.drain(..) {
            // A worker that panicked has already said so; there is nothing to add.
            let _ = thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crossbeam_channel::{bounded, unbounded};

    #[test]
    fn the_newest_job_wins_and_begins_while_the_one_before_is_still_ending() {
        let (started, on_start) = unbounded();
        let (results, on_result) = unbounded();
        let doors: HashMap<_, _> = ["first", "second", "fourth"].map(|job| (job, bounded::<()>(0))).into();
        let open = doors.clone();
        let worker = Worker::new(move |generation, job: &'static str, stop: &Stop| {
            started.send(job).unwrap();
            doors[job].1.recv().unwrap();
            results.send((generation, job, stop.requested())).unwrap();
        });
        let go = |job| open[job].0.send(()).unwrap();
        worker.submit("first");
        assert_eq!(on_start.recv(), Ok("first"));
        worker.submit("second");
        assert_eq!(on_start.recv(), Ok("second"), "it does not wait for the first");
        worker.submit("third");
        worker.submit("fourth");
        go("first");
        assert_eq!(on_result.recv(), Ok((1, "first", true)));
        assert_eq!(on_start.recv(), Ok("fourth"), "nobody waits for the third");
        go("second");
        assert_eq!(on_result.recv(), Ok((2, "second", true)));
        go("fourth");
        assert_eq!(on_result.recv(), Ok((4, "fourth", false)));
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
