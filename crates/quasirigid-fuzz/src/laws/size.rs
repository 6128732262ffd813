//! Bodies that are built within the time of an execution. Counts that no machine has room for are let through: they must be refused.

use quasirigid::elements::{Assembly, CavityShape, PartKind};

/// Most coordinates of a body that is reduced.
pub const COORDINATES: usize = 48;
/// Most points, springs and other elements.
const ELEMENTS: usize = 200;
/// Most nodes of a mesh.
const NODES: usize = 400;
/// Most cells across a cavity, degree of its polynomials, and the number of cells across that is too many for any machine.
const RESOLUTION: [usize; 2] = [6, 900];
/// Cells across the narrowest width of a cavity of finite elements, its longest width over the narrowest, and the ratio that is too large
/// for any machine.
const ACROSS: usize = 2;
const SLENDER: [f64; 2] = [3.0, 1e5];
/// Degree of the polynomials in a surface, and its cells.
const DEGREE: usize = 6;
/// Elements of a member.
const MEMBER: usize = 40;

/// Whether an execution has time for the body.
pub fn is_small(assembly: &Assembly) -> bool {
    let counts =
        [assembly.points.len(), assembly.springs.len(), assembly.bushings.len(), assembly.hinged.len()];
    let modal: usize = assembly.appendages.iter().map(|appendage| appendage.modes.len()).sum();
    let inside =
        [assembly.rotors.len(), assembly.wheels.len(), assembly.cavities.len(), assembly.forces.len()];
    counts.into_iter().chain(inside).sum::<usize>() + modal <= ELEMENTS
        && assembly.cavities.len() <= 4
        && assembly.tanks.len() + assembly.tubes.len() <= 2
        && assembly.parts.len() <= 8
        && assembly.parts.iter().all(|part| is_small_part(&part.kind))
        && assembly.cavities.iter().all(|cavity| is_small_cavity(&cavity.shape, cavity.resolution))
        && assembly.surfaces.iter().all(|surface| {
            surface.surface.triangles().len() <= NODES
                && surface.degree.is_some_and(|degree| degree <= DEGREE)
                && surface.cells.is_none_or(|cells| cells <= NODES || cells >= 1_000_000_000)
        })
        && assembly.reduction.modes <= COORDINATES
}

fn is_small_cavity(shape: &CavityShape, resolution: usize) -> bool {
    let ratio = |sides: &mut dyn Iterator<Item = f64>| {
        let [low, high] =
            sides.fold([f64::INFINITY, 0.0], |[low, high], side| [side.min(low), side.max(high)]);
        resolution <= ACROSS && high <= SLENDER[0] * low || high >= SLENDER[1] * low
    };
    match shape {
        CavityShape::Mesh(mesh) => mesh.nodes.len() <= NODES,
        CavityShape::Cuboid { sides } => ratio(&mut sides.iter().copied()),
        CavityShape::Shell { outer, inner } => {
            let gaps = outer.iter().zip(inner).map(|(outer, inner)| outer - inner);
            ratio(&mut outer.iter().copied().chain(gaps))
        }
        _ => resolution <= RESOLUTION[0] || resolution >= RESOLUTION[1],
    }
}

fn is_small_part(kind: &PartKind) -> bool {
    match kind {
        PartKind::Solid(solid) => solid.mesh.nodes.len() <= NODES,
        PartKind::Mixed(mixed) => mixed.mesh.nodes.len() <= NODES,
        PartKind::Panel(panel) => panel.mesh.nodes.len() <= NODES,
        PartKind::Frame(frame) => frame.members.iter().all(|member| member.elements <= MEMBER),
        _ => true,
    }
}
