/// Jacobi polynomials `J_n^{(a,b)}`, `n = 0, 1, …`, with their first two derivatives.
pub(super) fn jacobi(count: usize, [a, b]: [f64; 2], x: f64) -> Vec<[f64; 3]> {
    let [plain, once, twice] = [0, 1, 2]
        .map(|k| values(count.saturating_sub(k), a + f64::from(k as u32), b + f64::from(k as u32), x));
    let entry = |n: usize| {
        let rate = n as f64 + a + b + 1.0;
        let slope = if n > 0 { 0.5 * rate * once[n - 1] } else { 0.0 };
        let second = if n > 1 { 0.25 * rate * (rate + 1.0) * twice[n - 2] } else { 0.0 };
        [plain[n], slope, second]
    };
    (0..count).map(entry).collect()
}

/// Values by the three-term recurrence.
fn values(count: usize, a: f64, b: f64, x: f64) -> Vec<f64> {
    let mut values = vec![1.0, 0.5 * (a - b + (a + b + 2.0) * x)];
    for n in 2..count {
        let n = n as f64;
        let sum = 2.0 * n + a + b;
        let last = 2.0 * n * (n + a + b) * (sum - 2.0);
        let next = (sum - 1.0) * (sum * (sum - 2.0) * x + a * a - b * b);
        let before = 2.0 * (n + a - 1.0) * (n + b - 1.0) * sum;
        let [.., second, first] = values[..] else { break };
        values.push((next * first - before * second) / last);
    }
    values.truncate(count);
    values
}
