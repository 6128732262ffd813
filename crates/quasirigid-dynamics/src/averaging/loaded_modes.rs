//! Modal basis of the response to a free rotation: vibrations, relaxations and liquids, with their loads.
//! Large bodies are projected on the static responses to the loads and their images under mass and damping, exact to the second power of
//! the frequency, instead of on their lowest modes, most of which no load excites.
//! Equations (G5) and (G6), docs/theory/11-materials.md; (C7), docs/theory/13-inside.md.

use crate::math::eigen::{Dense, NoConvergence, modes};
use crate::math::span::{Span, largest};
use crate::math::sym3::{self, Sym};
use crate::math::vec3;
use crate::model::{FlexibleBody, LiquidMemory, Principal};

/// Row of the modal basis: an elastic mode or a relaxation of unit modal mass, or a liquid that rotates about an axis.
#[derive(Clone, Debug)]
pub(super) struct LoadedMode {
    /// Square of its frequency (rad²/s²); zero of a relaxation or a liquid.
    pub square: f64,
    /// Share of each coordinate; none of a liquid whose force at a frequency is known.
    pub shape: Vec<f64>,
    /// Angular momentum per unit rate.
    pub h: [f64; 3],
    /// Load by xx, yy, zz, yz, zx, xy.
    pub load: Sym,
    /// Coordinate with the largest share.
    pub name: String,
}

/// Loaded modes of a body: vibrations, relaxations, liquids, in this order.
///
/// # Errors
/// [`NoConvergence`] if the eigenvalue solver fails.
pub(super) fn loaded_modes(
    body: &FlexibleBody,
    principal: &Principal,
    whole: usize,
) -> Result<Vec<LoadedMode>, NoConvergence> {
    loaded_modes_in(body, principal, |loads| (body.elastic() > whole).then(|| excited(body, loads)))
}

/// Loaded modes with the vibrations in a span of the elastic coordinates, made from the loads; without a span, all vibrations.
///
/// # Errors
/// [`NoConvergence`] if the eigenvalue solver fails.
pub(super) fn loaded_modes_in(
    body: &FlexibleBody,
    principal: &Principal,
    span: impl Fn(&[Sym]) -> Option<Span>,
) -> Result<Vec<LoadedMode>, NoConvergence> {
    let loads = loads(body, principal);
    let row = |Shape { square, x }: Shape| {
        let h = body.invariants().h.iter().zip(&x);
        LoadedMode {
            square,
            h: h.fold([0.0; 3], |sum, (h, x)| vec3::add(sum, vec3::scale(*x, *h))),
            load: loads.iter().zip(&x).fold([0.0; 6], |mut sum, (load, x)| {
                sum.iter_mut().zip(load).for_each(|(sum, load)| *sum += x * load);
                sum
            }),
            name: largest(&x).map_or_else(String::new, |row| body.coordinates()[row].name.clone()),
            shape: x,
        }
    };
    let vibrations = vibrations(body, span(&loads))?;
    let mut rows: Vec<LoadedMode> = vibrations.into_iter().chain(relaxations(body)?).map(row).collect();
    rows.extend(body.memories().iter().flat_map(|memory| liquid(body, principal, memory)));
    Ok(rows)
}

/// Rows of a liquid, one per axis of rotation.
fn liquid(body: &FlexibleBody, principal: &Principal, memory: &LiquidMemory) -> Vec<LoadedMode> {
    let row = |axis: &[f64; 3]| {
        let h = vec3::scale(memory.inertia, *axis);
        LoadedMode {
            square: 0.0,
            shape: vec![0.0; body.coordinates().len()],
            h,
            load: load(principal, [0.0; 6], h),
            name: body.coordinates()[memory.coordinates.start].name.clone(),
        }
    };
    memory.axes.iter().map(row).collect()
}

/// Loads of a free rotation on each coordinate. (G5)
pub(super) fn loads(body: &FlexibleBody, principal: &Principal) -> Vec<Sym> {
    let invariants = body.invariants();
    invariants.J1.iter().zip(&invariants.h).map(|(J, h)| load(principal, *J, *h)).collect()
}

/// Load by the products xx, yy, zz, yz, zx, xy of the angular velocity in principal axes: `½ω·J_jω − h_j·ω̇` with Euler's `ω̇`. (G5)
fn load(principal: &Principal, J: Sym, h: [f64; 3]) -> Sym {
    let Principal { moments: [I1, I2, I3], axes } = principal;
    let euler = [(I2 - I3) / I1, (I3 - I1) / I2, (I1 - I2) / I3];
    let turned = axes.map(|axis| sym3::times(J, axis));
    let entry = |a: usize, b: usize| vec3::dot(axes[a], turned[b]);
    let recoil = [0, 1, 2].map(|i| euler[i] * vec3::dot(axes[i], h));
    [
        0.5 * entry(0, 0),
        0.5 * entry(1, 1),
        0.5 * entry(2, 2),
        entry(1, 2) - recoil[0],
        entry(2, 0) - recoil[1],
        entry(0, 1) - recoil[2],
    ]
}

/// A mode as a vector over all coordinates, with the square of its frequency.
struct Shape {
    square: f64,
    x: Vec<f64>,
}

/// Elastic modes with internal rotors and liquids locked: all, or those of a span.
fn vibrations(body: &FlexibleBody, span: Option<Span>) -> Result<Vec<Shape>, NoConvergence> {
    let elastic = 0..body.elastic();
    let (A, C) = match &span {
        None => (
            body.recoiling_mass_matrix().block(elastic.clone()),
            Dense::of(&body.stiffness().block(elastic.clone())),
        ),
        Some(span) => {
            (span.projected(|x| body.recoiling_mass_times(x)), span.projected(|x| body.stiffness().times(x)))
        }
    };
    let found = modes(&A, &C)?;
    let shape = |(mode, frequency): (usize, &f64)| {
        let shares: Vec<f64> = (0..A.size()).map(|row| found.shapes.at(row, mode)).collect();
        let mut x = span.as_ref().map_or(shares.clone(), |span| span.combined(&shares));
        x.resize(body.coordinates().len(), 0.0);
        Shape { square: frequency * frequency, x }
    };
    Ok(found.frequencies.iter().enumerate().map(shape).collect())
}

/// Relaxations of the cyclic coordinates, elastic ones fixed and the body free to recoil, without those of liquids that have rows of
/// their own. (C7)
fn relaxations(body: &FlexibleBody) -> Result<Vec<Shape>, NoConvergence> {
    let known = |j: &usize| body.memories().iter().any(|memory| memory.coordinates.contains(j));
    let cyclic = body.cyclic();
    let free: Vec<usize> = cyclic.clone().filter(|j| !known(j)).map(|j| j - cyclic.start).collect();
    let (mass, friction) = (body.recoiling_cyclic_mass(), Dense::of(&body.damping().block(cyclic.clone())));
    let part = |matrix: &Dense| {
        let mut part = Dense::zero(free.len());
        for (row, j) in free.iter().enumerate() {
            free.iter().enumerate().for_each(|(column, k)| part.add(row, column, matrix.at(*j, *k)));
        }
        part
    };
    let found = modes(&part(&mass), &part(&friction))?;
    let shape = |mode: usize| {
        let mut x = vec![0.0; body.coordinates().len()];
        free.iter().enumerate().for_each(|(row, j)| x[cyclic.start + j] = found.shapes.at(row, mode));
        Shape { square: 0.0, x }
    };
    Ok((0..free.len()).map(shape).collect())
}

/// Vectors that span the response to the loads up to the second power of the frequency.
fn excited(body: &FlexibleBody, loads: &[Sym]) -> Span {
    let softened = |mut x: Vec<f64>| {
        body.solve_stiffness(&mut x, 1);
        x
    };
    let first: Vec<Vec<f64>> = (0..6).map(|i| softened(loads.iter().map(|load| load[i]).collect())).collect();
    let after = |x: &Vec<f64>| {
        let mass = std::iter::once(body.recoiling_mass_times(x));
        let damping = std::iter::once(body.damping().times(x));
        let materials = body.viscoelastic().iter().map(|part| part.stiffness.times(x));
        mass.chain(damping).chain(materials).map(softened).collect::<Vec<_>>()
    };
    let second: Vec<Vec<f64>> = first.iter().flat_map(after).collect();
    let third: Vec<Vec<f64>> = second.iter().flat_map(after).collect();
    Span::orthonormal([first, second, third].concat(), |x| body.stiffness().times(x))
}
