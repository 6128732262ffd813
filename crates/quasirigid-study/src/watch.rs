//! Progress and cancellation of long work.

use std::ops::ControlFlow;

/// Watches long work: shows how far it is, and may end it.
pub trait Watch {
    /// Told from time to time how far a stage of the work is, from 0 to 1. Work that is told to break ends with what it has.
    fn at(&mut self, stage: &str, share: f64) -> ControlFlow<()>;

    /// Told what cannot wait for the end of the work.
    fn remark(&mut self, _sentence: &str) {}
}

/// Nobody watches: the work goes on to its end.
impl Watch for () {
    fn at(&mut self, _: &str, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}
