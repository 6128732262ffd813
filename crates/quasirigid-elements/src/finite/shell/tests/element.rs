//! Laws of one element, anywhere in space.

use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Vector3};
use proptest::prelude::*;

use super::super::{Ply, ShellError, ShellSection, geometric, mass, stiffness};
use super::grid::SHAPES;
use quasirigid_mesh::Shape;

/// Carbon fibre in four directions, unsymmetric and off the nodes: every entry of A, B, D is there.
pub fn laminate(thickness: f64) -> ShellSection {
    ShellSection::laminate(&plies(thickness), 0.2 * thickness).unwrap()
}

fn plies(thickness: f64) -> Vec<Ply> {
    let layer = |(share, angle): (f64, f64)| Ply {
        young: [140e9, 9e9],
        poisson: 0.3,
        shear: [5e9, 4.5e9, 3e9],
        density: 1550.0,
        thickness: share * thickness,
        angle,
    };
    [(0.4, 0.2), (0.1, -0.9), (0.2, 1.4), (0.3, 0.6)].map(layer).to_vec()
}

const REFERENCE: Vector3<f64> = Vector3::new(0.4, 0.7, -0.3);

/// Rotation vectors and corners of a square moved by up to 0.3 along each axis, far from the origin.
fn placed(turn: [f64; 3], shifts: [[f64; 3]; 4], shape: Shape, unit: f64) -> Vec<Vector3<f64>> {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let place = |(corner, shift): (&[f64; 2], &[f64; 3])| {
        let local = Vector3::new(corner[0] + shift[0], corner[1] + shift[1], shift[2]);
        unit * (Rotation3::new(turn.into()) * local + Vector3::new(2.0, -3.0, 1.5))
    };
    corners.iter().zip(&shifts).map(place).take(shape.nodes()).collect()
}

fn skew(shape: Shape) -> Vec<Vector3<f64>> {
    let shifts = [[0.1, -0.2, 0.15], [0.2, 0.0, -0.1], [-0.1, 0.25, 0.2], [0.05, -0.1, -0.05]];
    placed([0.4, -1.1, 0.7], shifts, shape, 1.0)
}

/// A translation and a rotation of the whole.
pub fn rigid(nodes: &[Vector3<f64>], translation: Vector3<f64>, rotation: Vector3<f64>) -> DVector<f64> {
    let moved = nodes.iter().flat_map(|node| {
        let shift = translation + rotation.cross(node);
        [shift.x, shift.y, shift.z, rotation.x, rotation.y, rotation.z]
    });
    DVector::from_iterator(6 * nodes.len(), moved)
}

fn motions(nodes: &[Vector3<f64>]) -> Vec<DVector<f64>> {
    let unit = |axis: usize| Vector3::ith(axis, 1.0);
    let zero = Vector3::zeros();
    (0..6)
        .map(|i| if i < 3 { rigid(nodes, unit(i), zero) } else { rigid(nodes, zero, unit(i - 3)) })
        .collect()
}

fn shift() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(-0.2..0.2)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Warped quadrilaterals and triangles in any position and unit; forces are compared with those of
    /// moving one node alone as far.
    #[test]
    fn a_rigid_motion_meets_no_force(
        turn in prop::array::uniform3(-2.0..2.0), shifts in prop::array::uniform4(shift()), power in -3..4i32,
    ) {
        let unit = 10f64.powi(power);
        for shape in SHAPES {
            let nodes = placed(turn, shifts, shape, unit);
            let K = stiffness(shape, &nodes, REFERENCE, &laminate(0.01 * unit)).unwrap();
            for motion in motions(&nodes) {
                let force = &K * &motion;
                prop_assert!(force.amax() <= 1e-12 * K.amax() * motion.amax(), "{force}");
            }
        }
    }

    /// Axes of the body, and the node with which the list begins, are the user's choice.
    #[test]
    fn stiffness_and_mass_turn_with_the_body(
        turn in prop::array::uniform3(-2.0..2.0), shifts in prop::array::uniform4(shift()), start in 0usize..4,
    ) {
        for shape in SHAPES {
            let nodes = placed([0.0; 3], shifts, shape, 1.0);
            let rotation = Rotation3::new(turn.into());
            let mut turned: Vec<Vector3<f64>> = nodes.iter().map(|node| rotation * node).collect();
            let count = nodes.len();
            turned.rotate_left(start % count);
            let mut R = DMatrix::zeros(6 * count, 6 * count);
            for i in 0..count {
                let new = (i + count - start % count) % count;
                for half in [0, 3] {
                    R.fixed_view_mut::<3, 3>(6 * new + half, 6 * i + half).copy_from(rotation.matrix());
                }
            }
            let section = laminate(0.05);
            let u = DVector::from_fn(6 * count, |i, _| (1.7 * i as f64).sin());
            let pairs = [
                (
                    stiffness(shape, &nodes, REFERENCE, &section),
                    stiffness(shape, &turned, rotation * REFERENCE, &section),
                ),
                (mass(shape, &nodes, &section), mass(shape, &turned, &section)),
                (
                    geometric(shape, &nodes, REFERENCE, &section, &u),
                    geometric(shape, &turned, rotation * REFERENCE, &section, &(&R * &u)),
                ),
            ];
            for (here, there) in pairs {
                let (here, there) = (&R * here.unwrap() * R.transpose(), there.unwrap());
                prop_assert!((&here - &there).amax() <= 1e-11 * there.amax());
            }
        }
    }
}

#[test]
fn an_element_has_six_free_motions_and_no_more() {
    for shape in SHAPES {
        for thickness in [0.3, 3e-3] {
            let nodes = skew(shape);
            let K = stiffness(shape, &nodes, REFERENCE, &laminate(thickness)).unwrap();
            assert!((&K - K.transpose()).amax() <= 1e-14 * K.amax());
            let mut values: Vec<f64> = K.clone().symmetric_eigenvalues().iter().copied().collect();
            values.sort_by(f64::total_cmp);
            // The weakest of the others bends: it goes with the square of the thickness.
            let weakest = 1e-4 * thickness * thickness * K.amax();
            assert!(values[5].abs() < 1e-2 * weakest, "{values:?}");
            assert!(values[6] > weakest, "{shape} {thickness}: {values:?}");
        }
    }
}

#[test]
fn stiffness_and_mass_of_layers_add() {
    let layers = ShellSection::layers(&plies(0.02), 0.004).unwrap();
    for shape in SHAPES {
        let nodes = skew(shape);
        let whole = stiffness(shape, &nodes, REFERENCE, &laminate(0.02)).unwrap();
        let parts: DMatrix<f64> =
            layers.iter().map(|layer| stiffness(shape, &nodes, REFERENCE, layer).unwrap()).sum();
        assert!((&whole - parts).amax() <= 1e-13 * whole.amax());
        let whole = mass(shape, &nodes, &laminate(0.02)).unwrap();
        let parts: DMatrix<f64> = layers.iter().map(|layer| mass(shape, &nodes, layer).unwrap()).sum();
        assert!((&whole - parts).amax() <= 1e-13 * whole.amax());
    }
}

#[test]
fn turning_the_fibres_is_turning_the_reference() {
    for shape in SHAPES {
        let nodes: Vec<_> = skew(shape).iter().map(|node| Vector3::new(node.x, node.y, 0.0)).collect();
        let ply = |angle: f64| Ply { angle, ..plies(0.02)[0] };
        let section = |angle: f64| ShellSection::laminate(&[ply(angle)], 0.01).unwrap();
        let reference = |angle: f64| Vector3::new(angle.cos(), angle.sin(), 0.6);
        // Counter-clockwise about the normal, which looks down where the nodes run clockwise.
        let up = (nodes[1] - nodes[0]).cross(&(nodes[2] - nodes[0])).z.signum();
        let fibres = stiffness(shape, &nodes, reference(0.3), &section(0.5)).unwrap();
        let turned = stiffness(shape, &nodes, reference(0.3 + 0.5 * up), &section(0.0)).unwrap();
        assert!((&fibres - turned).amax() <= 1e-13 * fibres.amax());
        let unturned = stiffness(shape, &nodes, reference(0.3), &section(0.0)).unwrap();
        assert!((&fibres - unturned).amax() > 0.1 * fibres.amax());
    }
}

/// `∫ x xᵀ dA` of a triangle is `A/12 (Σ x_i x_iᵀ + s sᵀ)` with `s = Σ x_i`; layers lie at their heights along the
/// normal.
#[test]
fn rigid_motions_have_the_inertia_of_the_layers() {
    let section = laminate(0.3);
    for shape in SHAPES {
        let rotation = Rotation3::new(Vector3::new(0.4, -1.1, 0.7));
        let flat = [[0.1, -0.2], [1.3, 0.1], [0.8, 1.2], [-0.2, 0.9]];
        let place = |[x, y]: &[f64; 2]| rotation * Vector3::new(*x, *y, 0.0) + Vector3::new(2.0, -3.0, 1.5);
        let nodes: Vec<Vector3<f64>> = flat.iter().map(place).take(shape.nodes()).collect();
        let n = rotation * Vector3::z();
        let (mut area, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
        for corners in (1..shape.nodes() - 1).map(|i| [nodes[0], nodes[i], nodes[i + 1]]) {
            let part = 0.5 * (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).norm();
            let s: Vector3<f64> = corners.iter().sum();
            let squares: Matrix3<f64> = corners.iter().map(|x| x * x.transpose()).sum();
            area += part;
            first += part / 3.0 * s;
            second += part / 12.0 * (squares + s * s.transpose());
        }
        let spread = section.mass * second
            + section.first * (n * first.transpose() + first * n.transpose())
            + section.second * area * n * n.transpose();
        let inertia = Matrix3::identity() * spread.trace() - spread;
        let centre = section.mass * first + section.first * area * n;

        let M = mass(shape, &nodes, &section).unwrap();
        let motions = DMatrix::from_columns(&motions(&nodes));
        let found = motions.tr_mul(&M) * &motions;
        let mut expected = DMatrix::zeros(6, 6);
        expected.fixed_view_mut::<3, 3>(0, 0).copy_from(&(section.mass * area * Matrix3::identity()));
        // angular momentum of a rotation: ω × c, columns by axis of ω
        expected.fixed_view_mut::<3, 3>(0, 3).copy_from(&-centre.cross_matrix());
        expected.fixed_view_mut::<3, 3>(3, 0).copy_from(&centre.cross_matrix());
        expected.fixed_view_mut::<3, 3>(3, 3).copy_from(&inertia);
        assert!((&found - &expected).amax() <= 1e-13 * expected.amax(), "{found}{expected}");
    }
}

/// Rotated with the body, the forces of a dead stress stay in balance: `K_G (ω × x) = ω × f`.
#[test]
fn geometric_stiffness_turns_the_forces() {
    // Without coupling: moments have corner forces of their own.
    let section = ShellSection::laminate(&[plies(0.02)[0]], 0.0).unwrap();
    for shape in SHAPES {
        let rotation = Rotation3::new(Vector3::new(0.4, -1.1, 0.7));
        let flat = [[0.1, -0.2], [1.3, 0.1], [0.8, 1.2], [-0.2, 0.9]];
        let nodes: Vec<_> =
            flat.iter().map(|[x, y]| rotation * Vector3::new(*x, *y, 0.0)).take(shape.nodes()).collect();
        let stretch: Matrix3<f64> =
            1e-3 * rotation.matrix() * Matrix3::new(1.0, 0.2, 0.0, 0.2, -0.6, 0.0, 0.0, 0.0, 0.0);
        let stretch = stretch * rotation.matrix().transpose();
        let moved = |node: &Vector3<f64>| {
            let shift: Vector3<f64> = stretch * node;
            [shift.x, shift.y, shift.z, 0.0, 0.0, 0.0]
        };
        let u = DVector::from_iterator(6 * nodes.len(), nodes.iter().flat_map(moved));
        let forces = stiffness(shape, &nodes, REFERENCE, &section).unwrap() * &u;
        let K = geometric(shape, &nodes, REFERENCE, &section, &u).unwrap();
        let omega = Vector3::new(0.3, -0.8, 0.5);
        let turned = K * rigid(&nodes, Vector3::new(1.0, 2.0, 3.0), omega);
        for i in 0..nodes.len() {
            let expected = omega.cross(&forces.fixed_rows::<3>(6 * i).into_owned());
            let error = (turned.fixed_rows::<3>(6 * i) - expected).norm();
            assert!(error <= 1e-12 * forces.amax(), "{shape}: {turned} {expected}");
        }
    }
}

#[test]
fn what_is_no_shell_is_refused() {
    let refused = |shape: Shape, nodes: &[[f64; 3]], reference: [f64; 3]| {
        let nodes: Vec<Vector3<f64>> = nodes.iter().map(|node| Vector3::from(*node)).collect();
        stiffness(shape, &nodes, reference.into(), &laminate(0.1)).unwrap_err()
    };
    let (o, x, y) = ([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    assert_eq!(refused(Shape::Line2, &[o, x], x), ShellError::Shape { shape: Shape::Line2 });
    assert!(matches!(refused(Shape::Quad4, &[o, x, y], x), ShellError::Nodes { found: 3, .. }));
    assert!(matches!(refused(Shape::Triangle3, &[o, x, [2.0, 0.0, 0.0]], y), ShellError::Area { .. }));
    assert!(matches!(refused(Shape::Triangle3, &[o, x, [f64::NAN; 3]], y), ShellError::Area { .. }));
    assert!(matches!(refused(Shape::Triangle3, &[o, x, y], [0.0, 0.0, 2.0]), ShellError::Reference { .. }));
    assert!(matches!(refused(Shape::Triangle3, &[o, x, y], o), ShellError::Reference { .. }));
    let dart = [o, x, [0.3, 0.3, 0.0], y];
    assert_eq!(refused(Shape::Quad4, &dart, x), ShellError::Concave { node: 3 });
}
