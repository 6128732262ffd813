//! Audits of histories with an attitude, in every convention.

use std::fmt::Write;

use super::audit::{MOMENTS, audited, refused};
use crate::support::close;
use crate::support::free_body::{
    Free, OWN, Step, cross, explicit_euler, implicit_euler, lie_euler, plus, rows, runge_kutta, turned,
};

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

/// Attitudes of rows `t, w`, each turned from the one before by the mean of both rates, and the rows.
fn carried(body: &Free, start: [f64; 3], step: Step, [h, duration]: [f64; 2]) -> Vec<([f64; 4], [f64; 4])> {
    let mut q = [0.5, -0.1, 0.7, (1.0 - 0.25 - 0.01 - 0.49_f64).sqrt()];
    let mut before: Option<[f64; 4]> = None;
    let turned = |[a, b, c, d]: [f64; 4], turn: [f64; 3]| {
        let angle = turn.iter().map(|part| part * part).sum::<f64>().sqrt();
        let (w, [x, y, z]) = ((0.5 * angle).cos(), turn.map(|part| part * (0.5 * angle).sin() / angle));
        [
            a * w - b * x - c * y - d * z,
            a * x + b * w + c * z - d * y,
            a * y + c * w + d * x - b * z,
            a * z + d * w + b * y - c * x,
        ]
    };
    let rows = rows(body, start, step, [h, duration], 1).into_iter();
    rows.map(|row| {
        if let Some(before) = before {
            q = turned(q, [1, 2, 3].map(|i| 0.5 * h * (before[i] + row[i])));
        }
        before = Some(row);
        (row, q)
    })
    .collect()
}

/// Text of every so many rows: with rates, or of the attitude alone, from inertial to body axes with the scalar last, at times in another unit.
fn texts(motion: &[([f64; 4], [f64; 4])], every: usize) -> [String; 2] {
    let mut both = ["t,wx,wy,wz\n".to_owned(), "t [min],q1,q2,q3,q4\n".to_owned()];
    for ([t, x, y, z], q) in motion.iter().step_by(every) {
        writeln!(both[0], "{t},{x},{y},{z}").unwrap();
        writeln!(both[1], "{},{},{},{},{}", t / 60.0, -q[1], -q[2], -q[3], q[0]).unwrap();
    }
    both
}

/// Two roads to a time constant: by the rates of an integrator, and by those of its attitudes alone, in turned axes, about either axis.
#[test]
fn an_attitude_alone_has_the_time_constant_of_its_rates() {
    let axes = turned(0.7, -0.3);
    let body = Free::new(MOMENTS, &axes);
    for (about, across) in [(2, 0), (0, 2)] {
        for step in [explicit_euler as Step, implicit_euler, lie_euler] {
            let motion = carried(&body, plus(axes[about], 0.1, axes[across]), step, [0.005, 120.0]);
            let [by_rates, alone] = texts(&motion, 40).map(|text| audited(&text, &body.entries()));
            let [expected, found] = [&by_rates, &alone].map(|found| found.invented_time_constant.unwrap());
            close(found, expected, 2e-3);
            close(alone.energy_drift, by_rates.energy_drift, 0.1); // the rows at the ends, a twentieth of the time, are gone
            assert_eq!(alone.rows, by_rates.rows - 6);
            assert!(
                alone.holds
                    && alone.attitude.unwrap().convention.contains("scalar last, from inertial to body")
            );
            assert!(alone.rounding.energy > 10.0 * by_rates.rounding.energy, "{}", alone.rounding.energy);
            assert_eq!((alone.units.source, alone.units.times.as_str()), ("heading", "min"));
        }
    }
}

/// A motion that keeps everything shows nothing above the errors of its differences, which fall with the spacing of the rows.
#[test]
fn an_attitude_alone_invents_nothing_by_its_differences() {
    let body = Free::new(MOMENTS, &OWN);
    let motion = with_attitude(&body, [0.2, -0.1, 1.0], 200.0);
    let floor = |every: usize| {
        let found = audited(&texts(&motion, every)[1], &body.entries());
        assert_eq!(found.invented_time_constant, None, "{every}: {}", found.sentence);
        assert!(found.energy_excursion < found.rounding.energy, "{every}: {}", found.energy_excursion);
        assert!(found.notes.iter().any(|note| note.contains("the file has no rates")), "{:?}", found.notes);
        found.rounding.energy
    };
    let [coarse, middle, fine] = [80, 40, 20].map(floor);
    // the slope through one row fewer is of fifth order
    for ratio in [coarse / middle, middle / fine] {
        assert!((ratio.log2() - 5.0).abs() < 0.8, "{coarse:e} {middle:e} {fine:e}");
    }
}

/// Rows that are too far apart or too few, another inertia, and times without a unit are told in words.
#[test]
fn attitudes_alone_that_tell_nothing_are_refused() {
    let body = Free::new(MOMENTS, &OWN);
    let motion = with_attitude(&body, [0.3, -0.1, 1.0], 200.0);
    let refused = |every: usize, rows: usize, entries: &[f64]| {
        let text: String =
            texts(&motion, every)[1].lines().take(rows + 1).map(|line| format!("{line}\n")).collect();
        refused(&text, entries)
    };
    let coarse = refused(110, 1000, &MOMENTS);
    assert!(
        coarse.contains("row 2 is 1.1") && coarse.contains("write rows closer to each other"),
        "{coarse}"
    );
    assert!(refused(20, 7, &MOMENTS).contains("of 7 rows; their rates need 8 rows"));
    // numbers of unknown order are those of this motion with its axes renamed, too; names are not
    let reversed = [17.0, 14.0, 10.0];
    let renamed = audited(&texts(&motion, 20)[1], &reversed);
    close(renamed.momentum_drift, audited(&texts(&motion, 20)[1], &MOMENTS).momentum_drift, 1e-3);
    let mut named = "t,qw,qx,qy,qz\n".to_owned();
    for ([t, ..], q) in motion.iter().step_by(20) {
        writeln!(named, "{t},{},{},{},{}", q[0], q[1], q[2], q[3]).unwrap();
    }
    let other = super::audit::refused(&named, &reversed);
    assert!(other.contains("in no convention") && other.contains("the axes of the body"), "{other}");
    let bare = texts(&motion, 20)[1].replace("t [min]", "t");
    let found = audited(&bare, &body.entries());
    assert_eq!(found.units.source, "assumed");
    assert!(found.notes.iter().any(|note| note.contains("does not tell their unit")), "{:?}", found.notes);
}
