//! Linear model of a body with its continuous controllers: the loop closed between the model of the body and their laws.
//! Equation (Y6), docs/theory/20-control.md.

use quasirigid::model::Marker;
use quasirigid::model::MotionState;
use quasirigid::model::control::{
    Actuator, BodyController, ControlState, Controls, LinearLaw, Measurement, SensedField, SensedOrbit,
};
use quasirigid::modes::{LinearInput, LinearModel, LinearOutput, SteadyState};
use quasirigid_math::eigen::{Dense, eigenvalues};
use quasirigid_math::vec3::norm;

use super::channels::AXES;
use super::steady_field::{by_moment, by_rotation, steady_field};
use crate::error::StudyError;
use crate::words::plain;

/// Channels between a body and its controllers.
#[derive(Debug, Default)]
pub struct Loop {
    /// Inputs of the body that controllers command, after those asked for; none is twice among all.
    pub inputs: Vec<LinearInput>,
    /// Their names.
    pub names: Vec<String>,
    /// Outputs of the body that controllers measure, after those asked for.
    pub outputs: Vec<LinearOutput>,
    laws: Vec<Law>,
}

/// Channels that are asked for.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// Names of the inputs.
    pub names: &'a [String],
    /// Number of outputs.
    pub outputs: usize,
    /// Whether the steady state is one in any attitude, so that it may be the target of each controller.
    pub any_attitude: bool,
}

/// Linear law between channels of the body.
#[derive(Debug)]
struct Law {
    law: LinearLaw,
    name: String,
    /// Outputs of the body whose sum each input of the law is; none of an input that the law does not use.
    measured: Vec<Vec<Seen>>,
    /// Inputs of the body that each output of the law acts on, with its factors.
    commanded: Vec<Vec<(usize, f64)>>,
}

/// Part of a measurement.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// Output of the body.
    output: usize,
    /// Whether its rate is measured.
    is_rate: bool,
    factor: f64,
}

/// Attitude error (rad) that is rounding of a steady state.
const AT_TARGET: f64 = 1e-8;
/// Command at a steady state, relative to the sizes of its parts, from which the state is not steady under the controller.
const STEADY: f64 = 1e-9;

impl Loop {
    /// Channels of controllers at a steady state, behind those that are asked for.
    ///
    /// # Errors
    /// [`StudyError::NotLinear`] for a controller that is sampled, or acts at the steady state.
    pub fn new(controls: &Controls, steady: &SteadyState, asked: &Asked<'_>) -> Result<Self, StudyError> {
        let mut own = Self::default();
        for controller in &controls.controllers {
            let field = steady_field(controls, controller, steady)?;
            let law = linear_law(controls, controller, steady, (asked, field))?;
            let outputs = controller.outputs.iter();
            let commanded = outputs.map(|output| own.command(controls, &output.to, (asked, field))).collect();
            let used = |i: usize| law.B.iter().chain(&law.D).any(|row| row[i] != 0.0);
            let mut measured = Vec::new();
            for (i, input) in controller.inputs.iter().enumerate() {
                measured.push(match &input.of {
                    _ if !used(i) => Vec::new(),
                    Measurement::Field { axis } => own.measure_field(field, *axis, false, asked),
                    Measurement::FieldRate { axis } => own.measure_field(field, *axis, true, asked),
                    of => vec![own.measure(controls, controller, of, (steady, asked))?],
                });
            }
            own.laws.push(Law { law, name: controller.name.clone(), measured, commanded });
        }
        Ok(own)
    }

    /// Inputs of the body that an actuator acts on, with its factors.
    fn command(
        &mut self,
        controls: &Controls,
        to: &Actuator<usize>,
        (asked, field): (&Asked<'_>, [f64; 3]),
    ) -> Vec<(usize, f64)> {
        match to {
            Actuator::Torque { axis } => vec![(self.torque(*axis, asked), 1.0)],
            Actuator::Wheel { wheel } => vec![(self.wheel(controls, *wheel, asked), 1.0)],
            Actuator::Moment { axis } => {
                let factors = by_moment(field, *axis).into_iter().enumerate();
                let acting = factors.filter(|(_, factor)| *factor != 0.0);
                acting.map(|(axis, factor)| (self.torque(axis, asked), factor)).collect()
            }
        }
    }

    /// Index of the input that a torque on the carrier is.
    fn torque(&mut self, axis: usize, asked: &Asked<'_>) -> usize {
        self.input(format!("torque.{}", AXES[axis]), LinearInput::Torque { axis }, asked)
    }

    /// Index of the input that the motor of a wheel is; wheels of one axis are told apart by their names.
    fn wheel(&mut self, controls: &Controls, wheel: usize, asked: &Asked<'_>) -> usize {
        let wheel = &controls.wheels[wheel];
        self.input(format!("wheel.{}.torque", wheel.name), LinearInput::Wheel { axis: wheel.axis }, asked)
    }

    fn input(&mut self, name: String, input: LinearInput, asked: &Asked<'_>) -> usize {
        let known = asked.names.iter().chain(&self.names).position(|known| plain(known) == plain(&name));
        known.unwrap_or_else(|| {
            self.inputs.push(input);
            self.names.push(name);
            asked.names.len() + self.inputs.len() - 1
        })
    }

    /// Outputs of the body that a component of the magnetic field, or of its rate, is. (Y6)
    fn measure_field(
        &mut self,
        field: [f64; 3],
        component: usize,
        is_rate: bool,
        asked: &Asked<'_>,
    ) -> Vec<Seen> {
        let factors = by_rotation(field, component).into_iter().enumerate();
        let acting = factors.filter(|(_, factor)| *factor != 0.0);
        acting
            .map(|(axis, factor)| {
                self.outputs.push(LinearOutput::Attitude { axis });
                Seen { output: asked.outputs + self.outputs.len() - 1, is_rate, factor }
            })
            .collect()
    }

    /// Output of the body that a controller measures.
    fn measure(
        &mut self,
        controls: &Controls,
        controller: &BodyController,
        of: &Measurement<Marker, usize, usize>,
        (steady, asked): (&SteadyState, &Asked<'_>),
    ) -> Result<Seen, StudyError> {
        let refused = |what| Err(StudyError::NotLinear { name: controller.name.clone(), what });
        let turns = norm(steady.omega) > 0.0;
        let output = match of {
            Measurement::Rate { axis } => LinearOutput::Rate { axis: *axis },
            Measurement::Attitude { .. } if turns => {
                return refused(
                    "about a spin the attitude does not stay at a target, and there is no linear model; ask for it about rest",
                );
            }
            Measurement::Attitude { axis, .. } => LinearOutput::Attitude { axis: *axis },
            Measurement::Displacement { at, axis } | Measurement::Velocity { at, axis } => {
                LinearOutput::Displacement { at: at.clone(), axis: *axis }
            }
            Measurement::Coordinate { coordinate } => LinearOutput::Coordinate { coordinate: *coordinate },
            Measurement::Speed { coordinate } => LinearOutput::Speed { coordinate: *coordinate },
            Measurement::Wheel { wheel } => {
                LinearOutput::Wheel { input: self.wheel(controls, *wheel, asked) }
            }
            Measurement::Time
            | Measurement::Quaternion { .. }
            | Measurement::Field { .. }
            | Measurement::FieldRate { .. }
            | Measurement::OrbitAttitude { .. }
            | Measurement::OrbitRate { .. }
            | Measurement::Nadir { .. }
            | Measurement::Sun { .. } => {
                return refused(
                    "its law depends on the time, the orbit, the Sun or the quaternion itself, and has no linear model here; write it in the attitude error ex ey ez and the rates",
                );
            }
        };
        self.outputs.push(output);
        let is_rate = matches!(of, Measurement::Velocity { .. });
        Ok(Seen { output: asked.outputs + self.outputs.len() - 1, is_rate, factor: 1.0 })
    }

    /// Closes the loop of a model that has the inputs and outputs asked for, then those of the loop; those asked for stay. Returns the
    /// names of the states of the controllers, which follow those of the body.
    pub fn close(&self, model: &mut LinearModel, asked: [usize; 2]) -> Vec<String> {
        let mut names = Vec::new();
        for law in &self.laws {
            names.extend((1..=law.law.A.len()).map(|state| format!("controller.{}.{state}", law.name)));
            law.close(model);
        }
        let [inputs, outputs] = asked;
        model.B.iter_mut().chain(&mut model.D).for_each(|row| row.truncate(inputs));
        model.C.truncate(outputs);
        model.D.truncate(outputs);
        names
    }
}

impl Law {
    /// Closes the loop of this law: `u = C_c z + D_c y`, `ż = A_c z + B_c y` with the outputs `y` of the model. (Y6)
    fn close(&self, model: &mut LinearModel) {
        let n = model.A.len();
        let columns = model.B.first().or(model.D.first()).map_or(0, Vec::len);
        let of_input =
            |parts: &Vec<Seen>| parts.iter().map(|part| (part.factor, seen(model, *part))).collect();
        let seen: Vec<Vec<(f64, [Vec<f64>; 2])>> = self.measured.iter().map(of_input).collect();
        let through = |gains: &[f64], part: usize, width: usize| {
            let mut row = vec![0.0; width];
            for (gain, (factor, seen)) in
                gains.iter().zip(&seen).flat_map(|(gain, parts)| parts.iter().map(move |part| (gain, part)))
            {
                row.iter_mut().zip(&seen[part]).for_each(|(sum, entry)| *sum += gain * factor * entry);
            }
            row
        };
        let law = &self.law;
        let demanded: Vec<[Vec<f64>; 3]> = law
            .D
            .iter()
            .zip(&law.C)
            .map(|(D, C)| [through(D, 0, n), C.clone(), through(D, 1, columns)])
            .collect();
        let states: Vec<[Vec<f64>; 3]> = law
            .B
            .iter()
            .zip(&law.A)
            .map(|(B, A)| [through(B, 0, n), A.clone(), through(B, 1, columns)])
            .collect();
        let z = law.A.len();
        let widen = |rows: &mut [Vec<f64>], by: &[Vec<f64>], direct: &mut [Vec<f64>]| {
            for ((row, gains), direct) in rows.iter_mut().zip(by).zip(direct) {
                row.resize(n + z, 0.0);
                for (acts_on, [from_x, from_z, from_w]) in self.commanded.iter().zip(&demanded) {
                    let gain: f64 = acts_on.iter().map(|(input, factor)| factor * gains[*input]).sum();
                    let with = from_x.iter().chain(from_z);
                    row.iter_mut().zip(with).for_each(|(sum, entry)| *sum += gain * entry);
                    direct.iter_mut().zip(from_w).for_each(|(sum, entry)| *sum += gain * entry);
                }
            }
        };
        let (B, D) = (model.B.clone(), model.D.clone());
        widen(&mut model.A, &B, &mut model.B);
        widen(&mut model.C, &D, &mut model.D);
        for [from_x, from_z, from_w] in states {
            model.A.push([from_x, from_z].concat());
            model.B.push(from_w);
        }
    }
}

/// Rows of an output of a model, or of its rate: on the states and on the inputs.
fn seen(model: &LinearModel, Seen { output, is_rate, .. }: Seen) -> [Vec<f64>; 2] {
    let row = &model.C[output];
    if !is_rate {
        return [row.clone(), model.D[output].clone()];
    }
    let times = |matrix: &[Vec<f64>], width: usize| {
        (0..width).map(|j| row.iter().zip(matrix).map(|(c, entries)| c * entries[j]).sum()).collect()
    };
    [times(&model.A, row.len()), times(&model.B, model.D[output].len())]
}

/// Law of a controller about a steady state, at which it commands nothing.
fn linear_law(
    controls: &Controls,
    controller: &BodyController,
    steady: &SteadyState,
    (asked, field): (&Asked<'_>, [f64; 3]),
) -> Result<LinearLaw, StudyError> {
    let refused = |what| Err(StudyError::NotLinear { name: controller.name.clone(), what });
    if controller.sampling.is_some() {
        return refused(
            "it is sampled, and a linear model is of continuous motion; leave out its `period`, or follow it by `simulate`",
        );
    }
    if controller.inputs.iter().any(|input| input.deadband > 0.0) {
        return refused(
            "within its deadband it does nothing, and the linear model would be that of the body alone; leave the deadband out",
        );
    }
    let still = vec![0.0; steady.q.len()];
    let wheels: Vec<f64> = controls.wheels.iter().map(|wheel| wheel.angular_momentum).collect();
    let motion = MotionState { omega: steady.omega, q: &steady.q, rate: &still };
    let field = SensedField { field, ..SensedField::default() };
    let state = ControlState {
        t: 0.0,
        attitude: steady.attitude,
        motion,
        wheels: &wheels,
        field,
        orbit: SensedOrbit::default(),
        sun: [0.0; 3],
    };
    let mut inputs = controller.inputs(&state, None);
    for (value, input) in inputs.iter_mut().zip(&controller.inputs) {
        let is_attitude = matches!(input.of, Measurement::Attitude { .. });
        if is_attitude && (asked.any_attitude || value.abs() <= AT_TARGET) {
            *value = 0.0;
        }
    }
    let Some(law) = controller.law.linearized(&inputs, &controller.start) else {
        return refused("its law jumps and has no slope; leave it out");
    };
    let (values, rates) = controller.act(&inputs, &controller.start);
    let sized = |value: f64, onto: &[f64], through: &[f64]| {
        let parts = through.iter().zip(&inputs).chain(onto.iter().zip(&controller.start));
        let size: f64 = parts.map(|(gain, part)| (gain * part).abs()).sum();
        value == 0.0 || value.abs() <= STEADY * size
    };
    let rests = values
        .iter()
        .zip(law.C.iter().zip(&law.D))
        .all(|(value, (onto, through))| sized(*value, onto, through));
    let stays =
        rates.iter().zip(law.A.iter().zip(&law.B)).all(|(rate, (onto, through))| sized(*rate, onto, through));
    if !(rests && stays) {
        return refused(
            "at the steady state it commands a torque or a moment, or changes its states, so that the state is not steady; give [initial] the attitude of its target, or choose its spin by `--at`",
        );
    }
    let all = law.A.iter().chain(&law.B).chain(&law.C).chain(&law.D).flatten();
    if !all.copied().all(f64::is_finite) {
        return refused(
            "its formulas have no slopes at the steady state: look for a square root or an absolute value of zero there",
        );
    }
    Ok(law)
}

/// Poles of a model (1/s), real and imaginary parts, slowest decay first.
pub fn poles(A: &[Vec<f64>]) -> Result<Vec<[f64; 2]>, StudyError> {
    let mut matrix = Dense::zero(A.len());
    for (i, row) in A.iter().enumerate() {
        row.iter().enumerate().for_each(|(j, entry)| matrix.add(i, j, *entry));
    }
    let mut poles = eigenvalues(&matrix).map_err(StudyError::Vibration)?;
    poles.sort_by(|a, b| b[0].total_cmp(&a[0]).then(a[1].total_cmp(&b[1])));
    Ok(poles)
}
