//! Bodies in a few lines: constructors with what most elements need, and an assembly that hands out ids.
//!
//! Every field stays public: values that a constructor leaves at their default are changed by struct update. Nothing is checked here;
//! [`Assembly::check`] and [`Assembly::build`] report errors with the element.

use super::error::{ElementId, ElementKind};
use super::{
    Assembly, Carrier, Coefficient, Ellipsoid, End, HingeCoefficient, Hinged, Material, PlaceRef, Point,
    PointMotion, Prestress, Spring, SpringLaw,
};
use crate::model::Rheology;

/// The carrier, as an end of a spring.
pub const CARRIER: ElementId = ElementId::CARRIER;

/// An element that an [`Assembly`] takes.
pub trait AssemblyElement {
    /// Adds the element to the list of its kind.
    fn add_to(self, assembly: &mut Assembly) -> ElementId;
}

impl Assembly {
    /// Adds an element; its id serves as the end of a spring, and stands in errors.
    ///
    /// ```
    /// use quasirigid::prelude::*;
    ///
    /// let mut assembly = Assembly::default();
    /// assembly.add(Carrier::principal(40.0, [9.0, 13.0, 16.0]));
    /// let tip = assembly.add(Point::new("tip", 1.0, [0.8, 0.3, 0.5]));
    /// assembly.add(Spring::isotropic(600.0, 30.0).between(tip, CARRIER));
    /// assert_eq!(assembly.body()?.coordinates().len(), 3);
    /// # Ok::<(), quasirigid::Error>(())
    /// ```
    pub fn add(&mut self, element: impl AssemblyElement) -> ElementId {
        element.add_to(self)
    }

    /// The assembly with one more element.
    #[must_use]
    pub fn with(mut self, element: impl AssemblyElement) -> Self {
        self.add(element);
        self
    }
}

impl AssemblyElement for Carrier {
    /// Adds the carrier in place of an earlier one.
    fn add_to(self, assembly: &mut Assembly) -> ElementId {
        assembly.carrier = Some(self);
        CARRIER
    }
}

impl From<ElementId> for End {
    /// The carrier, a point, or the first place of a hinged appendage.
    ///
    /// # Panics
    /// If the element is of another kind, to which no spring can be fixed.
    fn from(ElementId { kind, index }: ElementId) -> Self {
        match kind {
            ElementKind::Carrier => Self::Carrier,
            ElementKind::Point => Self::Point(index),
            ElementKind::Hinged => Self::Hinged(PlaceRef { hinged: index, place: 0 }),
            _ => panic!("no spring can be fixed to a {}", kind.words()),
        }
    }
}

impl Carrier {
    /// A carrier whose centre of mass is the origin and whose principal axes are the axes of the frame: mass (kg), principal
    /// moments (kg·m²).
    ///
    /// ```
    /// use quasirigid::prelude::*;
    ///
    /// let carrier = Carrier::principal(40.0, [9.0, 13.0, 16.0]);
    /// assert_eq!(carrier.inertia[1], [0.0, 13.0, 0.0]);
    /// ```
    #[must_use]
    pub fn principal(mass: f64, [I1, I2, I3]: [f64; 3]) -> Self {
        let inertia = [[I1, 0.0, 0.0], [0.0, I2, 0.0], [0.0, 0.0, I3]];
        Self { mass, center_of_mass: [0.0; 3], inertia }
    }
}

impl Point {
    /// A point that moves in every direction: mass (kg), equilibrium position (m).
    ///
    /// ```
    /// use quasirigid::prelude::*;
    ///
    /// let bead = Point::new("bead", 0.2, [0.0, 0.5, 0.1]).along([0.0, 1.0, 0.0]);
    /// assert_eq!(bead.motion, PointMotion::Line([0.0, 1.0, 0.0]));
    /// ```
    #[must_use]
    pub fn new(name: impl Into<String>, mass: f64, position: [f64; 3]) -> Self {
        Self { name: name.into(), mass, position, motion: PointMotion::Free }
    }

    /// The point constrained to a line with this direction.
    #[must_use]
    pub fn along(self, direction: [f64; 3]) -> Self {
        Self { motion: PointMotion::Line(direction), ..self }
    }

    /// The point constrained to a plane with this normal.
    #[must_use]
    pub fn across(self, normal: [f64; 3]) -> Self {
        Self { motion: PointMotion::Plane(normal), ..self }
    }
}

impl Spring {
    fn new(law: SpringLaw) -> Self {
        Self { name: String::new(), from: End::Carrier, to: End::Carrier, law, rheology: Rheology::Elastic }
    }

    /// An isotropic spring: stiffness (N/m) and damping (N·s/m) in every direction; [`between`](Self::between) sets its ends.
    ///
    /// ```
    /// use quasirigid::prelude::*;
    ///
    /// let mut assembly = Assembly::default();
    /// let tip = assembly.add(Point::new("tip", 1.0, [0.8, 0.3, 0.5]));
    /// let spring = Spring::isotropic(600.0, 30.0).between(tip, CARRIER);
    /// assert_eq!((spring.from, spring.to), (End::Point(0), End::Carrier));
    /// ```
    #[must_use]
    pub fn isotropic(stiffness: f64, damping: f64) -> Self {
        let [stiffness, damping] = [stiffness, damping].map(Coefficient::Isotropic);
        Self::new(SpringLaw::Spatial { stiffness, damping })
    }

    /// One stiffness (N/m) and one damping (N·s/m) for each axis of the frame.
    #[must_use]
    pub fn diagonal(stiffness: [f64; 3], damping: [f64; 3]) -> Self {
        let [stiffness, damping] = [stiffness, damping].map(Coefficient::Diagonal);
        Self::new(SpringLaw::Spatial { stiffness, damping })
    }

    /// Stiffness (N/m) and damping (N·s/m) along the line between its ends, neither of which is the carrier.
    #[must_use]
    pub fn axial(stiffness: f64, damping: f64) -> Self {
        Self::new(SpringLaw::Axial { stiffness, damping, anchor: None, prestress: Prestress::Relaxed })
    }

    /// The spring between two elements.
    ///
    /// # Panics
    /// If an element is of a kind to which no spring can be fixed.
    #[must_use]
    pub fn between(self, from: impl Into<End>, to: impl Into<End>) -> Self {
        Self { from: from.into(), to: to.into(), ..self }
    }

    /// The spring under a name.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }
}

impl Hinged {
    /// A rigid appendage without a hinge yet: mass (kg), centre of mass (m), inertia tensor about it (kg·m²).
    ///
    /// ```
    /// use quasirigid::prelude::*;
    ///
    /// let inertia = [[0.2, 0.0, 0.0], [0.0, 1e-3, 0.0], [0.0, 0.0, 0.2]];
    /// let boom = Hinged::new("boom", 2.0, [0.0, -1.5, 0.2], inertia)
    ///     .on([0.0, -1.0, 0.2])
    ///     .about([1.0, 0.0, 0.0], 200.0, 0.5);
    /// let body = Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0])).with(boom).body()?;
    /// assert_eq!(body.coordinates()[0].name, "\"boom\" about axis 1");
    /// # Ok::<(), quasirigid::Error>(())
    /// ```
    #[must_use]
    pub fn new(name: impl Into<String>, mass: f64, center_of_mass: [f64; 3], inertia: [[f64; 3]; 3]) -> Self {
        Self {
            name: name.into(),
            mass,
            center_of_mass,
            inertia,
            hinge: [0.0; 3],
            axes: Vec::new(),
            stiffness: HingeCoefficient::PerAxis(Vec::new()),
            damping: HingeCoefficient::PerAxis(Vec::new()),
            rheology: Rheology::Elastic,
            angle: None,
            places: Vec::new(),
        }
    }

    /// The appendage with its hinge at a place (m).
    #[must_use]
    pub fn on(self, hinge: [f64; 3]) -> Self {
        Self { hinge, ..self }
    }

    /// The appendage with one more hinge axis, inside those that it has: stiffness (N·m/rad), damping (N·m·s/rad).
    ///
    /// # Panics
    /// If stiffness or damping is a full matrix, to which an axis adds no row.
    #[must_use]
    pub fn about(mut self, axis: [f64; 3], stiffness: f64, damping: f64) -> Self {
        self.axes.push(axis);
        for (coefficient, value) in [(&mut self.stiffness, stiffness), (&mut self.damping, damping)] {
            match coefficient {
                HingeCoefficient::PerAxis(values) => values.push(value),
                HingeCoefficient::Full(_) => panic!("a full matrix of a hinge takes no further axis"),
            }
        }
        self
    }

    /// The appendage with one more place (m) at which springs and forces act.
    #[must_use]
    pub fn place(mut self, name: impl Into<String>, position: [f64; 3]) -> Self {
        self.places.push((name.into(), position));
        self
    }
}

impl Material {
    /// An elastic material: density (kg/m³), Young's modulus (Pa), Poisson's ratio.
    #[must_use]
    pub fn new(density: f64, young: f64, poisson: f64) -> Self {
        Self { density, young, poisson, rheology: Rheology::Elastic }
    }

    /// The material with the quality factor `Q`.
    #[must_use]
    pub fn quality(self, factor: f64) -> Self {
        Self { rheology: Rheology::QualityFactor { factor }, ..self }
    }
}

impl Ellipsoid {
    /// An ellipsoid about the origin, its semi-axes (m) along the axes of the frame.
    ///
    /// ```
    /// use quasirigid::prelude::*;
    ///
    /// let rock = Ellipsoid::new("rock", [200.0, 140.0, 120.0], Material::new(2000.0, 1e9, 0.25).quality(100.0));
    /// let body = Assembly::default().with(rock).body()?;
    /// assert_eq!(body.coordinates().len(), 36);
    /// # Ok::<(), quasirigid::Error>(())
    /// ```
    #[must_use]
    pub fn new(name: impl Into<String>, semi_axes: [f64; 3], material: Material) -> Self {
        Self { name: name.into(), semi_axes, center: [0.0; 3], material }
    }
}
