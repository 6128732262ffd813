//! Choice of the method for the flows in a cavity: exact, polynomials of the meridian, finite elements, or a boundary layer.
//! Exact flows lose digits at high degree, so fast changes of the spin go to polynomials in patches or to graded cells.
//! Equations (L4), (L9), (L10), (L12) and (L14), docs/theory/13-inside.md.

use std::borrow::Cow;

use nalgebra::Matrix3;

use super::ellipsoid::EllipsoidFlow;
use super::liquid::{Memory, Relaxations};
use super::meshed::MeshedFlow;
use super::pipe::PipeFlow;
use super::revolved::MeridianFlow;
use super::shape::{CavityShape, Extent};
use super::{boundary_layer, ideal};
use crate::error::{Field, Problem};
use crate::flow::revolution::{self, Fineness, Outline};
use crate::flow::stokes;
use quasirigid_mesh::Mesh;

/// Flows in a cavity, in its axes.
pub(super) struct Flowing {
    pub extent: Extent,
    pub relaxations: Relaxations,
    /// Estimate of the relative error in `P` about each axis; none of exact and of ideal flows.
    pub errors: Option<[f64; 3]>,
    /// Inertia tensor of the body that an ideal liquid is equivalent to, of unit density (m⁵).
    pub equivalent: Option<Matrix3<f64>>,
}

/// Lowest and highest degree of the polynomials in a cavity of revolution.
const DEGREES: [usize; 2] = [4, 24];
/// Rates of change that the exact flows resolve; polynomials of higher degree lose their digits to rounding.
const KNOWN: usize = 2;
/// Rates of change that one layer of patches along walls resolves.
const FAST: usize = 3;
/// Grading of the cells of a mesh: even, and finer towards the walls for the boundary layers of fast changes.
const EVEN: f64 = 1.0;
const LAYERS: f64 = 2.0;

impl Flowing {
    /// An ideal liquid behind a boundary layer.
    pub fn layered(shape: &CavityShape, resolution: usize, modes: usize) -> Result<Self, (Field, Problem)> {
        let unresolved = (Field::SHAPE, Problem::LiquidUnresolved);
        let (extent, slip) = if let CavityShape::Ellipsoid { semi_axes } = *shape {
            (shape.extent(), Some(ideal::in_ellipsoid(semi_axes)))
        } else if let Some((outline, axis)) = shape.revolution() {
            let degree = polynomial_degree(resolution)?;
            (shape.extent(), revolution::slip(&outline, degree).map(|slip| slip.about(axis)))
        } else {
            let mesh = cells(shape, resolution, EVEN)?;
            let (moments, slip) = stokes::slip(&mesh).map_err(|error| (Field::SHAPE, error.into()))?;
            (Some(shape.extent().unwrap_or_else(|| (&moments).into())), Some(slip))
        };
        let (extent, slip) = extent.zip(slip).ok_or(unresolved.clone())?;
        let relaxations =
            boundary_layer::relaxations(&slip, modes + 1, extent.mean_inertia()).ok_or(unresolved)?;
        Ok(Self { extent, relaxations, errors: None, equivalent: Some(slip.equivalent(extent.inertia())) })
    }

    /// Flows in a cavity: exact where they are known, else of polynomials or finite elements.
    pub fn new(shape: &CavityShape, resolution: usize, memory: Memory) -> Result<Self, (Field, Problem)> {
        let unresolved = (Field::SHAPE, Problem::LiquidUnresolved);
        if shape.is_known() && memory.modes <= KNOWN {
            return Self::exact(shape, memory).ok_or(unresolved);
        }
        if let Some((outline, axis)) = shape.revolution() {
            let extent = shape.extent().ok_or(unresolved)?;
            return Self::revolved(extent, &outline, axis, resolution, memory);
        }
        let grading = if memory.modes > 0 { LAYERS } else { EVEN };
        let mesh = cells(shape, resolution, grading)?;
        Self::meshed(&mesh, shape.extent(), memory)
    }

    fn exact(shape: &CavityShape, memory: Memory) -> Option<Self> {
        let extent = shape.extent()?;
        let steps = memory.depth.saturating_sub(1).max(3 * memory.modes);
        let mass = extent.mean_inertia();
        let relaxations = match *shape {
            CavityShape::Ellipsoid { semi_axes } => {
                Relaxations::of(&EllipsoidFlow::new(semi_axes, 3 + 2 * steps)?, memory, mass)
            }
            CavityShape::Ring { radius, tube_radius } => {
                Relaxations::of(&PipeFlow::new(radius, tube_radius, 1 + steps)?, memory, mass)
            }
            _ => None,
        };
        Some(Self { extent, relaxations: relaxations?, errors: None, equivalent: None })
    }

    fn revolved(
        extent: Extent,
        outline: &Outline,
        axis: usize,
        degree: usize,
        memory: Memory,
    ) -> Result<Self, (Field, Problem)> {
        let degree = polynomial_degree(degree)?;
        let refused = |error| (Field::SHAPE, Problem::Stokes(error));
        let layers = if memory.modes > FAST { 2 } else { 1 };
        let fine = Fineness { degree, layers, harmonics: memory.depth };
        let coarse = Fineness { degree: degree - 1, layers: 1, harmonics: 1 };
        let flow = MeridianFlow::new(outline, axis, fine).map_err(refused)?;
        let coarse = MeridianFlow::new(outline, axis, coarse).map_err(refused)?;
        let [fine, coarse] = [flow.answers(), coarse.answers()];
        let relaxations = Relaxations::of(&flow, memory, extent.mean_inertia());
        Ok(Self {
            extent,
            relaxations: relaxations.ok_or((Field::SHAPE, Problem::LiquidUnresolved))?,
            errors: Some([0, 1, 2].map(|axis| (coarse[axis] / fine[axis] - 1.0).abs())),
            equivalent: None,
        })
    }

    fn meshed(mesh: &Mesh, extent: Option<Extent>, memory: Memory) -> Result<Self, (Field, Problem)> {
        let flow = MeshedFlow::new(mesh).map_err(|error| (Field::SHAPE, error.into()))?;
        let extent = extent.unwrap_or_else(|| flow.extent());
        let relaxations = Relaxations::of(&flow, memory, extent.mean_inertia());
        Ok(Self {
            extent,
            relaxations: relaxations.ok_or((Field::SHAPE, Problem::LiquidUnresolved))?,
            errors: Some(flow.errors()),
            equivalent: None,
        })
    }
}

fn cells(shape: &CavityShape, resolution: usize, grading: f64) -> Result<Cow<'_, Mesh>, (Field, Problem)> {
    let mesh = shape.mesh(resolution, grading).ok_or((Field::SHAPE, Problem::LiquidUnresolved))?;
    mesh.map_err(|error| (Field::SHAPE, error.into()))
}

fn polynomial_degree(resolution: usize) -> Result<usize, (Field, Problem)> {
    let ([least, most], degree) = (DEGREES, resolution);
    if (least..=most).contains(&degree) {
        Ok(degree)
    } else {
        Err((Field::RESOLUTION, Problem::FlowDegree { degree, least, most }))
    }
}
