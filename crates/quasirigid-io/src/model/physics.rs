use quasirigid::elements::{Assembly, ElementError, Kind, Place, Problem};
use quasirigid::math::mesh::MeshNote;
use quasirigid::model::{InertiaError, RheologyError};

use super::Diagnostic;
use super::spans::Spans;

/// What a law of mechanics says against an element, at the place of the file it is about.
pub(super) fn diagnostic(error: &ElementError, assembly: &Assembly, spans: &Spans) -> Diagnostic {
    let ElementError { place, field, problem } = error;
    let span = spans.find(*place, *field);
    let message = match problem {
        Problem::Mechanism { .. } | Problem::NoInertia { .. } | Problem::NoBody => problem.to_string(),
        Problem::BesideWhole
        | Problem::InsideNothing
        | Problem::HeavyInside
        | Problem::Memory { .. }
        | Problem::NotAttached
        | Problem::Circle { .. } => {
            format!("{}: {problem}", described(*place, assembly))
        }
        _ => format!("`{field}` of {}: {problem}", described(*place, assembly)),
    };
    let diagnostic = Diagnostic::new(span, message, label(problem));
    match advice(*place, problem) {
        Some(help) => diagnostic.help(help),
        None => diagnostic,
    }
}

/// An element as its user knows it: by its name, a spring by its number.
fn described(place: Place, assembly: &Assembly) -> String {
    let named = match place {
        Place::Point(index) => assembly.points.get(index).map(|point| format!("point {:?}", point.name)),
        Place::Hinged(index) => assembly.hinged.get(index).map(|part| format!("appendage {:?}", part.name)),
        Place::Surface(index) => assembly.surfaces.get(index).map(|part| format!("surface {:?}", part.name)),
        Place::Ellipsoid(index) => {
            assembly.ellipsoids.get(index).map(|part| format!("ellipsoid {:?}", part.name))
        }
        Place::Force(index) => assembly.forces.get(index).map(|force| format!("force {:?}", force.name)),
        Place::Part(index) => {
            assembly.parts.get(index).map(|part| format!("{} {:?}", kind(&part.kind), part.name))
        }
        Place::Rotor(index) => assembly.rotors.get(index).map(|rotor| format!("rotor {:?}", rotor.name)),
        Place::Wheel(index) => assembly.wheels.get(index).map(|wheel| format!("wheel {:?}", wheel.name)),
        Place::Cavity(index) => {
            assembly.cavities.get(index).map(|cavity| format!("cavity {:?}", cavity.name))
        }
        Place::Carrier | Place::Spring(_) | Place::Connection(_) | Place::Support => None,
    };
    named.unwrap_or_else(|| {
        format!(
            "{}{place}",
            if matches!(place, Place::Spring(_) | Place::Connection(_)) { "" } else { "the " }
        )
    })
}

fn kind(kind: &Kind) -> &'static str {
    match kind {
        Kind::Frame(_) => "beam",
        Kind::Panel(_) => "panel",
        Kind::Solid(_) => "solid",
        Kind::Matrices(_) => "matrices",
        Kind::Modes(_) => "modes",
        _ => "part",
    }
}

fn label(problem: &Problem) -> &'static str {
    match problem {
        Problem::NotFinite { .. } => "not finite",
        Problem::NotAMass { .. } => "must be positive",
        Problem::Inertia(InertiaError::Impossible { .. }) => "no body has this inertia",
        Problem::Inertia(InertiaError::NotSymmetric { .. })
        | Problem::NotSymmetric { .. }
        | Problem::Lopsided { .. } => "not symmetric",
        Problem::NegativeDiagonal { .. } => "negative energy",
        Problem::HeldByMatrices { .. } => "held by nothing",
        Problem::Indefinite { .. } => "gives energy",
        Problem::Mechanism { .. } => "held by no spring",
        Problem::NoSuchPoint { .. } => "no such point",
        Problem::DuplicateName { .. } => "used twice",
        Problem::NoAnchor => "needs an `anchor`",
        Problem::NoStation => "needs an `at`",
        Problem::StationOnPoint => "not for a point",
        Problem::Driving { .. } => "gives energy",
        Problem::NotPositive { .. } => "must be positive",
        Problem::NotElliptic { .. } => "no ellipse",
        Problem::Poisson { .. } | Problem::Rheology(_) => "no such material",
        Problem::NoBody => "no body",
        Problem::BesideWhole => "beside a whole body",
        Problem::InsideNothing => "held by no carrier",
        Problem::HeavyInside => "less than what turns inside",
        Problem::Memory { .. } => "too large",
        Problem::LiquidUnresolved => "not resolved",
        Problem::FlowDegree { .. } => "not offered",
        Problem::TooManyModes { .. } => "too many",
        Problem::NotAttitude { .. } => "not a unit quaternion",
        Problem::HeldWhole => "cannot be held",
        Problem::NoCarrier => "no carrier",
        Problem::SameEnds => "the same",
        Problem::NotAttached => "joined by nothing",
        Problem::NoNodes => "no nodes",
        Problem::HeldTwice { .. } => "held twice",
        Problem::NotInterface { .. } => "not of the interface",
        Problem::ShapeRows { .. }
        | Problem::ShapeColumns { .. }
        | Problem::NotUnit { .. }
        | Problem::EmptyMode { .. }
        | Problem::CoupledModes { .. } => "not its shapes",
        Problem::ValuePerMode { .. } => "one for each mode",
        Problem::Circle { .. } => "in a circle",
        Problem::NoArm { .. } | Problem::NoTurn { .. } => "cannot turn",
        Problem::NoPartner { .. } => "no partner",
        Problem::NoCells { .. } => "no such cells",
        Problem::Mesh(_) => "not the mesh of a body",
        Problem::LooseNodes(_) => "loose nodes",
        Problem::Elasticity(_) => "no such material",
        Problem::Beam(_) => "no such beam",
        Problem::Shell { .. } => "no such panel",
        _ => "here",
    }
}

fn advice(place: Place, problem: &Problem) -> Option<&'static str> {
    Some(match problem {
        Problem::NotFinite { .. } => "write a finite number",
        Problem::NotAMass { .. } => "write a positive mass, or leave the element out",
        Problem::Inertia(InertiaError::NotFinite { .. }) => "write finite numbers",
        Problem::Inertia(InertiaError::NotSymmetric { .. }) | Problem::NotSymmetric { .. } => {
            "write the same value at [i][j] and [j][i], or only the three values of the axes"
        }
        Problem::Inertia(InertiaError::Impossible { .. }) => {
            "check the units and the signs of the products of inertia; the tensor is about the element's own centre of mass"
        }
        Problem::Lopsided { .. } => {
            "a mass, damping or stiffness is symmetric; was one triangle written, or the matrix of another step?"
        }
        Problem::NegativeDiagonal { .. } => "check the sign, and that this is the matrix it should be",
        Problem::HeldByMatrices { .. } => {
            "add a [carrier], or export the matrices of the body that nothing holds"
        }
        Problem::ZeroDirection => "write a direction such as [0, 0, 1]; its length does not matter",
        Problem::Indefinite { .. } => {
            "check the signs; the eigenvalues of the matrix must be zero or positive"
        }
        Problem::SameEnds if matches!(place, Place::Connection(_)) => {
            "a connection joins a part to the carrier, or to another part"
        }
        Problem::SameEnds => "a spring joins two points, or a point and the carrier",
        Problem::NoLine => "move one end, or leave out axial = true",
        Problem::NoAnchor => "add anchor = [x, y, z], the place of the spring's end on the carrier",
        Problem::NoStation => "add at = [x, y, z], the place on the carrier, in the file's frame",
        Problem::StationOnPoint => "leave it out, or write on = \"carrier\"",
        Problem::Driving { .. } => "write a positive coefficient; the force is opposite to the velocity",
        Problem::NotPositive { .. } => "write a positive number",
        Problem::NotElliptic { .. } => "write 0 for a circle; a body that escapes is not modelled",
        Problem::Poisson { .. } => "most rocks and metals have 0.2 to 0.35",
        Problem::Rheology(RheologyError::NotPositive { .. }) => "write a positive number",
        Problem::Rheology(RheologyError::Exponent { .. }) => "most materials have 0.2 to 0.5",
        Problem::NoBody => "add a [carrier], or parts that are elastic throughout, such as an [[ellipsoid]]",
        Problem::BesideWhole => "leave it out, or make the body of a [carrier] and what hangs on it",
        Problem::InsideNothing => "add a [carrier]: rotors, wheels and liquids turn in a rigid body",
        Problem::HeavyInside => {
            "add the inertia of what turns inside to that of the carrier, or check the units of both"
        }
        Problem::LiquidUnresolved => "choose a shape whose sides differ less, or fewer `modes`",
        Problem::FlowDegree { .. } => "8 is enough for six digits; leave `resolution` out",
        Problem::TooManyModes { .. } => "the slow motion needs none of them",
        Problem::NotAttitude { .. } => "write four numbers, scalar first, whose squares add up to 1",
        Problem::HeldWhole => "leave [support] out",
        Problem::NoCarrier if !matches!(place, Place::Force(_)) => {
            "add a [carrier], or leave this out: a body without one hangs on nothing"
        }
        Problem::NoCarrier => {
            "on a body that is elastic throughout act gravity and torques, which need no place"
        }
        Problem::Unresolved { .. } => "choose a lower degree",
        Problem::TwoRoads => "leave out `degree` or `cells`, or both",
        Problem::SeveralBodies { .. } => {
            "give each body its own file, or join them by a [carrier] and springs; a [[surface]] is one solid"
        }
        Problem::Unmeshed { .. } | Problem::Unsettled { .. } => {
            "describe the body by a [[solid]] with a mesh that is fine at its neck; or write `cells = 60000`, or `degree = 10` for \
             polynomials all the same, to see what they say"
        }
        Problem::AxisCount { .. } if matches!(place, Place::Connection(_)) => {
            "write one to three axes, for example hinge = [[0, 1, 0], [0, 0, 1]]"
        }
        Problem::AxisCount { .. } => "write one to three axes, for example axes = [[0, 0, 1]]",
        Problem::DependentAxes => "no axis may be a combination of the others",
        Problem::ValuePerAxis { .. } if matches!(place, Place::Connection(_)) => {
            "write one number for all axes, or one per axis"
        }
        Problem::ValuePerAxis { .. } => {
            "write one number for all axes, one per axis, or a square matrix with a row per axis"
        }
        Problem::MasslessAxis { .. } => "or give the appendage an inertia about it",
        Problem::DuplicateName { .. } => "give each element its own name",
        Problem::Mechanism { .. } if matches!(place, Place::Connection(_)) => {
            "give it a `stiffness`, or leave this axis out"
        }
        Problem::Mechanism { .. } if matches!(place, Place::Part(_)) => {
            "attach or connect more of its nodes, three or more of a solid; or add a spring that resists it"
        }
        Problem::Mechanism { .. } => {
            "add a spring that resists it, or leave the point less freedom: motion = { line = [x, y, z] }"
        }
        Problem::NotAttached => {
            "write attach = with one of its nodes, or a [[connection]]; springs alone do not hold a part"
        }
        Problem::NoNodes => "name a node, or a set of nodes",
        Problem::HeldTwice { .. } => "leave out one of the two, or put a stiff spring in its place",
        Problem::NoPartner { .. } => {
            "sets are joined node by node; name one node on one side to make the set of the other side rigid"
        }
        Problem::NoCells { .. } => {
            "a [[solid]] is made of cells of its volume, a [[panel]] of those of a surface"
        }
        Problem::LooseNodes(MeshNote::Coincident { .. }) => {
            "cells hang together by the nodes they share; for parts that turn, write two tables and a [[connection]]"
        }
        Problem::LooseNodes(_) => {
            "nothing resists their motion: delete them; the cells of a solid have a volume, those of a panel an area"
        }
        Problem::NoMass => "write a layer: { material = \"aluminium\", thickness = \"2 mm\" }",
        Problem::NoInertia { held: false, .. } => "check the masses and the inertia of the carrier",
        Problem::NoInertia { held: true, .. } => {
            "check the inertia of the carrier and the `point` of the support"
        }
        _ => return None,
    })
}
