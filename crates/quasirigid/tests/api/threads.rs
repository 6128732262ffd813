//! Public types cross threads and print themselves.

use std::fmt::Debug;

use quasirigid::secular::choice;
use quasirigid::{
    averaging, dynamics, elements, model, modes, problems, reduction, secular, submanifold, verification,
};

/// Modules that a user meets, as their sources list them.
const MODULES: [(&str, &str); 11] = [
    ("elements", include_str!("../../../quasirigid-elements/src/lib.rs")),
    ("model", include_str!("../../../quasirigid-body/src/lib.rs")),
    ("reduction", include_str!("../../../quasirigid-dynamics/src/reduction/mod.rs")),
    ("dynamics", include_str!("../../../quasirigid-dynamics/src/dynamics/mod.rs")),
    ("averaging", include_str!("../../../quasirigid-dynamics/src/averaging/mod.rs")),
    ("modes", include_str!("../../../quasirigid-dynamics/src/modes/mod.rs")),
    ("submanifold", include_str!("../../../quasirigid-dynamics/src/submanifold/mod.rs")),
    ("secular", include_str!("../../../quasirigid-dynamics/src/secular/mod.rs")),
    ("choice", include_str!("../../../quasirigid-dynamics/src/secular/choice/mod.rs")),
    ("verification", include_str!("../../../quasirigid-dynamics/src/verification/mod.rs")),
    ("problems", include_str!("../../../quasirigid-elements/src/problems/mod.rs")),
];

/// Traits, which have no threads to cross.
const TRAITS: [&str; 4] = ["AssemblyElement", "ChoiceObserver", "MeanPower", "Observer"];

fn crosses<T: Send + Sync + Debug>() {}

/// The compiler is the test.
#[test]
fn public_types_are_send_sync_and_debug() {
    crosses::<quasirigid::Error>();
    crosses::<averaging::FreeRotationError>();
    crosses::<elements::Anchor>();
    crosses::<elements::Approximation>();
    crosses::<elements::Assembly>();
    crosses::<elements::BeamError>();
    crosses::<elements::Built>();
    crosses::<elements::Bushing>();
    crosses::<elements::Carrier>();
    crosses::<elements::Cavity>();
    crosses::<elements::CavityShape>();
    crosses::<elements::Coefficient>();
    crosses::<elements::Condensation>();
    crosses::<elements::Turning>();
    crosses::<elements::Visual>();
    crosses::<elements::Connection>();
    crosses::<elements::Constant>();
    crosses::<elements::ElasticityError>();
    crosses::<elements::ElementError>();
    crosses::<elements::ElementId>();
    crosses::<elements::ElementKind>();
    crosses::<elements::Ellipsoid>();
    crosses::<elements::End>();
    crosses::<elements::Field>();
    crosses::<elements::Frame>();
    crosses::<elements::FrameNode>();
    crosses::<elements::HingeCoefficient>();
    crosses::<elements::Hinged>();
    crosses::<elements::Incomplete>();
    crosses::<elements::PartKind>();
    crosses::<elements::SpringLaw>();
    crosses::<elements::Layer>();
    crosses::<elements::Material>();
    crosses::<elements::Matrices>();
    crosses::<elements::Member>();
    crosses::<elements::GivenModes>();
    crosses::<elements::Modulus>();
    crosses::<elements::PointMotion>();
    crosses::<elements::Network>();
    crosses::<elements::NodalMass>();
    crosses::<elements::NodeRef>();
    crosses::<elements::Orthotropic>();
    crosses::<elements::Panel>();
    crosses::<elements::Part>();
    crosses::<elements::PlaceRef>();
    crosses::<elements::Point>();
    crosses::<elements::Prestress>();
    crosses::<elements::Problem>();
    crosses::<elements::Quantity>();
    crosses::<elements::PartReduction>();
    crosses::<elements::Regime>();
    crosses::<elements::Region>();
    crosses::<elements::Resolution>();
    crosses::<elements::Rotor>();
    crosses::<elements::RotorKind>();
    crosses::<elements::Section>();
    crosses::<elements::SectionShape>();
    crosses::<elements::ShellError>();
    crosses::<elements::SlowLiquid>();
    crosses::<elements::Solid>();
    crosses::<elements::Spectrum>();
    crosses::<elements::Spring>();
    crosses::<elements::Station>();
    crosses::<elements::StokesError>();
    crosses::<elements::ElasticMaterial>();
    crosses::<elements::Surface>();
    crosses::<elements::TipMass>();
    crosses::<elements::Wheel>();
    crosses::<elements::WheelSpeed>();
    crosses::<model::Advection>();
    crosses::<model::BalancedSpin>();
    crosses::<model::Carried>();
    crosses::<model::Coordinate>();
    crosses::<model::CurvedPaths>();
    crosses::<model::Displaced>();
    crosses::<model::Dissipator>();
    crosses::<model::DrivenWheel>();
    crosses::<model::ExpandedMotion>();
    crosses::<model::FlexibleBody>();
    crosses::<model::FlexibleError>();
    crosses::<model::Follower>();
    crosses::<model::Gimbal>();
    crosses::<model::Hinge>();
    crosses::<model::Hung>();
    crosses::<model::Inertia>();
    crosses::<model::InertiaError>();
    crosses::<model::Invariants>();
    crosses::<model::Kinetics>();
    crosses::<model::LiquidFlow>();
    crosses::<model::LiquidMemory>();
    crosses::<model::Viscoelastic>();
    crosses::<model::Marker>();
    crosses::<model::Measured>();
    crosses::<model::Mode>();
    crosses::<model::MotionState<f64>>();
    crosses::<model::Pair>();
    crosses::<model::PartMass>();
    crosses::<model::BodyParts>();
    crosses::<model::Polhode>();
    crosses::<model::Principal>();
    crosses::<model::Reach>();
    crosses::<model::EnergyMotion<f64>>();
    crosses::<model::ReducedBody>();
    crosses::<model::Rheology>();
    crosses::<model::RheologyError>();
    crosses::<model::SpinCoefficients>();
    crosses::<model::StraightKinetics>();
    crosses::<model::Support>();
    crosses::<model::Velocities>();
    crosses::<model::Watched>();
    crosses::<model::Wheels>();
    crosses::<reduction::Assessment<'static>>();
    crosses::<reduction::Comparison>();
    crosses::<reduction::Criterion>();
    crosses::<reduction::DegreeSize>();
    crosses::<reduction::ReductionError>();
    crosses::<reduction::Relaxation>();
    crosses::<reduction::Residual>();
    crosses::<reduction::Resonance>();
    crosses::<reduction::Validity>();
    crosses::<reduction::ValidityError>();
    crosses::<reduction::Verdict>();
    crosses::<reduction::Vibrations>();
    crosses::<dynamics::BoundaryLayer>();
    crosses::<dynamics::Checkpoint>();
    crosses::<dynamics::DampedMode>();
    crosses::<dynamics::Event>();
    crosses::<dynamics::Rounding>();
    crosses::<dynamics::FastPart>();
    crosses::<dynamics::Forced<'static>>();
    crosses::<dynamics::ForcedTorque>();
    crosses::<dynamics::Form>();
    crosses::<dynamics::FullState>();
    crosses::<dynamics::IsolatedSpin>();
    crosses::<dynamics::Method>();
    crosses::<dynamics::Nutation>();
    crosses::<dynamics::Nutations>();
    crosses::<dynamics::Missed>();
    crosses::<dynamics::Options>();
    crosses::<dynamics::Outcome>();
    crosses::<dynamics::PropagateError>();
    crosses::<dynamics::RigidState>();
    crosses::<dynamics::Run>();
    crosses::<dynamics::Sample>();
    crosses::<dynamics::Scan>();
    crosses::<dynamics::SlowEquations>();
    crosses::<dynamics::SlowPoint>();
    crosses::<dynamics::SlowState>();
    crosses::<dynamics::SpinPath>();
    crosses::<dynamics::Start>();
    crosses::<dynamics::SteadySpin>();
    crosses::<dynamics::SteadySpins>();
    crosses::<averaging::HarmonicResonance>();
    crosses::<averaging::DampingEstimate>();
    crosses::<averaging::Drift>();
    crosses::<averaging::DrivenMaterial>();
    crosses::<averaging::DriftStopReason>();
    crosses::<averaging::EllipsoidLoss>();
    crosses::<averaging::EllipsoidPassage>();
    crosses::<averaging::EllipsoidRefusal>();
    crosses::<averaging::Wobble>();
    crosses::<averaging::WobblingEllipsoid>();
    crosses::<averaging::DriftHistory>();
    crosses::<averaging::DriftLimits>();
    crosses::<averaging::DriftState>();
    crosses::<averaging::EulerAngles>();
    crosses::<averaging::Evolution>();
    crosses::<averaging::EvolutionError>();
    crosses::<averaging::Floquet>();
    crosses::<averaging::FreeRotation>();
    crosses::<averaging::Harmonic>();
    crosses::<averaging::HillError>();
    crosses::<averaging::HillResponse>();
    crosses::<averaging::InterpolatedPower>();
    crosses::<averaging::Level>();
    crosses::<averaging::LevelStopReason>();
    crosses::<averaging::LevelError>();
    crosses::<averaging::LevelEvolution>();
    crosses::<averaging::LevelPassage>();
    crosses::<averaging::LevelRow>();
    crosses::<averaging::ObservedError>();
    crosses::<averaging::ObservedPeriods>();
    crosses::<averaging::ParametricResonance>();
    crosses::<averaging::Elapsed>();
    crosses::<averaging::PeriodicResponse<'static>>();
    crosses::<averaging::PolynomialPower>();
    crosses::<averaging::PowerSource>();
    crosses::<averaging::Response>();
    crosses::<averaging::Separatrix>();
    crosses::<averaging::SeparatrixPassage>();
    crosses::<averaging::SlowTorque>();
    crosses::<averaging::SmallBody>();
    crosses::<averaging::RotationState>();
    crosses::<averaging::Unaveraged>();
    crosses::<averaging::Until>();
    crosses::<averaging::Way>();
    crosses::<modes::CampbellError>();
    crosses::<modes::EquilibriumError>();
    crosses::<modes::Given>();
    crosses::<modes::ModesError>();
    crosses::<modes::Near>();
    crosses::<modes::RelativeEquilibrium>();
    crosses::<modes::SpinEigenvalues>();
    crosses::<modes::SpinMode>();
    crosses::<modes::SpinModes>();
    crosses::<modes::SteadyError>();
    crosses::<modes::SteadyModes>();
    crosses::<modes::SteadyState>();
    crosses::<modes::WhirlOnset>();
    crosses::<submanifold::AmplitudeRange>();
    crosses::<submanifold::Backbone>();
    crosses::<submanifold::BackbonePoint>();
    crosses::<submanifold::Defect>();
    crosses::<submanifold::ExpansionError>();
    crosses::<submanifold::ManifoldPower>();
    crosses::<submanifold::ManifoldRun>();
    crosses::<submanifold::ManifoldStart>();
    crosses::<submanifold::MasterMode>();
    crosses::<submanifold::Masters>();
    crosses::<submanifold::MetResonance>();
    crosses::<submanifold::NearResonance>();
    crosses::<submanifold::OuterMode>();
    crosses::<submanifold::Ring>();
    crosses::<submanifold::SpinManifold>();
    crosses::<submanifold::SpinManifoldPlan>();
    crosses::<submanifold::SteadySpin>();
    crosses::<submanifold::Style>();
    crosses::<submanifold::SubmanifoldError>();
    crosses::<submanifold::Truncated>();
    crosses::<secular::AverageCriteria>();
    crosses::<secular::CalibratedPower>();
    crosses::<secular::DirectStopReason>();
    crosses::<secular::DirectOptions>();
    crosses::<secular::DirectRow>();
    crosses::<secular::DirectRun>();
    crosses::<secular::EnergyRange>();
    crosses::<secular::GyrostatSpins>();
    crosses::<secular::GyrostatWobble>();
    crosses::<secular::MeasureError>();
    crosses::<secular::MeasureOptions>();
    crosses::<secular::HandOver>();
    crosses::<secular::ManifoldHistory>();
    crosses::<secular::MeasuredPower>();
    crosses::<secular::Measurement>();
    crosses::<secular::Pole>();
    crosses::<secular::Poles>();
    crosses::<secular::Probes>();
    crosses::<choice::AverageBasis>();
    crosses::<choice::AveragePowers>();
    crosses::<choice::Case<'static>>();
    crosses::<choice::ChoiceError>();
    crosses::<choice::Criteria>();
    crosses::<choice::Decision>();
    crosses::<choice::Followed>();
    crosses::<choice::GrowingVibration>();
    crosses::<choice::GyrostatCriteria>();
    crosses::<choice::Instability>();
    crosses::<choice::Last>();
    crosses::<choice::Limits>();
    crosses::<choice::Method>();
    crosses::<choice::MomentsOnly>();
    crosses::<choice::Outcome>();
    crosses::<choice::Reason>();
    crosses::<choice::ReferenceSpins<'static>>();
    crosses::<choice::Span>();
    crosses::<choice::Stop>();
    crosses::<choice::Tried>();
    crosses::<choice::UnknownLiquid>();
    crosses::<choice::Work>();
    crosses::<verification::AverageError>();
    crosses::<verification::AverageRow>();
    crosses::<verification::DegreeRow>();
    crosses::<verification::Difference>();
    crosses::<verification::OrderRow>();
    crosses::<verification::SpinVerification>();
    crosses::<verification::SpinVerificationPlan>();
    crosses::<verification::VerificationPlan>();
    crosses::<verification::Verification>();
    crosses::<verification::VerificationError>();
    crosses::<model::Form>();
    crosses::<model::Method>();
    crosses::<problems::AxialMass>();
    crosses::<problems::CommonProblem>();
    crosses::<problems::Explorer1>();
    crosses::<problems::QuarticQuintic>();
}

/// A type that a module shows is in the list above.
#[test]
fn no_public_type_is_forgotten() {
    let here = include_str!("threads.rs");
    for (module, source) in MODULES {
        let shown = source.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
        let words = shown.flat_map(|names| names.split(|c: char| !c.is_alphanumeric() && c != '_'));
        let types = words.filter(|word| {
            word.starts_with(char::is_uppercase)
                && word.contains(char::is_lowercase)
                && !TRAITS.contains(word)
        });
        for name in types {
            let listed = ['>', '<'].iter().any(|end| here.contains(&format!("<{module}::{name}{end}")));
            assert!(listed, "{module}::{name} is not listed");
        }
    }
}
