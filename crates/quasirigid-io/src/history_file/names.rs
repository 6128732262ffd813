//! Names of the columns of a history, in the spellings of many programs, and what each column holds.

use std::collections::BTreeMap;

/// Quantity of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Role {
    Time,
    /// Component of the angular velocity, from 0.
    Rate(u8),
    /// Part of a quaternion by its name: the scalar is 0.
    Quaternion(u8),
    /// Part of a quaternion by its number, from 0; which part is the scalar is not told.
    Numbered(u8),
    /// Modified Rodrigues parameter, from 0.
    Rodrigues(u8),
}

const TIMES: [&str; 13] = [
    "t",
    "time",
    "times",
    "simtime",
    "simulationtime",
    "elapsed",
    "elapsedtime",
    "timestamp",
    "sec",
    "secs",
    "second",
    "seconds",
    "mettime",
];
const RATES: [&str; 22] = [
    "w",
    "om",
    "omega",
    "omegab",
    "omegabody",
    "omegabn",
    "omegabnb",
    "wb",
    "wbody",
    "g",
    "gyro",
    "gyr",
    "rate",
    "rates",
    "bodyrate",
    "bodyrates",
    "angularrate",
    "angularvelocity",
    "angvel",
    "av",
    "angularvelocitybody",
    "bodyangularvelocity",
];
const QUATERNIONS: [&str; 11] =
    ["q", "quat", "quaternion", "att", "attitude", "orientation", "qbn", "qnb", "qib", "qbi", "rot"];
const RODRIGUES: [&str; 4] = ["sigma", "sigmabn", "mrp", "mrps"];
/// Endings of names that are units.
const UNITS: [(&str, &str); 9] = [
    ("_rad_s", "rad/s"),
    ("_radps", "rad/s"),
    ("_rads", "rad/s"),
    ("_deg_s", "deg/s"),
    ("_degps", "deg/s"),
    ("_dps", "deg/s"),
    ("_rpm", "rpm"),
    ("_ms", "ms"),
    ("_s", "s"),
];

/// A name without its unit, in brackets or as an ending, and the unit.
pub(super) fn parts(title: &str) -> (&str, Option<&str>) {
    let title = title.trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((name, unit)) = title.strip_suffix(close).and_then(|inner| inner.rsplit_once(open)) {
            // the index of an array is no unit
            let is_index = unit.trim().parse::<u8>().is_ok();
            if !is_index && !name.trim().is_empty() {
                return (name.trim(), Some(unit.trim()));
            }
        }
    }
    let ends =
        |ending: &str| title.get(title.len().checked_sub(ending.len())?..).map(str::to_ascii_lowercase);
    for (ending, unit) in UNITS.into_iter().filter(|(ending, _)| ends(ending).as_deref() == Some(ending)) {
        let name = &title[..title.len() - ending.len()];
        // `q_s` is the scalar of a quaternion
        if !matches!(unit, "s" | "ms") || TIMES.contains(&compact(name).as_str()) {
            return (name, Some(unit));
        }
    }
    (title, None)
}

/// What the columns of these names hold, by their indices; those of other names are left out.
pub(super) fn roles(titles: &[String]) -> BTreeMap<Role, Vec<usize>> {
    let plain: Vec<String> = titles.iter().map(|title| compact(parts(title).0)).collect();
    let mut found = BTreeMap::<Role, Vec<usize>>::new();
    for (column, name) in plain.iter().enumerate() {
        if let Some(role) = role(name, &plain) {
            found.entry(role).or_default().push(column);
        }
    }
    found
}

/// A name in small letters without anything between them.
fn compact(name: &str) -> String {
    let letters = name.chars().filter(|letter| letter.is_alphanumeric());
    letters.flat_map(char::to_lowercase).map(|letter| if letter == 'ω' { 'w' } else { letter }).collect()
}

fn role(name: &str, all: &[String]) -> Option<Role> {
    if TIMES.contains(&name) {
        return Some(Role::Time);
    }
    let there = |name: &str| all.iter().any(|other| other == name);
    if ["p", "q", "r"].contains(&name) && ["p", "q", "r"].into_iter().all(there) {
        return Some(Role::Rate(name.bytes().next()? - b'p'));
    }
    let (stem, last) = name.split_at_checked(name.len().checked_sub(1)?)?;
    let axis = |letters: &str| letters.find(last).and_then(|place| u8::try_from(place).ok());
    // numbers count from nought where there is a zeroth column
    let numbered = || last.parse::<u8>().ok()?.checked_sub(u8::from(!there(&format!("{stem}0"))));
    if RATES.contains(&stem) {
        return axis("xyz").or_else(numbered).filter(|place| *place < 3).map(Role::Rate);
    }
    if QUATERNIONS.contains(&stem) {
        let named = axis("wxyz").or_else(|| axis("sxyz")).or_else(|| axis("rijk"));
        return named
            .map(Role::Quaternion)
            .or_else(|| numbered().filter(|place| *place < 4).map(Role::Numbered));
    }
    if RODRIGUES.contains(&stem) {
        return axis("xyz").or_else(numbered).filter(|place| *place < 3).map(Role::Rodrigues);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(line: &str) -> Vec<Option<Role>> {
        let titles: Vec<String> = line.split(',').map(str::to_owned).collect();
        let found = roles(&titles);
        let of = |column: usize| found.iter().find(|(_, all)| all.contains(&column)).map(|(role, _)| *role);
        (0..titles.len()).map(of).collect()
    }

    #[test]
    fn spellings_of_many_programs_are_known() {
        let plain = [Some(Role::Time), Some(Role::Rate(0)), Some(Role::Rate(1)), Some(Role::Rate(2))];
        for line in [
            "t,wx,wy,wz",
            "Time [s],omega_x [deg/s],omega_y [deg/s],omega_z [deg/s]",
            "time (ms),w1,w2,w3",
            "timestamp,gx,gy,gz",
            "t,p,q,r",
            "sim_time,angular_velocity.x,angular_velocity.y,angular_velocity.z",
            "t,omega[0],omega[1],omega[2]",
            "t_s,wx_dps,wy_dps,wz_dps",
            "times,omega_BN_B_x,omega_BN_B_y,omega_BN_B_z",
            "t,ω_x,ω_y,ω_z",
            "T,Gyro X,Gyro Y,Gyro Z",
        ] {
            assert_eq!(told(line), plain, "{line}");
        }
    }

    #[test]
    fn quaternions_are_named_or_numbered() {
        let parts = |line: &str| told(line).into_iter().flatten().collect::<Vec<_>>();
        assert_eq!(parts("qx,qy,qz,qw"), [1, 2, 3, 0].map(Role::Quaternion));
        assert_eq!(parts("q_s,q_x,q_y,q_z"), [0, 1, 2, 3].map(Role::Quaternion));
        assert_eq!(parts("q0,q1,q2,q3"), [0, 1, 2, 3].map(Role::Numbered));
        assert_eq!(parts("q1,q2,q3,q4"), [0, 1, 2, 3].map(Role::Numbered));
        assert_eq!(parts("sigma_BN_1,sigma_BN_2,sigma_BN_3"), [0, 1, 2].map(Role::Rodrigues));
    }

    #[test]
    fn units_stand_in_brackets_or_at_the_end() {
        assert_eq!(parts("wx [deg/s]"), ("wx", Some("deg/s")));
        assert_eq!(parts("gyro_x_dps"), ("gyro_x", Some("deg/s")));
        assert_eq!(parts("omega[0]"), ("omega[0]", None));
        assert_eq!(parts("t"), ("t", None));
    }
}
