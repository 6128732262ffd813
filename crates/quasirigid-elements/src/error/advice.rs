//! Advice on an element that no body can have, beside the problem itself: a label for the place in the model file, and a remedy to try
//! there.

use super::{ElementKind, Problem};
use crate::model::{InertiaError, RheologyError};
use quasirigid_mesh::MeshNote;

impl Problem {
    /// Label for the place in a model file at which the problem stands.
    #[must_use]
    pub fn label(&self) -> &'static str {
        self.told(ElementKind::Part).0
    }

    /// Remedy for the problem at an element of a kind, in the words of the model file; none where the problem says it.
    #[must_use]
    pub fn advice(&self, kind: ElementKind) -> Option<&'static str> {
        Some(self.told(kind).1).filter(|remedy| !remedy.is_empty())
    }

    /// Label, which no kind changes, and remedy; an empty remedy is none.
    fn told(&self, kind: ElementKind) -> (&'static str, &'static str) {
        let connection = kind == ElementKind::Connection;
        match self {
            Self::NotFinite { .. } => ("not finite", "write a finite number"),
            Self::NotAMass { .. } => ("must be positive", "write a positive mass, or leave the element out"),
            Self::Inertia(InertiaError::NotFinite { .. }) => ("here", "write finite numbers"),
            Self::Inertia(InertiaError::NotSymmetric { .. }) | Self::NotSymmetric { .. } => (
                "not symmetric",
                "write the same value at [i][j] and [j][i], or only the three values of the axes",
            ),
            Self::Inertia(InertiaError::Impossible { .. }) => (
                "no body has this inertia",
                "check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass",
            ),
            Self::Lopsided { .. } => (
                "not symmetric",
                "a mass, damping or stiffness is symmetric; was one triangle written, or the matrix of another step?",
            ),
            Self::NegativeDiagonal { .. } => {
                ("negative energy", "check the sign, and that this is the matrix it should be")
            }
            Self::HeldByMatrices { .. } => {
                ("held by nothing", "add a [carrier], or export the matrices of the body that nothing holds")
            }
            Self::ZeroDirection => {
                ("here", "write a direction such as [0, 0, 1]; its length does not matter")
            }
            Self::Indefinite { .. } => {
                ("gives energy", "check the signs; the eigenvalues of the matrix must be zero or positive")
            }
            Self::SameEnds if connection => {
                ("the same", "a connection joins a part to the carrier, or to another part")
            }
            Self::SameEnds => ("the same", "a spring joins two points, or a point and the carrier"),
            Self::NoLine => ("here", "move one end, or leave out axial = true"),
            Self::NoSheetModes => (
                "no modes",
                "write modes = [{ frequency = \"0.3 Hz\", translation = [0, 0, 1.2], rotation = [0, -2.4, 0] }], or add the mass to the carrier",
            ),
            Self::ModesTooHeavy { .. } => (
                "more than there is",
                "check the units of the participation factors, the point of `rotation`, the axes, and that modes are not given twice",
            ),
            Self::NoAnchor => {
                ("needs an `anchor`", "add anchor = [x, y, z], the place of the spring's end on the carrier")
            }
            Self::NoApplicationPoint => {
                ("needs an `at`", "add at = [x, y, z], the place on the carrier, in the file's frame")
            }
            Self::ApplicationPointOnPoint => ("not for a point", "leave it out, or write on = \"carrier\""),
            Self::Driving { .. } => {
                ("gives energy", "write a positive coefficient; the force is opposite to the velocity")
            }
            Self::Powered { .. } => (
                "gives energy",
                "check the signs; the eigenvalues of the magnetic tensor must be zero or positive",
            ),
            Self::NotPositive { .. } => ("must be positive", "write a positive number"),
            Self::Remanent { .. } => ("too large", "write a `remanence` below the `saturation`"),
            Self::Demagnetization { .. } => {
                ("no such rod", "leave it out beside `length` and `diameter`; of a long rod it is small")
            }
            Self::NotElliptic { .. } => (
                "no ellipse",
                "write 0 for a circle; a flyby has a `periapsis_distance`, under central gravity",
            ),
            Self::NoConic { .. } => {
                ("no orbit", "write 0 for a circle, 1 for a parabola, more for a hyperbola")
            }
            Self::Poisson { .. } => ("no such material", "most rocks and metals have 0.2 to 0.35"),
            Self::Rheology(RheologyError::NotPositive { .. }) => {
                ("no such material", "write a positive number")
            }
            Self::Rheology(RheologyError::Quality { .. }) => {
                ("no such material", "give a law or a table of a material that loses more than it stores")
            }
            Self::Rheology(RheologyError::Exponent { .. }) => {
                ("no such material", "most materials have 0.2 to 0.5")
            }
            Self::Tank(error) => error.told(),
            Self::Tube(error) => error.told(),
            Self::NoMainField { .. } => ("not known", "choose another epoch or degree, or give a `dipole`"),
            Self::NotTheEarth { .. } => {
                ("another centre", "write body = \"Earth\" in the orbit, or give a `dipole`")
            }
            Self::NotTheSun { .. } => (
                "another centre",
                "write body = \"Sun\" in the orbit, or give a `direction` and a `distance` of the Sun",
            ),
            Self::Underground { .. } => (
                "below the surface",
                "check the semi-major axis, from the centre of the Earth, and the eccentricity",
            ),
            Self::AsObserved => ("as observed", "find the relaxed assembly first"),
            Self::NoObservedShape => ("no such shape", "leave `shape` out"),
            Self::TooSoft { .. } => (
                "too soft",
                "check the stiffness and the spin, or leave `shape` out for the shape of the relaxed body",
            ),
            Self::FlowsSteadily => ("flows", "choose another rheology, or leave `shape` out"),
            Self::Aslant => ("aslant", "turn the spin along x, y or z of the file"),
            Self::NoBody => {
                ("no body", "add a [carrier], or parts that are elastic throughout, such as an [[ellipsoid]]")
            }
            Self::BesideWhole => {
                ("beside a whole body", "leave it out, or make the body of a [carrier] and what hangs on it")
            }
            Self::InsideNothing => {
                ("held by no carrier", "add a [carrier]: rotors, wheels and liquids turn in a rigid body")
            }
            Self::HeavyInside => (
                "less than that of the rotors and liquids inside",
                "add the inertia of the rotors and liquids inside to that of the carrier, or check the units of both",
            ),
            Self::LiquidUnresolved => {
                ("not resolved", "choose a shape whose sides differ less, or fewer `modes`")
            }
            Self::FlowDegree { .. } => ("not offered", "8 is enough for six digits; leave `resolution` out"),
            Self::TooManyModes { .. } => ("too many", "the slow motion needs none of them"),
            Self::NotAttitude { .. } => {
                ("not a unit quaternion", "write four numbers, scalar first, whose squares add up to 1")
            }
            Self::HeldWhole => ("cannot be held", "leave [support] out"),
            Self::NoCarrier if kind != ElementKind::Force => {
                ("no carrier", "add a [carrier], or leave this out: a body without one hangs on nothing")
            }
            Self::NoCarrier => (
                "no carrier",
                "on a body that is elastic throughout act gravity and torques, which need no place",
            ),
            Self::Unresolved { .. } => ("here", "choose a lower degree"),
            Self::TwoRoads => ("here", "leave out `degree` or `cells`, or both"),
            Self::SeveralBodies { .. } => (
                "here",
                "give each body its own file, or join them by a [carrier] and springs; a [[surface]] is one solid",
            ),
            Self::Unmeshed { .. } | Self::Unsettled { .. } => (
                "here",
                "describe the body by a [[solid]] with a mesh that is fine at its neck; or write `cells = 60000`, or `degree = 10` for \
             polynomials all the same, to see their result",
            ),
            Self::AxisCount { .. } if connection => {
                ("here", "write one to three axes, for example hinge = [[0, 1, 0], [0, 0, 1]]")
            }
            Self::AxisCount { .. } => ("here", "write one to three axes, for example axes = [[0, 0, 1]]"),
            Self::DrivenAxes { .. } => {
                ("one axis", "write one axis, for example axes = [[0, 0, 1]], or leave `angle` out")
            }
            Self::DrivenSpring => ("beside `angle`", "leave it out, or leave `angle` out"),
            Self::DependentAxes => ("here", "no axis may be a combination of the others"),
            Self::ValuePerAxis { .. } if connection => {
                ("here", "write one number for all axes, or one per axis")
            }
            Self::ValuePerAxis { .. } => (
                "here",
                "write one number for all axes, one per axis, or a square matrix with a row per axis",
            ),
            Self::MasslessAxis { .. } => ("here", "or give the appendage an inertia about it"),
            Self::DuplicateName { .. } => ("used twice", "give each element its own name"),
            Self::Mechanism { .. } if connection => {
                ("held by no spring", "give it a `stiffness`, or leave this axis out")
            }
            Self::Mechanism { .. } if kind == ElementKind::Part => (
                "held by no spring",
                "attach or connect more of its nodes, three or more of a solid; or add a spring that resists it",
            ),
            Self::Mechanism { .. } => (
                "held by no spring",
                "add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }",
            ),
            Self::NotAttached => (
                "joined by nothing",
                "write attach = with one of its nodes, or a [[connection]]; springs alone do not hold a part",
            ),
            Self::NoNodes => ("no nodes", "name a node, or a set of nodes"),
            Self::HeldTwice { .. } => {
                ("held twice", "leave out one of the two, or put a stiff spring in its place")
            }
            Self::NoPartner { .. } => (
                "no partner",
                "sets are joined node by node; name one node on one side to make the set of the other side rigid",
            ),
            Self::NoCells { .. } => (
                "no such cells",
                "a [[solid]] is made of cells of its volume, a [[panel]] of those of a surface",
            ),
            Self::LooseNodes(MeshNote::Coincident { .. }) => (
                "loose nodes",
                "cells hang together by the nodes they share; for parts that turn, write two tables and a [[connection]]",
            ),
            Self::LooseNodes(_) => (
                "loose nodes",
                "nothing resists their motion: delete them; the cells of a solid have a volume, those of a panel an area",
            ),
            Self::NoMass => ("here", "write a layer: { material = \"aluminium\", thickness = \"2 mm\" }"),
            Self::NoInertia { held: false, .. } => {
                ("here", "check the masses and the inertia of the carrier")
            }
            Self::NoInertia { held: true, .. } => {
                ("here", "check the inertia of the carrier and the `point` of the support")
            }
            Self::Memory { .. } => ("too large", ""),
            Self::NoSuchPoint { .. } => ("no such point", ""),
            Self::NotInterface { .. } => ("not of the interface", ""),
            Self::ShapeRows { .. }
            | Self::ShapeColumns { .. }
            | Self::NotUnit { .. }
            | Self::EmptyMode { .. }
            | Self::CoupledModes { .. } => ("not its shapes", ""),
            Self::ValuePerMode { .. } => ("one for each mode", ""),
            Self::Circle { .. } => ("in a circle", ""),
            Self::NoArm { .. } | Self::NoTurn { .. } | Self::NoDirection { .. } => ("cannot turn", ""),
            Self::Mesh(_) => ("not the mesh of a body", ""),
            Self::Elasticity(_)
            | Self::Rheology(RheologyError::NoRows | RheologyError::NotAscending { .. }) => {
                ("no such material", "")
            }
            Self::Control(problem) => ("no such controller", problem.remedy()),
            Self::Beam(_) => ("no such beam", ""),
            Self::Shell { .. } => ("no such panel", ""),
            Self::Degree { .. }
            | Self::Cells { .. }
            | Self::Meshing(_)
            | Self::Stokes(_)
            | Self::NoSuchPart { .. }
            | Self::NoSuchNode { .. }
            | Self::NoSuchRow { .. }
            | Self::NoSuchCell { .. }
            | Self::DensityPerCell { .. }
            | Self::NoTurnForInertia { .. }
            | Self::NoModes { .. }
            | Self::NoGuide
            | Self::Unbalanced { .. }
            | Self::TensionOnPart
            | Self::TensionAfloat
            | Self::Barred { .. } => ("here", ""),
        }
    }
}
