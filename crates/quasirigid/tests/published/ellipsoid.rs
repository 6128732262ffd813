//! Homogeneous ellipsoids: compliance, mean power, periods and times of secular evolution. `data/published/ellipsoid`.

use quasirigid::averaging::{Evolution, FreeRotation, MeanPower, PolynomialPower, Response};
use quasirigid::elements::{Assembly, Ellipsoid, Material};
use quasirigid::model::{FlexibleBody, Mode, Rheology};
use quasirigid::reduction::reduce;

const COMPLIANCE: &str = include_str!("../../../../data/published/ellipsoid/compliance.csv");
const POINTS: &str = include_str!("../../../../data/published/ellipsoid/kelvin_voigt.csv");
const POINTS_COMPLIANCE: &str =
    include_str!("../../../../data/published/ellipsoid/kelvin_voigt_compliance.csv");
const TIMES: &str = include_str!("../../../../data/published/ellipsoid/times.csv");
const SPHEROIDS: &str = include_str!("../../../../data/published/ellipsoid/spheroids.csv");
const TRIAXIAL: &str = include_str!("../../../../data/published/ellipsoid/triaxial.csv");

const MOMENTUM: f64 = 3.695_782_164_053_647_5e15;

fn rows(table: &str) -> impl Iterator<Item = Vec<f64>> {
    let number = |field: &str| if field.is_empty() { 0.0 } else { field.parse().unwrap() };
    table.lines().skip(1).map(move |line| line.split(',').map(number).collect())
}

/// An ellipsoid with a shear modulus and density of one.
fn unit(semi_axes: [f64; 3], poisson: f64, rheology: Rheology) -> FlexibleBody {
    let young = 2.0 * (1.0 + poisson);
    body(Ellipsoid {
        name: "rock".into(),
        semi_axes,
        center: [3.0, -1.0, 2.0],
        material: Material { density: 1.0, young, poisson, rheology },
    })
}

fn body(ellipsoid: Ellipsoid) -> FlexibleBody {
    Assembly { ellipsoids: vec![ellipsoid], ..Assembly::default() }.body().unwrap()
}

fn asteroid(young: f64, rheology: Rheology) -> FlexibleBody {
    body(Ellipsoid {
        name: "rock".into(),
        semi_axes: [2300.0, 1200.0, 950.0],
        center: [0.0; 3],
        material: Material { density: 2500.0, young, poisson: 0.25, rheology },
    })
}

fn close(what: &str, found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() <= tolerance, "{what}: {found:e}, expected {expected:e}");
}

/// Entries of a compliance that a table prints: three on the diagonal, three beside it, three shears.
fn printed(S: [[f64; 6]; 6]) -> [f64; 9] {
    let shears: f64 = (0..6)
        .flat_map(|i| (3..6).map(move |j| (i, j)))
        .filter(|(i, j)| i != j)
        .map(|(i, j)| S[i][j].abs())
        .sum();
    assert!(shears < 1e-12 * S[5][5]);
    [S[0][0], S[1][1], S[2][2], S[1][2], S[2][0], S[0][1], S[3][3], S[4][4], S[5][5]]
}

#[test]
fn compliance_is_the_exact_one() {
    for row in rows(COMPLIANCE) {
        let [a, b, c, poisson, ref rest @ ..] = row[..] else { panic!("16 columns") };
        let response = Response::compute(&unit([a, b, c], poisson, Rheology::Elastic)).unwrap();
        for (found, expected) in response.principal().moments.iter().zip(rest) {
            close("moment", *found, *expected, 1e-13);
        }
        let found = printed(response.static_compliance());
        let largest = found.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        for (i, (found, expected)) in found.iter().zip(&rest[3..]).enumerate() {
            let error = (found - expected).abs() / largest;
            assert!(error < 1e-10, "{a} {b} {c}, {poisson}, entry {i}: {found} {expected}");
        }
    }
    assert_eq!(rows(COMPLIANCE).count(), 14);
    let rock = Response::compute(&asteroid(1e9, Rheology::Elastic)).unwrap();
    let expected = rows(POINTS_COMPLIANCE).next().unwrap();
    for (found, expected) in printed(rock.static_compliance()).iter().zip(&expected) {
        close("asteroid", *found, *expected, 1e-10);
    }
}

/// The shear entries of any ellipsoid in closed form.
#[test]
fn shear_compliance_has_its_closed_form() {
    for (axes, nu) in [([1.0, 0.8, 0.6], 0.25), ([2.3, 0.4, 0.3], 0.1), ([1.0, 0.9, 0.1], 0.45)] {
        let response = Response::compute(&unit(axes, nu, Rheology::Elastic)).unwrap();
        let S = response.static_compliance();
        for i in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|k| axes[(i + k) % 3]);
            let (squares, product) = (b * b + c * c, b * b * c * c);
            let over = 4.0 * a.powi(4) + 2.0 * (1.0 + nu) * a * a * squares + 5.0 * (1.0 + nu) * product;
            let under = 2.0 * a.powi(4) + (1.0 + nu) * a * a * squares + 3.0 * (1.0 + nu) * product;
            let k =
                16.0 * std::f64::consts::PI / 105.0 * a * (b * c).powi(5) / squares.powi(2) * over / under;
            close("k", S[3 + i][3 + i], k, 1e-12);
        }
    }
}

/// A power as seen from a body whose dissipation is weaker by a factor.
#[derive(Debug)]
struct Stronger<'a>(&'a dyn MeanPower, f64);

impl MeanPower for Stronger<'_> {
    fn moments(&self) -> [f64; 3] {
        self.0.moments()
    }

    fn mean_power(&self, motion: &FreeRotation) -> f64 {
        self.1 * self.0.mean_power(motion)
    }
}

/// Two methods for the power of the asteroid: the mean of the polynomial, and the sum over the harmonics, of a body so stiff and a
/// Kelvin–Voigt time so short that the frequencies are as good as zero, scaled up.
fn both_roads(check: impl Fn(&dyn MeanPower)) {
    let polynomial = reduce(&asteroid(1e9, Rheology::KelvinVoigt { time: 100.0 }), 3).unwrap();
    check(&PolynomialPower::from_reduced(&polynomial));
    let response = Response::compute(&asteroid(1e17, Rheology::KelvinVoigt { time: 0.01 })).unwrap();
    check(&Stronger(&response, 1e12));
}

#[test]
fn asteroid_ages_as_tabulated() {
    both_roads(|power| {
        let evolution = Evolution::new(power, MOMENTUM);
        for row in rows(POINTS) {
            let rotation_state = evolution.rotation_state(row[0]).unwrap();
            close("power", evolution.power(rotation_state), row[1], 1e-9);
            close("period", evolution.motion(rotation_state).polhode_period(), row[2], 1e-12);
        }
        for row in rows(TIMES) {
            let [from, to] =
                [row[0], row[1]].map(|D| evolution.rotation_state(D / power.moments()[2]).unwrap());
            close("time", evolution.time(from, to), row[2], 1e-6);
            close("time back", evolution.time(to, from), -row[2], 1e-6);
            let reached = evolution.after(from, row[2]).unwrap();
            assert_eq!(reached.mode, to.mode);
            assert!((evolution.ratio(reached) - evolution.ratio(to)).abs() < 1e-6);
        }
    });
    assert_eq!((rows(POINTS).count(), rows(TIMES).count()), (8, 3));
}

/// Time in which a wobble of a spheroid falls from one angle to another, in degrees; `|K| = I₃`, so that `Ω = 1`.
fn fall(power: &dyn MeanPower, from: f64, to: f64) -> f64 {
    let [A, _, C] = power.moments();
    let evolution = Evolution::new(power, C);
    let rotation_state = |degrees: f64| {
        let u = degrees.to_radians().cos().powi(2);
        evolution.rotation_state(1.0 / (C * (u / C + (1.0 - u) / A))).unwrap()
    };
    evolution.time(rotation_state(from), rotation_state(to))
}

/// Half of the last digit of a printed number, relative.
fn rounding(text: &str) -> f64 {
    let digits = text.split('e').next().unwrap();
    let last = digits.split('.').nth(1).map_or(1.0, |decimals| 10f64.powi(-(decimals.len() as i32)));
    0.501 * last / digits.parse::<f64>().unwrap()
}

#[test]
fn spheroids_have_the_printed_coefficients() {
    for line in SPHEROIDS.lines().skip(1) {
        let text: Vec<&str> = line.split(',').collect();
        let h: f64 = text[0].parse().unwrap();
        let expect = |column: usize, found: f64| {
            close(
                &format!("h = {h}, column {column}"),
                found,
                text[column].parse().unwrap(),
                rounding(text[column]),
            );
        };
        // So slow that no frequency is near an elastic one: |K| = I₃ with a modulus of 1 would not be.
        let (stiff, factor, time) = (1e12, 50.0, 3.0);
        let spheroid = |rheology: Rheology| {
            let Rheology::Elastic = rheology else {
                return Response::compute(&body(Ellipsoid {
                    name: "spheroid".into(),
                    semi_axes: [1.0, 1.0, h],
                    center: [0.0; 3],
                    material: Material { density: 1.0, young: 2.5 * stiff, poisson: 0.25, rheology },
                }))
                .unwrap();
            };
            Response::compute(&unit([1.0, 1.0, h], 0.25, rheology)).unwrap()
        };
        let S = spheroid(Rheology::Elastic).static_compliance();
        expect(1, S[4][4]);
        expect(2, S[5][5]);
        let constant = spheroid(Rheology::QualityFactor { factor });
        let evolution = Evolution::new(&constant, constant.moments()[2]);
        let unit = stiff * factor * (1.0 + factor.powi(-2)); // −Im 1/(1 + i/Q) = (1/Q)/(1 + 1/Q²)
        expect(3, evolution.wobble_rate(Mode::ShortAxis).recip() / unit);
        expect(4, fall(&constant, 45.0, 5.0) / unit);
        expect(5, fall(&constant, 80.0, 5.0) / unit);
        let viscous = spheroid(Rheology::KelvinVoigt { time: time / stiff });
        let evolution = Evolution::new(&viscous, viscous.moments()[2]);
        let unit = stiff * stiff / time;
        expect(6, evolution.wobble_rate(Mode::ShortAxis).recip() / unit);
        expect(7, fall(&viscous, 45.0, 5.0) / unit);
    }
}

#[test]
fn triaxial_body_has_the_printed_powers_and_shares() {
    let (stiff, factor, time) = (1e12, 100.0, 1e-6);
    let rock = |rheology| {
        Response::compute(&body(Ellipsoid {
            name: "rock".into(),
            semi_axes: [1.0, 0.8, 0.6],
            center: [0.0; 3],
            material: Material { density: 1.0, young: 2.5 * stiff, poisson: 0.25, rheology },
        }))
        .unwrap()
    };
    let (viscous, constant) =
        (rock(Rheology::KelvinVoigt { time }), rock(Rheology::QualityFactor { factor }));
    let moments = viscous.moments();
    for line in TRIAXIAL.lines().skip(1) {
        let text: Vec<&str> = line.split(',').collect();
        let e: f64 = text[0].parse().unwrap();
        let motion = FreeRotation::at_ratio(moments, moments[2], 1.0 / e);
        let mode = if text[1] == "short" { Mode::ShortAxis } else { Mode::LongAxis };
        assert_eq!(motion.mode(), mode);
        let expect =
            |what: &str, found: f64, text: &str| close(what, found, text.parse().unwrap(), rounding(text));
        expect("period", motion.polhode_period(), text[2]);
        expect("viscous", viscous.mean_power(&motion) * stiff / time, text[3]);
        let powers: Vec<f64> = constant.harmonic_powers(&motion).map(|(_, power)| power).collect();
        let sum: f64 = powers.iter().sum();
        expect("constant", sum * stiff * factor * (1.0 + factor.powi(-2)), text[4]);
        for (power, printed) in powers.iter().zip(&text[5..]) {
            let share: f64 = if printed.is_empty() { 0.0 } else { printed.parse().unwrap() };
            assert!((power / sum - share).abs() < 5.1e-4, "e = {e}: {} {share}", power / sum);
        }
    }
}

/// Small wobble about the axis of greatest inertia of any ellipsoid: `1/T` in closed form.
#[test]
fn small_wobble_falls_at_its_closed_rate() {
    let response = Response::compute(&asteroid(1e9, Rheology::Elastic)).unwrap();
    let [I1, I2, I3] = response.principal().moments;
    let S = response.static_compliance();
    let Omega = MOMENTUM / I3;
    let square = Omega * Omega * (I3 - I1) * (I3 - I2) / (I1 * I2);
    let expected =
        0.5 * 100.0 * square * Omega * Omega * I3 * (S[4][4] / (I1 * (I3 - I1)) + S[3][3] / (I2 * (I3 - I2)));
    both_roads(|power| {
        close("rate", Evolution::new(power, MOMENTUM).wobble_rate(Mode::ShortAxis), expected, 1e-9);
    });
}

/// The time law of a spheroid under Kelvin–Voigt material in closed form, by partial fractions, with both shear
/// compliances. `du/dt = κ u(1−u)(αu + β(1−u))`, `u = cos²θ`.
#[test]
fn spheroid_follows_the_closed_time_law() {
    let (stiff, time, h) = (1e12, 1e-3, 0.6);
    let response = Response::compute(&body(Ellipsoid {
        name: "spheroid".into(),
        semi_axes: [1.0, 1.0, h],
        center: [0.0; 3],
        material: Material {
            density: 1.0,
            young: 2.5 * stiff,
            poisson: 0.25,
            rheology: Rheology::KelvinVoigt { time },
        },
    }))
    .unwrap();
    let [A, _, C] = response.moments();
    let S = response.static_compliance();
    let G = 2e-3 * C; // slow beside 1/time
    let rate = 2.0 * time * (C - A) * G.powi(4) / (A.powi(3) * C);
    let (alpha, beta) = (S[4][4] / (C * C), S[5][5] / (A * A));
    let primitive = |u: f64| {
        let f = alpha * u + beta * (1.0 - u);
        u.ln() / beta - (1.0 - u).ln() / alpha + (beta - alpha) / (alpha * beta) * f.ln()
    };
    let evolution = Evolution::new(&response, G);
    let rotation_state = |u: f64| evolution.rotation_state(1.0 / (C * (u / C + (1.0 - u) / A))).unwrap();
    for (from, to) in [(0.01, 0.99), (0.3, 0.31), (0.5, 0.9999)] {
        close(
            "time",
            evolution.time(rotation_state(from), rotation_state(to)) * rate,
            primitive(to) - primitive(from),
            1e-9,
        );
    }
}
