use super::liquid::Liquid;
use crate::flow::Velocity;
use crate::math::vec3::dot;

/// Share of the largest term below which terms are rounding.
const TERM_ROUNDING: f64 = 1e-10;

/// Advection `∫u_a·(u_b·∇)u_c dV` of three among a few flows, the mean of both orders of the last two, without zeros. Solenoidal flows
/// between walls take no power from each other: before that mean the integral is antisymmetric in the first and the last. (L21)
pub(super) fn advection(liquid: &dyn Liquid, flows: &[Vec<f64>]) -> Vec<([usize; 3], f64)> {
    let count = flows.len();
    let place = |a: usize, b: usize, c: usize| (a * count + b) * count + c;
    let mut sums = vec![0.0; count.pow(3)];
    let mut sizes = 0.0;
    liquid.sample(flows, &mut |volume: f64, at: &[Velocity]| {
        for (b, carrier) in at.iter().enumerate() {
            for (c, carried) in at.iter().enumerate() {
                let moved = carried.gradient.map(|row| volume * dot(row, carrier.u));
                at.iter().enumerate().for_each(|(a, own)| sums[place(a, b, c)] += dot(own.u, moved));
                sizes +=
                    dot(moved, moved).sqrt() * at.iter().map(|own| dot(own.u, own.u).sqrt()).sum::<f64>();
            }
        }
    });
    let powerless = |a: usize, b: usize, c: usize| 0.5 * (sums[place(a, b, c)] - sums[place(c, b, a)]);
    let all = (0..count).flat_map(|a| (0..count).flat_map(move |b| (0..count).map(move |c| [a, b, c])));
    all.map(|[a, b, c]| ([a, b, c], 0.5 * (powerless(a, b, c) + powerless(a, c, b))))
        .filter(|(_, term)| term.abs() > TERM_ROUNDING * sizes)
        .collect()
}
