//! Secular evolution: change of the rotation of a free body over many revolutions, by the method that holds there.
//!
//! Where the internal motion settles much faster than the wobble changes, and is light, one may average along the polhode of the rigid
//! body. Elsewhere the full system gives the mean power at a few places ([`MeasuredPower`]), or the whole history ([`follow_directly`]).
//! Every method is checked against the steady spins and their modes, [`Poles`]; [`choice`] decides which of them an evolution takes.

pub mod choice;

mod calibrated;
mod criteria;
mod direct;
mod energy_range;
mod gyrostat;
mod manifold_boundary;
mod mean_power;
mod measure;
mod measured_power;
mod measurement_point;
mod on_manifold;
mod periodic_place;
mod poles;
mod settled_start;
mod spot_checks;
mod start;
mod wobbling;

pub use calibrated::CalibratedPower;
pub use criteria::{AverageCriteria, apart, average_criteria};
pub use direct::{DirectOptions, DirectRow, DirectRun, DirectStopReason, follow_directly};
pub use energy_range::EnergyRange;
pub use gyrostat::{GyrostatSpins, GyrostatWobble};
pub use manifold_boundary::ManifoldBoundary;
pub use measure::{MeasureError, MeasuredBy, Measurement};
pub use measured_power::{MeasuredPower, Places};
pub use measurement_point::{MeasureOptions, micro_run_periods};
pub use on_manifold::{ManifoldHistory, follow_about, follow_on_manifold};
pub use poles::{Pole, Poles};
pub use settled_start::SettledStarts;
pub use spot_checks::SpotChecks;
pub use start::{spun_displacements, spun_state};
