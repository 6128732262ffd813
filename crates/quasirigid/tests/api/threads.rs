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

macro_rules! types {
    ($($module:ident { $($name:ident $([$argument:tt])?)+ })+) => {
        /// Modules and names of the types.
        const LISTED: &[(&str, &str)] = &[$($((stringify!($module), stringify!($name)),)+)+];

        /// The compiler is the test.
        #[test]
        fn public_types_are_send_sync_and_debug() {
            crosses::<quasirigid::Error>();
            $($(crosses::<$module::$name $(<$argument>)?>();)+)+
        }
    };
}

types! {
    averaging {
        DampingEstimate Drift DriftHistory DriftLimits DriftState DriftStopReason DrivenMaterial EddyTorque Elapsed
        EllipsoidLoss EllipsoidPassage EllipsoidRefusal EulerAngles Evolution EvolutionError Floquet
        FreeRotation FreeRotationError Harmonic HarmonicResonance HillError HillResponse InterpolatedPower
        Level LevelError LevelEvolution LevelPassage LevelRow LevelStopReason MaterialFlow
        ObservedError ObservedPeriods ParametricResonance PeriodicResponse['static] PolynomialPower PowerSource Response
        RotationState Separatrix SeparatrixPassage SlowTorque SmallBody Unaveraged Until Way Wobble
        WobblingEllipsoid
    }
    elements {
        Anchor Appendage AppendageMode Approximation Assembly BeamError Built Boom Bushing Carrier Cavity CavityShape Coefficient
        Condensation Connection Constant ElasticMaterial ElasticityError ElementError ElementId
        ElementKind Ellipsoid End Extent Field Frame FrameNode GivenModes Grading HingeCoefficient Hinged Incomplete InertiaPoint
        Layer Material Matrices MeasuredSlosh Member Modulus NamedController Network NodalMass NodeRef ObservedShape Orthotropic Panel Part PartKind
        PartReduction PlaceRef Point PointMotion PrescribedMotion Prestress Problem Quantity Regime Region Relaxed Resolution Rotor
        RingBaffle RotorKind Section SectionShape SettledTank Settling ShellError SlowLiquid Slug Solid Spectrum Spring SpringLaw SunlightAccuracy SunlitShape
        ApplicationPoint StokesError Surface Tank TankContents TankDamping TankError TankMode TankShape TipMass Tube TubeError RotorAxis Visual Wheel WheelSpeed
        Bar BarKind Coupling Mixed NodeBody NodeLink Skin Strain Term Weighted
    }
    model {
        Advection BalancedSpin BodyParts Carried Coordinate CurvedPaths Displaced Dissipator Drive DriveFault DrivenWheel
        EnergyMotion[f64] ExpandedMotion FlexibleBody FlexibleError Follower Form Friction Gimbal Hinge Hung
        Inertia InertiaError Invariants Kinetics LiquidFlow LiquidMemory Marker Measured Method Mode
        MotionState[f64] Pair PartMass Polhode Principal RationalModulus Reach Recoiling ReducedBody Rheology RheologyError
        SpinCoefficients SpinMatrix StraightKinetics Support TubeFlow TubeFriction Velocities Viscoelastic Watched Wheels
    }
    reduction {
        Assessment['static] Comparison Criterion DegreeSize ReductionError Relaxation Residual Resonance
        Validity ValidityError Verdict Vibrations
    }
    dynamics {
        BoundaryLayer Checkpoint DampedMode Event FastPart ForcedTorque Forced['static] Form FullState FullStepper['static]
        IsolatedSpin Method Missed Nutation Nutations Options Outcome PropagateError RigidState ReducedStepper Ringing Rounding
        Run Sample Scan SlowEquations SlowPoint SlowState SpinPath Start SteadySpin SteadySpins StepStatus StepperError
    }
    modes {
        CampbellError CantileverError CantileverMode CantileverModes Entries EquilibriumError FreeMode FrozenSpin SpinMagnitude SpinMatrices ModesError SteadyStateGuess RelativeEquilibrium SpinEigenvalues SpinMode
        LinearAccuracy LinearError LinearInput LinearModel LinearOutput LinearState ModeRange SlowModes SpinModes SteadyError SteadyModes SteadyState TruncatedLinearModel WhirlOnset
        StateSpace Truncation TruncationError TruncationMethod TruncationRequest['static]
    }
    submanifold {
        AmplitudeRange Backbone BackbonePoint Defect ExpansionError ManifoldPower ManifoldRun
        ManifoldStart MasterMode Masters CrossedResonance NearResonance OuterMode Ring SpinManifold
        SpinManifoldPlan SteadySpin Style SubmanifoldError Truncated
    }
    secular {
        AverageCriteria CalibratedPower DirectOptions DirectRow DirectRun DirectStopReason EnergyRange
        GyrostatSpins GyrostatWobble ManifoldBoundary ManifoldHistory MeasureError MeasureOptions MeasuredBy MeasuredPower
        Measurement Places Pole Poles SettledStarts['static] SpotChecks
    }
    choice {
        AverageBasis AveragePowers Case['static] ChoiceError Criteria Decision Followed GrowingVibration
        GyrostatCriteria Instability Last Limits Method MomentsOnly Outcome Reason ReferenceSpins['static]
        Span Stop Tried UnknownLiquid Work
    }
    verification {
        AverageError AverageRow DegreeRow Difference OrderRow SpinVerification SpinVerificationPlan
        Verification VerificationError VerificationPlan
    }
    problems {
        AxialMass CommonProblem Explorer1 QuarticQuintic
    }
}

/// A type that a module shows is in the list above.
#[test]
fn no_public_type_is_forgotten() {
    for (module, source) in MODULES {
        let shown = source.split("pub use ").skip(1).filter_map(|rest| rest.split(';').next());
        let words = shown.flat_map(|names| names.split(|c: char| !c.is_alphanumeric() && c != '_'));
        let types = words.filter(|word| {
            word.starts_with(char::is_uppercase)
                && word.contains(char::is_lowercase)
                && !TRAITS.contains(word)
        });
        for name in types {
            let listed = LISTED.contains(&(module, name));
            assert!(listed, "{module}::{name} is not listed");
        }
    }
}
