//! Partly full tanks: bobs and rigid rest against bodies made by hand, pendulums under thrust and in a spin, and full cavities. (U1)–(U9)

use nalgebra::{Matrix3, Vector3};
use quasirigid::elements::{
    ApplicationPoint, Assembly, CARRIER, Carrier, Cavity, CavityShape, End, Field, Point, PointMotion,
    Problem, Regime, SettledTank, Settling, Spring, Tank, TankContents, TankDamping, TankError, TankShape,
};
use quasirigid::model::force::{Axes, Force, ForceLaw, Wave};
use quasirigid::model::{FlexibleBody, Support};
use quasirigid::modes::{
    RelativeEquilibrium, SpinMagnitude, SpinModes, SteadyModes, SteadyState, SteadyStateGuess,
};
use quasirigid::reduction::Vibrations;
use quasirigid_math::sym3;

use super::common::turned_axes;
use crate::support::parts;

type V = Vector3<f64>;

/// Places, in axes of their own, at which a body stands.
const AWAY: V = V::new(0.4, -1.3, 2.1);

fn tank(shape: TankShape, fill: f64, settled_by: Settling) -> Tank {
    Tank {
        name: "fuel".into(),
        shape,
        center: [0.0; 3],
        axis: [0.0, 0.0, 1.0],
        contents: TankContents::Fill(fill),
        density: 800.0,
        damping: TankDamping::WallLayer(2e-6),
        surface_tension: Some(0.02),
        baffles: Vec::new(),
        wave_amplitude: None,
        measured: Vec::new(),
        settled_by,
        modes: 2,
    }
}

fn sphere(radius: f64) -> TankShape {
    TankShape::Ellipsoid { semi_axes: [radius; 3] }
}

fn pressed(x: f64, y: f64, z: f64) -> Settling {
    Settling::Acceleration([x, y, z])
}

fn settled(assembly: &Assembly) -> SettledTank {
    assembly.build().unwrap().tanks.into_iter().next().unwrap()
}

fn J(body: &FlexibleBody) -> Matrix3<f64> {
    sym3::rows(body.invariants().J).into()
}

fn close(value: f64, exact: f64, tolerance: f64, what: &str) {
    assert!((value / exact - 1.0).abs() < tolerance, "{what}: {value} instead of {exact}");
}

/// Mass, first moment and moment across the axis of what does not slosh, from the numbers of a tank and the moment of its frozen liquid
/// about its centre.
fn rest(tank: &SettledTank, first: f64, frozen: f64) -> [f64; 3] {
    let bobs = |power: i32| tank.slosh.iter().map(|mode| mode.mass * mode.height.powi(power)).sum::<f64>();
    [tank.liquid_mass - bobs(0), first - bobs(1), frozen - tank.drag[0] - bobs(2)]
}

/// A tank on a skew axis is a point in a plane on a spring for each mode, and a rod on the axis: the same frequencies and the same inertia.
#[test]
fn a_tank_is_points_on_springs_and_a_rod() {
    let (R, radius) = (turned_axes(), 0.45);
    let up = R * V::z();
    let own = Tank {
        center: AWAY.into(),
        axis: (-2.7 * up).into(),
        ..tank(sphere(radius), 0.5, Settling::Acceleration((-0.3 * up).into()))
    };
    let hub =
        parts::carrier(60.0, [0.3, -0.9, 1.7], [[14.0, 0.5, -0.3], [0.5, 17.0, 0.4], [-0.3, 0.4, 21.0]]);
    let with_tank = Assembly::default().with(hub.clone()).with(own);
    let liquid = settled(&with_tank);
    // half a ball: M = 2πρR³/3, centre 3R/8 below, moment 2MR²/5 about its centre
    let mass = 800.0 * 2.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
    close(liquid.liquid_mass, mass, 1e-13, "mass");
    let [m, s, across] = rest(&liquid, 0.375 * radius * mass, 0.4 * mass * radius * radius);
    let center = AWAY - s / m * up;
    let along = up * up.transpose();
    let rod = (across - s * s / m) * (Matrix3::identity() - along);
    let total = hub.mass + m;
    let middle = (hub.mass * V::from(hub.center_of_mass) + m * center) / total;
    let shift = |mass: f64, place: V| {
        let arm = place - middle;
        mass * (arm.norm_squared() * Matrix3::identity() - arm * arm.transpose())
    };
    let inertia =
        Matrix3::from(hub.inertia) + shift(hub.mass, hub.center_of_mass.into()) + rod + shift(m, center);
    let inertia = 0.5 * (inertia + inertia.transpose());
    let mut by_hand = Assembly::default().with(Carrier {
        mass: total,
        center_of_mass: middle.into(),
        inertia: inertia.into(),
    });
    for (number, mode) in liquid.slosh.iter().enumerate() {
        // heights are along the axis that the tank was given, which is downwards
        let bob = Point {
            name: format!("bob {number}"),
            mass: mode.mass,
            position: (AWAY - mode.height * up).into(),
            motion: PointMotion::Plane(up.into()),
        };
        let bob = by_hand.add(bob);
        let stiffness = mode.mass * mode.frequency * mode.frequency;
        let damping = 2.0 * mode.damping_ratio * mode.mass * mode.frequency;
        by_hand.add(Spring::isotropic(stiffness, damping).between(bob, CARRIER));
    }
    let [a, b] = [&with_tank, &by_hand].map(|assembly| assembly.body().unwrap());
    assert!((J(&a) - J(&b)).amax() < 1e-12 * J(&b).amax());
    let [a, b] = [a, b].map(|body| Vibrations::compute(&body).unwrap());
    for (a, b) in [(&a.free_frequencies, &b.free_frequencies), (&a.decay_rates, &b.decay_rates)] {
        assert!(a.len() == b.len() && a.len() >= 4);
        a.iter().zip(b).for_each(|(a, b)| close(*a, *b, 1e-9, "rate"));
    }
}

/// Frequency of a body on its thrust with one pendulum: `(a/L)(1 + m/m_b + m z(z + L)/I_b)` with the mass and the moment of what does not
/// slosh, `z` from its centre: the weight `m a` of the bob acts at its place though the thrust is no spring's. (U8)
#[test]
fn thrust_weighs_on_a_bob_of_a_free_body() {
    for (R, sense) in [(turned_axes(), 1.0), (turned_axes().inverse(), -1.0)] {
        let up = R * V::z();
        let (a, push) = (0.25, 0.7);
        let hub = {
            let J = R * Matrix3::from_diagonal(&V::new(30.0, 30.0, 20.0)) * R.inverse();
            parts::carrier(200.0, AWAY.into(), (0.5 * (J + J.transpose())).into())
        };
        let shape = TankShape::Cylinder { radius: 0.4, height: 0.9 };
        let own = Tank {
            center: (AWAY + 0.6 * up).into(),
            axis: (sense * up).into(),
            modes: 1,
            damping: TankDamping::Ratio(0.0),
            ..tank(shape, 0.6, Settling::Acceleration((-a * up).into()))
        };
        let mut assembly = Assembly::default().with(hub).with(own);
        let mass = assembly.body().unwrap().invariants().mass;
        let law = ForceLaw::Thrust {
            at: ApplicationPoint { on: End::Carrier, at: Some((AWAY - push * up).into()) },
            force: (mass * a * up).into(),
            axes: Axes::Body,
            wave: Wave::default(),
        };
        assembly.forces.push(Force { name: "engine".into(), law });
        let built = assembly.build().unwrap();
        let liquid = &built.tanks[0];
        let mode = liquid.slosh[0];
        let depth = 0.6 * 0.9;
        let first = liquid.liquid_mass * 0.5 * (depth - 0.9);
        let frozen = liquid.liquid_mass * (0.04 + depth * depth / 12.0) + first * first / liquid.liquid_mass;
        let bob = sense * mode.height;
        let [m, s, across] = {
            let (moment, height) = (frozen - liquid.drag[0], bob);
            [liquid.liquid_mass - mode.mass, first - mode.mass * height, moment - mode.mass * height * height]
        };
        let m_b = 200.0 + m;
        let center = (m * (0.6 + s / m)) / m_b;
        let I_b = 30.0 + 200.0 * center * center + across - s * s / m + m * (0.6 + s / m - center).powi(2);
        let z = 0.6 + bob - center;
        let square = a / mode.length * (1.0 + mode.mass / m_b + mode.mass * z * (z + mode.length) / I_b);
        let near = SteadyStateGuess {
            omega: [0.0; 3],
            attitude: [1.0, 0.0, 0.0, 0.0],
            place: [0.0; 3],
            velocity: [0.0; 3],
            asked: false,
        };
        let state = SteadyState::near(&built.body, &built.forces, near).unwrap();
        let modes = SteadyModes::about(&built.body, &built.forces, state).unwrap();
        let swinging: Vec<f64> = modes.modes.iter().map(|mode| mode.frequency).filter(|f| *f > 0.0).collect();
        assert_eq!(swinging.len(), 2, "{swinging:?}");
        swinging.iter().for_each(|frequency| close(*frequency, square.sqrt(), 1e-8, "frequency"));
    }
}

/// In a spin a spherical tank swings as the pendulum at its centre: `Ω²(R − L)/L` in the plane of the spin with the centre at `R` less the bob,
/// `Ω²R/L` along its axis, in a body too heavy to recoil.
#[test]
fn a_sphere_in_a_spin_is_a_spherical_pendulum() {
    let (R, spin, arm) = (turned_axes(), 1.7, 3.0);
    let (axis, out) = (R * V::z(), R * V::x());
    let J = R * Matrix3::from_diagonal(&V::new(1e9, 1.5e9, 2e9)) * R.inverse();
    let hub = parts::carrier(1e9, AWAY.into(), (0.5 * (J + J.transpose())).into());
    let own = Tank {
        center: (AWAY + arm * out + 0.8 * axis).into(),
        modes: 1,
        damping: TankDamping::Ratio(0.0),
        ..tank(sphere(0.2), 0.4, Settling::Spin((spin * axis).into()))
    };
    let assembly = Assembly::default().with(hub).with(own);
    let liquid = settled(&assembly);
    let mode = liquid.slosh[0];
    let bob = (V::from(liquid.center_of_mass) - AWAY).dot(&out);
    assert!(bob > arm && (mode.height.abs() - mode.length).abs() < 1e-9);
    let radius = arm + mode.length;
    close(mode.frequency, spin * (radius / mode.length).sqrt(), 1e-7, "frequency at rest");
    let body = assembly.body().unwrap();
    let steady = RelativeEquilibrium::near(&body, (spin * axis).into(), SpinMagnitude::Rate(spin)).unwrap();
    let found = SpinModes::about(&body, steady).unwrap();
    let mut rates: Vec<f64> =
        found.modes.iter().map(|mode| mode.frequency).filter(|rate| *rate > 1.01 * spin).collect();
    rates.sort_by(f64::total_cmp);
    assert_eq!(rates.len(), 2, "{rates:?}");
    close(rates[0], spin * (arm / mode.length).sqrt(), 1e-6, "in the plane");
    close(rates[1], spin * (radius / mode.length).sqrt(), 1e-6, "along the axis");
}

/// Filled up, a tank is the ideal liquid of the full cavity, and hardly any of it sloshes.
#[test]
fn a_full_tank_is_a_cavity() {
    let (radius, height) = (0.3, 0.7);
    let cavity = Cavity {
        name: "full".into(),
        shape: CavityShape::Cylinder { radius, height },
        center: AWAY.into(),
        attitude: [1.0, 0.0, 0.0, 0.0],
        density: 800.0,
        viscosity: 2e-6,
        resolution: 10,
        regime: Regime::BoundaryLayer,
        modes: 0,
    };
    let hub = Carrier::principal(100.0, [9.0, 13.0, 16.0]);
    let support = Support::FixedPoint { point: AWAY.into() };
    let of = |assembly: Assembly| {
        Assembly { support: support.clone(), ..assembly.with(hub.clone()) }.build().unwrap()
    };
    let full = of(Assembly::default().with(cavity)).liquids[0].equivalent.unwrap();
    let shape = TankShape::Cylinder { radius, height };
    let own = Tank { center: AWAY.into(), ..tank(shape, 1.0 - 1e-6, pressed(0.0, 0.0, -9.8)) };
    let partly = of(Assembly::default().with(own));
    let gap = J(&partly.body) - J(&of(Assembly::default()).body);
    for axis in [0, 1] {
        close(gap[(axis, axis)], full[axis][axis], 1e-5, "across");
    }
    assert!(gap[(2, 2)].abs() < 1e-12 * gap[(0, 0)]);
}

/// A unit of mass scales masses alone; a unit of length all lengths; a stronger gravity frequencies by its root.
#[test]
fn slosh_knows_no_units() {
    let at = |length: f64, density: f64, gravity: f64| {
        let shape = TankShape::Capsule { radius: 0.4 * length, height: 1.3 * length };
        let own = Tank {
            density,
            damping: TankDamping::WallLayer(1e-6 * length.powf(1.5) * gravity.sqrt()),
            surface_tension: Some(1e-9 * density * gravity * length * length),
            ..tank(shape, 0.3, pressed(0.0, 0.0, gravity))
        };
        let mass = 100.0 * density * length.powi(3);
        let moments = [9.0, 13.0, 16.0].map(|moment| moment * density * length.powi(5));
        settled(&Assembly::default().with(Carrier::principal(mass, moments)).with(own))
    };
    let one = at(1.0, 1000.0, 1.0);
    for (length, density, gravity) in [(1e-6, 1.0, 1e3), (1e6, 1e5, 1e-4)] {
        let other = at(length, density, gravity);
        for (a, b) in one.slosh.iter().zip(&other.slosh) {
            close(b.mass, a.mass * (density / 1000.0) * length.powi(3), 1e-9, "mass");
            close(b.height, a.height * length, 1e-8, "height");
            close(b.frequency, a.frequency * (gravity / length).sqrt(), 1e-9, "frequency");
            close(b.damping_ratio, a.damping_ratio, 1e-8, "damping");
            assert!(a.height > 0.0, "the liquid lies at the side to which the acceleration points");
        }
    }
}

/// A profile of lines is the shape that they make.
#[test]
fn profiles_are_the_shapes_they_draw() {
    let profile = |points: Vec<[f64; 2]>| TankShape::Profile { points };
    let pairs = [
        (
            TankShape::Cylinder { radius: 0.4, height: 1.0 },
            profile(vec![[0.0, -0.5], [0.4, -0.5], [0.4, 0.1], [0.4, 0.5], [0.0, 0.5]]),
        ),
        (
            TankShape::Cone { radii: [0.2, 0.5], height: 0.8 },
            profile(vec![[0.0, -0.4], [0.2, -0.4], [0.35, 0.0], [0.5, 0.4], [0.0, 0.4]]),
        ),
    ];
    for (shape, drawn) in pairs {
        let [a, b] = [shape, drawn].map(|shape| {
            let own = tank(shape, 0.65, pressed(0.0, 0.0, -1.0));
            settled(&Assembly::default().with(Carrier::principal(40.0, [9.0, 13.0, 16.0])).with(own))
        });
        close(b.liquid_mass, a.liquid_mass, 1e-12, "mass");
        for (a, b) in a.slosh.iter().zip(&b.slosh) {
            close(b.wavenumber, a.wavenumber, 1e-6, "wavenumber");
            close(b.mass, a.mass, 1e-5, "mass of the bob");
        }
    }
}

/// What is not answered is refused at its key, and the same a little better is answered.
#[test]
fn what_is_not_known_is_refused() {
    let cylinder = TankShape::Cylinder { radius: 0.3, height: 0.8 };
    let refusal = |own: Tank| {
        let hub = Carrier::principal(400.0, [90.0, 130.0, 160.0]);
        let error = Assembly::default().with(hub).with(own).build().err()?;
        let Problem::Tank(cause) = error.problem else { panic!("{error}") };
        Some((error.field, cause))
    };
    let own = |settled_by| tank(cylinder.clone(), 0.5, settled_by);
    let down = pressed(0.0, 0.0, -0.5);
    assert_eq!(refusal(own(down)), None);
    for fill in [0.0, 1.0, -0.2, f64::NAN] {
        let (field, cause) = refusal(Tank { contents: TankContents::Fill(fill), ..own(down) }).unwrap();
        assert!(field == Field::new("fill") && matches!(cause, TankError::Fill { .. }));
    }
    let capacity = 800.0 * std::f64::consts::PI * 0.09 * 0.8;
    let heavy = |share: f64| Tank { contents: TankContents::Mass(share * capacity), ..own(down) };
    assert!(matches!(refusal(heavy(1.0 + 1e-9)), Some((_, TankError::Overfull { .. }))));
    assert_eq!(refusal(heavy(0.5)), None);
    let tilted = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        own(pressed(0.5 * sin, 0.0, -0.5 * cos))
    };
    assert_eq!(refusal(tilted(0.99)), None);
    assert!(
        matches!(refusal(tilted(1.01)), Some((_, TankError::Tilted { degrees, .. })) if (degrees - 1.01).abs() < 1e-9)
    );
    assert!(matches!(refusal(own(pressed(0.0, 0.0, 0.0))), Some((_, TankError::Weightless { .. }))));
    // Bo = ρ g R²/σ = 800 · 0.09/0.02 g
    let light = |bond: f64| own(pressed(0.0, 0.0, -bond / 3600.0));
    let held = |own: Tank| Tank { damping: TankDamping::Ratio(0.01), ..own };
    assert_eq!(refusal(held(light(1.01))), None);
    assert!(matches!(refusal(held(light(0.99))), Some((_, TankError::Capillary { .. }))));
    let thick = Tank { damping: TankDamping::WallLayer(0.05), ..own(down) };
    assert!(matches!(refusal(thick), Some((_, TankError::Viscous { .. }))));
    let ball = |arm: f64, spin: f64| Tank {
        center: [arm, 0.0, 0.0],
        ..tank(sphere(0.1), 0.5, Settling::Spin([0.0, 0.0, spin]))
    };
    assert_eq!(refusal(ball(1.0, 1.0)), None);
    assert!(matches!(refusal(ball(1.0, 0.0)), Some((_, TankError::Weightless { .. }))));
    assert!(matches!(refusal(ball(0.0, 1.0)), Some((_, TankError::Weightless { .. }))));
    assert!(matches!(refusal(ball(0.05, 3.0)), Some((_, TankError::NearSpinAxis { .. }))));
    let axial = Tank { center: [1.0, 0.0, 0.0], ..own(Settling::Spin([0.0, 0.0, 1.0])) };
    assert!(
        matches!(refusal(axial), Some((_, TankError::Tilted { degrees, .. })) if (degrees - 90.0).abs() < 1e-6)
    );
}

/// A liquid that turns with the body in its steady spin is refused where it decides the stability of that spin.
#[test]
fn a_liquid_that_decides_the_motion_is_refused() {
    let of = |moments: [f64; 3]| {
        let own = Tank { center: [1.5, 0.0, 0.0], ..tank(sphere(0.2), 0.5, Settling::Spin([0.0, 0.0, 1.0])) };
        Assembly::default().with(Carrier::principal(400.0, moments)).with(own).build()
    };
    let share = of([140.0, 150.0, 260.0]).unwrap().tanks[0].inertia_share;
    assert!(share > 0.0 && share < 0.01, "{share}");
    let error = of([150.0, 259.5, 260.0]).unwrap_err();
    assert!(
        matches!(error.problem, Problem::Tank(TankError::Uncertain { share, .. }) if share > 0.2),
        "{error}"
    );
}

/// Any tank, in any unit of length and however full, is answered within what a liquid can have, or refused; never by a panic.
mod any {
    use proptest::prelude::*;

    use super::*;
    use crate::support::{cases, vector};

    fn shapes() -> impl Strategy<Value = TankShape> {
        let length = || (-3.0..1.0).prop_map(|power: f64| 10_f64.powf(power));
        prop_oneof![
            (length(), length()).prop_map(|(a, c)| TankShape::Ellipsoid { semi_axes: [a, a, c] }),
            (length(), length()).prop_map(|(radius, height)| TankShape::Cylinder { radius, height }),
            (length(), length())
                .prop_map(|(radius, height)| TankShape::Capsule { radius, height: height + 2.0 * radius }),
            (length(), length(), length())
                .prop_map(|(low, high, height)| TankShape::Cone { radii: [low, high], height }),
            (length(), length(), length()).prop_map(|(low, high, rise)| TankShape::Profile {
                points: vec![[0.0, -rise], [low, -0.3 * rise], [high, 0.4 * rise], [0.0, rise]]
            }),
        ]
    }

    proptest! {
        #![proptest_config(cases(48))]

        #[test]
        fn tank_is_answered_or_refused(
            shape in shapes(), fill in 1e-3..0.999, up in vector(), unit in -6..6i32, modes in 1usize..4,
        ) {
            prop_assume!(V::from(up).norm() > 0.1);
            let unit = 10_f64.powi(unit);
            let scaled = |value: f64| unit * value;
            let shape = match shape {
                TankShape::Ellipsoid { semi_axes } => TankShape::Ellipsoid { semi_axes: semi_axes.map(scaled) },
                TankShape::Cylinder { radius, height } =>
                    TankShape::Cylinder { radius: scaled(radius), height: scaled(height) },
                TankShape::Capsule { radius, height } =>
                    TankShape::Capsule { radius: scaled(radius), height: scaled(height) },
                TankShape::Cone { radii, height } =>
                    TankShape::Cone { radii: radii.map(scaled), height: scaled(height) },
                TankShape::Profile { points } =>
                    TankShape::Profile { points: points.into_iter().map(|point| point.map(scaled)).collect() },
            };
            let up = V::from(up).normalize();
            let own = Tank {
                center: (unit * AWAY).into(),
                axis: up.into(),
                damping: TankDamping::Ratio(0.01),
                surface_tension: Some(1e-30),
                modes,
                ..tank(shape, fill, Settling::Acceleration((-up).into()))
            };
            let hub = Carrier::principal(1e6 * unit.powi(3), [9.0, 13.0, 16.0].map(|moment| 1e6 * moment * unit.powi(5)));
            match Assembly::default().with(hub).with(own).build() {
                Ok(built) => {
                    let tank = &built.tanks[0];
                    let bobs: f64 = tank.slosh.iter().map(|mode| mode.mass).sum();
                    prop_assert!(bobs > 0.0 && bobs < tank.liquid_mass * (1.0 + 1e-3), "{bobs} {tank:?}");
                    prop_assert!(tank.slosh.windows(2).all(|pair| pair[0].frequency < pair[1].frequency));
                    prop_assert!(tank.drag[0] > -1e-3 * tank.liquid_mass * unit * unit * 1e2);
                }
                Err(error) => prop_assert!(matches!(error.problem, Problem::Tank(TankError::Unresolved { .. })), "{error}"),
            }
        }
    }
}
