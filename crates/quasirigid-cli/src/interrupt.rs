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
    /// Whether the work has seen it, and is about to end with what it has.
    heard: AtomicBool,
}

/// Time in which the work must see it: longer than between any two questions of a propagation.
const GRACE: Duration = Duration::from_secs(2);
/// Time between two looks whether it has.
const LOOK: Duration = Duration::from_millis(20);

impl Interrupt {
    /// Starts to listen for Ctrl-C, and for signals to end. The work that sees one ends with what it has; work that does not see it
    /// in time ends with nothing, and so does any at the second one.
    pub fn listen() -> Result<Self, Failure> {
        let state = Arc::new(State::default());
        let seen = Arc::clone(&state);
        ctrlc::set_handler(move || {
            if seen.pressed.swap(true, Ordering::SeqCst) {
                end();
            }
            let waiting = Arc::clone(&seen);
            thread::spawn(move || waiting.wait());
        })?;
        Ok(Self(state))
    }

    /// Whether it was pressed since the last [`forget`](Self::forget).
    pub fn pressed(&self) -> bool {
        let pressed = self.0.pressed.load(Ordering::SeqCst);
        if pressed {
            self.0.heard.store(true, Ordering::SeqCst);
        }
        pressed
    }

    /// Waits for it to be pressed again.
    pub fn forget(&self) {
        self.0.pressed.store(false, Ordering::SeqCst);
        self.0.heard.store(false, Ordering::SeqCst);
    }
}

impl State {
    /// Ends the program unless the work sees in time that it was pressed.
    fn wait(&self) {
        let start = Instant::now();
        while start.elapsed() < GRACE {
            if self.heard.load(Ordering::SeqCst) || !self.pressed.load(Ordering::SeqCst) {
                return;
            }
            thread::sleep(LOOK);
        }
        end();
    }
}

/// Ends the program. Results appear only when they are whole, so what stands on the disk is what stood there before.
#[allow(clippy::exit)] // the work does not return in time
fn end() {
    abandon(|| {
        message::print(&Failure::Abandoned);
        process::exit(1)
    });
}
