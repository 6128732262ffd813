//! A record as a run would leave it: a free body whose energy falls while its angular momentum stays.

pub mod secular;

use std::collections::BTreeMap;

use quasirigid_io::record::*;

use secular::evolution;

/// Principal moments (kg·m²).
pub const MOMENTS: [f64; 3] = [9.21, 13.4, 16.3];

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn axpy(x: f64, a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| x * a[i] + b[i])
}

/// Rows of the principal axes: a turn by 0.3 rad about z, then 0.2 rad about x.
pub fn axes() -> [Vector; 3] {
    let ([s, c], [t, d]) = ([0.3f64.sin(), 0.3f64.cos()], [0.2f64.sin(), 0.2f64.cos()]);
    [[c, s, 0.0], [-s * d, c * d, t], [s * t, -c * t, d]]
}

fn to_body(k: Vector) -> Vector {
    let axes = axes();
    [0, 1, 2].map(|i| (0..3).map(|a| k[a] * axes[a][i]).sum())
}

fn inertia() -> [Vector; 3] {
    let axes = axes();
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).map(|a| MOMENTS[a] * axes[a][i] * axes[a][j]).sum()))
}

fn omega(k: Vector) -> Vector {
    [0, 1, 2].map(|a| k[a] / MOMENTS[a])
}

/// `K̇ = K × (ω + α K × ω)`: keeps `|K|`, loses the energy `α |K × ω|²` per second.
fn rate(k: Vector, alpha: f64) -> Vector {
    cross(k, axpy(alpha, cross(k, omega(k)), omega(k)))
}

fn step(k: Vector, alpha: f64, h: f64) -> Vector {
    let k1 = rate(k, alpha);
    let k2 = rate(axpy(h / 2.0, k1, k), alpha);
    let k3 = rate(axpy(h / 2.0, k2, k), alpha);
    let k4 = rate(axpy(h, k3, k), alpha);
    let sum = [0, 1, 2].map(|i| k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    axpy(h / 6.0, sum, k)
}

const COLUMNS: [(&str, &str); 13] = [
    ("t", "s"),
    ("wx", "rad/s"),
    ("wy", "rad/s"),
    ("wz", "rad/s"),
    ("qw", "1"),
    ("qx", "1"),
    ("qy", "1"),
    ("qz", "1"),
    ("energy", "J"),
    ("momentum", "N m s"),
    ("dissipated", "J"),
    ("energy_drift", "J"),
    ("momentum_drift", "1"),
];

/// A history of so many rows over `duration` seconds, losing energy at the rate `alpha`.
pub fn history(system: &str, rows: usize, duration: f64, alpha: f64) -> HistoryRecord {
    let substeps = ((duration / 0.1) as usize).div_ceil(rows.max(2) - 1);
    let h = duration / ((rows.max(2) - 1) * substeps) as f64;
    let energy = |k: Vector| 0.5 * dot(k, omega(k));
    let power = |k: Vector| {
        alpha * {
            let l = cross(k, omega(k));
            dot(l, l)
        }
    };
    let mut k = [11.7, 3.9, 2.2];
    let (first, size) = (energy(k), dot(k, k).sqrt());
    let (mut dissipated, mut revolutions, mut angle) = (0.0, 0.0, 0.0f64);
    let mut columns: Vec<Column> = COLUMNS
        .iter()
        .chain(&[("nutation_max", "rad")])
        .map(|&(name, unit)| Column { name: name.into(), unit: unit.into(), values: vec![] })
        .collect();
    for row in 0..rows {
        if row > 0 {
            for _ in 0..substeps {
                let next = step(k, alpha, h);
                let middle = [0, 1, 2].map(|i| 0.5 * (k[i] + next[i]));
                dissipated += h / 6.0 * (power(k) + 4.0 * power(middle) + power(next));
                let turn = h * dot(omega(k), omega(k)).sqrt();
                revolutions += turn / std::f64::consts::TAU;
                angle += turn;
                k = next;
            }
        }
        let w = to_body(omega(k));
        let drift = energy(k) - first + dissipated;
        let norm = dot(k, k).sqrt();
        let values = [
            h * (row * substeps) as f64,
            w[0],
            w[1],
            w[2],
            (angle / 2.0).cos(),
            0.0,
            0.0,
            (angle / 2.0).sin(),
            energy(k),
            norm,
            dissipated,
            drift,
            norm / size - 1.0,
            (k[2] / norm).clamp(-1.0, 1.0).acos(),
        ];
        columns.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
    }
    let last = |name: &str| {
        columns.iter().find(|c| c.name == name).and_then(|c| c.values.last().copied()).unwrap_or(0.0)
    };
    HistoryRecord {
        form: "momentum form, degree 5".into(),
        method: "explicit Runge-Kutta of order 8".into(),
        status: "finished".into(),
        message: "The run reached the end of its duration.".into(),
        tolerance: 1e-10,
        steps: (rows * substeps) as u64,
        rejected: 12,
        revolutions,
        energy: first,
        dissipated,
        dissipation: shares(),
        work: 0.0,
        energy_drift: last("energy_drift"),
        left_out: 0.0,
        load_ratio: 0.0,
        ringing: None,
        momentum_drift: last("momentum_drift"),
        rows: rows as u64,
        log: None,
        system: system.into(),
        columns,
    }
}

/// Shares of three dissipators.
pub fn shares() -> BTreeMap<String, f64> {
    [("spring tip-carrier", 0.62), ("tank", 0.3795), ("flywheel", 0.0005)]
        .map(|(name, share)| (name.into(), share))
        .into()
}

fn criterion(name: &str, symbol: &str, value: f64, limit: f64, sentence: &str) -> CriterionRecord {
    let verdict = if value < limit {
        "holds"
    } else if value < 3.0 * limit {
        "marginal"
    } else {
        "fails"
    };
    let [name, symbol, verdict, sentence] = [name, symbol, verdict, sentence].map(String::from);
    CriterionRecord { name, symbol, value, limit, verdict, sentence }
}

fn validity() -> ValidityRecord {
    ValidityRecord {
        valid: true,
        verdict: "The motion is slow against every vibration, so the reduced equations hold to about 0.1 %."
            .into(),
        overall: "marginal".into(),
        T1: 0.263,
        T2: Some(4.81),
        T3: 0.752,
        frequencies: vec![23.871, 24.466, 24.503, 31.209, 33.8, 47.25],
        decay_rates: vec![0.2079, 0.3, 0.3002, 0.51, 0.58, 1.1],
        relaxations: vec![24.53, 3.846],
        criteria: vec![
            criterion(
                "Spin against the slowest vibration",
                "|ω|/Ω₁",
                0.0557,
                0.1,
                "Deformation follows the spin without lag.",
            ),
            criterion(
                "Damping force against spring force",
                "|B|ω/|C|",
                0.0166,
                0.1,
                "Dashpots bend the motion little within a turn.",
            ),
            criterion(
                "Decay of free vibrations against the spin",
                "T₂/T₃",
                2.4,
                1.0,
                "Vibrations at the start are not yet forgotten after one turn; forced motion does not mind.",
            ),
            criterion(
                "Degree 5 against degree 3",
                "|Ω₅|/|Ω₃|",
                0.00312,
                0.1,
                "The series converges well at this spin.",
            ),
        ],
    }
}

/// A viscous liquid, and one behind its boundary layer.
fn liquids() -> Vec<LiquidRecord> {
    let tank = LiquidRecord {
        name: "glycerine".into(),
        mass: 31.67,
        radius: 0.1861,
        viscosity: 1.119e-3,
        reynolds: 0.976,
        P: [[2.4426e-7, 1e-24, 0.0], [1e-24, 2.4426e-7, 0.0], [0.0, 0.0, 3.1e-7]],
        errors: Some([1e-9, 2.3e-8, 1e-9]),
        equivalent_inertia: None,
    };
    let equivalent_inertia = Some([[0.802, 0.0, 0.0], [0.0, 1.116, 0.0], [0.0, 0.0, 1.441]]);
    let water = LiquidRecord { name: "water".into(), errors: None, equivalent_inertia, ..tank.clone() };
    vec![tank, water]
}

/// A mode that rises with the spin, and one that stays and grows.
fn campbell() -> CampbellRecord {
    let spins: Vec<f64> = (1..=20).map(|step| 0.1 * f64::from(step)).collect();
    let modes = spins.iter().flat_map(|spin| [(*spin, 0.4 * spin, 0.01), (*spin, 3.0, -0.002)]);
    let mut record = CampbellRecord { axis: "least".into(), spin: 1.0, ..Default::default() };
    for (spin, frequency, rate) in modes {
        record.spins.push(spin);
        record.frequencies.push(frequency);
        record.decay_rates.push(rate);
    }
    record
}

/// Reduced equations about a spin whose nutation grows to 30 degrees and decays beyond, with names that a page has to escape.
fn about_spin() -> AboutSpinRecord {
    let angles: Vec<f64> = (0..=20).map(|step| 0.001 + 0.04 * f64::from(step)).collect();
    let column = |name: &str, unit: &str, value: &dyn Fn(f64) -> f64| Column {
        name: name.into(),
        unit: unit.into(),
        values: angles.iter().map(|angle| value(*angle)).collect(),
    };
    AboutSpinRecord {
        sentence:
            "The reduced equations about the spin hold to a nutation of 35 degrees within 1 % at degree 5."
                .into(),
        holds: true,
        axis: "least".into(),
        spin: [0.0, 0.1, 1.0],
        angular_momentum: [0.0, 0.9, 9.0],
        degree: 5,
        style: "normal-form".into(),
        masters: vec![
            MasterRecord { name: "nutation".into(), decay_rate: -1e-3, frequency: 0.4 },
            MasterRecord { name: "damper <x>".into(), decay_rate: 2e-2, frequency: 0.0 },
        ],
        range: 35f64.to_radians(),
        share: 0.01,
        start: Some(20f64.to_radians()),
        resonances: vec!["near resonance: z1^2 turns within 3 % of tip <x>, 0.82 rad/s".into()],
        dissipators: vec!["tip <x>".into(), "tip y".into()],
        columns: vec![
            column("amplitude", "rad", &|angle| angle),
            column("nutation", "rad", &|angle| angle),
            column("decay_rate", "1/s", &|angle| 4e-3 * (angle * angle - 0.27)),
            column("frequency", "rad/s", &|angle| 0.4 - 0.2 * angle * angle),
            column("power", "W", &|angle| angle * angle),
            column("defect", "1", &|angle| 0.02 * angle),
            column("share of tip <x>", "1", &|angle| 0.7 + 0.2 * angle),
            column("share of tip y", "1", &|angle| 0.3 - 0.2 * angle),
        ],
    }
}

/// A steady spin with two modes, and one that was not found.
fn steady_spins() -> Vec<SteadySpinRecord> {
    let mode = |name: &str, decay_rate: f64, frequency: f64| ModeRecord {
        name: name.into(),
        nutation: name == "nutation",
        neutral: false,
        rate_bound: None,
        overdamped: false,
        decay_rate,
        frequency,
        time_constant: Some(1.0 / decay_rate),
        damping_ratio: decay_rate / frequency,
        seen_from_outside: [frequency - 0.3, frequency + 0.3],
        moves: shares(),
        dissipation: shares(),
    };
    let found = SteadySpinRecord {
        sentence: "About the axis of greatest inertia the nutation decays e-fold in 44 min.".into(),
        axis: "greatest".into(),
        spin: Some([0.0, 0.0, 0.3]),
        angular_momentum: Some([0.0, 0.0, 12.0]),
        energy: Some(1.8),
        displacements: shares(),
        stable: true,
        modes: vec![mode("nutation", 3.8e-4, 0.12), mode("tip <x>", -2.1e-3, 4.7)],
        slowest: None,
    };
    let sentence = "About the axis of least inertia: no steady spin was found.".into();
    let lost =
        SteadySpinRecord { sentence, axis: "least".into(), spin: None, modes: vec![], ..found.clone() };
    vec![found, lost]
}

/// A record with a damped and a rigid history.
pub fn record(rows: usize, duration: f64, alpha: f64) -> RunRecord {
    let histories = vec![history("reduced", rows, duration, alpha), history("rigid", rows, duration, 0.0)];
    RunRecord {
        scene: None,
        format: RECORD_FORMAT,
        version: "0.1.0".into(),
        model: ModelRecord {
            name: "Boom satellite".into(),
            file: "boom-satellite.toml".into(),
            sha256: "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08".into(),
            files: Vec::new(),
        },
        inputs: None,
        notes: vec!["The spring “tip to carrier” has no damping along y; its vibration decays only through the others.".into()],
        body: BodyRecord {
            mass: 41.0,
            center_of_mass: [0.0195, 0.1049, 0.0122],
            pole: [0.0195, 0.1049, 0.0122],
            support: "free".into(),
            kind: quasirigid_io::model::BodyKind::Spacecraft,
            inertia: inertia(),
            principal_moments: MOMENTS,
            principal_axes: axes(),
            coordinates: ["tip.x", "tip.y", "tip.z", "panel.angle"].map(String::from).into(),
            resolution: Some(ResolutionRecord {
                degree: None,
                cells: Some(6123),
                error: Some(0.034),
                sentence: "\"nucleus\": finite elements in 6123 cells; known to 3.4 %.".into(),
            }),
        },
        liquids: liquids(),
        validity: validity(),
        steady_spins: steady_spins(),
        campbell: Some(campbell()),
        about_spin: Some(about_spin()),
        reduction: ReductionRecord {
            order: 3,
            optimal_order: 9,
            residual: 3.1e-6,
            degrees: [(2, 0.271), (4, 1.93e-4), (5, 1.21e-6), (6, 3.3e-7), (7, 8.0e-9)]
                .map(|(degree, size)| DegreeRecord { degree, size, relative: size / 0.271 })
                .into(),
            power: 3.21e-4,
            dissipation: shares(),
        },
        histories,
        verification: Some(verification()),
        evolution: Some(evolution(0.75)),
    }
}

/// Two orders, one of them reached.
fn verification() -> VerificationRecord {
    let order = |p: usize, order: Option<f64>| {
        let epsilons: Vec<f64> = (0..5).map(|k| 0.5f64.powi(k)).collect();
        let errors = |scale: f64| epsilons.iter().map(|e| scale * e.powi(p as i32 + 1)).collect();
        OrderRecord {
            form: "momentum".into(),
            p,
            order,
            expected: p + 1,
            reached: order.is_some(),
            epsilons: epsilons.clone(),
            errors: errors(1e-3),
            attitude: errors(5e-3),
            dissipated: errors(2e-4),
            dissipation: errors(0.1),
        }
    };
    let orders = vec![order(1, Some(2.01)), order(2, None)];
    let average = AverageRecord {
        epsilons: vec![1.0, 0.5],
        errors: vec![1e-3, 2.5e-4],
        order: Some(2.0),
        expected: 2,
        reached: true,
    };
    VerificationRecord {
        reached: false,
        rotations: 5.0,
        duration: 31.4,
        orders,
        average: Some(average),
        average_left_out: None,
    }
}

/// A record without any history or evolution.
pub fn without_histories() -> RunRecord {
    RunRecord { histories: vec![], verification: None, evolution: None, ..record(2, 1.0, 0.0) }
}
