//! A solid inside a surface by finite elements.

use std::sync::Arc;

use super::{Approximation, PartReduction, Resolution, Surface, SurfaceBody};
use crate::contribution::Exact;
use crate::error::{ElementId, Problem};
use crate::kinds::part::{ElasticMaterial, Part, PartKind, Region, Solid};
use crate::material::Material;
use crate::math::sym3::Sym;
use crate::model::FlexibleBody;
use crate::structure::Condensation;
use crate::{Assembly, Visual};
use quasirigid_mesh::meshing::{GradedMesh, Neck, graded};

/// Body made of cells.
pub(super) struct Meshed {
    pub body: FlexibleBody,
    pub mesh: GradedMesh,
    pub cells: usize,
    asked: usize,
    condensation: Option<Condensation>,
    visuals: Vec<Visual>,
}

impl Meshed {
    /// Solid in about so many cells, finest in a neck. Mass, centre and inertia are those of the surface itself. (G11)
    pub fn new(
        solid: &Surface,
        place: ElementId,
        asked: usize,
        neck: Option<&Neck>,
        (reduction, visuals): (PartReduction, bool),
    ) -> Result<Self, Problem> {
        let mesh = graded(&solid.surface, neck, asked)?;
        let cells = mesh.mesh.cells.len();
        let exact = exact(solid);
        let all: Vec<usize> = (0..cells).collect();
        let density = exact.mass / mesh.mesh.volume(&all);
        let material = Material { density, ..solid.material.clone() };
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let region = Region {
            cells: all,
            name: String::new(),
            material: ElasticMaterial::Isotropic(material),
            axes,
            grading: None,
        };
        let kind = PartKind::Solid(Solid { mesh: Arc::new(mesh.mesh.clone()), regions: vec![region] });
        let (name, masses, attached) = (solid.name.clone(), Vec::new(), Vec::new());
        let part = Part { name, kind, masses, attached, rayleigh: [0.0; 2] };
        let assembly = Assembly { parts: vec![part], reduction, ..Assembly::default() };
        let built = assembly.floating(&[], Some(exact), visuals).map_err(|error| error.problem)?;
        let visuals = built.visuals.into_iter().map(|visual| Visual {
            element: place,
            kind: place.kind.words(),
            ..visual
        });
        Ok(Self {
            body: built.body,
            mesh,
            cells,
            asked,
            condensation: built.condensation,
            visuals: visuals.collect(),
        })
    }

    /// The body with its error.
    pub fn found(self, error: f64) -> SurfaceBody {
        let approximation = Approximation::Elements { cells: self.cells, asked: self.asked };
        let resolution = Resolution { approximation, error };
        SurfaceBody { body: self.body, condensation: self.condensation, resolution, visuals: self.visuals }
    }
}

impl Surface {
    /// Inertia tensor (kg·m²) about the centre of mass, axes of the file. (G9)
    pub(crate) fn inertia(&self) -> Sym {
        exact(self).inertia
    }
}

/// Mass, centre and inertia of the solid, from the moments of the surface. (G9)
fn exact(solid: &Surface) -> Exact<'_> {
    let [low, high] = solid.surface.bounds();
    let scale = [0, 1, 2].map(|axis| 0.5 * (high[axis] - low[axis]));
    let center = solid.surface.centroid();
    let moments = solid.surface.moments(2, center, scale);
    let unit = solid.material.density * scale.iter().product::<f64>();
    let second = |a: usize, b: usize| {
        let mut exponents = [0; 3];
        exponents[a] += 1;
        exponents[b] += 1;
        unit * scale[a] * scale[b] * moments.of(exponents)
    };
    let [xx, yy, zz] = [0, 1, 2].map(|axis| second(axis, axis));
    let inertia: Sym = [yy + zz, zz + xx, xx + yy, -second(1, 2), -second(2, 0), -second(0, 1)];
    Exact { name: &solid.name, mass: unit * moments.of([0; 3]), center, inertia }
}
