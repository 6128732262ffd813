//! Main field of the Earth against the test values of its authors, and the laws of a field without sources. (F21)

use nalgebra::{Matrix3, Vector3};
use quasirigid::model::force::{EarthField, MagneticField, Orbit};

type V = Vector3<f64>;

const VALUES: &str = include_str!("../../../../data/published/igrf14/values.csv");

fn earth(year: f64, degree: usize) -> EarthField {
    EarthField { year, degree, sidereal: 0.0 }
}

#[test]
fn the_main_field_has_its_published_values() {
    for line in VALUES.lines().skip(1) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let [year, colatitude, longitude, radius, expected @ ..] = &cells[..] else { panic!("{line}") };
        let ((st, ct), (sp, cp)) = (colatitude.to_radians().sin_cos(), longitude.to_radians().sin_cos());
        let up = V::new(st * cp, st * sp, ct);
        let (south, east) = (V::new(ct * cp, ct * sp, -st), V::new(-sp, cp, 0.0));
        let B = 1e9 * V::from(earth(*year, 13).in_earth_axes((1e3 * radius * up).into()));
        let found = [-south.dot(&B), east.dot(&B), -up.dot(&B)];
        println!("{year}: {found:?} {expected:?}");
        // two digits are printed; the last two were computed before the coefficients were rounded
        let tolerance = if *year < 2010.0 { 0.006 } else { 0.1 };
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < tolerance, "{year}: {found} {expected}");
        }
    }
}

/// Slopes of the field by differences of fourth order.
fn slopes(field: EarthField, place: V) -> Matrix3<f64> {
    let apart = 1e3;
    Matrix3::from_columns(&[0, 1, 2].map(|axis| {
        let at =
            |steps: f64| V::from(field.in_earth_axes((place + steps * apart * V::ith(axis, 1.0)).into()));
        (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * apart)
    }))
}

/// Outside the Earth the field has neither divergence nor curl, over the poles too.
#[test]
fn the_main_field_has_no_sources() {
    for place in
        [V::new(0.0, 0.0, 6.6e6), V::new(1e-3, 0.0, -6.9e6), V::new(4e6, -5e6, 2e6), V::new(-2e6, 7e6, -5e6)]
    {
        for degree in [1, 4, 13] {
            let slope = slopes(earth(2024.0, degree), place);
            // the differences are right to the fourth power of a thousand metres over the length of the finest harmonics
            let size = slope.norm();
            assert!(slope.trace().abs() < 1e-8 * size, "{place} {degree}: {}", slope.trace() / size);
            assert!((slope - slope.transpose()).norm() < 1e-8 * size, "{place} {degree}");
        }
    }
}

/// Along an orbit the field turns with the Earth: at the start as seen from the sidereal time there, and its rate is the derivative.
#[test]
fn the_main_field_turns_with_the_earth() {
    let orbit = Orbit {
        mu: Orbit::EARTH_PARAMETER,
        semi_major_axis: 7.1e6,
        eccentricity: 0.02,
        inclination: 1.4,
        raan: 0.6,
        argument_of_periapsis: 2.0,
        mean_anomaly: 0.3,
        node_rate: 2e-7,
        periapsis_rate: -1e-7,
    };
    let field = EarthField { year: 2023.2, degree: 13, sidereal: 1.3 };
    let along = MagneticField::Earth { field, orbit };
    for t in [0.0, 4000.0, 3e5] {
        let angle = 1.3 + EarthField::RATE * t;
        let turn = nalgebra::Rotation3::from_axis_angle(&V::z_axis(), angle);
        let place = turn.inverse() * V::from(orbit.at(t).place);
        let B = turn * V::from(field.in_earth_axes(place.into()));
        let [own, rate] = along.with_rate(t).map(V::from);
        assert!((own - B).norm() < 1e-13 * B.norm() && own == V::from(along.at(t)));
        let at = |steps: f64| V::from(along.at(t + steps));
        let slope = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / 12.0;
        // the clock has ten digits behind the point at 3e5 s
        assert!((slope - rate).norm() < 1e-7 * rate.norm(), "{t}: {slope} {rate}");
    }
}
