//! One body described in two ways.

use nalgebra::{Matrix3, Vector3};
use quasirigid::elements::{Assembly, Coefficient, End, HingeCoefficient, PointMotion, Spring, SpringLaw};
use quasirigid::model::{Rheology, Support};

/// Size of the old units in the new ones.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    pub length: f64,
    pub mass: f64,
    pub time: f64,
}

impl Units {
    /// The factor of a quantity with these exponents of length, mass and time.
    pub fn factor(self, [length, mass, time]: [i32; 3]) -> f64 {
        self.length.powi(length) * self.mass.powi(mass) * self.time.powi(time)
    }
}

/// The body in other units.
pub fn rescaled(assembly: &Assembly, units: Units) -> Assembly {
    let mut scaled = assembly.clone();
    let place = |r: &mut [f64; 3]| *r = r.map(|x| units.length * x);
    let inertia = |J: &mut [[f64; 3]; 3]| *J = J.map(|row| row.map(|x| units.factor([2, 1, 0]) * x));
    if let Some(carrier) = &mut scaled.carrier {
        carrier.mass *= units.mass;
        place(&mut carrier.center_of_mass);
        inertia(&mut carrier.inertia);
    }
    for point in &mut scaled.points {
        point.mass *= units.mass;
        place(&mut point.position);
    }
    for spring in &mut scaled.springs {
        spring.law = strengthened(spring.law, units.factor([0, 1, -2]), units.factor([0, 1, -1]));
        if let SpringLaw::Axial { anchor: Some(anchor), .. } = &mut spring.law {
            place(anchor);
        }
    }
    for hinged in &mut scaled.hinged {
        hinged.mass *= units.mass;
        place(&mut hinged.center_of_mass);
        place(&mut hinged.hinge);
        inertia(&mut hinged.inertia);
        hinged.stiffness = hinge_times(&hinged.stiffness, units.factor([2, 1, -2]));
        hinged.damping = hinge_times(&hinged.damping, units.factor([2, 1, -1]));
    }
    if let Support::FixedPoint { point } = &mut scaled.support {
        place(point);
    }
    scaled
}

/// The body in a file whose axes are rotated: every vector `v` becomes `R v`.
pub fn rotated(assembly: &Assembly, R: &Matrix3<f64>) -> Assembly {
    let mut turned = assembly.clone();
    let vector = |r: &mut [f64; 3]| *r = (R * Vector3::from(*r)).into();
    let tensor = |J: &mut [[f64; 3]; 3]| {
        let image = R * Matrix3::from(*J) * R.transpose();
        *J = (0.5 * (image + image.transpose())).into();
    };
    if let Some(carrier) = &mut turned.carrier {
        vector(&mut carrier.center_of_mass);
        tensor(&mut carrier.inertia);
    }
    for point in &mut turned.points {
        vector(&mut point.position);
        match &mut point.motion {
            PointMotion::Free => {}
            PointMotion::Line(direction) | PointMotion::Plane(direction) => vector(direction),
        }
    }
    let coefficient = |coefficient: &mut Coefficient| {
        let mut rows = match *coefficient {
            Coefficient::Isotropic(_) => return,
            Coefficient::Diagonal(values) => Matrix3::from_diagonal(&Vector3::from(values)).into(),
            Coefficient::Full(rows) => rows,
        };
        tensor(&mut rows);
        *coefficient = Coefficient::Full(rows);
    };
    for spring in &mut turned.springs {
        match &mut spring.law {
            SpringLaw::Spatial { stiffness, damping } => {
                coefficient(stiffness);
                coefficient(damping);
            }
            SpringLaw::Axial { anchor, .. } => anchor.iter_mut().for_each(vector),
        }
    }
    for hinged in &mut turned.hinged {
        vector(&mut hinged.center_of_mass);
        vector(&mut hinged.hinge);
        tensor(&mut hinged.inertia);
        hinged.axes.iter_mut().for_each(vector);
    }
    if let Support::FixedPoint { point } = &mut turned.support {
        vector(point);
    }
    turned
}

/// Springs and dashpots multiplied by two factors.
pub fn stiffened(assembly: &Assembly, stiffness: f64, damping: f64) -> Assembly {
    let mut stiff = assembly.clone();
    for spring in &mut stiff.springs {
        spring.law = strengthened(spring.law, stiffness, damping);
    }
    for hinged in &mut stiff.hinged {
        hinged.stiffness = hinge_times(&hinged.stiffness, stiffness);
        hinged.damping = hinge_times(&hinged.damping, damping);
    }
    stiff
}

/// The body with a point cut in two at its place: each part takes its share of the mass and of every spring.
pub fn with_point_cut(assembly: &Assembly, index: usize, share: f64) -> Assembly {
    let mut cut = assembly.clone();
    let mut part = cut.points[index].clone();
    part.name.push_str(" cut");
    part.mass *= share;
    cut.points[index].mass *= 1.0 - share;
    cut.points.push(part);
    let new = End::Point(cut.points.len() - 1);
    for spring in &mut cut.springs.iter_mut().collect::<Vec<_>>() {
        if spring.from == End::Point(index) || spring.to == End::Point(index) {
            spring.law = strengthened(spring.law, 1.0 - share, 1.0 - share);
        }
    }
    let moved = |end: End| if end == End::Point(index) { new } else { end };
    let parts = assembly.springs.iter().filter(|s| s.from == End::Point(index) || s.to == End::Point(index));
    let parts: Vec<_> = parts
        .map(|s| Spring {
            name: s.name.clone(),
            from: moved(s.from),
            to: moved(s.to),
            law: strengthened(s.law, share, share),
            rheology: Rheology::Elastic,
        })
        .collect();
    cut.springs.extend(parts);
    cut
}

/// The body with an appendage cut in two of the same shape on the same hinge.
pub fn with_hinged_cut(assembly: &Assembly, index: usize, share: f64) -> Assembly {
    let mut cut = assembly.clone();
    let mut part = cut.hinged[index].clone();
    part.name.push_str(" cut");
    for (hinged, share) in [(&mut cut.hinged[index], 1.0 - share), (&mut part, share)] {
        hinged.mass *= share;
        hinged.inertia = hinged.inertia.map(|row| row.map(|x| share * x));
        hinged.stiffness = hinge_times(&hinged.stiffness, share);
        hinged.damping = hinge_times(&hinged.damping, share);
    }
    cut.hinged.push(part);
    cut
}

/// A spring or dashpot coefficient multiplied by a number.
pub fn times(coefficient: Coefficient, factor: f64) -> Coefficient {
    match coefficient {
        Coefficient::Isotropic(value) => Coefficient::Isotropic(factor * value),
        Coefficient::Diagonal(values) => Coefficient::Diagonal(values.map(|x| factor * x)),
        Coefficient::Full(rows) => Coefficient::Full(rows.map(|row| row.map(|x| factor * x))),
    }
}

/// A law with its stiffness and its damping multiplied by numbers.
pub fn strengthened(law: SpringLaw, by: f64, damped_by: f64) -> SpringLaw {
    match law {
        SpringLaw::Spatial { stiffness, damping } => {
            SpringLaw::Spatial { stiffness: times(stiffness, by), damping: times(damping, damped_by) }
        }
        SpringLaw::Axial { stiffness, damping, anchor, .. } => SpringLaw::Axial {
            stiffness: by * stiffness,
            damping: damped_by * damping,
            anchor,
            prestress: quasirigid::elements::Prestress::Relaxed,
        },
    }
}

/// A hinge coefficient multiplied by a number.
pub fn hinge_times(coefficient: &HingeCoefficient, factor: f64) -> HingeCoefficient {
    match coefficient {
        HingeCoefficient::PerAxis(values) => {
            HingeCoefficient::PerAxis(values.iter().map(|x| factor * x).collect())
        }
        HingeCoefficient::Full(rows) => {
            let row = |row: &Vec<f64>| row.iter().map(|x| factor * x).collect();
            HingeCoefficient::Full(rows.iter().map(row).collect())
        }
    }
}
