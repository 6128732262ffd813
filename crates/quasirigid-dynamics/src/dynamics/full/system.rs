//! Full equations of motion in momenta: rates, quantities of a state, and the stiff part for the implicit method.
//! With momenta no acceleration is solved for and the mass matrix is factored once; the stiff linear part is exact on straight paths and a
//! Jacobian by differences on curved ones.
//! Equations (S3), (S4), docs/theory/01-system.md; (T1) to (T4), docs/theory/08-full-system.md.

use super::drives::{Drives, rest_of_jump};
use super::stiff_part::StiffPart;
use crate::dynamics::control::{ControlBlock, Seen};
use crate::dynamics::external::{Forced, Pose};
use crate::dynamics::invariant_monitor::{Invariant, StateView, Trajectory};
use crate::dynamics::layout::{
    ANGLE, ATTITUDE, DISSIPATED, IMPULSE, Layout, MOMENTUM, PLACE, VELOCITY, WORK, attitude, triple,
};
use crate::dynamics::position::Position;
use crate::dynamics::run::Observer;
use crate::math::eigen::{Dense, eigenvalues};
use crate::math::lanes::Lanes;
use crate::math::ode::{Stiff, Stretch, System};
use crate::math::rotation::{self, Turn};
use crate::math::simd::{Arithmetic, Unfused};
use crate::math::sparse::SparseRows;
use crate::math::vec3::{add, cross, dot, norm, scale};
use crate::model::control::Controls;
use crate::model::{Displaced, Dissipator, FlexibleBody, Friction, Kinetics, MotionState, StraightKinetics};

/// Full equations in momenta, `K̇ = K × ω + M`, `ṗ = ∂L/∂q − Bq̇ + Q`: no acceleration is solved for. (S3), (S4), (T1), (C2)
#[derive(Clone, Debug)]
pub(super) struct FullSystem<'a> {
    system: Forced<'a>,
    layout: Layout,
    control: ControlBlock<'a>,
    kinetics: Kinetics<'a>,
    /// Drives of coordinates, where there are any.
    drives: Option<Drives<'a>>,
    /// Kinetics for stages side by side and the angular velocities of the last ones, where nothing acts from outside on a small body.
    straight: Option<StraightKinetics>,
    omega: [Lanes; 3],
    /// Damping of each dissipator, if there are several.
    accounts: Vec<Account<'a>>,
    stiff: StiffPart,
    /// Stretch between breakpoints of the forces that steps lie in. (Z1)
    stretch: Stretch,
    /// Torque on the carrier (N·m, body axes), where it is held from outside.
    held: Option<[f64; 3]>,
    /// First component of the state that the implicit method takes as stiff. (T4)
    first_stiff: usize,
    /// Steps of the finite differences of a Jacobian, for each component from there on; infinite where the rates do not depend on it.
    differences: Vec<f64>,
}

/// Step of a difference over the size of the component: the root of the rounding, since rates are smooth.
const DIFFERENCE: f64 = 1.5e-8;
/// Largest body whose loop with a controller is taken as stiff: its Jacobian is dense.
const MOST_IN_LOOP: usize = 60;
/// Steps of power iteration: the frequency is needed to a few per cent.
const POWER_ITERATIONS: usize = 40;

impl<'a> FullSystem<'a> {
    /// Equations of a body under controllers, whose state has components of these sizes; none if the mass matrix is not positive.
    pub fn new(system: Forced<'a>, controls: &'a Controls, sizes: &[f64]) -> Option<Self> {
        let body = system.body;
        let control = ControlBlock::of(controls);
        let layout = Layout::of(body).with_controls(control.len());
        let accounts = body.dissipators().iter().take(layout.accounts).map(|part| Account::of(body, part));
        let loops = control.is_continuous() && layout.n <= MOST_IN_LOOP;
        let first_stiff = if loops { 0 } else { layout.slow() };
        Some(Self {
            system,
            layout,
            kinetics: Kinetics::new(body)?,
            drives: Drives::of(body),
            straight: if system.acts() || !control.is_empty() { None } else { StraightKinetics::new(body) },
            control,
            omega: [Lanes::splat(0.0); 3],
            accounts: accounts.collect(),
            stiff: StiffPart::vibrations(body),
            stretch: Stretch::default(),
            held: None,
            first_stiff,
            differences: sizes[first_stiff..].iter().map(|size| DIFFERENCE * size).collect(),
        })
    }

    /// Sets the work of a state at the start to zero, for a run up to an end (s). (T9)
    pub fn begin(&mut self, y: &mut [f64], end: f64) {
        System::enter(self, Stretch { from: 0.0, to: end });
        if let Some(drives) = self.driven_at(0.0, y) {
            y[WORK] = -drives.carried();
        }
    }

    /// Drives with the momenta of their coordinates at a time and a state; none without. (T8)
    fn driven_at(&mut self, t: f64, y: &[f64]) -> Option<&Drives<'a>> {
        let t = self.stretch.within(t);
        let own = add(triple(y, MOMENTUM), scale(-1.0, self.wheels(t, y)));
        let drives = self.drives.as_mut()?;
        drives.set(t, &y[self.layout.q()]);
        self.kinetics.drive(drives.rates());
        let mut rate = vec![0.0; self.layout.n];
        let velocities = self.kinetics.velocities(own, &y[self.layout.p()], drives.q(), &mut rate);
        drives.note(velocities.driven_momenta());
        Some(drives)
    }

    /// The state after the rates of drives jump at the end of a stretch, with the work of that; none elsewhere. (T9)
    fn kinked(&mut self, t: f64, y: &[f64]) -> Option<Vec<f64>> {
        let (stretch, after) = (self.stretch, Drives::beyond(self.stretch, t)?);
        let before = self.driven_at(t, y)?.motion();
        self.stretch = Stretch::default();
        let rest = self.driven_at(after, y).map(|drives| rest_of_jump(&before, &drives.motion()));
        self.stretch = stretch;
        let mut next = y.to_vec();
        next[WORK] += rest?;
        Some(next)
    }

    /// Holds a torque on the carrier (N·m, body axes), beside the forces.
    pub fn hold(&mut self, torque: [f64; 3]) {
        self.straight = None;
        self.held = Some(torque);
    }

    /// The torque that is held (N·m, body axes).
    pub fn held(&self) -> [f64; 3] {
        self.held.unwrap_or_default()
    }

    /// Adds the torque that is held to the rates of a state.
    fn add_held(y: &[f64], torque: [f64; 3], omega: [f64; 3], slow: &mut [f64]) {
        let impulse = Turn::of(attitude(y)).to_inertial(torque);
        for axis in 0..3 {
            slow[MOMENTUM + axis] += torque[axis];
            slow[IMPULSE + axis] += impulse[axis];
        }
        slow[WORK] += dot(omega, torque);
    }

    /// Jacobian of the rates of the stiff components, by differences. (T4)
    fn jacobian(&mut self, t: f64, y: &[f64]) -> Dense {
        let first = self.first_stiff;
        let (mut place, mut rate, mut moved) = (y.to_vec(), y.to_vec(), y.to_vec());
        self.rate::<Unfused>(t, &place, &mut rate);
        let mut jacobian = Dense::zero(y.len() - first);
        for column in 0..jacobian.size() {
            if !self.differences[column].is_finite() {
                continue;
            }
            place[first + column] += self.differences[column];
            let step = place[first + column] - y[first + column];
            self.rate::<Unfused>(t, &place, &mut moved);
            place[first + column] = y[first + column];
            for row in 0..jacobian.size() {
                jacobian.add(row, column, (moved[first + row] - rate[first + row]) / step);
            }
        }
        jacobian
    }

    /// Adds the external loads to the rates of a state. (F1), (F11)
    fn add_external(
        &self,
        t: f64,
        y: &[f64],
        motion: MotionState<f64>,
        slow: &mut [f64],
        p_rate: &mut [f64],
    ) {
        let velocity = triple(y, VELOCITY);
        let pose = Pose { t, attitude: attitude(y), place: triple(y, PLACE), velocity };
        let loads = self.system.loads(&pose, motion);
        let impulse = Turn::of(pose.attitude).to_inertial(loads.moment);
        let acceleration = self.system.acceleration(&pose, loads.force);
        let turning = add(triple(slow, MOMENTUM), loads.moment);
        for (at, rate) in
            [(MOMENTUM, turning), (IMPULSE, impulse), (PLACE, velocity), (VELOCITY, acceleration)]
        {
            slow[at..at + 3].copy_from_slice(&rate);
        }
        p_rate.iter_mut().zip(&loads.generalized).for_each(|(rate, Q)| *rate += Q);
        slow[WORK] = loads.power(motion, [0.0; 3]);
    }

    /// Adds what controllers do to the rates of a state. (Y4)
    fn add_control(&self, seen: &Seen, y: &[f64], slow: &mut [f64]) {
        let block = self.layout.controls();
        let action = self.control.act(seen, &y[block.clone()], &mut slow[block]);
        for (at, added) in [(MOMENTUM, action.torque), (IMPULSE, action.impulse)] {
            let rate = add(triple(slow, at), added);
            slow[at..at + 3].copy_from_slice(&rate);
        }
        slow[WORK] += action.power;
    }

    /// Angular momentum (N·m·s, body axes) of wheels relative to the body. (C4), (Y4)
    fn wheels(&self, t: f64, y: &[f64]) -> [f64; 3] {
        let own = self.system.body.wheels().angular_momentum(t);
        if self.control.is_empty() { own } else { add(own, self.control.given(&y[self.layout.controls()])) }
    }

    /// Whether something acts on the body.
    fn acts(&self) -> bool {
        self.system.acts() || !self.control.is_empty()
    }

    /// Upper estimate of the fastest rate at a state (1/s): of the elastic part, and of the loop that a controller closes. (T3), (T4)
    pub fn fastest(&mut self, y: &[f64]) -> f64 {
        let elastic = self.fastest_vibration();
        if self.first_stiff == self.layout.slow() {
            return elastic;
        }
        let found = eigenvalues(&self.jacobian(0.0, y)).unwrap_or_default();
        found.iter().fold(elastic, |fastest, [re, im]| fastest.max(re.hypot(*im)))
    }

    /// Upper estimate of the fastest rate of the elastic part, `|λ|` of `λ²M + λB + C` (1/s). (T3)
    fn fastest_vibration(&mut self) -> f64 {
        let body = self.system.body;
        self.kinetics.drive(body.drives().iter().map(|_| 0.0));
        let damping = self.largest(body.damping());
        let stiffness = self.largest(body.stiffness());
        0.5 * (damping + (damping * damping + 4.0 * stiffness).sqrt())
    }

    /// Largest eigenvalue of `M⁻¹X`, by power iteration.
    fn largest(&mut self, matrix: &SparseRows<f64>) -> f64 {
        let n = self.layout.n;
        let still = vec![0.0; n];
        let mut x: Vec<f64> = (0..n).map(|i| 1.0 + 0.5 * (i as f64).sin()).collect();
        let mut largest = 0.0;
        for _ in 0..POWER_ITERATIONS {
            let force = matrix.times(&x);
            let scale = product(&force, &x);
            if !(scale > 0.0) {
                return largest;
            }
            let mut next = vec![0.0; n];
            self.kinetics.velocities([0.0; 3], &force, &still, &mut next);
            largest = product(&force, &next) / scale;
            let size = product(&next, &next).sqrt();
            x = next.iter().map(|entry| entry / size).collect();
        }
        largest
    }
}

impl System<Vec<f64>> for FullSystem<'_> {
    fn rate<A: Arithmetic>(&mut self, t: f64, y: &Vec<f64>, rate: &mut Vec<f64>) {
        let t = self.stretch.within(t);
        let K = triple(y, MOMENTUM);
        let (q, p) = (&y[self.layout.q()], &y[self.layout.p()]);
        let (slow, fast) = rate.split_at_mut(self.layout.slow());
        let (q_rate, p_rate) = fast.split_at_mut(self.layout.n);
        let own = add(K, scale(-1.0, self.wheels(t, y)));
        if let Some(drives) = &mut self.drives {
            drives.set(t, q);
            self.kinetics.drive(drives.rates());
        }
        let q = self.drives.as_ref().map_or(q, Drives::q);
        let velocities = self.kinetics.velocities(own, p, q, q_rate);
        p_rate.fill(0.0);
        slow[DISSIPATED] = velocities.add_loads(q, q_rate, p_rate);
        let omega = velocities.omega;
        let driven: Vec<f64> = velocities.driven_momenta().collect();
        for (power, account) in slow[self.layout.accounts()].iter_mut().zip(&self.accounts) {
            *power = account.power(q_rate);
        }
        slow[ANGLE] = norm(omega);
        slow[MOMENTUM..MOMENTUM + 3].copy_from_slice(&cross(K, omega));
        slow[ATTITUDE..ATTITUDE + 4].copy_from_slice(&rotation::rate(attitude(y), omega));
        if self.acts() {
            let motion = MotionState { omega, q, rate: q_rate };
            self.add_external(t, y, motion, slow, p_rate);
            slow[WORK] -= dot(omega, self.system.body.wheels().torque(t));
            if !self.control.is_empty() {
                self.add_control(&Seen { t, attitude: attitude(y), motion }, y, slow);
            }
        } else {
            slow[PLACE..PLACE + 3].copy_from_slice(&triple(y, VELOCITY));
            if self.drives.is_some() {
                slow[WORK] = 0.0;
            }
        }
        if let Some(torque) = self.held {
            if !self.system.acts() {
                slow[WORK] = 0.0;
                slow[IMPULSE..IMPULSE + 3].fill(0.0);
            }
            Self::add_held(y, torque, omega, slow);
        }
        if let Some(drives) = &mut self.drives {
            drives.note(driven.into_iter());
            slow[WORK] += drives.rest_of_power(p_rate);
        }
    }

    fn enter(&mut self, stretch: Stretch) {
        self.stretch = stretch;
    }
}

impl Trajectory for FullSystem<'_> {
    type State = Vec<f64>;

    const ATTITUDE: usize = ATTITUDE;

    fn view(&mut self, t: f64, y: &[f64]) -> StateView {
        let (mut q, mut p) = (y[self.layout.q()].to_vec(), y[self.layout.p()].to_vec());
        let mut carried = 0.0;
        if let Some(drives) = self.driven_at(t, y) {
            carried = drives.carried();
            (q, p) = (drives.q().to_vec(), drives.momenta(&p));
        }
        let mut rate = vec![0.0; self.layout.n];
        let angular_momentum = triple(y, MOMENTUM);
        let own = add(angular_momentum, scale(-1.0, self.wheels(t, y)));
        let omega = self.kinetics.velocities(own, &p, &q, &mut rate).omega;
        let kinetic = dot(omega, own) + product(&p, &rate);
        let elastic = product(&self.system.body.stiffness().times(&q), &q);
        let (dissipated, work) = (y[DISSIPATED], y[WORK] + carried);
        StateView {
            omega,
            angular_momentum,
            energy: 0.5 * (kinetic + elastic),
            q,
            rate,
            dissipated,
            work,
            explained: [-dissipated, work],
            angle: y[ANGLE],
            impulse: triple(y, IMPULSE),
        }
    }

    fn angular_momentum(&mut self, _: f64, y: &[f64]) -> [f64; 3] {
        triple(y, MOMENTUM)
    }

    fn position(&self, _: f64, y: &[f64], view: &StateView, _: [f64; 4]) -> Position {
        let motion = MotionState { omega: view.omega, q: &view.q, rate: &view.rate };
        Position::of_center(self.system.body, motion, y)
    }

    fn left(&self, y: &[f64]) -> Option<Displaced> {
        self.system.body.left_range(&y[self.layout.q()])
    }

    fn show_controls(&self, t: f64, y: &[f64], view: &StateView, observer: &mut dyn Observer) {
        if !self.control.is_empty() && observer.keeps_controls() {
            let motion = MotionState { omega: view.omega, q: &view.q, rate: &view.rate };
            let seen = Seen { t, attitude: rotation::normalized(attitude(y)), motion };
            observer.controls(&self.control.channels(&seen, &y[self.layout.controls()]));
        }
    }

    fn invariant(&self) -> Invariant {
        if self.acts() { Invariant::Impulse } else { Invariant::AngularMomentum }
    }

    fn enter(&mut self, stretch: Stretch, _: bool) {
        System::enter(self, stretch);
    }

    fn jumped(&mut self, t: f64, y: &Vec<f64>) -> Option<Vec<f64>> {
        let kinked = self.kinked(t, y);
        if !self.control.is_sampled() {
            return kinked;
        }
        let StateView { omega, q, rate, .. } = self.view(t, y);
        let motion = MotionState { omega, q: &q, rate: &rate };
        let mut next = kinked.clone().unwrap_or_else(|| y.clone());
        let seen = Seen { t, attitude: attitude(y), motion };
        self.control.jump(&seen, &mut next[self.layout.controls()]).then_some(next).or(kinked)
    }
}

impl Stiff for FullSystem<'_> {
    fn stiff(&self) -> usize {
        self.first_stiff
    }

    fn changes(&self) -> bool {
        let body = self.system.body;
        self.first_stiff < self.layout.slow() || body.paths().is_some() || !body.frictions().is_empty()
    }

    fn renew(&mut self, t: f64, y: &[f64]) {
        self.stiff = StiffPart::Jacobian(self.jacobian(t, y), Vec::new());
    }

    fn shift(&mut self, shifts: [[f64; 2]; 4]) {
        self.stiff.shift(shifts);
    }

    fn solve(&mut self, shift: usize, right: &mut [[f64; 2]]) {
        self.stiff.solve(shift, right);
    }

    fn steering(&self) -> Option<usize> {
        self.straight.as_ref().map(|_| DISSIPATED)
    }

    #[inline(always)]
    fn rates_beside<R: Arithmetic>(&mut self, y: &[Lanes], rates: &mut [Lanes]) {
        let Some(straight) = &mut self.straight else { return };
        let wheels = self.system.body.wheels().constant;
        let (slow, n) = (self.layout.slow(), self.layout.n);
        let K = [y[MOMENTUM], y[MOMENTUM + 1], y[MOMENTUM + 2]];
        let own =
            [K[0] - Lanes::splat(wheels[0]), K[1] - Lanes::splat(wheels[1]), K[2] - Lanes::splat(wheels[2])];
        let (steering, fast) = rates.split_at_mut(slow);
        let (q_rate, p_rate) = fast.split_at_mut(n);
        let omega = straight.rates::<R>(own, [&y[slow..slow + n], &y[slow + n..]], [q_rate, p_rate]);
        let attitude = [y[ATTITUDE], y[ATTITUDE + 1], y[ATTITUDE + 2], y[ATTITUDE + 3]];
        steering[MOMENTUM..MOMENTUM + 3].copy_from_slice(&cross(K, omega));
        steering[ATTITUDE..ATTITUDE + 4].copy_from_slice(&rotation::rate(attitude, omega));
        self.omega = omega;
    }

    #[inline(always)]
    fn integrands_beside<R: Arithmetic>(&mut self, y: &[Lanes], rates: &mut [Lanes]) {
        let Some(straight) = &self.straight else { return };
        let q_rate = self.layout.q();
        rates[DISSIPATED] = straight.dissipation::<R>(&rates[q_rate.clone()]);
        for (place, account) in self.layout.accounts().zip(&self.accounts) {
            let product = |&(j, k, entry): &(usize, usize, f64)| {
                Lanes::splat(entry) * rates[q_rate.start + j] * rates[q_rate.start + k]
            };
            rates[place] =
                account.damping.iter().map(product).fold(Lanes::splat(0.0), |sum, part| sum + part);
        }
        rates[ANGLE] = dot(self.omega, self.omega).sqrt();
        rates[PLACE..PLACE + 3].copy_from_slice(&y[VELOCITY..VELOCITY + 3]);
    }
}

/// What one of several dissipators takes.
#[derive(Clone, Debug)]
struct Account<'a> {
    /// Damping: entries of the upper triangle, those off the diagonal doubled.
    damping: Vec<(usize, usize, f64)>,
    /// Friction beyond it.
    frictions: Vec<&'a Friction>,
}

impl<'a> Account<'a> {
    fn of(body: &'a FlexibleBody, part: &Dissipator) -> Self {
        let frictions = body.frictions().iter().filter(|friction| friction.name == part.name);
        Self { damping: upper(&part.damping), frictions: frictions.collect() }
    }

    /// Power (W) at these rates.
    fn power(&self, rate: &[f64]) -> f64 {
        let damped: f64 = self.damping.iter().map(|(j, k, entry)| entry * rate[*j] * rate[*k]).sum();
        damped + self.frictions.iter().map(|friction| friction.power(rate)).sum::<f64>()
    }
}

/// Entries of a symmetric matrix on and above the diagonal, the others doubled.
fn upper(matrix: &SparseRows<f64>) -> Vec<(usize, usize, f64)> {
    let above = matrix.iter().filter(|(j, k, _)| j <= k);
    above.map(|(j, k, entry)| (j, k, if j == k { *entry } else { 2.0 * entry })).collect()
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elements::Assembly;
    use crate::math::lanes::LANES;
    use crate::math::simd::{Rounding, Task, dispatch_lanes};
    use crate::model::Support;
    use crate::problems::ring_of_points;

    /// Rates at eight states, side by side.
    struct Beside<'a, 'b> {
        system: &'a mut FullSystem<'b>,
        states: &'a [Lanes],
    }

    impl Task for Beside<'_, '_> {
        type Output = Vec<Lanes>;

        fn run<R: Arithmetic>(self) -> Vec<Lanes> {
            let mut rates = vec![Lanes::splat(0.0); self.states.len()];
            self.system.rates_beside::<R>(self.states, &mut rates);
            self.system.integrands_beside::<R>(self.states, &mut rates);
            rates
        }
    }

    /// Largest difference of the rates in lanes from those of one state after the other, over the largest rate of the kind.
    fn difference(assembly: &Assembly, rounding: Rounding) -> f64 {
        let body = assembly.body().unwrap();
        let layout = Layout::of(&body);
        let none = Controls::default();
        let mut system = FullSystem::new(Forced::not(&body), &none, &vec![1.0; layout.len()]).unwrap();
        assert!(system.steering().is_some());
        let entry = |i: usize, lane: usize| (1.3 * i as f64 + 0.9 * lane as f64 + 0.2).sin();
        let small = |i: usize| if i < layout.slow() { 1.0 } else { 0.2 };
        let states: Vec<Lanes> =
            (0..layout.len()).map(|i| Lanes(std::array::from_fn(|lane| small(i) * entry(i, lane)))).collect();
        let found = dispatch_lanes(rounding, Beside { system: &mut system, states: &states });
        let mut worst = 0.0_f64;
        for lane in 0..LANES {
            let state: Vec<f64> = states.iter().map(|lanes| lanes.0[lane]).collect();
            let mut known = vec![0.0; layout.len()];
            system.rate::<Unfused>(0.0, &state, &mut known);
            let kinds = [0..3, 3..7, DISSIPATED..WORK, ANGLE..IMPULSE, PLACE..VELOCITY];
            for kind in kinds.into_iter().chain([layout.accounts(), layout.q(), layout.p()]) {
                let size = known[kind.clone()].iter().fold(0.0_f64, |size, rate| size.max(rate.abs()));
                for i in kind {
                    worst = worst.max((found[i].0[lane] - known[i]).abs() / size);
                }
            }
        }
        worst
    }

    /// Coordinates coupled in mass, stiffness and damping, off every axis and plane, free and constrained off the centre.
    #[test]
    fn rates_side_by_side_are_those_of_each_state() {
        for count in [1, 2, 4] {
            let free = ring_of_points(count);
            let support = Support::FixedPoint { point: [0.4, -0.3, 0.7] };
            for assembly in [Assembly { support, ..free.clone() }, free] {
                for rounding in [Rounding::Fastest, Rounding::Reproducible] {
                    let worst = difference(&assembly, rounding);
                    assert!(worst < 1e-13, "{count} points, {:?}: {worst:e}", assembly.support);
                }
            }
        }
    }
}
