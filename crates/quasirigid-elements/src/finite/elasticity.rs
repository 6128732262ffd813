//! Elasticity matrix: isotropic and orthotropic materials in any axes.
//! A material that would release energy is refused with the inequality that fails, since its stiffness would not be positive.
//! Bounds of Poisson's ratios after Lempriere `[@lempriere1968]`.

use nalgebra::{Matrix3, Matrix6};
use thiserror::Error;

/// Engineering constants of a material with three planes of symmetry, in its own axes 1, 2, 3.
///
/// `ν_ij` is the shortening along `j` per lengthening along `i` under tension along `i`; `ν_ji / E_j = ν_ij / E_i`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Orthotropic {
    /// Young's moduli (Pa) along 1, 2, 3.
    pub young: [f64; 3],
    /// Poisson's ratios `ν₁₂`, `ν₁₃`, `ν₂₃`.
    pub poisson: [f64; 3],
    /// Shear moduli (Pa) `G₁₂`, `G₁₃`, `G₂₃`.
    pub shear: [f64; 3],
}

/// Axes that a Poisson's ratio or a shear modulus joins.
const PAIRS: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];
/// Place of each pair of axes among xx yy zz yz zx xy.
pub(super) const VOIGT: [[usize; 3]; 3] = [[0, 5, 4], [5, 1, 3], [4, 3, 2]];

/// Error of elastic constants that describe no material.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum ElasticityError {
    /// A modulus that is not positive and finite.
    #[error("{} = {value} Pa; a modulus is positive", name(*modulus))]
    Modulus {
        /// The modulus.
        modulus: Modulus,
        /// Value given.
        value: f64,
    },
    /// A Poisson's ratio of an isotropic material outside −1 to ½.
    #[error("Poisson's ratio {value} is not above -1 and below 0.5, as in every stable isotropic material")]
    Poisson {
        /// Value given.
        value: f64,
    },
    /// A Poisson's ratio of two axes that is too large for their moduli.
    #[error("nu{0}{1} = {value}, but it must be below sqrt(E{0}/E{1}) = {limit:.4} in size; are the indices swapped?", axes[0] + 1, axes[1] + 1)]
    PoissonOfPair {
        /// Axes, from 0.
        axes: [usize; 2],
        /// The ratio.
        value: f64,
        /// The bound.
        limit: f64,
    },
    /// Poisson's ratios that are too large together.
    #[error(
        "1 - nu12 nu21 - nu23 nu32 - nu31 nu13 - 2 nu21 nu32 nu13 = {value:.4} must be positive; Poisson's ratios are too large together"
    )]
    PoissonTogether {
        /// Value of the expression.
        value: f64,
    },
    /// Axes that are not a rotation.
    #[error(
        "the material axes are not three unit vectors at right angles in right-handed order: they are off by {departure:.1e}"
    )]
    Axes {
        /// Largest entry of `RᵀR − 1`, or 2 if they are left-handed.
        departure: f64,
    },
}

/// A modulus of elasticity; axes count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Modulus {
    /// Young's modulus of an isotropic material.
    Young,
    /// Young's modulus along an axis.
    YoungAlong(usize),
    /// Shear modulus between two axes.
    Shear([usize; 2]),
}

/// Departure of material axes from right angles up to which they are square: rounding of the digits in a file.
const SQUARE: f64 = 1e-9;

/// Elasticity (Pa) of an isotropic material: `σ = λ tr ε + 2μ ε`, over xx yy zz yz zx xy with engineering shears.
///
/// # Errors
/// [`ElasticityError::Modulus`] and [`ElasticityError::Poisson`].
pub(crate) fn isotropic(young: f64, poisson: f64) -> Result<Matrix6<f64>, ElasticityError> {
    positive(Modulus::Young, young)?;
    if !(poisson > -1.0 && poisson < 0.5) {
        return Err(ElasticityError::Poisson { value: poisson });
    }
    let shear = young / (2.0 * (1.0 + poisson));
    let lame = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
    Ok(Matrix6::from_fn(|row, column| match (row, column) {
        (0..3, 0..3) if row == column => lame + 2.0 * shear,
        (0..3, 0..3) => lame,
        _ if row == column => shear,
        _ => 0.0,
    }))
}

/// Elasticity (Pa) of an orthotropic material whose axes 1, 2, 3 are the columns of `R_BM`, over xx yy zz yz zx xy of
/// the axes B with engineering shears.
///
/// The compliance in the axes of the material has `1/E_i` on its diagonal, `−ν_ij/E_i` beside it and `1/G_ij` for
/// shears; its inverse transforms as a tensor of fourth order, `C_ijkl = R_ip R_jq R_kr R_ls C_pqrs`.
///
/// # Errors
/// [`ElasticityError`] names the inequality that fails; together they are those of a positive definite elasticity
/// `[@lempriere1968]`.
pub(crate) fn orthotropic(
    constants: &Orthotropic,
    R_BM: &Matrix3<f64>,
) -> Result<Matrix6<f64>, ElasticityError> {
    constants.check()?;
    let square = (R_BM.transpose() * R_BM - Matrix3::identity()).amax();
    let departure = if R_BM.determinant() < 0.0 { 2.0 } else { square };
    if !(departure <= SQUARE) {
        return Err(ElasticityError::Axes { departure });
    }
    let turn = turn(R_BM);
    Ok(turn * constants.elasticity() * turn.transpose())
}

impl Orthotropic {
    fn check(&self) -> Result<(), ElasticityError> {
        for axis in 0..3 {
            positive(Modulus::YoungAlong(axis), self.young[axis])?;
        }
        for (pair, axes) in PAIRS.into_iter().enumerate() {
            positive(Modulus::Shear(axes), self.shear[pair])?;
            let (value, limit) = (self.poisson[pair], (self.young[axes[0]] / self.young[axes[1]]).sqrt());
            if !(value.abs() < limit) {
                return Err(ElasticityError::PoissonOfPair { axes, value, limit });
            }
        }
        let [nu12, nu13, nu23] = self.poisson;
        let [nu21, nu31, nu32] = [0, 1, 2]
            .map(|pair| self.poisson[pair] * self.young[PAIRS[pair][1]] / self.young[PAIRS[pair][0]]);
        let value = 1.0 - nu12 * nu21 - nu23 * nu32 - nu31 * nu13 - 2.0 * nu21 * nu32 * nu13;
        if !(value > 0.0) {
            return Err(ElasticityError::PoissonTogether { value });
        }
        Ok(())
    }

    /// Elasticity in the axes of the material, by the inverse of its compliance in closed form.
    fn elasticity(&self) -> Matrix6<f64> {
        let mut compliance =
            Matrix3::from_diagonal(&nalgebra::Vector3::from(self.young.map(|young| 1.0 / young)));
        let mut elasticity = Matrix6::zeros();
        for (pair, [i, j]) in PAIRS.into_iter().enumerate() {
            compliance[(i, j)] = -self.poisson[pair] / self.young[i];
            compliance[(j, i)] = compliance[(i, j)];
            let shear = VOIGT[i][j];
            elasticity[(shear, shear)] = self.shear[pair];
        }
        // The inequalities of `check` leave a positive determinant; rounding may still lose it.
        let straight = compliance.try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN));
        elasticity.fixed_view_mut::<3, 3>(0, 0).copy_from(&straight);
        elasticity
    }
}

/// Matrix of the rotation `R σ Rᵀ` of stresses over xx yy zz yz zx xy.
fn turn(R: &Matrix3<f64>) -> Matrix6<f64> {
    let mut turn = Matrix6::zeros();
    for (i, j) in [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)] {
        for k in 0..3 {
            for l in 0..3 {
                turn[(VOIGT[i][j], VOIGT[k][l])] += R[(i, k)] * R[(j, l)];
            }
        }
    }
    turn
}

fn positive(modulus: Modulus, value: f64) -> Result<(), ElasticityError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(ElasticityError::Modulus { modulus, value }) }
}

fn name(modulus: Modulus) -> String {
    match modulus {
        Modulus::Young => "E".into(),
        Modulus::YoungAlong(axis) => format!("E{}", axis + 1),
        Modulus::Shear([i, j]) => format!("G{}{}", i + 1, j + 1),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector3, Vector6};

    use super::*;

    /// Carbon fibres in epoxy, along 1.
    const CARBON: Orthotropic =
        Orthotropic { young: [140e9, 10e9, 9e9], poisson: [0.3, 0.25, 0.45], shear: [5e9, 4.5e9, 3.3e9] };

    fn turned() -> Matrix3<f64> {
        *Rotation3::from_scaled_axis(Vector3::new(0.4, -1.1, 0.7)).matrix()
    }

    #[test]
    fn tension_along_a_turned_axis_shows_its_constants() {
        let R = turned();
        let compliance = orthotropic(&CARBON, &R).unwrap().try_inverse().unwrap();
        for (axis, [across, thrice]) in [[1, 2], [0, 2], [0, 1]].into_iter().enumerate() {
            let n = R.column(axis);
            let stress = n * n.transpose();
            let voigt = Vector6::new(
                stress[(0, 0)],
                stress[(1, 1)],
                stress[(2, 2)],
                stress[(1, 2)],
                stress[(2, 0)],
                stress[(0, 1)],
            );
            let [xx, yy, zz, yz, zx, xy] = (compliance * voigt).into();
            let half = 0.5;
            let strain =
                Matrix3::new(xx, half * xy, half * zx, half * xy, yy, half * yz, half * zx, half * yz, zz);
            let along = |axis: usize| R.column(axis).dot(&(strain * R.column(axis)));
            let close =
                |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
            close(along(axis), 1.0 / CARBON.young[axis]);
            // ν_ji / E_j = ν_ij / E_i
            let ratio = |i: usize, j: usize| CARBON.poisson[i + j - 1] / CARBON.young[i.min(j)];
            close(along(across), -ratio(axis, across));
            close(along(thrice), -ratio(axis, thrice));
        }
    }

    #[test]
    fn shear_in_a_turned_plane_shows_its_modulus() {
        let R = turned();
        let D = orthotropic(&CARBON, &R).unwrap();
        for (pair, [i, j]) in PAIRS.into_iter().enumerate() {
            let strain =
                0.5 * (R.column(i) * R.column(j).transpose() + R.column(j) * R.column(i).transpose());
            let voigt = Vector6::new(
                strain[(0, 0)],
                strain[(1, 1)],
                strain[(2, 2)],
                2.0 * strain[(1, 2)],
                2.0 * strain[(2, 0)],
                2.0 * strain[(0, 1)],
            );
            let energy = voigt.dot(&(D * voigt));
            assert!((energy / CARBON.shear[pair] - 1.0).abs() < 1e-12, "{energy}");
        }
    }

    #[test]
    fn equal_constants_are_isotropic_in_any_axes() {
        let (young, poisson) = (7e10, 0.33);
        let shear = young / (2.0 * (1.0 + poisson));
        let equal = Orthotropic { young: [young; 3], poisson: [poisson; 3], shear: [shear; 3] };
        let D = isotropic(young, poisson).unwrap();
        assert!((orthotropic(&equal, &turned()).unwrap() - D).amax() < 1e-13 * D.amax());
        // Compression on all sides: 3K = E / (1 − 2ν); shear alone: G.
        let [xx, ..]: [f64; 6] = (D * Vector6::new(1.0, 1.0, 1.0, 0.0, 0.0, 0.0)).into();
        assert!((xx * (1.0 - 2.0 * poisson) / young - 1.0).abs() < 1e-13 && D[(4, 4)] == shear);
    }

    #[test]
    fn each_inequality_is_named_on_both_sides_of_its_line() {
        let R = turned();
        let with = |change: fn(&mut Orthotropic, f64), value: f64| {
            let mut constants = CARBON;
            change(&mut constants, value);
            orthotropic(&constants, &R)
        };
        let positive = |found: Result<Matrix6<f64>, ElasticityError>| found.unwrap().cholesky().is_some();
        let limit = 14.0_f64.sqrt();
        let nu12 = |constants: &mut Orthotropic, value| {
            constants.poisson = [value, 0.0, 0.0];
        };
        assert!(positive(with(nu12, 0.999 * limit)) && positive(with(nu12, -0.999 * limit)));
        let error = with(nu12, 1.001 * limit).unwrap_err();
        assert!(matches!(error, ElasticityError::PoissonOfPair { axes: [0, 1], .. }), "{error}");
        // With equal moduli and ratios the three are too large together beyond one half.
        let all = |constants: &mut Orthotropic, value| {
            constants.young = [1e9; 3];
            constants.poisson = [value; 3];
        };
        assert!(positive(with(all, 0.4999)));
        assert!(matches!(with(all, 0.5001), Err(ElasticityError::PoissonTogether { .. })));
        let shear = |constants: &mut Orthotropic, value| constants.shear[1] = value;
        let error = with(shear, 0.0).unwrap_err();
        assert_eq!(error.to_string(), "G13 = 0 Pa; a modulus is positive");
        let young = |constants: &mut Orthotropic, value| constants.young[2] = value;
        assert!(with(young, f64::NAN).is_err() && with(young, f64::INFINITY).is_err());
        assert_eq!(isotropic(1.0, 0.5), Err(ElasticityError::Poisson { value: 0.5 }));
        assert!(isotropic(1.0, 0.499_999).is_ok() && isotropic(1.0, -0.999).is_ok());
        assert!(isotropic(1.0, -1.0).is_err() && isotropic(-1.0, 0.3).is_err());
    }

    #[test]
    fn axes_must_be_a_rotation() {
        let off = |by: f64| orthotropic(&CARBON, &(turned() * (1.0 + by)));
        assert!(off(0.4e-9).is_ok() && off(0.6e-9).is_err());
        let left = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
        assert_eq!(orthotropic(&CARBON, &left), Err(ElasticityError::Axes { departure: 2.0 }));
    }
}
