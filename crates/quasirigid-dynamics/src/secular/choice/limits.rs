/// Limits of the methods: errors that are accepted, and extents up to which a method is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest error of an average. (Q7)
    pub average_error: f64,
    /// Largest error of the time of an average from the uneven fall of the energy, where the full system can be followed.
    pub uneven: f64,
    /// Largest error of an average under a torque, which has no other method.
    pub error_under_torque: f64,
    /// Largest error of a measured power, of the rates of the modes, and of the response of liquids.
    pub measured_error: f64,
    /// Largest share of the losses that the equations of motion may leave out.
    pub losses_left_out: f64,
    /// Relative change of a difference of moments of inertia by elasticity from which level curves are followed.
    pub moments_change: f64,
    /// Ratio of the spin to the slowest elastic frequency up to which level curves are followed.
    pub spin_ratio_of_levels: f64,
    /// Bound of the ratio of any spin to the slowest elastic frequency up to which level curves with momentum wheels are followed.
    pub spin_ratio_of_gyrostat_levels: f64,
    /// Ratio of the spin to the slowest elastic frequency from which averages are compared with short runs. (Q9)
    pub spin_ratio_of_probes: f64,
    /// Decay in a period of the polhode up to which the power has a mean.
    pub decay_per_period: f64,
    /// Revolutions up to which the full system is followed at once, or unasked where their number is not known.
    pub few_revolutions: f64,
    /// Revolutions up to which the full system is followed where nothing else holds.
    pub many_revolutions: f64,
    /// Coordinates up to which the response in the spinning frame is computed.
    pub coordinates_of_spinning_frame: usize,
    /// Coordinates up to which the reduced equations about a spin are tried unasked.
    pub coordinates_of_manifold: usize,
    /// Coordinates up to which periodic motions are tried unasked.
    pub coordinates_of_periodic_motions: usize,
    /// Steps of the full system.
    pub steps: u64,
    /// Steps of the full system unasked, times the square of the number of coordinates or, on curved paths, its cube: minutes.
    pub unasked_steps: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            average_error: 0.04,
            uneven: 0.1,
            error_under_torque: 0.1,
            measured_error: 0.03,
            losses_left_out: 0.02,
            moments_change: 0.01,
            spin_ratio_of_levels: 0.15,
            spin_ratio_of_gyrostat_levels: 0.1,
            spin_ratio_of_probes: 0.1,
            decay_per_period: 0.05,
            few_revolutions: 3_000.0,
            many_revolutions: 200_000.0,
            coordinates_of_spinning_frame: 120,
            coordinates_of_manifold: 150,
            coordinates_of_periodic_motions: 40,
            steps: 30_000_000,
            unasked_steps: 1e9,
        }
    }
}

impl Limits {
    /// Steps of a full system that was not asked for, with so many coordinates, on curved paths or straight ones.
    #[must_use]
    pub fn steps_unasked(&self, coordinates: usize, curved_paths: bool) -> u64 {
        let work = (coordinates.max(1) as f64).powi(if curved_paths { 3 } else { 2 });
        self.steps.min((self.unasked_steps / work) as u64)
    }
}
