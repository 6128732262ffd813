//! Elements: the components of a body that a user describes, and their assembly into a flexible body.

#[macro_use]
mod kinds;

mod affine;
mod assembly;
mod attachment;
mod builder;
mod bushing;
mod carrier;
mod cavity;
mod coefficient;
mod complete;
mod compliance;
mod element;
mod ellipsoid;
mod error;
mod force;
mod hinged;
mod internal;
mod material;
mod network;
mod part;
mod point;
mod ritz;
mod rotor;
mod single_element;
mod spring;
mod station;
mod surface;
mod system_matrices;
mod wheel;

pub use crate::finite::beam::{BeamError, Quantity, Section, SectionShape};
pub use crate::finite::elasticity::{ElasticityError, Modulus};
pub use crate::finite::shell::{Constant, ShellError};
pub use crate::flow::stokes::StokesError;
pub use crate::structure::Condensation;
pub use assembly::{Built, PartReduction};
pub use builder::{AssemblyElement, CARRIER};
pub use bushing::Bushing;
pub use carrier::Carrier;
pub use cavity::{Cavity, CavityShape, MOST_OF_BALL, MOST_OF_CYLINDER, MOST_OF_SPHEROID, Regime, SlowLiquid};
pub use complete::Incomplete;
pub use ellipsoid::Ellipsoid;
pub use error::{ElementError, Field, Problem};
pub use hinged::{HingeCoefficient, Hinged, PlaceRef};
pub use kinds::ElementId;
pub use material::Material;
pub use network::Network;
pub use part::{
    Anchor, Connection, ElasticMaterial, Frame, FrameNode, GivenModes, Layer, Matrices, Member, NodalMass,
    NodeRef, Orthotropic, Panel, Part, PartKind, Region, Solid, Spectrum, TipMass,
};
pub use point::{Point, PointMotion};
pub use rotor::{Rotor, RotorKind};
pub use spring::{Coefficient, End, Prestress, Spring, SpringLaw};
pub use station::Station;
pub use surface::{Approximation, Resolution, Surface};
pub use wheel::{Wheel, WheelSpeed};

use crate::model::Support;
use crate::model::force::Force;

kinds! {
    /// Material points.
    points: Point(Point) = "point";
    /// Springs and dashpots.
    springs: Spring(Spring) = "spring";
    /// Bushings: springs along and about axes of their own.
    bushings: Bushing(Bushing) = "bushing";
    /// Rigid appendages on hinges.
    hinged: Hinged(Hinged) = "appendage";
    /// Ellipsoids, each of them a whole body.
    ellipsoids: Ellipsoid(Ellipsoid) = "ellipsoid";
    /// Solids inside closed surfaces, each of them a whole body.
    surfaces: Surface(Surface) = "surface";
    /// Parts of finite elements.
    parts: Part(Part) = "part";
    /// Joints between parts, and between them and the carrier.
    connections: Connection(Connection) = "connection";
    /// Rotors with friction.
    rotors: Rotor(Rotor) = "rotor";
    /// Momentum wheels.
    wheels: Wheel(Wheel) = "wheel";
    /// Cavities full of liquid.
    cavities: Cavity(Cavity) = "cavity";
    /// External forces.
    forces: Force(Force<Station>) = "force";
}
