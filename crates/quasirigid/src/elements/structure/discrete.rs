use nalgebra::DMatrix;

use super::freedoms::{Freedoms, Hold, Node, Unknown};
use crate::elements::finite::Element;
use crate::math::sparse::SparseRows;
use crate::model::Rheology;

/// Finite elements between nodes, as the parts of a body give them.
#[derive(Default)]
pub(in crate::elements) struct Structure {
    pub nodes: Vec<Node>,
    /// How each node is held.
    pub holds: Vec<Hold>,
    pub elements: Vec<Box<dyn Element>>,
    pub joints: Vec<Joint>,
    pub matters: Vec<Matter>,
}

impl Structure {
    /// Number of a matter, which it gets if it is new.
    pub fn matter(&mut self, matter: Matter) -> usize {
        self.matters.iter().position(|known| *known == matter).unwrap_or_else(|| {
            self.matters.push(matter);
            self.matters.len() - 1
        })
    }
}

/// How a kind of matter dissipates.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::elements) struct Matter {
    pub rheology: Rheology,
    /// Damping per mass (1/s).
    pub per_mass: f64,
    /// Damping per stiffness (s).
    pub per_stiffness: f64,
}

/// Springs and dashpots about the axes of a joint.
#[derive(Clone, Debug)]
pub(in crate::elements) struct Joint {
    /// The node that is held by it.
    pub node: usize,
    /// Stiffness about each axis (N·m/rad).
    pub stiffness: Vec<f64>,
    /// Damping about each axis (N·m·s/rad).
    pub damping: Vec<f64>,
    pub matter: usize,
}

/// A structure as matrices over its unknowns.
pub(in crate::elements) struct Discrete<'a> {
    pub structure: &'a Structure,
    pub freedoms: Freedoms,
    /// Stiffness of each matter.
    pub stiffness: Vec<SparseRows<f64>>,
    /// Dashpots, and damping in proportion to mass or stiffness.
    pub damping: SparseRows<f64>,
    pub mass: SparseRows<f64>,
    pub total: SparseRows<f64>,
}

/// Entries of a matrix, with row and column.
type Entries = Vec<(usize, usize, f64)>;

impl<'a> Discrete<'a> {
    /// Adds up the elements. (K1)–(K3)
    pub fn new(structure: &'a Structure, freedoms: Freedoms) -> Self {
        let size = freedoms.unknowns().len();
        let mut stiffness: Vec<Entries> = vec![Vec::new(); structure.matters.len()];
        let (mut damping, mut mass) = (Entries::new(), Entries::new());
        for element in &structure.elements {
            let rows: Vec<_> = freedoms.rows(element.nodes(), element.freedoms()).collect();
            let matter = &structure.matters[element.matter()];
            let (K, M) = (element.stiffness(), consistent(element.as_ref()));
            scatter(&rows, &K, 1.0, &mut stiffness[element.matter()]);
            scatter(&rows, &M, 1.0, &mut mass);
            scatter(&rows, &K, matter.per_stiffness, &mut damping);
            scatter(&rows, &M, matter.per_mass, &mut damping);
            if let Some(dashpots) = element.damping() {
                scatter(&rows, &dashpots, 1.0, &mut damping);
            }
        }
        for joint in &structure.joints {
            for (axis, unknown) in joint_unknowns(&freedoms, joint) {
                stiffness[joint.matter].push((unknown, unknown, joint.stiffness[axis]));
                damping.push((unknown, unknown, joint.damping[axis]));
            }
        }
        let total = SparseRows::sum(size, stiffness.concat());
        Self {
            structure,
            stiffness: stiffness.into_iter().map(|entries| SparseRows::sum(size, entries)).collect(),
            damping: SparseRows::sum(size, damping),
            mass: SparseRows::sum(size, mass),
            total,
            freedoms,
        }
    }
}

impl Discrete<'_> {
    /// What takes energy from a motion, as matrices; nothing that is a multiple of the stiffness.
    pub fn losses(&self) -> Vec<&SparseRows<f64>> {
        let matters = self.structure.matters.iter().zip(&self.stiffness);
        let lossy = matters.filter(|(matter, _)| matter.rheology != Rheology::Elastic);
        let several = if self.structure.matters.len() > 1 { usize::MAX } else { 0 };
        let dashpots = (!self.damping.is_zero()).then_some(&self.damping);
        dashpots.into_iter().chain(lossy.map(|(_, stiffness)| stiffness).take(several)).collect()
    }
}

/// Mass matrix over the freedoms of an element. (K3)
fn consistent(element: &dyn Element) -> DMatrix<f64> {
    let size = element.nodes().len() * element.freedoms();
    element
        .grains()
        .iter()
        .fold(DMatrix::zeros(size, size), |sum, grain| sum + grain.mass * grain.shapes.tr_mul(&grain.shapes))
}

fn scatter(rows: &[&[(usize, f64)]], matrix: &DMatrix<f64>, factor: f64, entries: &mut Entries) {
    if factor == 0.0 {
        return;
    }
    for (i, row) in rows.iter().enumerate() {
        for (j, column) in rows.iter().enumerate() {
            let value = factor * matrix[(i, j)];
            for (r, a) in row.iter().filter(|_| value != 0.0) {
                entries.extend(column.iter().map(|(c, b)| (*r, *c, a * b * value)));
            }
        }
    }
}

fn joint_unknowns<'f>(freedoms: &'f Freedoms, joint: &'f Joint) -> impl Iterator<Item = (usize, usize)> + 'f {
    freedoms.unknowns().iter().enumerate().filter_map(move |(index, unknown)| match unknown {
        Unknown::OfJoint(node, axis) if *node == joint.node => Some((*axis, index)),
        _ => None,
    })
}
