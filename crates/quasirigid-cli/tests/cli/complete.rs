//! Orders above the one that the parts of a body support are named after a verification.

use crate::support::ran_with;

const ELLIPSOID: &str = r#"
[material.rubble]
density = 2000
shear = "2 kPa"
poisson = 0.25
rheology = { kind = "kelvin-voigt", time = "0.05 s" }
[[ellipsoid]]
semi_axes = [1.5, 1.2, 0.9]
material = "rubble"
[initial]
angular_velocity = [0.06, 0.05, 0.09]
"#;

#[test]
fn a_verification_beyond_the_kinematics_does_not_end_with_every_order_reached() {
    let ran = ran_with(ELLIPSOID, "verify model.toml --orders 3,4 --revolutions 0.1 --halvings 1");
    let last = ran.stdout.trim_end().replace('\n', " ");
    assert!(last.contains("complete to order 3") && last.ends_with("in the full system, too."), "{last}");
    let ran = ran_with(ELLIPSOID, "verify model.toml --orders 3 --revolutions 0.1 --halvings 1");
    assert!(!ran.stdout.contains("complete to order"), "{}", ran.stdout);
    assert!(ran.stdout.contains("in the paper's form"), "{}", ran.stdout);
}
