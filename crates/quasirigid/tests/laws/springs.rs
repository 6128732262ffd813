//! Stiffness and damping by their definition: the energy of every spring, written out. (I9)

use nalgebra::{Matrix3, Vector3};
use proptest::collection::vec;
use proptest::prelude::*;
use quasirigid::elements::{Assembly, Coefficient, End, HingeCoefficient, SpringLaw};
use quasirigid::model::FlexibleBody;

use crate::support::{assemblies, cases};

type V = Vector3<f64>;

fn matrix(coefficient: Coefficient) -> Matrix3<f64> {
    match coefficient {
        Coefficient::Isotropic(value) => value * Matrix3::identity(),
        Coefficient::Diagonal(values) => Matrix3::from_diagonal(&V::from(values)),
        Coefficient::Full(rows) => Matrix3::from(rows).transpose(),
    }
}

fn hinge_form(coefficient: &HingeCoefficient, angles: &[f64]) -> f64 {
    match coefficient {
        HingeCoefficient::PerAxis(values) => values.iter().zip(angles).map(|(k, q)| k * q * q).sum(),
        HingeCoefficient::Full(rows) => {
            let torque = |row: &[f64]| row.iter().zip(angles).map(|(k, q)| k * q).sum::<f64>();
            rows.iter().zip(angles).map(|(row, q)| torque(row) * q).sum()
        }
    }
}

/// `qᵀCq` and `qᵀBq` as sums over springs of the form of their stretch, and over hinges of that of their angles.
fn by_definition(assembly: &Assembly, body: &FlexibleBody, q: &[f64]) -> [f64; 2] {
    let displacement = |end: End| match end {
        End::Carrier => V::zeros(),
        End::Point(i) => body.markers()[i].shapes.iter().map(|(j, H)| q[*j] * V::from(*H)).sum(),
        End::Node(_) | End::Hinged(_) => unreachable!("these bodies have no parts"),
    };
    let place = |end: End, anchor: Option<[f64; 3]>| match end {
        End::Carrier => V::from(anchor.unwrap()),
        End::Point(i) => V::from(assembly.points[i].position),
        End::Node(_) | End::Hinged(_) => unreachable!("these bodies have no parts"),
    };
    let mut forms = [0.0; 2];
    for spring in &assembly.springs {
        let stretch = displacement(spring.to) - displacement(spring.from);
        let parts = match spring.law {
            SpringLaw::Spatial { stiffness, damping } => {
                [stiffness, damping].map(|coefficient| stretch.dot(&(matrix(coefficient) * stretch)))
            }
            SpringLaw::Axial { stiffness, damping, anchor, .. } => {
                let line = (place(spring.to, anchor) - place(spring.from, anchor)).normalize();
                [stiffness, damping].map(|coefficient| coefficient * stretch.dot(&line).powi(2))
            }
        };
        forms = std::array::from_fn(|i| forms[i] + parts[i]);
    }
    let mut rest = &q[body.coordinates().iter().filter(|c| c.unit == "m").count()..];
    for hinged in &assembly.hinged {
        let (angles, others) = rest.split_at(hinged.axes.len());
        forms[0] += hinge_form(&hinged.stiffness, angles);
        forms[1] += hinge_form(&hinged.damping, angles);
        rest = others;
    }
    assert!(rest.is_empty(), "every coordinate belongs to something");
    forms
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn stiffness_and_damping_are_forms_of_the_stretch_of_every_spring(
        assembly in assemblies(), numbers in vec(-1.0..1.0, 24)
    ) {
        let body = assembly.body().unwrap();
        let q = &numbers[..body.coordinates().len()];
        let expected = by_definition(&assembly, &body, q);
        for (matrix, expected) in [body.stiffness(), body.damping()].into_iter().zip(expected) {
            let found: f64 = matrix.times(q).iter().zip(q).map(|(force, q)| force * q).sum();
            // Rounding of a sum of positive terms.
            prop_assert!((found - expected).abs() < 1e-13 * expected, "{found} {expected}");
        }
    }

    /// A common displacement of all points stretches only the springs that go to the carrier. (I9)
    #[test]
    fn moving_two_points_together_does_not_stretch_the_spring_between_them(
        assembly in assemblies().prop_filter("two points", |a| a.points.len() > 1), along in 0..3usize
    ) {
        let mut pair = assembly;
        pair.hinged.clear();
        for point in &mut pair.points {
            point.motion = quasirigid::elements::PointMotion::Free;
        }
        let form = |assembly: &Assembly| {
            let body = assembly.body().unwrap();
            let q: Vec<f64> = (0..body.coordinates().len()).map(|j| f64::from(u8::from(j % 3 == along))).collect();
            body.stiffness().times(&q).iter().zip(&q).map(|(force, q)| force * q).sum::<f64>()
        };
        let before = form(&pair);
        let mut joined = pair.springs[0].clone();
        (joined.from, joined.to) = (End::Point(1), End::Point(0));
        pair.springs.push(joined);
        prop_assert!((form(&pair) - before).abs() < 1e-13 * before);
    }
}
