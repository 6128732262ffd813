use std::ops::Range;

/// The two kinds of a harmonic: with `cos mθ` along r and z and `sin mθ` round the axis, and a quarter of a revolution further.
pub(super) const KINDS: usize = 2;

/// Layout: places of the parts of a vector. (L10)
///
/// A flow is `u_r e_r + u_θ e_θ + u_z e_z`. Of harmonic `m` and the first kind it is `(u_r cos mθ, u_θ sin mθ, u_z cos mθ)`, of the second
/// `(u_r sin mθ, −u_θ cos mθ, u_z sin mθ)`; harmonic 0 has the first kind only, without factors. Its parts are `u_r + u_θ`, `u_r − u_θ` and
/// `u_z`, of the orders `m+1`, `|m−1|` and `m` round the axis in space.
pub(super) struct Layout {
    /// The highest harmonic.
    pub most: usize,
    /// Unknowns of order zero round the axis, and of higher orders.
    pub counts: [usize; 2],
}

impl Layout {
    /// Orders of the parts of a harmonic round the axis.
    pub fn orders(m: usize) -> [usize; 3] {
        [m + 1, m.abs_diff(1), m]
    }

    /// Factors of the squares of the parts in the integral round the axis.
    pub fn weights(m: usize) -> [f64; 3] {
        let whole = Self::round(m);
        [0.5 * whole, 0.5 * whole, whole]
    }

    /// `∫cos² mθ dθ`.
    pub fn round(m: usize) -> f64 {
        if m == 0 { 2.0 * std::f64::consts::PI } else { std::f64::consts::PI }
    }

    /// Harmonics and kinds in their order.
    pub fn families(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        (0..=self.most).flat_map(|m| (0..if m == 0 { 1 } else { KINDS }).map(move |kind| (m, kind)))
    }

    /// Size of a part of order `k`.
    pub fn count(&self, k: usize) -> usize {
        self.counts[usize::from(k > 0)]
    }

    /// Size of a family.
    pub fn width(&self, m: usize) -> usize {
        Self::orders(m).iter().map(|k| self.count(*k)).sum()
    }

    /// Size of a vector.
    pub fn size(&self) -> usize {
        self.families().map(|(m, _)| self.width(m)).sum()
    }

    /// The places of a family.
    pub fn family(&self, m: usize, kind: usize) -> Range<usize> {
        let before: usize =
            self.families().take_while(|family| *family != (m, kind)).map(|(m, _)| self.width(m)).sum();
        before..before + self.width(m)
    }

    /// The places of the parts of a family.
    pub fn parts(&self, m: usize, kind: usize) -> [Range<usize>; 3] {
        let mut start = self.family(m, kind).start;
        Self::orders(m).map(|k| {
            let own = start..start + self.count(k);
            start = own.end;
            own
        })
    }
}
