use super::super::Expression;
use super::Changes;

const BUDGET: u64 = 2_000_000;

fn scanned(text: &str, end: f64) -> Changes {
    Expression::parse(text, &["t", "w"]).unwrap().changes(0, &[0.0, 0.3], [0.0, end], BUDGET)
}

/// Longest interval that holds the place.
fn cell(changes: &Changes, x: f64) -> f64 {
    let cells = changes.ends.windows(2).filter(|pair| pair[0] <= x && x <= pair[1]);
    cells.map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

/// Corners of pulses of any length and depth of nesting are known to rounding, and to nothing else is broken.
#[test]
fn corners_of_formulas_are_breaks() {
    let table: [(&str, f64, &[f64]); 9] = [
        (
            "15*(max(0,min(1,(t-1000)*1e4))-max(0,min(1,(t-1000.1)*1e4)))",
            2000.0,
            &[1000.0, 1000.0001, 1000.1, 1000.1001],
        ),
        ("abs(t-3)", 10.0, &[3.0]),
        ("max(abs(t-3)-1, 0)", 1e7, &[2.0, 3.0, 4.0]),
        (
            "max(0, sin(t)-0.5)",
            7.0,
            &[
                std::f64::consts::FRAC_PI_6,
                5.0 * std::f64::consts::FRAC_PI_6,
                13.0 * std::f64::consts::FRAC_PI_6,
            ],
        ),
        ("(t-5)/abs(t-5)", 12.0, &[5.0]),
        ("5*(step(t-500)-step(t-500.001))", 1e3, &[500.0, 500.001]),
        ("step(min(t-2, 5-t))*max(2.3, t)*max(10*w, t)", 7.0, &[2.0, 2.3, 3.5, 5.0]),
        // nothing is followed where a factor is zero
        ("step(min(t-2, 5-t))*max(0.3, t)", 7.0, &[2.0, 3.5, 5.0]),
        ("exp(t/100)*w", 10.0, &[]),
    ];
    for (text, end, expected) in table {
        let found = scanned(text, end);
        assert!(found.complete, "{text}");
        for place in expected {
            let nearest = found.breaks.iter().map(|x| (x - place).abs()).fold(f64::INFINITY, f64::min);
            assert!(nearest <= 1e-15 * end + 4e-16 * place, "{text}: {place} among {:?}", found.breaks);
        }
        let apart = |x: &f64| expected.iter().all(|place| (x - place).abs() > 1e-11 * end);
        assert_eq!(found.breaks.iter().filter(|x| apart(x)).count(), 0, "{text}: {:?}", found.breaks);
    }
}

/// Where two parts cross twice in 1e-4 of the interval: `sin t + cos t = √2 cos(t − π/4)`.
#[test]
fn parts_that_barely_cross_are_breaks() {
    let found = scanned("max(sin(t), 1.41421356-cos(t))", 3.0);
    let expected = [0.785_340_231_859_629, 0.785_456_094_935_267_6];
    assert_eq!(found.breaks.len(), 2, "{:?}", found.breaks);
    assert!(found.breaks.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-11), "{:?}", found.breaks);
}

/// Pulses down to 1e-9 of the interval, of every shape, have intervals of their own length.
#[test]
fn narrow_pulses_are_found() {
    for (text, end, at, length) in [
        ("0.1*exp(-((t-500)/0.05)^2)", 1000.0, 500.0, 0.05),
        ("exp(-((t-500)/1e-6)^2)", 1000.0, 500.0, 1e-6),
        ("exp(-1e6*(t-777.7)^2)*w", 5000.0, 777.7, 1e-3),
        ("tanh((t-500)*20)-tanh((t-510)*20)", 1000.0, 510.0, 0.05),
        ("0.5*(tanh((t-500)*2e4)-tanh((t-500.0001)*2e4))", 1e4, 500.0, 1e-4),
        ("1/(1+((t-123)/0.01)^2)", 1e4, 123.0, 0.01),
        ("1/(1+exp(-(t-500)*100))", 1e4, 500.0, 0.01),
        ("cos(0.01*t)^1000", 1000.0, 100.0 * std::f64::consts::PI, 10.0),
        ("exp(-1e8*sin(0.001*t)^2)", 1e4, 1000.0 * std::f64::consts::PI, 0.1),
        ("atan((t-40)*1e6)", 1e3, 40.0, 1e-6),
        ("exp(-abs(t-300)*1e3)", 1e3, 300.0, 1e-3),
        ("w*0*exp(-((t-500)/0.05)^2)", 1000.0, 500.0, 0.05),
    ] {
        let found = scanned(text, end);
        assert!(found.complete && found.evaluations < 200_000, "{text}: {}", found.evaluations);
        let cell = cell(&found, at);
        assert!(cell < 8.0 * length, "{text}: {cell} for {length}");
        assert!(found.ends.len() < 400, "{text}: {}", found.ends.len());
    }
}

/// What changes slowly costs nothing, and trains have intervals for each of their pulses.
#[test]
fn slow_formulas_have_few_intervals_and_trains_have_many() {
    assert!(scanned("1e-3*sin(0.1*t)", 100.0).ends.len() < 12);
    assert!(scanned("3 + 2*t - w*t^3", 1e9).ends.len() <= 3);
    let train = scanned("max(0, sin(0.1256637*t)-0.99)", 10_000.0);
    assert!(train.complete && train.breaks.len() == 400, "{}", train.breaks.len());
    let sine = scanned("sin(6.283185307*t)", 1000.0);
    assert!(sine.complete && sine.ends.len() > 400, "{}", sine.ends.len());
}

/// A formula that cannot be followed with the evaluations allowed says so.
#[test]
fn the_work_is_bounded() {
    let formula = Expression::parse("sin(1e9*t)", &["t"]).unwrap();
    let found = formula.changes(0, &[0.0], [0.0, 1000.0], 10_000);
    assert!(!found.complete && found.evaluations < 11_000, "{}", found.evaluations);
}

/// Corners that depend on what else the formula has are no breaks, since their places are not known in advance.
#[test]
fn corners_of_other_variables_are_no_breaks() {
    let found = scanned("max(0, t - 10*w)", 10.0);
    assert!(found.breaks.is_empty() && cell(&found, 3.0) < 10.0, "{}", found.ends.len());
}

/// A wave of 1e6 periods that a window of a few of them multiplies costs what those cost, whichever stands first; so does a Gaussian times a wave.
#[test]
fn waves_are_followed_in_their_windows_alone() {
    for text in [
        "step(t-333.333)*step(333.336-t)*cos((t-333.333)*6e3)",
        "cos((t-333.333)*6e3)*(step(t-333.333)-step(t-333.336))",
        "3*exp(-((t-333.333)/1e-3)^2)*(1+0.2*cos(5e3*t))",
    ] {
        let found = scanned(text, 1000.0);
        assert!(found.complete && found.evaluations < 200_000, "{text}: {} evaluations", found.evaluations);
        assert!(found.ends.len() < 400, "{text}: {}", found.ends.len());
        assert!(cell(&found, 333.3335) < 1e-3 && cell(&found, 100.0) > 50.0, "{text}");
    }
}

/// Parts that cancel leave rounding, in which there is nothing to find: alone, as a factor, as an argument, and as what a corner waits for.
#[test]
fn what_is_zero_to_rounding_has_no_changes() {
    for text in [
        "cos(t)^2+sin(t)^2-1",
        "1e-3*sin(t)*(1-cos(t)^2-sin(t)^2)+1e-3*sin(t)",
        "1e-3*((1+0.1*t)^2-1-0.2*t-0.01*t^2)",
        "0.002*sin(t)*cos(t)-0.001*sin(2*t)",
        "1e-3*(cos(t)^2+sin(t)^2-0.999999999)",
        "(0.5*sin(2*t)-sin(t)*cos(t))^2*exp(sin(t)*cos(t)-0.5*sin(2*t))",
        "max(0, cos(t)^2+sin(t)^2-1)+abs(sin(2*t)-2*sin(t)*cos(t))",
    ] {
        let found = scanned(text, 50.0);
        assert!(found.complete && found.evaluations < 100_000, "{text}: {}", found.evaluations);
        assert!(
            found.ends.len() < 150 && found.breaks.is_empty(),
            "{text}: {} {:?}",
            found.ends.len(),
            found.breaks
        );
    }
    // a pulse on what cancels is found as it is alone
    let found = scanned("cos(t)^2+sin(t)^2-1+1e-9*exp(-((t-3.3)*1e5)^2)", 50.0);
    assert!(found.complete && cell(&found, 3.3) < 1e-4, "{} {}", found.evaluations, cell(&found, 3.3));
}
