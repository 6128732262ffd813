//! Problems: the reasons for which a value of an element makes no body, with the message of each.
//! Each message tells the numbers that decide; what to try is advice by variant, so a new variant needs its line in `advice.rs`.

use thiserror::Error;

use crate::finite::beam::BeamError;
use crate::finite::elasticity::ElasticityError;
use crate::finite::shell::ShellError;
use crate::flow::stokes::StokesError;
use crate::kinds::tank::TankError;
use crate::kinds::tube::TubeError;
use crate::math::eigen::NoConvergence;
use crate::math::memory::TooMuchMemory;
use crate::model::control::ControlProblem;
use crate::model::{InertiaError, RheologyError, mechanism};
use quasirigid_mesh::meshing::MeshingError;
use quasirigid_mesh::{MeshFault, MeshNote};

/// Reasons for which a value of an element is refused.
#[non_exhaustive]
#[derive(Clone, Debug, Error, PartialEq)]
pub enum Problem {
    /// A number is NaN or infinite.
    #[error("{value} is not a finite number")]
    NotFinite {
        /// The number.
        value: f64,
    },
    /// A mass is zero or negative.
    #[error("{value} kg is not a mass; it must be positive")]
    NotAMass {
        /// The number (kg).
        value: f64,
    },
    /// No mass distribution has this inertia tensor.
    #[error(transparent)]
    Inertia(#[from] InertiaError),
    /// No isotropic material has this Poisson's ratio, or it is incompressible.
    #[error(
        "no elastic material that can be compressed has the Poisson's ratio {value}; it lies between -1 and 0.5"
    )]
    Poisson {
        /// The ratio.
        value: f64,
    },
    /// No material has this rheology.
    #[error(transparent)]
    Rheology(#[from] RheologyError),
    /// Polynomials that are linearly dependent up to rounding, or in this shape.
    #[error("polynomials of degree {degree} are linearly dependent on this body, to rounding")]
    Unresolved {
        /// Their degree.
        degree: usize,
    },
    /// A degree that is not offered.
    #[error("polynomials of degree {degree} are not offered; choose 1 to {most}")]
    Degree {
        /// Degree asked for.
        degree: usize,
        /// Highest one offered.
        most: usize,
    },
    /// Numbers of cells that are not offered.
    #[error("{cells} cells are not offered; choose 1 to {most}")]
    Cells {
        /// Number asked for.
        cells: usize,
        /// Highest one offered.
        most: usize,
    },
    /// Degree and number of cells given at once.
    #[error("a solid is made of polynomials or of cells, not of both")]
    TwoRoads,
    /// Bodies that nothing joins.
    #[error("the surface encloses {bodies} bodies that nothing joins")]
    SeveralBodies {
        /// Number of bodies.
        bodies: usize,
    },
    /// A year or a degree beyond the coefficients of the main field.
    #[error(
        "the main field of the Earth is known for 1900 to 2030 and degrees 1 to 13, not for {year:.1} and degree {degree}"
    )]
    NoMainField {
        /// Decimal year asked for.
        year: f64,
        /// Degree asked for.
        degree: usize,
    },
    /// Main field of the Earth along an orbit about another centre.
    #[error("the main field is that of the Earth, and the orbit is about a centre of {mu} m^3/s^2")]
    NotTheEarth {
        /// Gravitational parameter (m³/s²) of the centre.
        mu: f64,
    },
    /// Sunlight on an orbit about another centre.
    #[error(
        "the Sun is the centre of the orbit of a body in its light, and this orbit is about a centre of {mu} m^3/s^2"
    )]
    NotTheSun {
        /// Gravitational parameter (m³/s²) of the centre.
        mu: f64,
    },
    /// Main field of the Earth along an orbit that goes through it.
    #[error(
        "the main field is known above the Earth, and the orbit comes to {:.0} km from its centre",
        nearest / 1000.0
    )]
    Underground {
        /// Least distance (m) from the centre.
        nearest: f64,
    },
    /// A shape observed in rotation, of which a body is asked that is not in rotation.
    #[error("the shape given is that of the body in rotation, and a body is built of its relaxed shape")]
    AsObserved,
    /// A material that a constant load deforms without end.
    #[error("its material flows under a constant load, and a steady spin has no shape to be observed")]
    FlowsSteadily,
    /// Bodies of which no shape was observed.
    #[error("a shape as observed is that of a single ellipsoid or surface")]
    NoObservedShape,
    /// A spin that deforms a body too much for a linear law.
    #[error("{}", too_soft(*.strain))]
    TooSoft {
        /// Relative change of a length by the spin; NaN where no relaxed shape was found.
        strain: f64,
    },
    /// A steady spin about an axis that is none of the ellipsoid.
    #[error(
        "its three moments are equal and it spins aslant to its axes: the relaxed body is an ellipsoid with other axes"
    )]
    Aslant,
    /// A shape that polynomials do not follow and that cannot be meshed.
    #[error("polynomials do not follow this shape, and no mesh made here does: {cause}")]
    Unmeshed {
        /// Problem with the mesh.
        cause: Box<Problem>,
    },
    /// A shape that the meshes made here do not resolve.
    #[error(
        "the dissipation of this shape is not resolved: an error of {:.0} % is left in the finest mesh made here",
        100.0 * error
    )]
    Unsettled {
        /// Estimate of the relative error.
        error: f64,
    },
    /// The body has neither a carrier nor a part that is elastic throughout.
    #[error("the body has no carrier and no part that is elastic throughout")]
    NoBody,
    /// An element that only goes with a carrier, on a body without.
    #[error("an ellipsoid or a surface is the whole body; this is not allowed beside it")]
    BesideWhole,
    /// A rotor, a wheel or a liquid in a body that has no carrier to hold it.
    #[error("this needs a carrier that holds it; the body has none")]
    InsideNothing,
    /// Internal rotors and liquids have more inertia about some axis than the whole body with them locked.
    #[error(
        "the rotors and liquids inside have more inertia than the whole body about some axis; the carrier's inertia counts rotors and wheels as locked"
    )]
    HeavyInside,
    /// A tank whose slosh is not answered.
    #[error(transparent)]
    Tank(#[from] TankError),
    /// A partly full tube that is not answered.
    #[error(transparent)]
    Tube(#[from] TubeError),
    /// A cavity that cannot be meshed.
    #[error(transparent)]
    Meshing(#[from] MeshingError),
    /// A cavity whose flows cannot be found.
    #[error(transparent)]
    Stokes(#[from] StokesError),
    /// Flows in a cavity that are linearly dependent up to rounding.
    #[error("the flows of the liquid are linearly dependent in a cavity of this shape, to rounding")]
    LiquidUnresolved,
    /// Polynomials of a degree that is not offered.
    #[error("the flow in this shape has polynomials of degree {least} to {most}, not {degree}")]
    FlowDegree {
        /// Degree asked for.
        degree: usize,
        /// Lowest one offered.
        least: usize,
        /// Highest one offered.
        most: usize,
    },
    /// More rates of change than are offered.
    #[error("the responses to {modes} rates of change are not offered; choose 0 to {most}")]
    TooManyModes {
        /// Number asked for.
        modes: usize,
        /// Most that are offered.
        most: usize,
    },
    /// A quaternion that is not of norm 1.
    #[error("the quaternion has the norm {norm}, and an attitude has the norm 1")]
    NotAttitude {
        /// Norm of the quaternion.
        norm: f64,
    },
    /// Something acts on or is mounted on the carrier of a body that has none.
    #[error("this body has no carrier")]
    NoCarrier,
    /// A body that is elastic throughout has no point that a support could fix.
    #[error("a body that is elastic throughout moves freely; no point of it can be held")]
    HeldWhole,
    /// A part is loose: the body has a carrier and nothing joins the part to it.
    #[error("nothing joins this part to the carrier; attach some of its nodes, or connect it")]
    NotAttached,
    /// Something names a part that does not exist.
    #[error("there is no part number {index}")]
    NoSuchPart {
        /// Index of the part.
        index: usize,
    },
    /// Something names a node that does not exist.
    #[error("the part has no node number {index}; it has {count}")]
    NoSuchNode {
        /// Index of the node.
        index: usize,
        /// Number of nodes.
        count: usize,
    },
    /// An entry of a matrix is about a row that does not exist.
    #[error("an entry is about row {index}, but there are {count} degrees of freedom")]
    NoSuchRow {
        /// Index of the row.
        index: usize,
        /// Number of rows.
        count: usize,
    },
    /// A region names a cell that does not exist.
    #[error("there is no cell {index} among {count}")]
    NoSuchCell {
        /// Index of the cell.
        index: usize,
        /// Number of cells.
        count: usize,
    },
    /// A region has not one density for each of its cells.
    #[error("there are {found} densities and {cells} cells; give one for each")]
    DensityPerCell {
        /// Number of densities.
        found: usize,
        /// Number of cells.
        cells: usize,
    },
    /// Shapes are not over the rows of the mass matrix.
    #[error(
        "there are {rows} rows of shapes and {dofs} rows of the mass; each row of one is a row of the other"
    )]
    ShapeRows {
        /// Rows of the shapes.
        rows: usize,
        /// Rows of the mass matrix.
        dofs: usize,
    },
    /// There are fewer shapes than displacements of the interface.
    #[error(
        "there are {columns} shapes, and the interface alone has {interface} displacements and rotations"
    )]
    ShapeColumns {
        /// Number of shapes.
        columns: usize,
        /// Displacements and rotations of the interface.
        interface: usize,
    },
    /// A shape is not a unit displacement of the interface, or moves the interface where it should not.
    #[error(
        "shape {} moves component {} of node {node} by {share:.4}; the first shapes are unit displacements of the interface, \
         node by node, and the others leave it at rest",
        column + 1,
        component + 1
    )]
    NotUnit {
        /// Number of the node in its file.
        node: u64,
        /// Component, from 0.
        component: usize,
        /// The shape, from 0.
        column: usize,
        /// Component of the shape there.
        share: f64,
    },
    /// Not one value for each mode.
    #[error("there are {modes} shapes and {values} values; give one for each")]
    ValuePerMode {
        /// Number of shapes.
        modes: usize,
        /// Number of values.
        values: usize,
    },
    /// A mode moves no mass.
    #[error("mode {} moves no mass", mode + 1)]
    EmptyMode {
        /// The mode, from 0.
        mode: usize,
    },
    /// Shapes are no modes of a mass.
    #[error(
        "the mass couples modes {} and {} by {share:.2} of their own, so they are not modes of this mass; is the mass at the \
         nodes complete, and are the rows in their order?",
        modes[0] + 1,
        modes[1] + 1
    )]
    CoupledModes {
        /// The modes, from 0.
        modes: [usize; 2],
        /// Their coupling over the geometric mean of their masses.
        share: f64,
    },
    /// A node is constrained or carried whose motion is given by modes.
    #[error(
        "the shapes of its modes say how {node} moves; only nodes of the `interface` can be held or carried"
    )]
    NotInterface {
        /// The node, by name.
        node: String,
    },
    /// A side of a connection or an attachment has no nodes.
    #[error("no nodes are named here")]
    NoNodes,
    /// Both sides of a connection are constrained already.
    #[error("{node} is held already, by a connection or the carrier; a node can be held once")]
    HeldTwice {
        /// The node, by name.
        node: String,
    },
    /// Connections run in a circle.
    #[error("the connections at {node} run in a circle; replace one of them by a stiff spring")]
    Circle {
        /// A node of the circle, by name.
        node: String,
    },
    /// A joint is away from its base node, which has no rotations.
    #[error(
        "{base} has no rotations to carry {node}, {distance} m away; join nodes at the same place, or a whole face"
    )]
    NoArm {
        /// The base node, by name.
        base: String,
        /// The node to be joined, by name.
        node: String,
        /// Distance between them (m).
        distance: f64,
    },
    /// A moment acts on a node without rotations.
    #[error("{node} has no rotations, so no moment acts there; name a face, or three nodes or more")]
    NoTurn {
        /// The node, by name.
        node: String,
    },
    /// A force turns with a place without orientation.
    #[error(
        "{place} has no rotations, so no force turns with it; give the force in axes of the body, or at a node of a beam or panel"
    )]
    NoDirection {
        /// The place, by name.
        place: String,
    },
    /// A rigid body with inertia is at a node without rotations.
    #[error(
        "{node} has no rotations, so what is there can have no inertia; leave it out, or join a stiff beam"
    )]
    NoTurnForInertia {
        /// The node, by name.
        node: String,
    },
    /// Two sides of many nodes each do not match.
    #[error("{node} has no partner at its place on the other side; the nearest is {distance} m away")]
    NoPartner {
        /// The node, by name.
        node: String,
        /// Distance to the nearest node of the other side (m).
        distance: f64,
    },
    /// A controller that cannot be.
    #[error(transparent)]
    Control(#[from] ControlProblem),
    /// A beam or its section is not possible.
    #[error(transparent)]
    Beam(#[from] BeamError),
    /// A mesh is unfit for computation.
    #[error("{}", all(.0))]
    Mesh(Vec<MeshFault>),
    /// A mesh has no cells of the kind that the part is made of.
    #[error(
        "the mesh has no {}",
        if *dimension == 3 { "tetrahedra, wedges or hexahedra" } else { "triangles or quadrilaterals" }
    )]
    NoCells {
        /// Dimension of those cells: 3 of a solid, 2 of a panel.
        dimension: usize,
    },
    /// Nodes that no cell of the part holds, or that are at the same place as others.
    #[error(transparent)]
    LooseNodes(#[from] MeshNote),
    /// The constants of a material are not those of an elastic solid.
    #[error(transparent)]
    Elasticity(#[from] ElasticityError),
    /// A cell of a panel or its layers are not possible.
    #[error("{}{cause}", cell.map(|cell| format!("cell {cell}: ")).unwrap_or_default())]
    Shell {
        /// Number of the cell in its file; none where the layers are wrong.
        cell: Option<u64>,
        /// The error of the shell element.
        cause: ShellError,
    },
    /// The lowest modes of the parts are not found.
    #[error("its lowest modes are not found: {cause}")]
    NoModes {
        /// The cause.
        cause: NoConvergence,
    },
    /// A part has no mass, or too little of it to rotate.
    #[error("this has no mass")]
    NoMass,
    /// A point is guided on a line or in a plane, in a body without a carrier to fix the line or the plane to.
    #[error("a body without a carrier has nothing that could hold a line or a plane")]
    NoGuide,
    /// A direction has no length.
    #[error("a direction of zero length")]
    ZeroDirection,
    /// A matrix is not symmetric.
    #[error(
        "the matrix is not symmetric: entries [{row}][{column}] = {upper} and [{column}][{row}] = {lower} differ"
    )]
    NotSymmetric {
        /// Row of the first entry, from 0.
        row: usize,
        /// Column of the first entry, from 0.
        column: usize,
        /// The entry at (row, column).
        upper: f64,
        /// The entry at (column, row).
        lower: f64,
    },
    /// A matrix of a part is not symmetric.
    #[error(
        "the matrix is not symmetric: it has {} at row {}, column {}, and {} at row {}, column {}",
        values[0], dofs[0], dofs[1], values[1], dofs[1], dofs[0]
    )]
    Lopsided {
        /// Two degrees of freedom, as node.component.
        dofs: [String; 2],
        /// The entry in the row of the first, and that in the row of the second.
        values: [f64; 2],
    },
    /// A matrix of a part has a negative number on its diagonal.
    #[error("the matrix has {value} on its diagonal at {dof}; no motion has less than no energy")]
    NegativeDiagonal {
        /// The degree of freedom, as node.component.
        dof: String,
        /// The number.
        value: f64,
    },
    /// Matrices constrain nodes of a body without a carrier.
    #[error("node {node} has not all its rows, so it is held, and this body has no carrier to hold it")]
    HeldByMatrices {
        /// Number of the node.
        node: u64,
    },
    /// A stiffness or damping releases energy instead of absorbing it.
    #[error("the smallest eigenvalue is {eigenvalue:e}; a spring or dashpot must not give energy")]
    Indefinite {
        /// Smallest eigenvalue of the matrix.
        eigenvalue: f64,
    },
    /// Both ends of a spring or a connection are the same.
    #[error("both ends are the same")]
    SameEnds,
    /// There is no point with this index.
    #[error("there is no point {index}")]
    NoSuchPoint {
        /// Index asked for, from 0.
        index: usize,
    },
    /// The ends of an axial spring coincide, so they have no joining line.
    #[error("the ends of the axial spring are at the same place, so no line joins them")]
    NoLine,
    /// The tensions of springs do not balance at rest.
    #[error(
        "at rest the tensions of the springs pull {coordinate} with {force} N or N m; they must balance there"
    )]
    Unbalanced {
        /// Coordinate with the residual force, by name.
        coordinate: String,
        /// Generalised force (N, N·m).
        force: f64,
    },
    /// A spring under tension is attached to a part of finite elements.
    #[error(
        "a spring under tension at rest is fixed to a part of finite elements, which would be under load, too"
    )]
    TensionOnPart,
    /// A spring under tension on a body without a carrier.
    #[error("a spring under tension at rest needs a body with a carrier")]
    TensionAfloat,
    /// An axial spring to the carrier lacks the place of its end there.
    #[error("an axial spring to the carrier needs the place of its end on the carrier")]
    NoAnchor,
    /// A hinge has no axis, or more than three.
    #[error("a hinge has one, two or three axes, not {count}")]
    AxisCount {
        /// Number of axes given.
        count: usize,
    },
    /// A drive turns a hinge about several axes.
    #[error("a drive turns a hinge about one axis, not {count}")]
    DrivenAxes {
        /// Number of axes given.
        count: usize,
    },
    /// A driven hinge has a spring or a damper.
    #[error("a drive holds the hinge at its angle, so that neither spring nor damper acts on it")]
    DrivenSpring,
    /// The axes of a hinge are linearly dependent.
    #[error("the axes are not independent, so two of them would be the same motion")]
    DependentAxes,
    /// A hinge coefficient does not have one value or row per axis.
    #[error("{}, but {}", counted(*axes, "axis", "axes"), counted(*values, "value", "values"))]
    ValuePerAxis {
        /// Number of axes.
        axes: usize,
        /// Number of values or rows.
        values: usize,
    },
    /// An axis rotates the appendage without moving any of its mass.
    #[error("turning about axis {axis} moves no mass; leave that axis out")]
    MasslessAxis {
        /// Number of the axis, from 1.
        axis: usize,
    },
    /// A sheet without modes.
    #[error("there are no modes")]
    NoSheetModes,
    /// The modes of an appendage carry more than its mass or inertia.
    #[error("{}", too_heavy(*share, what))]
    ModesTooHeavy {
        /// What they carry, as a share of what there is.
        share: f64,
        /// Mass or inertia, and the motion.
        what: String,
    },
    /// A force on the carrier lacks its place there.
    #[error("a force on the carrier needs the place where it acts")]
    NoApplicationPoint,
    /// A force on a point has a place on the carrier.
    #[error("a force on a point acts at the point itself")]
    ApplicationPointOnPoint,
    /// A drag releases energy instead of absorbing it.
    #[error("the coefficient {value} is negative; a drag must not give energy")]
    Driving {
        /// The coefficient.
        value: f64,
    },
    /// Eddy currents release energy instead of absorbing it.
    #[error("the smallest eigenvalue is {eigenvalue:e} S m^4; eddy currents must not give energy")]
    Powered {
        /// Smallest eigenvalue of the magnetic tensor (S·m⁴).
        eigenvalue: f64,
    },
    /// A quantity is zero or negative.
    #[error("{value} is not positive")]
    NotPositive {
        /// The number.
        value: f64,
    },
    /// The remanence of a material is not below its saturation.
    #[error("a remanence of {remanence} T is not less than the saturation of {saturation} T")]
    Remanent {
        /// Remanence (T).
        remanence: f64,
        /// Saturation (T).
        saturation: f64,
    },
    /// No body has this demagnetisation factor along an axis.
    #[error("no rod has the demagnetisation factor {factor}; it is at least 0 and below 1")]
    Demagnetization {
        /// The factor.
        factor: f64,
    },
    /// An eccentricity is not that of an ellipse.
    #[error("no ellipse has the eccentricity {value}; it is at least 0 and below 1")]
    NotElliptic {
        /// The eccentricity.
        value: f64,
    },
    /// An eccentricity is not that of any orbit.
    #[error("no orbit has the eccentricity {value}; it is zero or positive")]
    NoConic {
        /// The eccentricity.
        value: f64,
    },
    /// A point is displaced in a direction that its constraints bar.
    #[error("its constraints leave only the part {left:?} of this motion")]
    Barred {
        /// The part along the free directions (m or m/s), file's axes.
        left: [f64; 3],
    },
    /// Two elements share a name.
    #[error("the name \"{name}\" is used twice")]
    DuplicateName {
        /// The name.
        name: String,
    },
    /// No spring resists a displacement.
    #[error("{}", mechanism(coordinates))]
    Mechanism {
        /// The coordinates that move, by name.
        coordinates: String,
    },
    /// The parts need more memory than there is.
    #[error("{unknowns} unknowns are too many here: {cause}; make the mesh coarser, or model fewer parts")]
    Memory {
        /// Unknowns of the parts, or coordinates of the body.
        unknowns: usize,
        /// The memory needed and the memory there is.
        cause: TooMuchMemory,
    },
    /// The frozen body has no inertia about some axis, so its rotation about that axis is undetermined.
    #[error("{}", no_inertia(*moments))]
    NoInertia {
        /// Principal moments of inertia about the pole (kg·m²), ascending.
        moments: [f64; 3],
        /// Whether the pole is a point that is fixed or driven, not the centre of mass.
        held: bool,
    },
}

/// Message for modes that carry more than there is.
fn too_heavy(share: f64, what: &str) -> String {
    if share.is_infinite() {
        return format!("the modes carry {what}, of which the appendage has none");
    }
    format!("the modes carry {} % of the {what}", (1e6 * share).round() / 1e4)
}

/// Message for a moment of inertia that is zero, or negligible beside the others.
fn no_inertia(moments: [f64; 3]) -> String {
    let [least, _, greatest] = moments;
    if least > 1e-13 * greatest {
        return format!(
            "the moment of inertia about one axis, {least:.3e} kg m^2, is {:.1e} of the greatest, {greatest:.3e}: from 1.5e-8 on the rotation about that axis is resolved",
            least / greatest
        );
    }
    format!("the whole body has no inertia about some axis (principal moments {moments:?} kg m^2)")
}

/// Faults listed in one message.
const MOST_FAULTS: usize = 5;

fn all(faults: &[MeshFault]) -> String {
    let mut listed: Vec<String> = faults.iter().take(MOST_FAULTS).map(MeshFault::to_string).collect();
    if faults.len() > MOST_FAULTS {
        listed.push(format!("and {} more faults", faults.len() - MOST_FAULTS));
    }
    listed.join("; ")
}

fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// Words for a body that its spin deforms too much.
fn too_soft(strain: f64) -> String {
    let spin = if strain.is_finite() {
        format!("the spin would change its size by {:.0} %", 100.0 * strain)
    } else {
        "no relaxed body has this shape at this spin".to_owned()
    };
    format!("{spin}; elasticity is linear here, to 10 %")
}
