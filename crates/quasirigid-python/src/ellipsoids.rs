//! Secular evolution of many ellipsoids in one call: blocks of rows on every core, eight at a time on each.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use quasirigid::averaging::{
    EllipsoidLoss, EllipsoidPassage, EllipsoidRefusal, Wobble, WobblingEllipsoid, ellipsoid_passages,
};
use quasirigid::dynamics::Rounding;
use quasirigid_study::StudyError;
use rayon::prelude::*;

use crate::ensemble::on_pool;
use crate::failure::Failure;
use crate::reduced::rows;
use crate::watching::{Shared, interruptible};

/// Rows that one thread takes at a time.
const BLOCK: usize = 1024;

/// Columns of numbers, a row for each ellipsoid.
type Numbers<'py> = PyReadonlyArray1<'py, f64>;

/// Columns of the ellipsoids, as a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Ellipsoids<'py> {
    semi_axes: PyReadonlyArray2<'py, f64>,
    density: Numbers<'py>,
    shear: Numbers<'py>,
    poisson: Numbers<'py>,
    loss: Numbers<'py>,
    /// Whether the loss is the time of a Kelvin–Voigt material, or a quality factor.
    kelvin_voigt: bool,
    spin: Numbers<'py>,
    from: Numbers<'py>,
    until: Numbers<'py>,
    /// Whether start and end are ratios `D/I₃`, or angles of nutation.
    ratios: [bool; 2],
}

impl Ellipsoids<'_> {
    fn read(&self) -> Result<Vec<WobblingEllipsoid>, Failure> {
        let semi_axes = rows(&self.semi_axes)?;
        let columns =
            [&self.density, &self.shear, &self.poisson, &self.loss, &self.spin, &self.from, &self.until];
        let columns = columns.map(|column| column.as_array());
        if let Some(column) = columns.iter().find(|column| column.len() != semi_axes.len()) {
            let (found, wanted) = (column.len(), semi_axes.len());
            return Err(Failure::Input(format!("a column has {found} rows, and semi_axes has {wanted}")));
        }
        let wobble =
            |ratio: bool, value: f64| if ratio { Wobble::Ratio(value) } else { Wobble::Nutation(value) };
        let ellipsoid = |(i, semi_axes): (usize, [f64; 3])| {
            let [density, shear, poisson, loss, spin, from, until] =
                columns.each_ref().map(|column| column[i]);
            WobblingEllipsoid {
                semi_axes,
                density,
                shear,
                poisson,
                loss: if self.kelvin_voigt {
                    EllipsoidLoss::KelvinVoigt(loss)
                } else {
                    EllipsoidLoss::QualityFactor(loss)
                },
                spin,
                from: wobble(self.ratios[0], from),
                until: wobble(self.ratios[1], until),
            }
        };
        Ok(semi_axes.into_iter().enumerate().map(ellipsoid).collect())
    }
}

/// Columns of the answers; the reasons of rows that do not hold, with their numbers.
#[derive(IntoPyObject)]
pub struct Passages<'py> {
    time: Bound<'py, PyArray1<f64>>,
    turns: Bound<'py, PyArray1<f64>>,
    power: Bound<'py, PyArray1<f64>>,
    error: Bound<'py, PyArray1<f64>>,
    holds: Bound<'py, PyArray1<bool>>,
    reasons: Vec<(usize, String)>,
}

/// The secular evolution of each ellipsoid.
#[pyfunction]
pub fn evolve_ellipsoids<'py>(
    py: Python<'py>,
    columns: Ellipsoids<'py>,
    reproducible: bool,
    observer: Option<Py<PyAny>>,
) -> PyResult<Passages<'py>> {
    let bodies = columns.read()?;
    let rounding = if reproducible { Rounding::Reproducible } else { Rounding::Fastest };
    let found = interruptible(py, observer.as_ref(), |shared| follow(bodies, rounding, shared))?;
    let column = |of: fn(&EllipsoidPassage) -> f64| {
        let values = found.iter().map(|row| row.as_ref().map_or(f64::NAN, of));
        PyArray1::from_iter(py, values)
    };
    let reason = |(i, row): (usize, &Result<EllipsoidPassage, EllipsoidRefusal>)| {
        row.as_ref().err().map(|refusal| (i, refusal.to_string()))
    };
    Ok(Passages {
        time: column(|passage| passage.time),
        turns: column(|passage| passage.revolutions),
        power: column(|passage| passage.power),
        error: column(|passage| {
            let of_quadrature =
                if passage.time > 0.0 { passage.quadrature_error / passage.time } else { 0.0 };
            passage.error + of_quadrature
        }),
        holds: PyArray1::from_iter(py, found.iter().map(Result::is_ok)),
        reasons: found.iter().enumerate().filter_map(reason).collect(),
    })
}

fn follow(
    bodies: Vec<WobblingEllipsoid>,
    rounding: Rounding,
    shared: &Arc<Shared>,
) -> Result<Vec<Result<EllipsoidPassage, EllipsoidRefusal>>, Failure> {
    let own = Arc::clone(shared);
    on_pool(shared, move || {
        let (done, count) = (AtomicUsize::new(0), bodies.len());
        let blocks = bodies.par_chunks(BLOCK).map(|block| {
            if own.stopped() {
                return Err(StudyError::Interrupted.into());
            }
            let found = ellipsoid_passages(block, rounding);
            let done = done.fetch_add(block.len(), Ordering::Relaxed) + block.len();
            own.tell("rows", done as f64 / count as f64);
            Ok(found)
        });
        let blocks: Result<Vec<_>, Failure> = blocks.collect();
        blocks.map(|blocks| blocks.concat())
    })?
}
