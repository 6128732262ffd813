//! Bodies derived from another one: stiffened, or with some coordinates locked. Paper, (2.2).

use std::ops::Range;

use super::flexible::BodyParts;
use super::{Carried, FlexibleBody, FlexibleError, Hung, Invariants, Marker};

impl FlexibleBody {
    /// Stiffened body, `C → C/ε²`, `B → B/ε`; paper, (2.2).
    ///
    /// # Errors
    /// [`FlexibleError`] if the stiffness overflows.
    pub fn stiffened(&self, epsilon: f64) -> Result<Self, FlexibleError> {
        let (stiffer, rougher) = (epsilon.powi(-2), epsilon.recip());
        let parts = BodyParts {
            damping: self.damping().scaled(rougher),
            stiffness: self.stiffness().scaled(stiffer),
            viscoelastic: self.viscoelastic().iter().map(|part| part.scaled(stiffer)).collect(),
            dissipators: self.dissipators().iter().map(|part| part.stiffened(epsilon)).collect(),
            memories: self.memories().iter().map(|memory| memory.scaled(epsilon)).collect(),
            ..self.parts.clone()
        };
        Ok(Self {
            paths: self.paths.clone(),
            frictions: self.frictions.iter().map(|own| own.moved(own.coordinate, rougher)).collect(),
            advections: self.advections.clone(),
            watched: self.watched.clone(),
            part_masses: self.part_masses.clone(),
            ..Self::hanging(parts, self.pendulums())?
        })
    }

    /// Body with its cyclic coordinates locked.
    #[must_use]
    pub fn locked_inside(&self) -> Self {
        self.with(0..self.elastic())
    }

    /// The body frozen at equilibrium: every coordinate locked.
    #[must_use]
    pub fn frozen(&self) -> Self {
        self.locked_inside().stiff_outside()
    }

    /// Body without the frequency responses of its liquids, whose coordinates in the equations of motion stay.
    #[must_use]
    pub fn without_memories(&self) -> Self {
        let mut body = self.clone();
        body.parts.memories.clear();
        body
    }

    /// Body with its elastic coordinates locked.
    #[must_use]
    pub fn stiff_outside(&self) -> Self {
        self.with(self.cyclic())
    }

    /// Coordinates that the spin may restore.
    fn pendulums(&self) -> &[usize] {
        self.hung.as_ref().map_or(&[], Hung::pendulums)
    }

    /// Body with a range of coordinates kept and the others locked: all elastic ones or all cyclic ones.
    fn with(&self, kept: Range<usize>) -> Self {
        let cyclic = if kept.start == 0 { 0 } else { kept.len() };
        let memories = self.memories().iter().filter(|_| cyclic > 0).map(|own| own.moved(kept.start));
        let parts = BodyParts {
            invariants: self.invariants().block(&kept),
            damping: self.damping().block(kept.clone()),
            stiffness: self.stiffness().block(kept.clone()),
            viscoelastic: self.viscoelastic().iter().map(|part| part.block(kept.clone())).collect(),
            dissipators: self.dissipators().iter().filter_map(|part| part.block(kept.clone())).collect(),
            memories: memories.collect(),
            coordinates: self.coordinates()[kept.clone()].to_vec(),
            cyclic,
            drives: self.drives().iter().filter_map(|drive| drive.locked(&kept)).collect(),
            markers: self.markers().iter().map(|marker| marker.locked(&kept)).collect(),
            ..self.parts.clone()
        };
        let paths = self.paths.as_ref().and_then(|paths| paths.locked(self.coordinates().len(), &kept));
        let advections = self.advections.iter().filter(|_| cyclic > 0).map(|own| own.moved(kept.start));
        let frictions = self.frictions.iter().filter(|own| kept.contains(&own.coordinate));
        let locked = Self::hanging(parts, if kept.start == 0 { self.pendulums() } else { &[] })
            .expect("a block of a positive definite matrix is positive definite");
        Self {
            paths: paths.or(locked.paths),
            frictions: frictions.map(|own| own.moved(own.coordinate - kept.start, 1.0)).collect(),
            advections: advections.collect(),
            watched: self.watched.locked(&kept),
            part_masses: self.part_masses.iter().map(|part| part.locked(kept.clone())).collect(),
            ..locked
        }
    }
}

impl Invariants {
    /// Modal mass `A_jj` of a coordinate; zero of one without mass. (I1)
    #[must_use]
    pub fn modal_mass(&self, j: usize) -> f64 {
        self.pairs.row(j).find(|(k, _)| *k == j).map_or(0.0, |(_, pair)| pair.A)
    }

    /// Invariants of the coordinates kept.
    fn block(&self, kept: &Range<usize>) -> Self {
        Self {
            S: self.S[kept.clone()].to_vec(),
            h: self.h[kept.clone()].to_vec(),
            J1: self.J1[kept.clone()].to_vec(),
            pairs: self.pairs.block(kept.clone()),
            ..*self
        }
    }
}

impl Marker {
    /// The place on the body frozen at equilibrium.
    #[must_use]
    pub fn frozen(&self) -> Self {
        let (shapes, rotations, curvature) = (Vec::new(), Vec::new(), Vec::new());
        Self { shapes, rotations, curvature, carried: None, ..self.clone() }
    }

    /// Marker with all coordinates locked but those kept.
    fn locked(&self, kept: &Range<usize>) -> Self {
        let place = |j: usize| kept.contains(&j).then(|| j - kept.start);
        let kept = |list: &[(usize, [f64; 3])]| -> Vec<_> {
            list.iter().filter_map(|(j, each)| Some((place(*j)?, *each))).collect()
        };
        let (shapes, rotations) = (kept(&self.shapes), kept(&self.rotations));
        let pairs = self.curvature.iter();
        let curvature = pairs.filter_map(|(j, k, G)| Some((place(*j)?, place(*k)?, *G)));
        let carried = self.carried.as_ref().and_then(|carried| {
            Some(Carried { gimbal: carried.gimbal.renumbered(&place)?, arm: carried.arm })
        });
        Self { shapes, rotations, curvature: curvature.collect(), carried, ..self.clone() }
    }
}
