use std::io;
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use crate::failure::Failure;
use crate::message;
use crate::output::abandon;

/// Whether Ctrl-C was pressed, or the system asked for an end.
#[derive(Clone, Debug)]
pub struct Interrupt(Arc<State>);

#[derive(Debug, Default)]
struct State {
    pressed: AtomicBool,
    /// Whether the work has seen Ctrl-C, and is about to end with its partial result.
    heard: AtomicBool,
    /// Whether what the work has written is kept, and gone on with later.
    resumable: AtomicBool,
}

/// Time in which the work must see Ctrl-C: longer than between any two questions of a propagation, and under the second in which a person
/// presses it again.
const GRACE: Duration = Duration::from_millis(900);
/// Time between two checks of that.
const CHECK_INTERVAL: Duration = Duration::from_millis(20);

impl Interrupt {
    /// Starts to listen for Ctrl-C, and for signals to end. Work that sees one ends with its partial result; work that does not see it
    /// in time ends with nothing, and so does any work at the second one.
    pub fn listen() -> Result<Self, Failure> {
        let state = Arc::new(State::default());
        let seen = Arc::clone(&state);
        at_signals(move || {
            if seen.pressed.swap(true, Ordering::SeqCst) {
                seen.end();
            }
            let waiting = Arc::clone(&seen);
            thread::spawn(move || waiting.wait());
        })
        .map_err(Failure::Signals)?;
        Ok(Self(state))
    }

    /// Whether Ctrl-C was pressed since the last [`forget`](Self::forget).
    pub fn pressed(&self) -> bool {
        let pressed = self.0.pressed.load(Ordering::SeqCst);
        if pressed {
            self.0.heard.store(true, Ordering::SeqCst);
        }
        pressed
    }

    /// Says that the work keeps what it has written, to go on with it later.
    pub fn keep(&self) {
        self.0.resumable.store(true, Ordering::SeqCst);
    }

    /// Forgets the last Ctrl-C and waits for the next.
    pub fn forget(&self) {
        self.0.pressed.store(false, Ordering::SeqCst);
        self.0.heard.store(false, Ordering::SeqCst);
    }
}

/// Does something at each signal to end: Ctrl-C, SIGTERM, the limit of processor time, and the end of the terminal unless that is to be
/// ignored, as `nohup` has it.
#[cfg(unix)]
fn at_signals(act: impl Fn() + Send + 'static) -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXCPU};
    let mut wanted = vec![SIGINT, SIGTERM, SIGXCPU];
    if !is_ignored(SIGHUP) {
        wanted.push(SIGHUP);
    }
    let mut signals = signal_hook::iterator::Signals::new(wanted)?;
    thread::spawn(move || signals.forever().for_each(|_| act()));
    Ok(())
}

#[cfg(not(unix))]
fn at_signals(act: impl Fn() + Send + 'static) -> io::Result<()> {
    ctrlc::set_handler(act).map_err(io::Error::other)
}

/// Whether this process was started with a signal ignored, where the system says so.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    ignored.is_some_and(|mask| {
        u64::from_str_radix(mask.trim(), 16).is_ok_and(|mask| mask >> (signal - 1) & 1 == 1)
    })
}

/// Makes a file beyond the size that the system allows an error of its writing, not the end of the program.
pub fn survive_limits() {
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default()); // without it the program ends, as most do
}

impl State {
    /// Ends the program unless the work sees Ctrl-C in time.
    fn wait(&self) {
        let start = Instant::now();
        while start.elapsed() < GRACE {
            if self.heard.load(Ordering::SeqCst) || !self.pressed.load(Ordering::SeqCst) {
                return;
            }
            thread::sleep(CHECK_INTERVAL);
        }
        self.end();
    }

    /// Ends the program. Results appear only when they are whole, so what stands on the disk is what stood there before, or what a
    /// study goes on from.
    #[allow(clippy::exit)] // the work does not return in time
    fn end(&self) {
        let resumable = self.resumable.load(Ordering::SeqCst);
        abandon(|| {
            message::print(if resumable { &Failure::Left } else { &Failure::Abandoned });
            process::exit(1)
        });
    }
}
