//! Checkpoints of the integrators: a run that goes on from one takes the steps of a run that never stopped, bit for bit.
//! The stiff system below is written for the purpose: its linear part changes by a factor of eight along the slow motion, so the age of
//! that part decides when it is evaluated again.

use quasirigid_math::lanes::Lanes;
use quasirigid_math::ode::{Checkpoint, Dop853, Radau, Solver, Stiff, System, Work};
use quasirigid_math::simd::{Arithmetic, Unfused};

/// Damped spring that hardens, `x'' = −k (x + β x³ − p) − c x'`, pulled by a slow oscillator `p'' = −p`: the state is `(p, p', x, x')`.
#[derive(Clone, Debug, Default)]
struct Hardening {
    /// Tangent stiffness at the last evaluation, over the mass (1/s²).
    tangent: f64,
    /// Evaluations of the linear part.
    evaluated: u32,
    shifts: [[f64; 2]; 4],
}

const STIFFNESS: f64 = 1e7;
const DAMPING: f64 = 800.0;
const HARDENING: f64 = 4.0;

impl System<Vec<f64>> for Hardening {
    fn rate<R: Arithmetic>(&mut self, _: f64, y: &Vec<f64>, rate: &mut Vec<f64>) {
        let [p, speed, x, v] = y[..] else { panic!("four components") };
        let force = -STIFFNESS * (x + HARDENING * x.powi(3) - p) - DAMPING * v;
        rate.copy_from_slice(&[speed, -p, v, force]);
    }
}

impl Stiff for Hardening {
    fn stiff(&self) -> usize {
        2
    }

    fn changes(&self) -> bool {
        true
    }

    fn renew(&mut self, _: f64, y: &[f64]) {
        self.tangent = STIFFNESS * (1.0 + 3.0 * HARDENING * y[2].powi(2));
        self.evaluated += 1;
    }

    fn shift(&mut self, shifts: [[f64; 2]; 4]) {
        self.shifts = shifts;
    }

    /// `(s − L) (x, v) = (a, b)` with `L = (0, 1; −tangent, −damping)`: `x = ((s + damping) a + b) / (s (s + damping) + tangent)`.
    fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]) {
        let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
        let [a, b] = right else { panic!("two components") };
        let s = self.shifts[shift];
        let damped = [s[0] + DAMPING, s[1]];
        let product = times(s, damped);
        let below = [product[0] + self.tangent, product[1]];
        let size = below[0].powi(2) + below[1].powi(2);
        let above = times(damped, *a);
        let x = times([above[0] + b[0], above[1] + b[1]], [below[0] / size, -below[1] / size]);
        let sx = times(s, x);
        *b = [sx[0] - a[0], sx[1] - a[1]];
        *a = x;
    }
}

const START: [f64; 4] = [0.9, 0.0, 0.5, 0.0];
const ALLOWED: [f64; 4] = [1e-9; 4];
const END: f64 = 12.0;

fn implicit(steps: f64) -> Radau<Hardening, Unfused> {
    Radau::new(Hardening::default(), 0.0, START.to_vec(), &ALLOWED, steps)
}

/// Time, state and work after each step to the end.
type Steps = Vec<(u64, Vec<u64>, Work)>;

fn rest<S: Solver<State = Vec<f64>>>(solver: &mut S, mut each: impl FnMut(&S)) -> Steps {
    let mut steps = Vec::new();
    while solver.t() < END {
        solver.step(END).unwrap();
        let bits = solver.y().iter().map(|part| part.to_bits()).collect();
        steps.push((solver.t().to_bits(), bits, solver.work()));
        each(solver);
    }
    steps
}

fn saved(solver: &impl Solver) -> Checkpoint {
    let mut checkpoint = Checkpoint::default();
    solver.save(&mut checkpoint);
    checkpoint
}

/// Stops after every step, and goes on with a solver that knows nothing but the checkpoint. Returns the number of steps.
fn assert_goes_on<S: Solver<State = Vec<f64>>>(new: impl Fn() -> S) -> usize {
    let mut stops = Vec::new();
    let whole = rest(&mut new(), |solver| stops.push(saved(solver)));
    for (done, stop) in stops.iter().enumerate() {
        let mut solver = new();
        let mut stop = Checkpoint::from_words(stop.words().to_vec());
        solver.load(&mut stop).unwrap();
        assert!(stop.is_spent());
        assert_eq!(rest(&mut solver, |_| ()), whole[done + 1..], "after step {}", done + 1);
    }
    whole.len()
}

#[test]
fn implicit_steps_with_a_linear_part_that_ages_go_on_with_the_same_bits() {
    let mut solver = implicit(1e-4);
    let steps = rest(&mut solver, |_| ()).len() as u32;
    let evaluated = solver.system().evaluated;
    // otherwise no age would matter: some steps use an old part, some a new one
    assert!(4 < evaluated && 2 * evaluated < steps, "{evaluated} evaluations in {steps} steps");
    assert_goes_on(|| implicit(1e-4));
}

/// The same spring with the work of its damper; stages are found side by side or in turn. The state is `(p, p', w, x, x')`.
#[derive(Clone, Debug)]
struct Working {
    spring: Hardening,
    beside: bool,
}

impl System<Vec<f64>> for Working {
    fn rate<R: Arithmetic>(&mut self, t: f64, y: &Vec<f64>, rate: &mut Vec<f64>) {
        let mut others = vec![0.0; 4];
        self.spring.rate::<R>(t, &vec![y[0], y[1], y[3], y[4]], &mut others);
        rate.copy_from_slice(&[others[0], others[1], DAMPING * y[4].powi(2), others[2], others[3]]);
    }
}

impl Stiff for Working {
    fn stiff(&self) -> usize {
        3
    }

    fn changes(&self) -> bool {
        true
    }

    fn renew(&mut self, t: f64, y: &[f64]) {
        self.spring.renew(t, &y[1..]);
    }

    fn shift(&mut self, shifts: [[f64; 2]; 4]) {
        self.spring.shift(shifts);
    }

    fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]) {
        self.spring.solve(shift, right);
    }

    fn steering(&self) -> Option<usize> {
        self.beside.then_some(2)
    }

    fn rates_beside<R: Arithmetic>(&mut self, y: &[Lanes], rates: &mut [Lanes]) {
        let number = Lanes::splat;
        let [p, speed, _, x, v] = y[..] else { panic!("five components") };
        rates[0] = speed;
        rates[1] = number(0.0) - p;
        rates[3] = v;
        let stretch = x + number(HARDENING) * x * x * x - p;
        rates[4] = number(0.0) - number(STIFFNESS) * stretch - number(DAMPING) * v;
    }

    fn integrands_beside<R: Arithmetic>(&mut self, _: &[Lanes], rates: &mut [Lanes]) {
        rates[2] = Lanes::splat(DAMPING) * rates[3] * rates[3];
    }
}

#[test]
fn stages_side_by_side_go_on_with_the_same_bits_and_agree_with_stages_in_turn() {
    let [p, speed, x, v] = START;
    let new = |beside| {
        let system = Working { spring: Hardening::default(), beside };
        Radau::<_, Unfused>::new(system, 0.0, vec![p, speed, 0.0, x, v], &[1e-9; 5], 1e-4)
    };
    assert!(assert_goes_on(|| new(true)) > 100);
    let [one, other] = [true, false].map(|beside| {
        let mut solver = new(beside);
        rest(&mut solver, |_| ());
        solver.y().clone()
    });
    for (a, b) in one.iter().zip(&other) {
        assert!((a - b).abs() < 1e-8 * a.abs().max(1.0), "{one:?} {other:?}");
    }
    assert!(one[2] > 1.0);
}

#[test]
fn explicit_steps_go_on_with_the_same_bits() {
    let soft = || Dop853::<Pull, Vec<f64>, Unfused>::new(Pull, 0.0, vec![0.9, 0.3], vec![1e-9; 2]);
    assert!(assert_goes_on(soft) > 10);
}

/// The slow oscillator alone.
#[derive(Clone, Debug)]
struct Pull;

impl System<Vec<f64>> for Pull {
    fn rate<R: Arithmetic>(&mut self, _: f64, y: &Vec<f64>, rate: &mut Vec<f64>) {
        rate.copy_from_slice(&[y[1], -y[0].sin()]);
    }
}
