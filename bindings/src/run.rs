//! Running a scene: one thread works, the caller's listens.

use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use engine::scene::Scene;
use engine::simulation::{Panes, Shelters, Simulation};
use pyo3::prelude::*;

use crate::recording::{Recording, Timing};
use crate::{InputError, engine, refused};

/// How often a run listens for Ctrl-C and reports how far it is.
const HEARTBEAT: Duration = Duration::from_millis(50);

/// Threads beyond this only cost time to start; the result is the same for any number.
const MOST_THREADS: usize = 256;

/// What the thread that works and the one that listens tell each other.
#[derive(Default)]
struct Watch {
    stop: AtomicBool,
    done: AtomicUsize,
    total: AtomicUsize,
}

/// Runs a scene in a thread of its own while this one listens for Ctrl-C, which Python hands to it alone, and reports
/// progress.
pub fn watched(
    scene: &Scene,
    threads: Option<usize>,
    most_pieces: usize,
    progress: Option<&Py<PyAny>>,
) -> PyResult<Recording> {
    let watch = Watch::default();
    let (working, ended) = mpsc::channel::<()>();
    thread::scope(|scope| {
        let worker = scope.spawn(|| {
            let _working = working;
            pooled(threads, || run(scene, most_pieces, &watch))
        });
        let mut interruption = None;
        while ended.recv_timeout(HEARTBEAT) == Err(RecvTimeoutError::Timeout) {
            if let Err(error) = watch.report(progress) {
                watch.stop.store(true, Relaxed);
                interruption = Some(error);
                break;
            }
        }
        let result = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
        match interruption {
            Some(error) => Err(error),
            None => watch.report(progress).and(result),
        }
    })
}

impl Watch {
    /// Passes on a Ctrl-C, and calls back with how many frames are done, and of how many.
    fn report(&self, progress: Option<&Py<PyAny>>) -> PyResult<()> {
        Python::attach(|py| {
            py.check_signals()?;
            let (done, total) = (self.done.load(Relaxed), self.total.load(Relaxed));
            progress.filter(|_| total > 0).map_or(Ok(()), |call| call.call1(py, (done, total)).map(drop))
        })
    }

    fn goes_on(&self) -> ControlFlow<()> {
        if self.stop.load(Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Does the work with a number of threads, or with as many as there are.
fn pooled(threads: Option<usize>, work: impl FnOnce() -> PyResult<Recording> + Send) -> PyResult<Recording> {
    let Some(count) = threads else { return work() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count.min(MOST_THREADS)).build();
    pool.map_err(|e| InputError::new_err(format!("{count} threads could not be started: {e}")))?.install(work)
}

fn run(scene: &Scene, most_pieces: usize, watch: &Watch) -> PyResult<Recording> {
    let start = Instant::now();
    let mut shelters = Shelters::find(scene).map_err(refused)?;
    let occlusion = start.elapsed();
    let panes = Panes::find(scene, &mut shelters, most_pieces, &mut || watch.goes_on()).map_err(refused)?;
    let fracture = start.elapsed() - occlusion;
    let simulation =
        Simulation::prepare_broken(scene, shelters, &panes, &mut || watch.goes_on()).map_err(refused)?;
    let load = start.elapsed() - occlusion - fracture;
    let recorded = simulation.run(&mut |done, total| {
        watch.done.store(done, Relaxed);
        watch.total.store(total, Relaxed);
        watch.goes_on()
    });
    let dynamics = start.elapsed() - occlusion - fracture - load;
    let timing = Timing { occlusion, fracture, load, dynamics };
    Ok(Recording::new(recorded.map_err(refused)?, panes.panes, timing))
}
