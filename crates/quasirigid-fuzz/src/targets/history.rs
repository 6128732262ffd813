//! Histories of other programs.

use quasirigid_io::history_file::read_history;

use super::disk::with_file;

pub const TEXT: &[&str] = &[
    "t,wx,wy,wz",
    ",qw,qx,qy,qz",
    " [deg/s]",
    "omega_x",
    "sigma_1",
    "\n0,1,2,3",
    "1.5D-3",
    "nan",
    "#",
    ";",
    "\"",
];

/// Reads a file; what it has is finite, of equal length, in order.
pub fn read(name: &str, bytes: &[u8]) {
    with_file(name, bytes, |path| match read_history(path) {
        Ok(history) => {
            let rows = history.t.len();
            let lengths = [history.rates.len(), history.attitude.len()];
            assert!(rows > 0 && lengths.contains(&rows), "every time has rates, or an attitude");
            assert!(lengths.iter().all(|length| [0, rows].contains(length)), "all rows have each, or none");
            assert!(history.t.is_sorted(), "times ascend");
            if !history.rates.is_empty() {
                assert!(history.rounding(rows - 1).iter().all(|error| *error >= 0.0), "rounding has a size");
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    });
}
