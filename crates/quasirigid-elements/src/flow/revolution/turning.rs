//! Rotation of a flow about any axis: its components in space, by harmonics round the axis of the cavity.
//! In space the product `e × u` mixes harmonics without derivatives or divisions by `r`; the parts of a family are recovered afterwards.
//! Equations (L3) and (L10), docs/theory/13-inside.md.

use std::collections::BTreeMap;

use nalgebra::Complex;

use super::layout::Layout;
use super::ring::Ring;

type C = Complex<f64>;

/// A flow at the nodes, `u_x + i u_y = Σ w_n e^{inθ}` and `u_z = Σ ζ_n e^{inθ}`: its components in space, which a rotation mixes without
/// derivatives.
pub(super) struct Nodal {
    w: BTreeMap<i32, Vec<C>>,
    /// Harmonics from `n = 0` on; the others are the conjugates of these.
    zeta: BTreeMap<i32, Vec<C>>,
    nodes: usize,
}

impl Nodal {
    /// Flow from the parts of each family at all nodes.
    pub fn new(layout: &Layout, nodes: usize, part: impl Fn(usize, usize, usize) -> Vec<f64>) -> Self {
        let mut own = Self { w: BTreeMap::new(), zeta: BTreeMap::new(), nodes };
        let joined = |real: Vec<f64>, imaginary: Vec<f64>, factor: f64| -> Vec<C> {
            real.iter().zip(&imaginary).map(|(re, im)| factor * C::new(*re, *im)).collect()
        };
        let (sum, difference) = (part(0, 0, 0), part(0, 0, 1));
        let round = sum.iter().zip(&difference).map(|(s, d)| 0.5 * C::new(s + d, s - d)).collect();
        own.w.insert(1, round);
        own.zeta.insert(0, joined(part(0, 0, 2), vec![0.0; nodes], 1.0));
        for m in 1..=layout.most {
            let kinds = |place: usize| (part(m, 0, place), part(m, 1, place));
            let negative = |values: Vec<f64>| values.into_iter().map(|value| -value).collect::<Vec<_>>();
            let ((s, s_odd), (d, d_odd), (z, z_odd)) = (kinds(0), kinds(1), kinds(2));
            own.w.insert(m as i32 + 1, joined(s, negative(s_odd), 0.5));
            own.w.insert(1 - m as i32, joined(d, d_odd, 0.5));
            own.zeta.insert(m as i32, joined(z, negative(z_odd), 0.5));
        }
        own
    }

    fn w(&self, n: i32) -> Vec<C> {
        self.w.get(&n).cloned().unwrap_or_else(|| vec![C::ZERO; self.nodes])
    }

    fn zeta(&self, n: i32) -> Vec<C> {
        match self.zeta.get(&n.abs()) {
            Some(values) if n < 0 => values.iter().map(C::conj).collect(),
            Some(values) => values.clone(),
            None => vec![C::ZERO; self.nodes],
        }
    }

    /// The ring of places at a point of the meridian, from the nodes of its patch and their polynomials there: value and slopes.
    pub fn at(&self, nodes: &[usize], functions: &[[f64; 3]]) -> Ring {
        let sum = |values: &Vec<C>| -> [C; 3] {
            let shares = nodes.iter().zip(functions);
            shares.fold([C::ZERO; 3], |sum, (node, functions)| {
                std::array::from_fn(|i| sum[i] + values[*node] * functions[i])
            })
        };
        let harmonics =
            |parts: &BTreeMap<i32, Vec<C>>| parts.iter().map(|(n, values)| (*n, sum(values))).collect();
        Ring { across: harmonics(&self.w), along: harmonics(&self.zeta) }
    }

    /// `e × u` for the unit vector of an axis.
    pub fn turned(&self, axis: usize) -> Self {
        let times = |factor: C, values: Vec<C>| values.into_iter().map(|value| factor * value).collect();
        let w = self.w.keys().map(|n| {
            let values = match axis {
                0 => times(-C::i(), self.zeta(*n)),
                1 => self.zeta(*n),
                _ => times(C::i(), self.w(*n)),
            };
            (*n, values)
        });
        let zeta = self.zeta.keys().map(|n| {
            let pairs = self.w(*n).into_iter().zip(self.w(-n));
            let values = match axis {
                0 => pairs.map(|(w, mirror)| -0.5 * C::i() * (w - mirror.conj())).collect(),
                1 => pairs.map(|(w, mirror)| -0.5 * (w + mirror.conj())).collect(),
                _ => vec![C::ZERO; self.nodes],
            };
            (*n, values)
        });
        Self { w: w.collect(), zeta: zeta.collect(), nodes: self.nodes }
    }

    /// The parts of a family at all nodes.
    pub fn parts(&self, m: usize, kind: usize) -> [Vec<f64>; 3] {
        let of = |values: Vec<C>, real: &dyn Fn(C) -> f64| values.into_iter().map(real).collect();
        let n = m as i32;
        match (m, kind) {
            (0, _) => {
                let round = self.w(1);
                [
                    of(round.clone(), &|w| w.re + w.im),
                    of(round, &|w| w.re - w.im),
                    of(self.zeta(0), &|z| z.re),
                ]
            }
            (_, 0) => [
                of(self.w(n + 1), &|w| 2.0 * w.re),
                of(self.w(1 - n), &|w| 2.0 * w.re),
                of(self.zeta(n), &|z| 2.0 * z.re),
            ],
            _ => [
                of(self.w(n + 1), &|w| -2.0 * w.im),
                of(self.w(1 - n), &|w| 2.0 * w.im),
                of(self.zeta(n), &|z| -2.0 * z.im),
            ],
        }
    }
}
