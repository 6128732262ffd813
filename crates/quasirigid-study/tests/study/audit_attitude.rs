//! Audits of histories with an attitude, in every convention.

use std::fmt::Write;

use super::audit::{MOMENTS, audited};
use crate::support::free_body::{Free, cross, plus, rows, runge_kutta, turned};

/// Rows `t, w, q` of a precise motion, whose attitude is integrated beside it.
fn with_attitude(body: &Free, start: [f64; 3], duration: f64) -> Vec<([f64; 4], [f64; 4])> {
    let h = 0.01;
    let mut q = [0.8, 0.1, -0.5, (1.0 - 0.64 - 0.01 - 0.25_f64).sqrt()];
    let product = |[a, b, c, d]: [f64; 4], [x, y, z]: [f64; 3]| {
        [-b * x - c * y - d * z, a * x + c * z - d * y, a * y + d * x - b * z, a * z + b * y - c * x]
            .map(|part| 0.5 * part)
    };
    let add = |a: [f64; 4], s: f64, b: [f64; 4]| [0, 1, 2, 3].map(|i| a[i] + s * b[i]);
    let mut found = Vec::new();
    for ([t, x, y, z], middle) in rows(body, start, runge_kutta, [h, duration], 1).into_iter().zip(rows(
        body,
        runge_kutta(body, start, 0.5 * h),
        runge_kutta,
        [h, duration],
        1,
    )) {
        found.push(([t, x, y, z], q));
        let (w, half) = ([x, y, z], [middle[1], middle[2], middle[3]]);
        let next = runge_kutta(body, w, h);
        let first = product(q, w);
        let second = product(add(q, 0.5 * h, first), half);
        let third = product(add(q, 0.5 * h, second), half);
        let fourth = product(add(q, h, third), next);
        q = add(q, h / 6.0, add(add(first, 2.0, second), 1.0, add(fourth, 2.0, third)));
        let norm = q.iter().map(|part| part * part).sum::<f64>().sqrt();
        q = q.map(|part| part / norm);
    }
    found
}

fn to_inertial([w, x, y, z]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let u = [x, y, z];
    let first = cross(u, v);
    plus(plus(v, 2.0 * w, first), 2.0, cross(u, first))
}

/// Every convention of quaternion and rates is found and told, and the angular momentum keeps its direction in it alone.
#[test]
fn conventions_of_attitudes_are_found() {
    let axes = turned(0.4, 0.2);
    let body = Free::new(MOMENTS, &axes);
    let motion = with_attitude(&body, plus(axes[2], 0.2, axes[0]), 60.0);
    for scalar_first in [true, false] {
        for to_inertial_axes in [true, false] {
            for body_rates in [true, false] {
                let mut text = "t,omega_x,omega_y,omega_z,q1,q2,q3,q4\n".to_owned();
                for ([t, x, y, z], q) in motion.iter().step_by(5) {
                    let w = if body_rates { [*x, *y, *z] } else { to_inertial(*q, [*x, *y, *z]) };
                    let [a, b, c, d] = if to_inertial_axes { *q } else { [q[0], -q[1], -q[2], -q[3]] };
                    let stored = if scalar_first { [a, b, c, d] } else { [b, c, d, a] };
                    let line: Vec<String> =
                        [*t].iter().chain(&w).chain(&stored).map(|value| format!("{value:.12e}")).collect();
                    writeln!(text, "{}", line.join(",")).unwrap();
                }
                let found = audited(&text, &body.entries());
                let attitude = found.attitude.expect("an attitude");
                for (words, told) in [
                    (["scalar first", "scalar last"], scalar_first),
                    (["from body to inertial", "from inertial to body"], to_inertial_axes),
                    (["rates in body axes", "rates in inertial axes"], body_rates),
                ] {
                    assert!(
                        attitude.convention.contains(words[usize::from(!told)]),
                        "{}",
                        attitude.convention
                    );
                }
                assert!(attitude.direction_excursion < 1e-6, "{attitude:?}");
                assert!(found.energy_excursion < 1e-9 && found.holds, "{}", found.sentence);
            }
        }
    }
    // an attitude that belongs to other rates
    let mut text = "t,wx,wy,wz,qw,qx,qy,qz\n".to_owned();
    for ([t, x, y, z], q) in motion.iter().step_by(5) {
        writeln!(text, "{t},{x},{y},{z},{},{},{},{}", q[0], q[2], q[1], q[3]).unwrap();
    }
    let found = audited(&text, &body.entries());
    assert!(
        found.sentence.starts_with("The attitude fits the rates in no convention") && !found.holds,
        "{}",
        found.sentence
    );
}
