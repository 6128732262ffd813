use super::Matrix12;
use super::element::Beam;
use super::interpolation::Row;

impl Beam {
    /// Stiffness matrix `K`, in the axes of the body: the six motions of a rigid beam cost no energy, and each of its six strains is a
    /// spring of its own,
    ///
    /// ```text
    /// K = EA/L eᵀe + GJ/L wᵀw + Σ [EI/L sᵀs + 3EI/(L(1 + φ)) aᵀa]
    /// ```
    ///
    /// with the stretch `e`, the twist `w`, and the even and odd bending `s` and `a` of each principal plane.
    pub fn stiffness(&self) -> Matrix12 {
        self.springs().iter().map(|(strain, stiffness)| *stiffness * strain.transpose() * strain).sum()
    }

    /// The six strains and their stiffness: stretch, twist, and the even and odd bending of both planes.
    pub(super) fn springs(&self) -> [(Row, f64); 6] {
        let [y, z] = self.planes();
        let [even_y, even_z] = [&y, &z].map(|plane| plane.stiffness / self.length);
        let [odd_y, odd_z] = [&y, &z].map(|plane| 3.0 * plane.stiffness / (self.length * (1.0 + plane.phi)));
        [
            (self.stretch(), self.young * self.section.area / self.length),
            (self.twist(), self.shear * self.section.torsion / self.length),
            (y.even, even_y),
            (y.odd, odd_y),
            (z.even, even_z),
            (z.odd, odd_z),
        ]
    }
}
