use std::ops::Range;

/// The two kinds of a harmonic: with `cos mθ` along r and z and `sin mθ` round the axis, and a quarter of a turn further.
pub(super) const KINDS: usize = 2;

/// Where the parts of a vector stand. (L10)
///
/// A flow is `u_r e_r + u_θ e_θ + u_z e_z`. Of harmonic `m` and the first kind it is `(u_r cos mθ, u_θ sin mθ, u_z cos mθ)`, of the
/// second `(u_r sin mθ, −u_θ cos mθ, u_z sin mθ)`; harmonic 0 has the first kind only, without factors. Its parts are
/// `u_r + u_θ`, `u_r − u_θ` and `u_z`, which turn `m+1`, `|m−1|` and `m` times round the axis in space.
pub(super) struct Layout {
    /// The highest harmonic.
    pub most: usize,
    /// Unknowns of what does not turn round the axis, and of what does.
    pub counts: [usize; 2],
}

impl Layout {
    /// How often the parts of a harmonic turn round the axis.
    pub fn turns(m: usize) -> [usize; 3] {
        [m + 1, m.abs_diff(1), m]
    }

    /// Factors of the squares of the parts in the integral over a turn.
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

    /// Size of a part that turns `k` times.
    pub fn count(&self, k: usize) -> usize {
        self.counts[usize::from(k > 0)]
    }

    /// Size of a family.
    pub fn width(&self, m: usize) -> usize {
        Self::turns(m).iter().map(|k| self.count(*k)).sum()
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
        Self::turns(m).map(|k| {
            let own = start..start + self.count(k);
            start = own.end;
            own
        })
    }
}
