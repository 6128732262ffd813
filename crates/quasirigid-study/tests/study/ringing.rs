//! What reduced equations say of their own angular velocity under forces as fast as the vibrations, against the full system. (E8)

use quasirigid::dynamics::Ringing;
use quasirigid_io::model::System;
use quasirigid_math::random::Random;
use quasirigid_study::settings::PartialRun;

use crate::support::{carrier, column, expression, point, spinning, study, table, told_history};

/// Angular velocity below which errors do not count, relative to the largest of the run: above the decade in which the program drops them.
const COUNTS: f64 = 1e-2;

/// Errors of an angular velocity: what the reduced history says; the largest, relative to the largest angular velocity until then, and of the
/// run; the first and last time (s) of one above 10 % of the former.
struct Compared {
    told: Option<Ringing>,
    notes: String,
    share: f64,
    share_of_run: f64,
    span: Option<[f64; 2]>,
}

fn compared(model: &str, times: &[f64]) -> Compared {
    let study = study(model);
    let [full, rigid, reduced] = [System::Full, System::Rigid, System::Reduced].map(|system| {
        let (found, said) = told_history(&study, &table(system, times), PartialRun::default());
        let rows = ["wx", "wy", "wz"].map(|name| column(&found.columns, name).to_vec());
        (found.run.ringing, said, rows)
    });
    let rows = reduced.2[0].len();
    let norm = |of: &dyn Fn(usize) -> f64| (0..3).map(|axis| of(axis).powi(2)).sum::<f64>().sqrt();
    let largest: Vec<f64> = (0..rows)
        .scan(0.0_f64, |largest, row| {
            *largest = largest.max(norm(&|axis| rigid.2[axis][row]));
            Some(*largest)
        })
        .collect();
    let (mut share, mut share_of_run, mut span): (f64, f64, Option<[f64; 2]>) = (0.0, 0.0, None);
    for row in (0..rows).filter(|row| largest[*row] > COUNTS * largest[rows - 1]) {
        let error = norm(&|axis| full.2[axis][row] - reduced.2[axis][row]) / largest[row];
        share = share.max(error);
        share_of_run = share_of_run.max(error * largest[row] / largest[rows - 1]);
        if error > 0.1 {
            span = Some([span.map_or(times[row], |[from, _]| from), times[row]]);
        }
    }
    Compared { told: reduced.0, notes: reduced.1, share, share_of_run, span }
}

/// Random carriers with one or two damped points, spinning or at rest, under pulses, windows and waves from far faster to slower than the vibrations.
#[test]
fn angular_velocities_that_fast_forces_spoil_are_told() {
    let mut random = Random::new(40);
    for body in 0..24 {
        let mut between = |low: f64, high: f64| low + (high - low) * random.unit();
        let inertia = [between(8.0, 12.0), between(10.0, 14.0), between(12.0, 18.0)];
        let frequency = between(5.0, 30.0);
        let mut model = carrier(40.0, inertia);
        for name in ["a", "b"].iter().take(1 + body % 2) {
            let mass = between(0.3, 3.0);
            let own = frequency * between(1.0, 2.0);
            let place = [between(-0.9, 0.9), between(-0.9, 0.9), between(0.3, 0.9)];
            let damping = 2.0 * between(0.02, 0.3) * own * mass;
            model += &point(name, mass, place, [own * own * mass, damping]);
        }
        let rate = if body % 3 == 0 { 0.0 } else { between(0.02, 0.2) };
        model += &spinning([0.3 * rate, 0.1 * rate, rate]);
        if rate == 0.0 {
            model += "displacements = \"rest\"\n";
        }
        let width = 10f64.powf(between(-2.0, 0.8)) / frequency;
        let size = between(0.3, 3.0);
        let torque = |shape: &str| {
            let parts = [0.7, -0.4, 1.0].map(|part| format!("\"{}*{shape}\"", part * size));
            format!("torque = [{}]", parts.join(", "))
        };
        model += &expression(&match body % 4 {
            0 | 1 => torque(&format!("exp(-((t - 10)/{width})^2)")),
            2 => torque(&format!("(step(t - 10) - step(t - {}))", 10.0 + width)),
            _ => torque(&format!("exp(-((t - 10)/2)^2)*sin({}*t)", between(0.1, 0.9) * frequency)),
        });
        let near = |i: u32| 10.0 + width * (f64::from(i) / 50.0 - 4.0);
        let mut times: Vec<f64> = (0..400).map(near).chain((0..600).map(|i| 0.05 * f64::from(i))).collect();
        times.retain(|t| *t >= 0.0);
        times.sort_by(f64::total_cmp);
        times.dedup();
        let Compared { told, notes, share, share_of_run, span } = compared(&model, &times);
        println!("{body} {width:.3e} {:.2} {share:.3e} {span:?} {told:?}", width * frequency);
        assert_eq!(told.is_some(), notes.contains("THE ANGULAR VELOCITY MAY BE WRONG"), "{notes}\n{model}");
        assert!(share < 0.1 || told.is_some(), "{share}\n{model}");
        if let Some(Ringing { from, to, share: said, .. }) = told {
            let ratio = said / share_of_run;
            assert!(ratio > 0.5 && (ratio < 3.0 || said < 0.1), "{said} {share_of_run}\n{model}");
            let [first, last] = span.unwrap_or([from, to]);
            assert!(from <= first + width && to >= last - 0.3, "{from} {to} {span:?}\n{model}");
        }
    }
}
