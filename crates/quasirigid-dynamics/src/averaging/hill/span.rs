use super::coefficients::{coupled, softening};
use crate::averaging::loaded_modes::loads;
use crate::math::eigen::NoConvergence;
use crate::math::krylov::Pencil;
use crate::math::span::Span;
use crate::math::sym3::Sym;
use crate::model::{FlexibleBody, Principal};

/// Number of lowest vibrations kept, excited or not.
const LOWEST: usize = 12;

/// Vectors that span the response of a body of many coordinates: its lowest vibrations; the static responses to the loads; the responses
/// to mass, damping, material, Coriolis' and centrifugal forces of these, the second power of spin over elastic frequency; and those to
/// mass, damping and material forces once more. (H9)
///
/// # Errors
/// [`NoConvergence`] if the lowest vibrations are not found.
pub(super) fn span(body: &FlexibleBody, principal: &Principal) -> Result<Span, NoConvergence> {
    let softened = |mut x: Vec<f64>| {
        body.solve_stiffness(&mut x, 1);
        x
    };
    let loads: Vec<Sym> = loads(body, principal);
    let first: Vec<Vec<f64>> = (0..6).map(|i| softened(loads.iter().map(|load| load[i]).collect())).collect();
    let heavy = |x: &Vec<f64>| {
        let materials = body.viscoelastic().iter().map(|part| part.stiffness.times(x));
        let images = [body.recoiling_mass_times(x), body.damping().times(x)].into_iter().chain(materials);
        images.map(softened).collect::<Vec<_>>()
    };
    let turning = |x: &Vec<f64>| {
        let coriolis = principal.axes.map(|axis| coupled(body, axis, x));
        let axes = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];
        let centrifugal = axes.map(|[a, b]| softening(body, [principal.axes[a], principal.axes[b]], 1.0, x));
        coriolis.into_iter().chain(centrifugal).map(softened).collect::<Vec<_>>()
    };
    let second: Vec<Vec<f64>> = first.iter().flat_map(heavy).collect();
    let beside: Vec<Vec<f64>> = first.iter().flat_map(turning).collect();
    let third: Vec<Vec<f64>> = second.iter().flat_map(heavy).collect();
    let mut vectors = [first, lowest(body)?, second, third, beside].concat();
    vectors.iter_mut().for_each(|x| scaled(body, x));
    Ok(Span::orthonormal(vectors, |x| body.stiffness().times(x)))
}

/// The lowest vibrations, the body free to recoil.
fn lowest(body: &FlexibleBody) -> Result<Vec<Vec<f64>>, NoConvergence> {
    let n = body.elastic();
    let whole = |x: &[f64]| {
        let mut all = x.to_vec();
        all.resize(body.coordinates().len(), 0.0);
        all
    };
    let part = |mut all: Vec<f64>| {
        all.truncate(n);
        all
    };
    let pencil = Pencil {
        size: n,
        stiffness: &|x| part(body.stiffness().times(&whole(x))),
        solve: &|x| {
            let mut all = whole(x);
            body.solve_stiffness(&mut all, 1);
            x.copy_from_slice(&all[..n]);
        },
        mass: &|x| part(body.recoiling_mass_times(&whole(x))),
    };
    Ok(pencil.largest(LOWEST.min(n))?.iter().map(|x| whole(x)).collect())
}

/// Scales a vector to unit elastic energy, so that its remainder beside others is measured against itself.
fn scaled(body: &FlexibleBody, x: &mut [f64]) {
    let energy = body.stiffness().quadratic(x);
    if energy > 0.0 {
        let size = energy.sqrt();
        x.iter_mut().for_each(|entry| *entry /= size);
    }
}
