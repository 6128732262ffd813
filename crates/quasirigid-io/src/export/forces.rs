//! External forces in the reduced equations: the formulas, and loads evaluated at the initial state.
//! Under forces `μ` and `φ` are functions of attitude, place and time, so there are no coefficients to print as without forces.
//! Equation (E3), docs/theory/08-full-system.md.

use std::fmt::{self, Write};

use serde::Serialize;

use super::text::{number, vector};

/// External forces, as the reduced equations have them: paper, (3.1) to (3.4). (E3)
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Forces {
    /// Names of the forces.
    pub names: Vec<String>,
    /// Loads at the start; none without an initial state.
    pub start: Option<StartLoads>,
}

/// Loads at `t = 0`, body axes.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct StartLoads {
    /// Angular velocity that they are taken at (rad/s).
    pub angular_velocity: [f64; 3],
    /// Moment `M*` on the frozen body about the pole (N·m), with the inertial force of a driven pole.
    pub moment: [f64; 3],
    /// Force `F*` on the frozen body (N), with the inertial force of a driven pole.
    pub force: [f64; 3],
    /// Contributions of the displacements; none where the angular-velocity form is not written for the body.
    pub displaced: Option<DisplacedLoads>,
}

/// Contributions of the displacements to the loads, to order `p`, at most 3.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct DisplacedLoads {
    /// First variation `M₁* = Σ{r × F* + ρ × (∂F/∂R r + ∂F/∂Ṙ ṙ)}` (N·m), part of `μ`.
    pub moment_variation: [f64; 3],
    /// `μ` (N·m).
    pub mu: [f64; 3],
    /// First variation of the force (N), part of `φ`.
    pub force_variation: [f64; 3],
    /// `φ` (N).
    pub phi: [f64; 3],
    /// Internal coordinates `C⁻¹(Q* − B C⁻¹ Q̇*)`.
    pub displacements: Vec<f64>,
}

const EQUATIONS: &str = "
Under forces mu and phi are functions of attitude, place, velocity and time; at
each moment, with all rates along the motion of the frozen body (E3),
  mu  = M1* - (d/dt + w x)(q_j J_j w + q_j' h_j) - s x a
  phi = F1* - (d/dt + w x)^2 s             s = S_j q_j,  a = R0'' of a free body
  M1* = sum r x F* + rho x F1,   F1 = dF/dR r + dF/dR' r',   F1* = sum F1
  q   = C^-1 (Q* - B C^-1 Q*'),  Q*_j = Q_j + 1/2 w J_j w - h_j w' - S_j a
`simulate --form angular-velocity` integrates them, `simulate` their momentum form (E2).
";

const OTHERWISE: &str = "
Under forces mu is no polynomial, and with rotors, liquids or momentum wheels
the program has none in the paper's form: it integrates the momentum form,
K' = K x w + M with w, M at the displacements and rates of (E2).
";

/// Writes the equations with forces, and the loads at the start.
pub(super) fn write(out: &mut String, forces: &Forces, elastic_only: bool) -> fmt::Result {
    out.push_str(if elastic_only { EQUATIONS } else { OTHERWISE });
    match &forces.start {
        None => writeln!(out, "They depend on the state, and the model has no initial state.")?,
        Some(start) => {
            writeln!(out, "\nat the start, body axes")?;
            let mut line = |name: &str, entries: [f64; 3], unit: &str| {
                writeln!(out, "  {name:<16}{} {unit}", vector(entries))
            };
            line("w", start.angular_velocity, "rad/s")?;
            line("M*", start.moment, "N m")?;
            if let Some(displaced) = &start.displaced {
                line("M1*, part of mu", displaced.moment_variation, "N m")?;
                line("mu", displaced.mu, "N m")?;
            }
            line("F*", start.force, "N")?;
            if let Some(displaced) = &start.displaced {
                line("F1*, of phi", displaced.force_variation, "N")?;
                line("phi", displaced.phi, "N")?;
                let largest = displaced.displacements.iter().fold(0.0_f64, |max, q| max.max(q.abs()));
                writeln!(out, "  {:<16}{:>13}", "largest q", number(largest))?;
            }
        }
    }
    writeln!(out, "\nWithout the forces:")
}
