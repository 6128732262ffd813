use std::ops::Range;

use thiserror::Error;

use super::{
    Advection, CurvedPaths, Displaced, Dissipator, Invariants, LiquidMemory, PartMass, Rheology, Support,
    Watched, Wheels,
};
use crate::math::cholesky::Cholesky;
use crate::math::eigen::Dense;
use crate::math::sparse::SparseRows;
use crate::math::sym3;
use crate::math::vec3;

/// A body that bends and dissipates, as its dynamics sees it: the first waist of the program.
///
/// The body frame has the axes of the model file and its origin at the pole `O`. `n` internal coordinates `q` with
/// mass, damping and stiffness matrices `A, B, C` (paper, (1.3)–(1.5)): first the elastic ones, whose values springs
/// hold, then the cyclic ones, which no spring holds and whose rates friction slaves to the spin. (C1)
#[derive(Clone, Debug)]
pub struct FlexibleBody {
    support: Support,
    pole: [f64; 3],
    center_of_mass: [f64; 3],
    invariants: Invariants,
    damping: SparseRows<f64>,
    stiffness: SparseRows<f64>,
    lossy: Vec<Lossy>,
    dissipators: Vec<Dissipator>,
    memories: Vec<LiquidMemory>,
    advections: Vec<Advection>,
    watched: Watched,
    part_masses: Vec<PartMass>,
    factor: Cholesky,
    /// Number of elastic coordinates, and the factor of the damping of the others.
    elastic: usize,
    friction: Cholesky,
    wheels: Wheels,
    coordinates: Vec<Coordinate>,
    markers: Vec<Marker>,
    paths: Option<CurvedPaths>,
}

/// An internal coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// What moves, in words: `tip x`, `boom hinge 1`.
    pub name: String,
    /// Unit of its value, `m` or `rad`.
    pub unit: &'static str,
}

impl Coordinate {
    /// Whether it is a displacement of a whole structure, of which [`FlexibleBody::part_masses`] says what moves.
    #[must_use]
    pub fn is_shape(&self) -> bool {
        self.name.starts_with("shape ")
    }

    /// Name of the part that it moves, as the model file has it.
    #[must_use]
    pub fn part(&self) -> &str {
        let mut quoted = self.name.split('"');
        match (quoted.next(), quoted.next()) {
            (Some(""), Some(name)) => name,
            _ => self.name.split(' ').next().unwrap_or(&self.name),
        }
    }
}

/// Part of the stiffness whose loss no equation of motion holds: a material with a rheology of its own.
///
/// The equations of motion take it as elastic; the response to a periodic load, which is what averaging asks for, has
/// its [`modulus`](Rheology::modulus) at every frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Lossy {
    /// How it answers periodic strain.
    pub rheology: Rheology,
    /// Its part of `C`.
    pub stiffness: SparseRows<f64>,
}

/// A place on the body: its displacement says whether the body stays nearly rigid, and a force may act there.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// What it marks.
    pub name: String,
    /// Equilibrium position from the pole (m).
    pub position: [f64; 3],
    /// Coordinates that move it, with the displacement per unit `H_j` of each.
    pub shapes: Vec<(usize, [f64; 3])>,
    /// Curvature `G_jk` of its path for pairs of them, in both orders (m); none on straight paths. (I8)
    pub curvature: Vec<(usize, usize, [f64; 3])>,
}

/// Matrices that do not belong to a body with an equilibrium.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FlexibleError {
    /// Some motion of the coordinates meets no stiffness.
    #[error("a mechanism: no spring resists some motion of {coordinates}")]
    Mechanism {
        /// The coordinates that move, by name.
        coordinates: String,
    },
    /// A cyclic coordinate that nothing brakes.
    #[error("no friction brakes some motion of {coordinates}")]
    Frictionless {
        /// The coordinates that move, by name.
        coordinates: String,
    },
}

impl FlexibleError {
    /// The coordinates that move, by name.
    #[must_use]
    pub fn coordinates(self) -> String {
        match self {
            Self::Mechanism { coordinates } | Self::Frictionless { coordinates } => coordinates,
        }
    }
}

/// The parts of a [`FlexibleBody`].
#[derive(Clone, Debug)]
pub struct Parts {
    /// How the body is held.
    pub support: Support,
    /// Pole `O` (m), in the file's frame.
    pub pole: [f64; 3],
    /// Centre of mass of the frozen body (m), in the file's frame.
    pub center_of_mass: [f64; 3],
    /// Inertia invariants about the pole.
    pub invariants: Invariants,
    /// Damping matrix `B`.
    pub damping: SparseRows<f64>,
    /// Stiffness matrix `C`.
    pub stiffness: SparseRows<f64>,
    /// Parts of `C` with a loss that is neither in `B` nor zero.
    pub lossy: Vec<Lossy>,
    /// What takes energy: their parts of `B` sum to it, their losses to the lossy parts of `C`. (D1)
    pub dissipators: Vec<Dissipator>,
    /// Liquids whose linear answer is known at every frequency.
    pub memories: Vec<LiquidMemory>,
    /// One per coordinate.
    pub coordinates: Vec<Coordinate>,
    /// How many of them, the last ones, are cyclic: of these only the rates count, and `A`, `B`, `h` and the gyroscopic
    /// coupling are all that the matrices hold.
    pub cyclic: usize,
    /// Momentum wheels.
    pub wheels: Wheels,
    /// Places whose displacement is watched.
    pub markers: Vec<Marker>,
}

/// Components of a null direction below this share of the largest are not named.
const NAMED: f64 = 0.1;
/// Coordinates named in an error, at most.
const MOST_NAMES: usize = 6;

impl FlexibleBody {
    /// Joins the parts of a body.
    ///
    /// # Errors
    /// [`FlexibleError`] names the coordinates that no spring holds, or no friction brakes.
    pub fn new(parts: Parts) -> Result<Self, FlexibleError> {
        let Parts { support, pole, center_of_mass, invariants, damping, .. } = parts;
        let Parts { stiffness, lossy, dissipators, memories, coordinates, cyclic, wheels, markers, .. } =
            parts;
        let elastic = coordinates.len() - cyclic;
        let (held, braked) = coordinates.split_at(elastic);
        let factor = Cholesky::new(&stiffness.block(0..elastic))
            .map_err(|singular| FlexibleError::Mechanism { coordinates: named(held, &singular.direction) })?;
        let friction = Cholesky::new(&damping.block(elastic..coordinates.len())).map_err(|singular| {
            FlexibleError::Frictionless { coordinates: named(braked, &singular.direction) }
        })?;
        Ok(Self {
            support,
            pole,
            center_of_mass,
            invariants,
            damping,
            stiffness,
            lossy,
            dissipators,
            memories,
            advections: Vec::new(),
            watched: Watched::default(),
            part_masses: Vec::new(),
            factor,
            elastic,
            friction,
            wheels,
            coordinates,
            markers,
            paths: None,
        })
    }

    /// The same body with all that the second order of its paths does to the full equations. (K12)
    #[must_use]
    pub fn along(self, paths: Option<CurvedPaths>) -> Self {
        Self { paths, ..self }
    }

    /// The same body with the advection of its liquids. (L21)
    #[must_use]
    pub fn advected(self, advections: Vec<Advection>) -> Self {
        Self { advections, ..self }
    }

    /// Advection of its liquids, where it is known. (L21)
    #[must_use]
    pub fn advections(&self) -> &[Advection] {
        &self.advections
    }

    /// The same body with places and hinges whose displacements are watched.
    #[must_use]
    pub fn watching(self, watched: Watched) -> Self {
        Self { watched, ..self }
    }

    /// Places and hinges whose displacements are watched.
    #[must_use]
    pub fn watched(&self) -> &Watched {
        &self.watched
    }

    /// The same body with the mass of each part of its structure.
    #[must_use]
    pub fn made_of(self, part_masses: Vec<PartMass>) -> Self {
        Self { part_masses, ..self }
    }

    /// Mass of each part of its structure. (M5)
    #[must_use]
    pub fn part_masses(&self) -> &[PartMass] {
        &self.part_masses
    }

    /// What has left the range in which the equations hold at these coordinates; none if nothing has. (K14)
    #[must_use]
    pub fn left_range(&self, q: &[f64]) -> Option<Displaced> {
        self.watched.left(q)
    }

    /// Paths whose second order the full equations have in full; none where all paths are straight, or where only (I6) is known.
    #[must_use]
    pub fn paths(&self) -> Option<&CurvedPaths> {
        self.paths.as_ref()
    }

    /// The same body with `C → C/ε²`, `B → B/ε`; paper, (2.2).
    ///
    /// # Errors
    /// [`FlexibleError`] if the stiffness overflows.
    pub fn stiffened(&self, epsilon: f64) -> Result<Self, FlexibleError> {
        let stiffened = Self::new(Parts {
            support: self.support.clone(),
            pole: self.pole,
            center_of_mass: self.center_of_mass,
            invariants: self.invariants.clone(),
            damping: self.damping.scaled(epsilon.recip()),
            stiffness: self.stiffness.scaled(epsilon.powi(-2)),
            lossy: self.lossy.iter().map(|part| part.scaled(epsilon.powi(-2))).collect(),
            dissipators: self.dissipators.iter().map(|part| part.stiffened(epsilon)).collect(),
            memories: self.memories.iter().map(|memory| memory.scaled(epsilon)).collect(),
            coordinates: self.coordinates.clone(),
            cyclic: self.cyclic().len(),
            wheels: self.wheels.clone(),
            markers: self.markers.clone(),
        });
        Ok(stiffened?
            .along(self.paths.clone())
            .advected(self.advections.clone())
            .watching(self.watched.clone())
            .made_of(self.part_masses.clone()))
    }

    /// The same body with its cyclic coordinates locked.
    #[must_use]
    pub fn locked_inside(&self) -> Self {
        self.with(0..self.elastic)
    }

    /// The same body with no more of its liquids than the coordinates that stand for them in the equations of motion.
    #[must_use]
    pub fn without_memories(&self) -> Self {
        Self { memories: Vec::new(), ..self.clone() }
    }

    /// The same body with its elastic coordinates locked.
    #[must_use]
    pub fn stiff_outside(&self) -> Self {
        self.with(self.cyclic())
    }

    /// The same body with some of its coordinates and the others locked: all elastic ones or all cyclic ones.
    fn with(&self, kept: Range<usize>) -> Self {
        let Invariants { mass, J, S, h, J1, pairs } = &self.invariants;
        let place = |j: usize| kept.contains(&j).then(|| j - kept.start);
        let shapes =
            |marker: &Marker| marker.shapes.iter().filter_map(|(j, H)| Some((place(*j)?, *H))).collect();
        let curvature = |marker: &Marker| {
            let pairs = marker.curvature.iter();
            pairs.filter_map(|(j, k, G)| Some((place(*j)?, place(*k)?, *G))).collect()
        };
        let cyclic = if kept.start == 0 { 0 } else { kept.len() };
        let parts = Parts {
            support: self.support.clone(),
            pole: self.pole,
            center_of_mass: self.center_of_mass,
            invariants: Invariants {
                mass: *mass,
                J: *J,
                S: S[kept.clone()].to_vec(),
                h: h[kept.clone()].to_vec(),
                J1: J1[kept.clone()].to_vec(),
                pairs: pairs.block(kept.clone()),
            },
            damping: self.damping.block(kept.clone()),
            stiffness: self.stiffness.block(kept.clone()),
            lossy: self.lossy.iter().map(|part| part.block(kept.clone())).collect(),
            dissipators: self.dissipators.iter().filter_map(|part| part.block(kept.clone())).collect(),
            memories: if cyclic > 0 {
                self.memories.iter().map(|memory| memory.moved(kept.start)).collect()
            } else {
                Vec::new()
            },
            coordinates: self.coordinates[kept.clone()].to_vec(),
            cyclic,
            wheels: self.wheels.clone(),
            markers: self
                .markers
                .iter()
                .map(|m| Marker { shapes: shapes(m), curvature: curvature(m), ..m.clone() })
                .collect(),
        };
        let paths = self.paths.as_ref().and_then(|paths| paths.locked(self.coordinates.len(), &kept));
        let body = Self::new(parts).expect("a block of a positive definite matrix is positive definite");
        let advections = self.advections.iter().filter(|_| cyclic > 0).map(|own| own.moved(kept.start));
        let part_masses = self.part_masses.iter().map(|part| part.locked(kept.clone()));
        body.along(paths)
            .advected(advections.collect())
            .watching(self.watched.locked(&kept))
            .made_of(part_masses.collect())
    }

    /// How the body is held.
    #[must_use]
    pub fn support(&self) -> &Support {
        &self.support
    }

    /// Pole `O` (m), in the file's frame.
    #[must_use]
    pub fn pole(&self) -> [f64; 3] {
        self.pole
    }

    /// Centre of mass of the frozen body `S*` (m), in the file's frame.
    #[must_use]
    pub fn center_of_mass(&self) -> [f64; 3] {
        self.center_of_mass
    }

    /// Inertia invariants about the pole.
    #[must_use]
    pub fn invariants(&self) -> &Invariants {
        &self.invariants
    }

    /// Inertia tensor `J` of the frozen body about the pole (kg·m²).
    #[must_use]
    pub fn inertia(&self) -> [[f64; 3]; 3] {
        sym3::rows(self.invariants.J)
    }

    /// Damping matrix `B`, as the springs give it.
    #[must_use]
    pub fn damping(&self) -> &SparseRows<f64> {
        &self.damping
    }

    /// Stiffness matrix `C`.
    #[must_use]
    pub fn stiffness(&self) -> &SparseRows<f64> {
        &self.stiffness
    }

    /// Parts of the stiffness whose loss is neither in the damping matrix nor zero.
    #[must_use]
    pub fn lossy(&self) -> &[Lossy] {
        &self.lossy
    }

    /// What takes energy from the motion of the coordinates; their parts of the damping matrix sum to it. (D1)
    #[must_use]
    pub fn dissipators(&self) -> &[Dissipator] {
        &self.dissipators
    }

    /// Liquids whose linear answer is known at every frequency.
    #[must_use]
    pub fn memories(&self) -> &[LiquidMemory] {
        &self.memories
    }

    /// Internal coordinates.
    #[must_use]
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.coordinates
    }

    /// Places whose displacement is watched.
    #[must_use]
    pub fn markers(&self) -> &[Marker] {
        &self.markers
    }

    /// `1/m*` for a free body, whose translation is eliminated (S6); none where a point is fixed or driven.
    #[must_use]
    pub fn translation(&self) -> Option<f64> {
        match self.support {
            Support::Free => Some(self.invariants.mass.recip()),
            Support::FixedPoint { .. } | Support::Prescribed { .. } => None,
        }
    }

    /// Number of elastic coordinates: the first ones.
    #[must_use]
    pub fn elastic(&self) -> usize {
        self.elastic
    }

    /// The cyclic coordinates: the last ones. Only their rates count.
    #[must_use]
    pub fn cyclic(&self) -> Range<usize> {
        self.elastic..self.coordinates.len()
    }

    /// Momentum wheels.
    #[must_use]
    pub fn wheels(&self) -> &Wheels {
        &self.wheels
    }

    /// Solves `C x = right` in place for right-hand sides stored coordinate by coordinate, `width` to a row; rows of cyclic
    /// coordinates become zero.
    pub fn solve_stiffness(&self, right: &mut [f64], width: usize) {
        let (held, braked) = right.split_at_mut(self.elastic * width);
        self.factor.solve(held, width);
        braked.fill(0.0);
    }

    /// Solves `B x = right` in place for right-hand sides of the cyclic coordinates alone, `width` to a row.
    pub fn solve_friction(&self, right: &mut [f64], width: usize) {
        self.friction.solve(right, width);
    }

    /// `A x`, with the translation of a free body eliminated. (S6)
    #[must_use]
    pub fn mass_times(&self, x: &[f64]) -> Vec<f64> {
        let Invariants { pairs, S, .. } = &self.invariants;
        let row = |j: usize| pairs.row(j).map(|(k, pair)| pair.A * x[k]).sum();
        let mut force: Vec<f64> = (0..x.len()).map(row).collect();
        if let Some(per_mass) = self.translation() {
            let moment = S.iter().zip(x).fold([0.0; 3], |sum, (S, x)| vec3::add(sum, vec3::scale(*x, *S)));
            force.iter_mut().zip(S).for_each(|(force, S)| *force -= per_mass * vec3::dot(*S, moment));
        }
        force
    }

    /// `(A − h J⁻¹ hᵀ) x`: the same with the body free to recoil in rotation. (V2)
    #[must_use]
    pub fn recoiling_mass_times(&self, x: &[f64]) -> Vec<f64> {
        let Invariants { J, h, .. } = &self.invariants;
        let momentum = h.iter().zip(x).fold([0.0; 3], |sum, (h, x)| vec3::add(sum, vec3::scale(*x, *h)));
        let turn = sym3::times(sym3::inverse(*J), momentum);
        self.mass_times(x).iter().zip(h).map(|(force, h)| force - vec3::dot(*h, turn)).collect()
    }

    /// Mass matrix `A` with the translation of a free body eliminated, `A − S Sᵀ/m*`. (S6)
    #[must_use]
    pub fn mass_matrix(&self) -> Dense {
        let mut A = Dense::zero(self.coordinates.len());
        for (row, column, pair) in self.invariants.pairs.iter() {
            A.add(row, column, pair.A);
        }
        if let Some(per_mass) = self.translation() {
            for (row, S_row) in self.invariants.S.iter().enumerate() {
                for (column, S_column) in self.invariants.S.iter().enumerate() {
                    A.add(row, column, -per_mass * vec3::dot(*S_row, *S_column));
                }
            }
        }
        A
    }

    /// Mass matrix of the cyclic coordinates alone.
    #[must_use]
    pub fn cyclic_mass(&self) -> Dense {
        let cyclic = self.cyclic();
        let mut A = Dense::zero(cyclic.len());
        for j in cyclic.clone() {
            for (k, pair) in self.invariants.pairs.row(j).filter(|(k, _)| cyclic.contains(k)) {
                A.add(j - cyclic.start, k - cyclic.start, pair.A);
            }
        }
        A
    }

    /// The same with the body free to recoil in rotation. (V2)
    #[must_use]
    pub fn recoiling_cyclic_mass(&self) -> Dense {
        let h = &self.invariants.h[self.cyclic()];
        let inverse = sym3::inverse(self.invariants.J);
        let mut A = self.cyclic_mass();
        for (row, h_row) in h.iter().enumerate() {
            let turn = sym3::times(inverse, *h_row);
            for (column, h_column) in h.iter().enumerate() {
                A.add(row, column, -vec3::dot(turn, *h_column));
            }
        }
        A
    }

    /// The same with the body free to recoil in rotation, `A − h J⁻¹ hᵀ`. (V2)
    #[must_use]
    pub fn recoiling_mass_matrix(&self) -> Dense {
        let Invariants { J, h, .. } = &self.invariants;
        let inverse = sym3::inverse(*J);
        let mut A = self.mass_matrix();
        for (row, h_row) in h.iter().enumerate() {
            let turn = sym3::times(inverse, *h_row);
            for (column, h_column) in h.iter().enumerate() {
                A.add(row, column, -vec3::dot(turn, *h_column));
            }
        }
        A
    }
}

impl Lossy {
    pub(super) fn block(&self, kept: Range<usize>) -> Self {
        Self { stiffness: self.stiffness.block(kept), ..self.clone() }
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self { stiffness: self.stiffness.scaled(factor), ..self.clone() }
    }
}

/// The coordinates that move along a direction, by name.
fn named(coordinates: &[Coordinate], direction: &[f64]) -> String {
    let moving: Vec<_> = coordinates
        .iter()
        .zip(direction)
        .filter(|(_, amount)| amount.abs() > NAMED)
        .map(|(coordinate, _)| coordinate.name.as_str())
        .collect();
    let mut names = moving[..moving.len().min(MOST_NAMES)].join(", ");
    if moving.len() > MOST_NAMES {
        names.push_str(&format!(" and {} more", moving.len() - MOST_NAMES));
    }
    names
}
