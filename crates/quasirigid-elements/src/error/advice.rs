//! Advice on an element that no body can have, beside the problem itself: a label for the place in the model file, and a remedy to try
//! there.

use super::{ElementKind, Problem};
use crate::model::{InertiaError, RheologyError};
use quasirigid_mesh::MeshNote;

impl Problem {
    /// Label for the place in a model file at which the problem stands.
    #[must_use]
    pub fn label(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => "not finite",
            Self::NotAMass { .. } => "must be positive",
            Self::Inertia(InertiaError::Impossible { .. }) => "no body has this inertia",
            Self::Inertia(InertiaError::NotSymmetric { .. })
            | Self::NotSymmetric { .. }
            | Self::Lopsided { .. } => "not symmetric",
            Self::NegativeDiagonal { .. } => "negative energy",
            Self::HeldByMatrices { .. } => "held by nothing",
            Self::Indefinite { .. } => "gives energy",
            Self::Mechanism { .. } => "held by no spring",
            Self::NoSuchPoint { .. } => "no such point",
            Self::DuplicateName { .. } => "used twice",
            Self::NoAnchor => "needs an `anchor`",
            Self::NoStation => "needs an `at`",
            Self::StationOnPoint => "not for a point",
            Self::Driving { .. } => "gives energy",
            Self::NotPositive { .. } => "must be positive",
            Self::NotElliptic { .. } => "no ellipse",
            Self::Poisson { .. } | Self::Rheology(_) => "no such material",
            Self::NoBody => "no body",
            Self::BesideWhole => "beside a whole body",
            Self::InsideNothing => "held by no carrier",
            Self::HeavyInside => "less than that of the rotors and liquids inside",
            Self::Memory { .. } => "too large",
            Self::LiquidUnresolved => "not resolved",
            Self::FlowDegree { .. } => "not offered",
            Self::TooManyModes { .. } => "too many",
            Self::NotAttitude { .. } => "not a unit quaternion",
            Self::HeldWhole => "cannot be held",
            Self::NoCarrier => "no carrier",
            Self::SameEnds => "the same",
            Self::NotAttached => "joined by nothing",
            Self::NoNodes => "no nodes",
            Self::HeldTwice { .. } => "held twice",
            Self::NotInterface { .. } => "not of the interface",
            Self::ShapeRows { .. }
            | Self::ShapeColumns { .. }
            | Self::NotUnit { .. }
            | Self::EmptyMode { .. }
            | Self::CoupledModes { .. } => "not its shapes",
            Self::ValuePerMode { .. } => "one for each mode",
            Self::Circle { .. } => "in a circle",
            Self::NoArm { .. } | Self::NoTurn { .. } => "cannot turn",
            Self::NoPartner { .. } => "no partner",
            Self::NoCells { .. } => "no such cells",
            Self::Mesh(_) => "not the mesh of a body",
            Self::LooseNodes(_) => "loose nodes",
            Self::Elasticity(_) => "no such material",
            Self::Beam(_) => "no such beam",
            Self::Shell { .. } => "no such panel",
            Self::Unresolved { .. }
            | Self::Degree { .. }
            | Self::Cells { .. }
            | Self::TwoRoads
            | Self::SeveralBodies { .. }
            | Self::Unmeshed { .. }
            | Self::Unsettled { .. }
            | Self::Meshing(_)
            | Self::Stokes(_)
            | Self::NoSuchPart { .. }
            | Self::NoSuchNode { .. }
            | Self::NoSuchRow { .. }
            | Self::NoSuchCell { .. }
            | Self::NoTurnForInertia { .. }
            | Self::NoModes { .. }
            | Self::NoMass
            | Self::NoGuide
            | Self::ZeroDirection
            | Self::NoLine
            | Self::Unbalanced { .. }
            | Self::TensionOnPart
            | Self::TensionAfloat
            | Self::AxisCount { .. }
            | Self::DependentAxes
            | Self::ValuePerAxis { .. }
            | Self::MasslessAxis { .. }
            | Self::Barred { .. }
            | Self::NoInertia { .. }
            | Self::Inertia(InertiaError::NotFinite { .. }) => "here",
        }
    }

    /// Remedy for the problem at an element of a kind, in the words of the model file; none where the problem says it.
    #[must_use]
    pub fn advice(&self, kind: ElementKind) -> Option<&'static str> {
        Some(match self {
            Self::NotFinite { .. } => "write a finite number",
            Self::NotAMass { .. } => "write a positive mass, or leave the element out",
            Self::Inertia(InertiaError::NotFinite { .. }) => "write finite numbers",
            Self::Inertia(InertiaError::NotSymmetric { .. }) | Self::NotSymmetric { .. } => {
                "write the same value at [i][j] and [j][i], or only the three values of the axes"
            }
            Self::Inertia(InertiaError::Impossible { .. }) => {
                "check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass"
            }
            Self::Lopsided { .. } => {
                "a mass, damping or stiffness is symmetric; was one triangle written, or the matrix of another step?"
            }
            Self::NegativeDiagonal { .. } => "check the sign, and that this is the matrix it should be",
            Self::HeldByMatrices { .. } => {
                "add a [carrier], or export the matrices of the body that nothing holds"
            }
            Self::ZeroDirection => "write a direction such as [0, 0, 1]; its length does not matter",
            Self::Indefinite { .. } => {
                "check the signs; the eigenvalues of the matrix must be zero or positive"
            }
            Self::SameEnds if kind == ElementKind::Connection => {
                "a connection joins a part to the carrier, or to another part"
            }
            Self::SameEnds => "a spring joins two points, or a point and the carrier",
            Self::NoLine => "move one end, or leave out axial = true",
            Self::NoAnchor => "add anchor = [x, y, z], the place of the spring's end on the carrier",
            Self::NoStation => "add at = [x, y, z], the place on the carrier, in the file's frame",
            Self::StationOnPoint => "leave it out, or write on = \"carrier\"",
            Self::Driving { .. } => "write a positive coefficient; the force is opposite to the velocity",
            Self::NotPositive { .. } => "write a positive number",
            Self::NotElliptic { .. } => "write 0 for a circle; a body that escapes is not modelled",
            Self::Poisson { .. } => "most rocks and metals have 0.2 to 0.35",
            Self::Rheology(RheologyError::NotPositive { .. }) => "write a positive number",
            Self::Rheology(RheologyError::Quality { .. }) => {
                "give a law or a table of a material that loses more than it stores"
            }
            Self::Rheology(RheologyError::Exponent { .. }) => "most materials have 0.2 to 0.5",
            Self::NoBody => "add a [carrier], or parts that are elastic throughout, such as an [[ellipsoid]]",
            Self::BesideWhole => "leave it out, or make the body of a [carrier] and what hangs on it",
            Self::InsideNothing => "add a [carrier]: rotors, wheels and liquids turn in a rigid body",
            Self::HeavyInside => {
                "add the inertia of the rotors and liquids inside to that of the carrier, or check the units of both"
            }
            Self::LiquidUnresolved => "choose a shape whose sides differ less, or fewer `modes`",
            Self::FlowDegree { .. } => "8 is enough for six digits; leave `resolution` out",
            Self::TooManyModes { .. } => "the slow motion needs none of them",
            Self::NotAttitude { .. } => "write four numbers, scalar first, whose squares add up to 1",
            Self::HeldWhole => "leave [support] out",
            Self::NoCarrier if kind != ElementKind::Force => {
                "add a [carrier], or leave this out: a body without one hangs on nothing"
            }
            Self::NoCarrier => {
                "on a body that is elastic throughout act gravity and torques, which need no place"
            }
            Self::Unresolved { .. } => "choose a lower degree",
            Self::TwoRoads => "leave out `degree` or `cells`, or both",
            Self::SeveralBodies { .. } => {
                "give each body its own file, or join them by a [carrier] and springs; a [[surface]] is one solid"
            }
            Self::Unmeshed { .. } | Self::Unsettled { .. } => {
                "describe the body by a [[solid]] with a mesh that is fine at its neck; or write `cells = 60000`, or `degree = 10` for \
             polynomials all the same, to see what they say"
            }
            Self::AxisCount { .. } if kind == ElementKind::Connection => {
                "write one to three axes, for example hinge = [[0, 1, 0], [0, 0, 1]]"
            }
            Self::AxisCount { .. } => "write one to three axes, for example axes = [[0, 0, 1]]",
            Self::DependentAxes => "no axis may be a combination of the others",
            Self::ValuePerAxis { .. } if kind == ElementKind::Connection => {
                "write one number for all axes, or one per axis"
            }
            Self::ValuePerAxis { .. } => {
                "write one number for all axes, one per axis, or a square matrix with a row per axis"
            }
            Self::MasslessAxis { .. } => "or give the appendage an inertia about it",
            Self::DuplicateName { .. } => "give each element its own name",
            Self::Mechanism { .. } if kind == ElementKind::Connection => {
                "give it a `stiffness`, or leave this axis out"
            }
            Self::Mechanism { .. } if kind == ElementKind::Part => {
                "attach or connect more of its nodes, three or more of a solid; or add a spring that resists it"
            }
            Self::Mechanism { .. } => {
                "add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }"
            }
            Self::NotAttached => {
                "write attach = with one of its nodes, or a [[connection]]; springs alone do not hold a part"
            }
            Self::NoNodes => "name a node, or a set of nodes",
            Self::HeldTwice { .. } => "leave out one of the two, or put a stiff spring in its place",
            Self::NoPartner { .. } => {
                "sets are joined node by node; name one node on one side to make the set of the other side rigid"
            }
            Self::NoCells { .. } => {
                "a [[solid]] is made of cells of its volume, a [[panel]] of those of a surface"
            }
            Self::LooseNodes(MeshNote::Coincident { .. }) => {
                "cells hang together by the nodes they share; for parts that turn, write two tables and a [[connection]]"
            }
            Self::LooseNodes(_) => {
                "nothing resists their motion: delete them; the cells of a solid have a volume, those of a panel an area"
            }
            Self::NoMass => "write a layer: { material = \"aluminium\", thickness = \"2 mm\" }",
            Self::NoInertia { held: false, .. } => "check the masses and the inertia of the carrier",
            Self::NoInertia { held: true, .. } => {
                "check the inertia of the carrier and the `point` of the support"
            }
            Self::Degree { .. }
            | Self::Cells { .. }
            | Self::Meshing(_)
            | Self::Stokes(_)
            | Self::NoSuchPart { .. }
            | Self::NoSuchNode { .. }
            | Self::NoSuchRow { .. }
            | Self::NoSuchCell { .. }
            | Self::ShapeRows { .. }
            | Self::ShapeColumns { .. }
            | Self::NotUnit { .. }
            | Self::ValuePerMode { .. }
            | Self::EmptyMode { .. }
            | Self::CoupledModes { .. }
            | Self::NotInterface { .. }
            | Self::Circle { .. }
            | Self::NoArm { .. }
            | Self::NoTurn { .. }
            | Self::NoTurnForInertia { .. }
            | Self::Beam(_)
            | Self::Mesh(_)
            | Self::Elasticity(_)
            | Self::Shell { .. }
            | Self::NoModes { .. }
            | Self::NoGuide
            | Self::NoSuchPoint { .. }
            | Self::Unbalanced { .. }
            | Self::TensionOnPart
            | Self::TensionAfloat
            | Self::Barred { .. }
            | Self::Memory { .. }
            | Self::Rheology(RheologyError::NoRows | RheologyError::NotAscending { .. }) => return None,
        })
    }
}
