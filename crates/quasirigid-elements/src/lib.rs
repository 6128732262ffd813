//! Elements of [`quasirigid`](https://docs.rs/quasirigid): the components of a body that a user describes, and their assembly into a
//! flexible body.
//!
//! Points, springs, hinges, beams, plates, solids, surfaces, liquids, rotors and matrices of other programs; [`problems`] are bodies with
//! known answers. Finite elements, flows in cavities and component modes stand behind them. `quasirigid::elements` is this crate.
#![allow(non_snake_case)]

/// The README of the crate, run with the documentation's own.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeOfCrate;

use quasirigid_body as model;
use quasirigid_math as math;

#[macro_use]
mod registry;

mod assembly;
mod builder;
mod complete;
mod contribution;
mod element;
mod error;
mod finite;
mod flow;
mod kinds;
mod lookup;
mod material;
mod names;
mod number;
pub mod problems;
mod reference;
mod structure;
mod sunlight;
mod visual;

pub use crate::finite::beam::{BeamError, Quantity, Section, SectionShape};
pub use crate::finite::elasticity::{ElasticityError, Modulus};
pub use crate::finite::shell::{Constant, ShellError};
pub use crate::flow::stokes::StokesError;
pub use crate::structure::Condensation;
pub use assembly::{Built, ObservedShape, Relaxed};
pub use builder::{AssemblyElement, CARRIER};
pub use complete::Incomplete;
pub use contribution::{PartReduction, SlowLiquid};
pub use error::{ElementError, Field, Problem};
pub use kinds::appendage::{Appendage, AppendageMode, Extent, InertiaPoint};
pub use kinds::application_point::ApplicationPoint;
pub use kinds::boom::Boom;
pub use kinds::bushing::Bushing;
pub use kinds::carrier::Carrier;
pub use kinds::cavity::{
    Cavity, CavityShape, MAX_REYNOLDS_OF_BALL, MAX_REYNOLDS_OF_CYLINDER, MAX_REYNOLDS_OF_SPHEROID, Regime,
};
pub use kinds::controller::NamedController;
pub use kinds::ellipsoid::Ellipsoid;
pub use kinds::hinged::{HingeCoefficient, Hinged};
pub use kinds::network::Network;
pub use kinds::part::{
    Anchor, Bar, BarKind, Connection, Coupling, ElasticMaterial, Frame, FrameNode, GivenModes, Grading,
    Layer, Matrices, Member, Mixed, NodalMass, NodeBody, NodeLink, Orthotropic, Panel, Part, PartKind,
    Region, Skin, Solid, Spectrum, Strain, Term, TipMass, Weighted,
};
pub use kinds::point::{Point, PointMotion};
pub use kinds::prescribed::PrescribedMotion;
pub use kinds::rotor::{Rotor, RotorKind};
pub use kinds::spring::{Coefficient, Prestress, Spring, SpringLaw};
pub use kinds::surface::{Approximation, Resolution, Surface};
pub use kinds::tank::{
    MeasuredSlosh, RingBaffle, SettledTank, Settling, Tank, TankContents, TankDamping, TankError, TankMode,
    TankShape,
};
pub use kinds::tube::{Slug, Tube, TubeError};
pub use kinds::wheel::{Wheel, WheelSpeed};
pub use material::Material;
pub use reference::{End, NodeRef, PlaceRef};
pub use registry::ElementId;
pub use sunlight::{SunlightAccuracy, SunlitShape, UNRESOLVED as UNRESOLVED_SUNLIGHT};
pub use visual::{RotorAxis, Visual};

use kinds::force;

use crate::element::Role;
use crate::model::Support;
use crate::model::control::HysteresisRod;
use crate::model::force::{Force, MagneticField};

kinds! {
    /// Material points.
    points: Point(Point) = "point", Role::Mass, name;
    /// Springs and dashpots.
    springs: Spring(Spring) = "spring", Role::Link, name;
    /// Bushings: springs along and about axes of their own.
    bushings: Bushing(Bushing) = "bushing", Role::Link, name;
    /// Rigid appendages on hinges.
    hinged: Hinged(Hinged) = "appendage", Role::OnCarrier(Field::HINGE), name;
    /// Booms whose lengths are prescribed.
    booms: Boom(Boom) = "boom", Role::OnCarrier(Field::POSITION), name;
    /// Appendages known by their cantilever modes.
    appendages: Appendage(Appendage) = "modal appendage", Role::OnCarrier(Field::MODES), name;
    /// Ellipsoids, each of them a whole body.
    ellipsoids: Ellipsoid(Ellipsoid) = "ellipsoid", Role::Whole, name;
    /// Solids inside closed surfaces, each of them a whole body.
    surfaces: Surface(Surface) = "surface", Role::Whole, name;
    /// Parts of finite elements.
    parts: Part(Part) = "part", Role::Mass, name;
    /// Joints between parts, and between them and the carrier.
    connections: Connection(Connection) = "connection", Role::Mass;
    /// Rotors with friction.
    rotors: Rotor(Rotor) = "rotor", Role::Inside(Field::AXIS), name;
    /// Momentum wheels.
    wheels: Wheel(Wheel) = "wheel", Role::Inside(Field::AXIS), name;
    /// Cavities full of liquid.
    cavities: Cavity(Cavity) = "cavity", Role::Inside(Field::SHAPE), name;
    /// Closed circular tubes that are partly full of a liquid.
    tubes: Tube(Tube) = "tank", Role::Inside(Field::SHAPE), name;
    /// Tanks that are partly full of a liquid.
    tanks: Tank(Tank) = "tank", Role::Inside(Field::SHAPE), name;
    /// External forces.
    forces: Force(Force<ApplicationPoint>) = "force", Role::External, name;
    /// Controllers.
    controllers: Controller(NamedController) = "controller", Role::External, name;
    /// Hysteresis rods.
    rods: Rod(HysteresisRod) = "rod", Role::External, name;
}
