//! Memory check: estimates of large pieces are compared with the free memory of the machine before these are allocated.

use std::fs;

use thiserror::Error;

/// Work that would take more memory than there is.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("it would take about {needed:.3} GiB of memory, and {allowed:.3} GiB may be used", needed = gibi(*needed), allowed = gibi(*allowed))]
pub struct TooMuchMemory {
    /// Estimate of the memory needed (bytes).
    pub needed: u64,
    /// Memory that may be used (bytes).
    pub allowed: u64,
}

/// Share of the free memory that may be used.
const FREE_MEMORY_SHARE: f64 = 0.9;
/// Memory that may be used where the system does not say how much there is (bytes).
const UNKNOWN_MEMORY: f64 = 8.0 * GIBI;
/// Pieces below this size are not checked (bytes).
const UNCHECKED_SIZE: f64 = 64.0 * 1024.0 * 1024.0;
const GIBI: f64 = 1024.0 * 1024.0 * 1024.0;

/// Compares an estimate (bytes) with the memory that may be used: nine tenths of what the machine, the group of processes and the
/// limit of the process leave free, or of 8 GiB where the system does not say.
///
/// # Errors
/// [`TooMuchMemory`].
pub fn ask(needed: f64) -> Result<(), TooMuchMemory> {
    if needed < UNCHECKED_SIZE {
        return Ok(());
    }
    within(needed, FREE_MEMORY_SHARE * free().unwrap_or(UNKNOWN_MEMORY))
}

/// Bytes of `count` square matrices of a size.
#[must_use]
pub fn dense(size: usize, matrices: usize) -> f64 {
    (size as f64).powi(2) * size_of::<f64>() as f64 * matrices as f64
}

fn within(needed: f64, allowed: f64) -> Result<(), TooMuchMemory> {
    if needed <= allowed {
        Ok(())
    } else {
        Err(TooMuchMemory { needed: needed as u64, allowed: allowed as u64 })
    }
}

fn gibi(bytes: u64) -> f64 {
    bytes as f64 / GIBI
}

/// Free memory (bytes): the least of what the machine, the group of processes and the process have left.
fn free() -> Option<f64> {
    let read = |file: &str| fs::read_to_string(file).ok();
    let machine =
        read("/proc/meminfo").and_then(|text| entry(&text, "MemAvailable:")).map(|kibi| 1024.0 * kibi);
    let number = |file: &str| read(file)?.trim().parse::<f64>().ok();
    let most = number("/sys/fs/cgroup/memory.max");
    let group = most.zip(number("/sys/fs/cgroup/memory.current")).map(|(most, used)| (most - used).max(0.0));
    let limit = read("/proc/self/limits").and_then(|text| entry(&text, "Max address space"));
    let used = read("/proc/self/status").and_then(|text| entry(&text, "VmSize:")).map(|kibi| 1024.0 * kibi);
    let process = limit.zip(used).map(|(limit, used)| (limit - used).max(0.0));
    [machine, group, process].into_iter().flatten().min_by(f64::total_cmp)
}

/// The number behind a name at the beginning of a line.
fn entry(text: &str, name: &str) -> Option<f64> {
    let rest = text.lines().find_map(|line| line.strip_prefix(name))?;
    rest.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn estimates_are_judged_on_both_sides_of_the_limit() {
        assert!(within(1e9, 1e9).is_ok());
        assert_eq!(
            within(1e9 + 1.0, 1e9),
            Err(TooMuchMemory { needed: 1_000_000_001, allowed: 1_000_000_000 })
        );
        assert!(within(f64::NAN, 1e9).is_err());
        let words = TooMuchMemory { needed: 3 << 30, allowed: 5 << 29 }.to_string();
        assert_eq!(words, "it would take about 3.000 GiB of memory, and 2.500 GiB may be used");
    }

    #[test]
    fn no_machine_has_room_for_a_dense_matrix_of_a_million_rows() {
        assert_eq!(dense(1000, 2), 16e6);
        assert!(ask(dense(1000, 2)).is_ok());
        assert!(ask(dense(1_000_000, 1)).is_err());
    }

    #[test]
    fn entries_are_found_by_name() {
        let text =
            "MemTotal:  16 kB\nMemAvailable:   12 kB\nMax address space   unlimited   unlimited bytes\n";
        assert_eq!(entry(text, "MemAvailable:"), Some(12.0));
        assert_eq!(entry(text, "Max address space"), None);
    }
}
