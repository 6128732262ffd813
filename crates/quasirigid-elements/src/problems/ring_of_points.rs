use std::f64::consts::TAU;

use crate::model::Rheology;
use crate::{Assembly, Carrier, Coefficient, End, Point, PointMotion, Spring, SpringLaw};

/// Free body with a crooked ring of sprung points, each joined to the carrier and to the next by general springs: of any size and without
/// symmetry, for timing and tests.
#[must_use]
pub fn ring_of_points(count: usize) -> Assembly {
    let angle = |i: usize| TAU * i as f64 / count as f64;
    let points = (0..count).map(|i| Point {
        name: format!("point {i}"),
        mass: 0.2 + 0.1 * (3.0 * angle(i)).sin().abs(),
        position: [1.3 * angle(i).cos(), 0.9 * angle(i).sin(), 0.4 * (2.0 * angle(i) + 0.3).sin()],
        motion: PointMotion::Free,
    });
    let springs = (0..count).flat_map(|i| {
        let next = (i + 1) % count;
        let to_carrier = spring(i, End::Carrier, 900.0 + 40.0 * i as f64);
        let to_next = (next != i).then(|| spring(i, End::Point(next), 250.0));
        std::iter::once(to_carrier).chain(to_next)
    });
    Assembly {
        carrier: Some(Carrier {
            mass: 30.0,
            center_of_mass: [0.1, -0.05, 0.02],
            inertia: [[9.0, 0.4, -0.2], [0.4, 13.0, 0.3], [-0.2, 0.3, 16.0]],
        }),
        points: points.collect(),
        springs: springs.collect(),
        ..Assembly::default()
    }
}

fn spring(from: usize, to: End, k: f64) -> Spring {
    let lean = 0.2 * (from as f64).cos();
    let matrix = |k: f64| [[k, lean * k, 0.0], [lean * k, 1.3 * k, 0.1 * k], [0.0, 0.1 * k, 0.8 * k]];
    Spring {
        name: String::new(),
        from: End::Point(from),
        to,
        law: SpringLaw::Spatial {
            stiffness: Coefficient::Full(matrix(k)),
            damping: Coefficient::Full(matrix(0.01 * k)),
        },
        rheology: Rheology::Elastic,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_point_is_joined_to_the_carrier_and_to_the_next() {
        for count in [1, 2, 5] {
            let springs = ring_of_points(count).springs;
            let joined = |from: usize, to: End| {
                springs.iter().filter(|spring| spring.from == End::Point(from) && spring.to == to).count()
            };
            for point in 0..count {
                let next = (point + 1) % count;
                assert_eq!(joined(point, End::Carrier), 1);
                assert_eq!(joined(point, End::Point(next)), usize::from(count > 1));
            }
        }
    }
}
