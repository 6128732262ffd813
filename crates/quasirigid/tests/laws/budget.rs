//! Budget of dissipation: shares that sum to the whole by every method, and that do not depend on each other.

use std::ops::ControlFlow;

use proptest::prelude::*;
use quasirigid::averaging::{FreeRotation, MeanPower, PolynomialPower, Response};
use quasirigid::dynamics::{
    Forced, Method, Observer, Options, Run, Sample, Start, propagate, propagate_full,
};
use quasirigid::elements::{Assembly, Carrier, End, Spring, SpringLaw};
use quasirigid::model::{FlexibleBody, Mode, Principal, Rheology, Support};
use quasirigid::problems::AxialMass;
use quasirigid::reduction::reduce;
use quasirigid::secular::{DirectOptions, follow_directly};
use quasirigid_math::rotation::ALIGNED;

use super::evolution::tumbler;
use crate::support::parts;
use crate::support::transform::{hinge_times, rotated, strengthened};
use crate::support::{assemblies, bodies, cases, rotation};

type Budget = Vec<(String, f64)>;

fn sum(budget: &Budget) -> f64 {
    budget.iter().map(|(_, power)| power).sum()
}

/// A tumbling motion of the frozen body.
fn tumbling(body: &FlexibleBody, spin: f64) -> FreeRotation {
    let Principal { moments, .. } = Principal::compute(body.invariants().J);
    FreeRotation::at_logit(moments, spin * moments[1], Mode::ShortAxis, 0.3)
}

/// The body with the loss of one dissipator alone, which are springs and then hinges.
fn alone(assembly: &Assembly, kept: usize) -> Assembly {
    let mut alone = assembly.clone();
    let springs = alone.springs.len();
    for (i, spring) in alone.springs.iter_mut().enumerate().filter(|(i, _)| *i != kept) {
        spring.law = strengthened(spring.law, 1.0, 0.0);
        assert_ne!(i, kept);
    }
    for (i, hinged) in alone.hinged.iter_mut().enumerate() {
        if springs + i != kept {
            hinged.damping = hinge_times(&hinged.damping, 0.0);
        }
    }
    alone
}

proptest! {
    #![proptest_config(cases(60))]

    /// Shares sum to the power in any units. (D1)–(D3)
    #[test]
    fn shares_sum_to_the_whole(assembly in bodies()) {
        let body = assembly.body().unwrap();
        let names: Vec<_> = body.dissipators().iter().map(|part| part.name.clone()).collect();
        prop_assert_eq!(names.len(), assembly.springs.len() + assembly.hinged.len());
        let size = body.coordinates().len();
        let entry = |j: usize, k: usize| {
            body.dissipators().iter().flat_map(|part| part.damping.row(j)).filter(|(c, _)| *c == k).map(|(_, B)| *B).sum::<f64>()
        };
        let diagonal = body.damping().diagonal();
        for j in 0..size {
            for (k, B) in body.damping().row(j) {
                prop_assert!((entry(j, k) - B).abs() <= 1e-12 * (diagonal[j] * diagonal[k]).sqrt());
            }
        }
        let reduced = reduce(&body, 5).unwrap();
        let response = Response::compute(&body).unwrap();
        let slowest = response.frequencies().next().unwrap().0;
        let motion = tumbling(&body, 0.05 * slowest);
        let polynomial = PolynomialPower::from_reduced(&reduced);
        let omega = motion.omega(0.3 * motion.polhode_period());
        let sources = [
            (MeanPower::budget(&polynomial, &motion), polynomial.mean_power(&motion)),
            (response.budget(&motion), response.mean_power(&motion)),
            (reduced.power_budget(omega), reduced.dissipated_power(omega)),
        ];
        let whole_power = sources[1].1;
        for (budget, whole) in sources {
            let found: Vec<_> = budget.iter().map(|(name, _)| name.clone()).collect();
            prop_assert_eq!(&found, &names);
            prop_assert!((sum(&budget) / whole - 1.0).abs() < 1e-11, "{:?} {}", budget, whole);
            prop_assert!(budget.iter().all(|(_, power)| *power > -1e-12 * whole));
        }
        for ((_, power), taken) in response.harmonic_powers(&motion).zip(response.harmonic_budgets(&motion)) {
            prop_assert!((taken.iter().sum::<f64>() - power).abs() < 1e-11 * whole_power, "{:?} {}", taken, power);
        }
        prop_assert!(response.dissipators().eq(names.iter().map(String::as_str)));
        let stiff = body.stiffened(0.5).unwrap();
        prop_assert_eq!(stiff.dissipators()[0].damping.diagonal(), body.dissipators()[0].damping.scaled(2.0).diagonal());
        prop_assert!(body.stiff_outside().dissipators().is_empty());
        prop_assert_eq!(body.locked_inside().dissipators().len(), names.len());
    }

    /// At order 3 the displacement does not depend on the damping, so a dashpot alone takes its share among others.
    #[test]
    fn a_dissipator_alone_keeps_its_share_at_order_three(assembly in assemblies()) {
        let body = assembly.body().unwrap();
        let motion = tumbling(&body, 0.3);
        let budget = MeanPower::budget(&PolynomialPower::from_reduced(&reduce(&body, 3).unwrap()), &motion);
        for (kept, (name, share)) in budget.iter().enumerate() {
            let only = alone(&assembly, kept).body().unwrap();
            prop_assert_eq!(only.dissipators().len(), 1);
            let power = PolynomialPower::from_reduced(&reduce(&only, 3).unwrap());
            let (found, whole) = (power.mean_power(&motion), sum(&budget));
            prop_assert!((found - share).abs() < 1e-12 * whole, "{}: {} {}", name, found, share);
            let [(only_name, all)] = &MeanPower::budget(&power, &motion)[..] else { panic!("one") };
            prop_assert!(only_name == name && (all / found - 1.0).abs() < 1e-14);
        }
    }

    /// Rotated axes may have their signs reversed, and so the sense of the motion.
    #[test]
    fn axes_do_not_matter(assembly in assemblies(), R in rotation()) {
        let bodies = [assembly.body().unwrap(), rotated(&assembly, &R).body().unwrap()];
        let budgets = bodies.map(|body| {
            let motion = tumbling(&body, 0.3);
            [
                Response::compute(&body).unwrap().budget(&motion),
                MeanPower::budget(&PolynomialPower::from_reduced(&reduce(&body, 4).unwrap()), &motion),
            ]
        });
        for method in 0..2 {
            let [here, there] = [&budgets[0][method], &budgets[1][method]];
            for ((name, a), (other, b)) in here.iter().zip(there) {
                let [a, b] = [a / sum(here), b / sum(there)];
                prop_assert!(name == other && (a - b).abs() < 1e-9, "{}: {} {}", name, a, b);
            }
        }
    }
}

/// Chernousko's mass on the axis, twice: each takes `b(mρ/c)²` of the sum. (X1)
#[test]
fn two_masses_on_the_axis_share_as_their_closed_forms_have_it() {
    let single = AxialMass { carrier: 2.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 0.4 };
    let mut assembly = single.assembly();
    let (m, z, c, b) = (0.07, -0.9, 25.0, 0.15);
    let mut point = assembly.points[0].clone();
    (point.name, point.mass, point.position) = ("counterweight".to_owned(), m, [0.0, 0.0, z]);
    assembly.points.push(point);
    let law = parts::isotropic(c, b);
    let spring = Spring { name: "tail".to_owned(), from: End::Point(1), law, ..assembly.springs[0].clone() };
    assembly.springs.push(spring);
    let body = assembly.body().unwrap();
    let center = body.center_of_mass()[2];
    let taken = [
        single.b * (single.m * (single.rho - center) / single.c).powi(2),
        b * (m * (z - center) / c).powi(2),
    ];
    let expected = taken.map(|part| part / (taken[0] + taken[1]));
    let motion = tumbling(&body, 0.02);
    let polynomial = MeanPower::budget(&PolynomialPower::from_reduced(&reduce(&body, 3).unwrap()), &motion);
    assert_eq!((polynomial[0].0.as_str(), polynomial[1].0.as_str()), ("spring mass-carrier", "tail"));
    let response = Response::compute(&body).unwrap().budget(&motion);
    for (budget, tolerance) in [(polynomial, 1e-12), (response, 1e-4)] {
        for ((name, power), expected) in budget.iter().zip(expected) {
            let share = power / sum(&budget);
            assert!((share / expected - 1.0).abs() < tolerance, "{name}: {share} {expected}");
        }
    }
}

/// A material without equation of motion has its share among the harmonics, and none in the reduced equations.
#[test]
fn materials_take_their_share_of_the_harmonics() {
    let mut assembly = tumbler(0.3);
    assembly.springs[1].rheology = Rheology::QualityFactor { factor: 20.0 };
    assembly.springs[1].law = strengthened(assembly.springs[1].law, 1.0, 0.0);
    let body = assembly.body().unwrap();
    let response = Response::compute(&body).unwrap();
    let motion = tumbling(&body, 0.4);
    let budget = response.budget(&motion);
    let whole = response.mean_power(&motion);
    assert!((sum(&budget) / whole - 1.0).abs() < 1e-12, "{budget:?} {whole}");
    assert!(budget.iter().all(|(_, power)| *power > 0.01 * whole), "{budget:?}");
    let reduced = reduce(&body, 3).unwrap();
    assert_eq!(reduced.power_shares.len(), 1);
    // The spring with a dashpot beside it moves as without the loss of the other, but for squares of the loss.
    let mut only = assembly.clone();
    only.springs[1].rheology = Rheology::Elastic;
    let only = Response::compute(&only.body().unwrap()).unwrap().mean_power(&motion);
    assert!((budget[0].1 / only - 1.0).abs() < 0.01, "{budget:?} {only}");
}

/// Samples, rates and the budget of a run.
#[derive(Default)]
struct Seen {
    samples: Vec<Sample>,
    rates: Vec<Vec<f64>>,
    budget: Budget,
}

impl Observer for Seen {
    fn sample(&mut self, sample: &Sample) {
        self.samples.push(*sample);
    }

    fn coordinates(&mut self, _: &[f64], rate: &[f64]) {
        self.rates.push(rate.to_vec());
    }

    fn budget(&mut self, energies: &[(String, f64)]) {
        self.budget = energies.to_vec();
    }
}

/// Integral of a function by Simpson's rule over an even number of equal steps.
fn simpson(values: &[f64], step: f64) -> f64 {
    let weight = |i: usize| if i == 0 || i == values.len() - 1 { 1.0 } else { [2.0, 4.0][i % 2] };
    values.iter().enumerate().map(|(i, value)| weight(i) * value).sum::<f64>() * step / 3.0
}

/// A tumbler with three dashpots and a boom, and its histories.
fn histories(method: Method, epsilon: f64, duration: f64, rows: usize) -> (FlexibleBody, Seen, Seen) {
    let mut assembly = tumbler(epsilon);
    let between = SpringLaw::Axial {
        stiffness: 60.0 / epsilon.powi(2),
        damping: 25.0 / epsilon,
        anchor: None,
        prestress: quasirigid::elements::Prestress::Relaxed,
    };
    let spring =
        Spring { from: End::Point(0), to: End::Point(1), law: between, ..assembly.springs[0].clone() };
    assembly.springs.push(spring);
    let body = assembly.body().unwrap();
    let omega = [0.5, 0.7, 0.6];
    let times: Vec<f64> = (0..=rows).map(|i| duration * i as f64 / rows as f64).collect();
    let mut seen = [Seen::default(), Seen::default()];
    let start = Start::new(omega, ALIGNED);
    let settled = start.settled(Forced::not(&body), 5).unwrap();
    let ended = |run: Run| assert!((run.last.t / duration - 1.0).abs() < 1e-12);
    // Explicit steps are stable up to a limit: rates, a thousandth of the spin, flutter by the tolerance of a step.
    let options = Options { method, tolerance: 1e-14, ..Options::default() };
    ended(propagate_full(Forced::not(&body), &settled, &times, &options, &mut seen[0]).unwrap());
    let reduced = reduce(&body, 5).unwrap();
    let spin = Start::new(omega, ALIGNED);
    ended(propagate(&reduced, spin, &times, &Options::default(), &mut seen[1]).unwrap());
    let [full, reduced] = seen;
    (body, full, reduced)
}

/// Two methods for the energy that each dissipator takes in a full history, and the reduced history beside it. (D4)
#[test]
fn histories_know_who_took_the_energy() {
    [Method::Explicit, Method::Implicit].into_iter().for_each(compare_histories);
}

fn compare_histories(method: Method) {
    let (duration, rows) = (30.0, 24_000);
    let (body, full, reduced) = histories(method, 0.15, duration, rows);
    for (seen, tolerance) in [(&full, 1e-12), (&reduced, 1e-12)] {
        let whole = seen.samples.last().unwrap().dissipated;
        assert_eq!(seen.budget.len(), 3);
        assert!((sum(&seen.budget) / whole - 1.0).abs() < tolerance, "{:?} {whole}", seen.budget);
    }
    for (part, (name, taken)) in body.dissipators().iter().zip(&full.budget) {
        let power =
            |rate: &Vec<f64>| -> f64 { part.damping.times(rate).iter().zip(rate).map(|(f, v)| f * v).sum() };
        let powers: Vec<f64> = full.rates.iter().map(power).collect();
        let expected = simpson(&powers, duration / rows as f64);
        assert!(&part.name == name && (taken / expected - 1.0).abs() < 1e-10, "{name}: {taken} {expected}");
    }
    let reduced_body = reduce(&body, 5).unwrap();
    for (row, (name, taken)) in reduced.budget.iter().enumerate() {
        let power = |sample: &Sample| reduced_body.power_budget(sample.omega)[row].1;
        let powers: Vec<f64> = reduced.samples.iter().map(power).collect();
        let expected = simpson(&powers, duration / rows as f64);
        assert!((taken / expected - 1.0).abs() < 1e-4, "{name}: {taken} {expected}");
    }
    for ((name, of_full), (_, of_reduced)) in full.budget.iter().zip(&reduced.budget) {
        assert!((of_reduced / of_full - 1.0).abs() < 0.02, "{name}: {of_reduced} {of_full}");
    }
}

/// One dissipator takes everything, and a body that loses nothing has none.
#[test]
fn one_dissipator_takes_everything() {
    let single = AxialMass { carrier: 2.0, A: 1.0, C: 1.5, m: 0.1, rho: 0.5, c: 40.0, b: 0.4 };
    let mut assembly = single.assembly();
    for expected in [1, 0] {
        let body = assembly.body().unwrap();
        let mut seen = Seen::default();
        let spin = Start::new([0.3, 0.1, 0.9], ALIGNED);
        propagate(&reduce(&body, 3).unwrap(), spin, &[20.0], &Options::default(), &mut seen).unwrap();
        assert_eq!(seen.budget.len(), expected);
        assert!(seen.budget.iter().all(|(_, taken)| *taken == seen.samples[0].dissipated && *taken > 0.0));
        assembly.springs[0].law = strengthened(assembly.springs[0].law, 1.0, 0.0);
    }
}

/// Names of springs and hinges, given and made.
#[test]
fn dissipators_have_names() {
    let mut assembly = tumbler(0.3);
    let again = assembly.springs[0].clone();
    let named = Spring { name: "strut".to_owned(), from: End::Point(1), to: End::Point(0), ..again.clone() };
    let twin = named.clone();
    assembly.springs.extend([again, named, twin]);
    assembly.support = Support::FixedPoint { point: [0.3, 0.0, 0.1] };
    assembly.carrier = Some(Carrier { mass: 3.0, ..assembly.carrier.unwrap() });
    let body = assembly.body().unwrap();
    let names: Vec<_> = body.dissipators().iter().map(|part| part.name.as_str()).collect();
    assert_eq!(names, ["spring 0-carrier", "spring 1-carrier", "spring 0-carrier 2", "strut"]);
    let strut = &body.dissipators()[3].damping;
    assert_eq!(strut.diagonal()[0], 2.0 * body.dissipators()[0].damping.diagonal()[0]);
}

/// A direct run splits its loss by samples, as the full system does by integrals.
#[test]
fn a_direct_run_has_the_budget_of_the_full_system() {
    let duration = 60.0;
    let (body, full, _) = histories(Method::Automatic, 0.3, duration, 10);
    let start = Start::new([0.5, 0.7, 0.6], ALIGNED);
    let settled = start.settled(Forced::not(&body), 5).unwrap();
    let options = DirectOptions {
        until: None,
        duration,
        most_revolutions: f64::INFINITY,
        most_steps: u64::MAX,
        tolerance: 1e-12,
    };
    let run = follow_directly(&body, &settled, &options, &mut |_| ControlFlow::Continue(())).unwrap();
    let dissipated = run.rows.last().unwrap().dissipated;
    assert!((dissipated / sum(&full.budget) - 1.0).abs() < 1e-8, "{dissipated} {:?}", full.budget);
    assert_eq!(run.budget.len(), full.budget.len());
    for (found, (name, energy)) in run.budget.iter().zip(&full.budget) {
        assert!((found - energy).abs() < 1e-2 * energy, "{name}: {found} {energy}");
    }
}
