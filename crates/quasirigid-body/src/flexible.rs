//! Flexible bodies: matrices and invariants of the internal coordinates, checked and factored. (C1), (I1)–(I8)
//!
//! The first core type: everything that describes a body makes one, and everything that computes starts from one.

use std::ops::Range;

use super::flexible_error::named;
use super::{
    Advection, Coordinate, CurvedPaths, Displaced, Dissipator, Drive, FlexibleError, Friction, Hung,
    Invariants, LiquidMemory, Marker, PartMass, Support, Viscoelastic, Watched, Wheels,
};
use crate::math::cholesky::Cholesky;
use crate::math::sparse::SparseRows;
use crate::math::sym3;

/// Flexible body: constants of the equations of motion of a body that bends and dissipates. The first core type.
///
/// The body frame has the axes of the model file and its origin at the pole `O`. `n` internal coordinates `q` with mass, damping and
/// stiffness matrices `A, B, C` (paper, (1.3)–(1.5)): first the elastic ones, with springs, then the cyclic ones, without springs, whose
/// rates friction slaves to the angular velocity. (C1)
#[derive(Clone, Debug)]
pub struct FlexibleBody {
    pub(super) parts: BodyParts,
    pub(super) advections: Vec<Advection>,
    pub(super) watched: Watched,
    pub(super) part_masses: Vec<PartMass>,
    pub(super) paths: Option<CurvedPaths>,
    pub(super) frictions: Vec<Friction>,
    /// Number of elastic coordinates.
    pub(super) elastic: usize,
    /// Factors: of the stiffness of the elastic coordinates, and of the damping of the cyclic ones.
    pub(super) factor: Cholesky,
    pub(super) friction: Cholesky,
    /// What the spin alone restores.
    pub(super) hung: Option<Hung>,
}

/// Parts of a [`FlexibleBody`].
#[derive(Clone, Debug)]
pub struct BodyParts {
    /// Support of the body.
    pub support: Support,
    /// Pole `O` (m), in the frame of the model file.
    pub pole: [f64; 3],
    /// Centre of mass of the frozen body (m), in the frame of the model file.
    pub center_of_mass: [f64; 3],
    /// Inertia invariants about the pole.
    pub invariants: Invariants,
    /// Damping matrix `B`.
    pub damping: SparseRows<f64>,
    /// Stiffness matrix `C`.
    pub stiffness: SparseRows<f64>,
    /// Viscoelastic parts of `C`: with a loss that is neither in `B` nor zero.
    pub viscoelastic: Vec<Viscoelastic>,
    /// Dissipators: their parts of `B` sum to `B`, their losses to the viscoelastic parts of `C`. (D1)
    pub dissipators: Vec<Dissipator>,
    /// Liquids whose linear response is known at every frequency.
    pub memories: Vec<LiquidMemory>,
    /// Name and unit of each coordinate.
    pub coordinates: Vec<Coordinate>,
    /// Number of cyclic coordinates, the last ones: only their rates have an effect, and only `A`, `B`, `h` and the gyroscopic coupling
    /// are nonzero.
    pub cyclic: usize,
    /// Momentum wheels.
    pub wheels: Wheels,
    /// Drives of elastic coordinates, one at most for each. (T7)
    pub drives: Vec<Drive>,
    /// Places whose displacement is watched.
    pub markers: Vec<Marker>,
}

/// Angular frequency (rad/s) of the springs that stand for drives in a factor: results do not depend on it.
const HELD: f64 = 1.0;

impl BodyParts {
    /// Stiffness of the elastic coordinates, with springs where drives hold some: to be factored, no force.
    fn held_stiffness(&self, elastic: usize) -> SparseRows<f64> {
        let own = self.stiffness.block(0..elastic);
        if self.drives.is_empty() {
            return own;
        }
        let spring = |drive: &Drive| {
            let j = drive.coordinate;
            (j, j, HELD * HELD * self.invariants.modal_mass(j))
        };
        let springs = self.drives.iter().map(spring);
        SparseRows::sum(elastic, own.iter().map(|(j, k, C)| (j, k, *C)).chain(springs).collect())
    }
}

impl FlexibleBody {
    /// Joins the parts of a body.
    ///
    /// # Errors
    /// [`FlexibleError`] names the coordinates that move without stiffness, or without friction.
    pub fn new(parts: BodyParts) -> Result<Self, FlexibleError> {
        Self::hanging(parts, &[])
    }

    /// Joins the parts of a body in which the spin alone may restore some of the coordinates, as it does a pendulum. (I13)
    ///
    /// # Errors
    /// [`FlexibleError`] names the coordinates that move without stiffness and are not among these, or without friction.
    pub fn hanging(parts: BodyParts, pendulums: &[usize]) -> Result<Self, FlexibleError> {
        let BodyParts { coordinates, damping, .. } = &parts;
        let elastic = coordinates.len() - parts.cyclic;
        let stiffness = parts.held_stiffness(elastic);
        let (held, braked) = coordinates.split_at(elastic);
        let mechanism = |direction: &[f64]| FlexibleError::Mechanism { coordinates: named(held, direction) };
        let (factor, hung) = match Cholesky::new(&stiffness) {
            Ok(factor) => (factor, None),
            Err(singular) => {
                let hung = Hung::of(&parts, &stiffness, pendulums, &singular.direction);
                let hung = hung.ok_or_else(|| mechanism(&singular.direction))?;
                let factor = Cholesky::new(hung.grounded()).map_err(|other| mechanism(&other.direction))?;
                (factor, Some(hung))
            }
        };
        let friction = Cholesky::new(&damping.block(elastic..coordinates.len())).map_err(|singular| {
            FlexibleError::Frictionless { coordinates: named(braked, &singular.direction) }
        })?;
        // with rates that are given, momenta are solved for as along curved paths (T8)
        let paths = (!parts.drives.is_empty())
            .then(|| CurvedPaths { straight: parts.invariants.clone(), followers: Vec::new() });
        Ok(Self {
            parts,
            advections: Vec::new(),
            watched: Watched::default(),
            part_masses: Vec::new(),
            paths,
            frictions: Vec::new(),
            elastic,
            factor,
            friction,
            hung,
        })
    }

    /// Drives of coordinates, which the full system alone follows: no answer about rest or a steady spin has them. (T7)
    #[must_use]
    pub fn drives(&self) -> &[Drive] {
        &self.parts.drives
    }

    /// Names of the coordinates that are driven, for messages; none where nothing is driven. (T7)
    #[must_use]
    pub fn driven(&self) -> Option<String> {
        let names: Vec<&str> =
            self.drives().iter().map(|drive| &*self.parts.coordinates[drive.coordinate].name).collect();
        (!names.is_empty()).then(|| names.join(", "))
    }

    /// Coordinates that nothing restores but the spin; none where springs hold everything. (I13)
    #[must_use]
    pub fn hung(&self) -> Option<&Hung> {
        self.hung.as_ref()
    }

    /// Stiffness matrix of the elastic coordinates, with that of springs in place of the spin where it alone restores: a measure of
    /// displacements, no force. (I13)
    #[must_use]
    pub fn grounded_stiffness(&self) -> SparseRows<f64> {
        let held = || self.parts.stiffness.block(0..self.elastic);
        self.hung.as_ref().map_or_else(held, |hung| hung.grounded().clone())
    }

    /// Body with springs where nothing but the spin restores a coordinate, as strong as the centrifugal force of an angular velocity (rad/s); itself
    /// where springs hold everything. (I13)
    ///
    /// # Errors
    /// [`FlexibleError`] where that force is lost beside the other springs.
    pub fn sprung(&self, rate: f64) -> Result<Self, FlexibleError> {
        let Some(hung) = &self.hung else { return Ok(self.clone()) };
        let springs = self.parts.stiffness.iter().map(|(j, k, C)| (j, k, *C)).chain(hung.springs(rate));
        let stiffness = SparseRows::sum(self.parts.coordinates.len(), springs.collect());
        let held = Self::new(BodyParts { stiffness, ..self.parts.clone() })?;
        Ok(Self { parts: held.parts, factor: held.factor, hung: None, ..self.clone() })
    }

    /// Body with the complete second order of its paths in the full equations. (K12)
    #[must_use]
    pub fn along(self, paths: Option<CurvedPaths>) -> Self {
        Self { paths: paths.or(self.paths), ..self }
    }

    /// Body with friction beyond the damping matrix. (U12)
    #[must_use]
    pub fn rubbed(self, frictions: Vec<Friction>) -> Self {
        Self { frictions, ..self }
    }

    /// Friction beyond the damping matrix, which the full system alone has: elsewhere motions are small. (U12)
    #[must_use]
    pub fn frictions(&self) -> &[Friction] {
        &self.frictions
    }

    /// Body with the advection of its liquids. (L21)
    #[must_use]
    pub fn advected(self, advections: Vec<Advection>) -> Self {
        Self { advections, ..self }
    }

    /// Advection of the liquids, where known. (L21)
    #[must_use]
    pub fn advections(&self) -> &[Advection] {
        &self.advections
    }

    /// Body with places and hinges whose displacements are watched.
    #[must_use]
    pub fn watching(self, watched: Watched) -> Self {
        Self { watched, ..self }
    }

    /// Places and hinges whose displacements are watched.
    #[must_use]
    pub fn watched(&self) -> &Watched {
        &self.watched
    }

    /// Body with the mass of each part of its structure.
    #[must_use]
    pub fn made_of(self, part_masses: Vec<PartMass>) -> Self {
        Self { part_masses, ..self }
    }

    /// Mass of each part of the structure. (M5)
    #[must_use]
    pub fn part_masses(&self) -> &[PartMass] {
        &self.part_masses
    }

    /// Place or hinge displaced beyond the range of the equations at these coordinates; none within the range. (K14)
    #[must_use]
    pub fn left_range(&self, q: &[f64]) -> Option<Displaced> {
        self.watched.left(q)
    }

    /// Curved paths with the complete second order in the full equations; none where all paths are straight, or where only (I6) is known.
    #[must_use]
    pub fn paths(&self) -> Option<&CurvedPaths> {
        self.paths.as_ref()
    }

    /// Support of the body.
    #[must_use]
    pub fn support(&self) -> &Support {
        &self.parts.support
    }

    /// Pole `O` (m), in the frame of the model file.
    #[must_use]
    pub fn pole(&self) -> [f64; 3] {
        self.parts.pole
    }

    /// Centre of mass of the frozen body `S*` (m), in the frame of the model file.
    #[must_use]
    pub fn center_of_mass(&self) -> [f64; 3] {
        self.parts.center_of_mass
    }

    /// Inertia invariants about the pole.
    #[must_use]
    pub fn invariants(&self) -> &Invariants {
        &self.parts.invariants
    }

    /// Inertia tensor `J` of the frozen body about the pole (kg·m²).
    #[must_use]
    pub fn inertia(&self) -> [[f64; 3]; 3] {
        sym3::rows(self.parts.invariants.J)
    }

    /// Damping matrix `B`.
    #[must_use]
    pub fn damping(&self) -> &SparseRows<f64> {
        &self.parts.damping
    }

    /// Stiffness matrix `C`.
    #[must_use]
    pub fn stiffness(&self) -> &SparseRows<f64> {
        &self.parts.stiffness
    }

    /// Viscoelastic parts of the stiffness: with a loss that is neither in the damping matrix nor zero.
    #[must_use]
    pub fn viscoelastic(&self) -> &[Viscoelastic] {
        &self.parts.viscoelastic
    }

    /// Dissipators; their parts of the damping matrix sum to the damping matrix. (D1)
    #[must_use]
    pub fn dissipators(&self) -> &[Dissipator] {
        &self.parts.dissipators
    }

    /// Liquids whose linear response is known at every frequency.
    #[must_use]
    pub fn memories(&self) -> &[LiquidMemory] {
        &self.parts.memories
    }

    /// Internal coordinates.
    #[must_use]
    pub fn coordinates(&self) -> &[Coordinate] {
        &self.parts.coordinates
    }

    /// Places whose displacement is watched.
    #[must_use]
    pub fn markers(&self) -> &[Marker] {
        &self.parts.markers
    }

    /// `1/m*` for a free body, whose translation is eliminated (S6); none where a point is fixed or driven.
    #[must_use]
    pub fn translation(&self) -> Option<f64> {
        match self.parts.support {
            Support::Free => Some(self.parts.invariants.mass.recip()),
            Support::FixedPoint { .. } | Support::Prescribed { .. } => None,
        }
    }

    /// Number of elastic coordinates: the first ones.
    #[must_use]
    pub fn elastic(&self) -> usize {
        self.elastic
    }

    /// Cyclic coordinates: the last ones. Only their rates have an effect.
    #[must_use]
    pub fn cyclic(&self) -> Range<usize> {
        self.elastic..self.parts.coordinates.len()
    }

    /// Momentum wheels.
    #[must_use]
    pub fn wheels(&self) -> &Wheels {
        &self.parts.wheels
    }

    /// Solves `C x = right` in place for right-hand sides stored coordinate by coordinate, `width` to a row; rows of cyclic
    /// coordinates become zero. Where the spin alone restores, `C` is the [grounded](Self::grounded_stiffness) one.
    pub fn solve_stiffness(&self, right: &mut [f64], width: usize) {
        let (held, braked) = right.split_at_mut(self.elastic * width);
        self.factor.solve(held, width);
        braked.fill(0.0);
    }

    /// Solves `B x = right` in place for right-hand sides of the cyclic coordinates alone, `width` to a row.
    pub fn solve_friction(&self, right: &mut [f64], width: usize) {
        self.friction.solve(right, width);
    }
}
