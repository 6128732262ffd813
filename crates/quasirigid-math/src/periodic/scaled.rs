use super::Unfolded;

/// System in units in which every component is of the size of one, so that neither the pivots of the linear equations nor the eigenvalues depend on
/// the units of the user; powers of two, which leave every digit.
#[derive(Clone)]
pub(super) struct Scaled<U> {
    system: U,
    units: Vec<f64>,
    place: Vec<f64>,
}

impl<U: Unfolded> Scaled<U> {
    /// The system in units of the sizes of its components.
    pub fn of(system: &U) -> Self {
        let unit = |component: usize| system.scale(component).log2().floor().exp2();
        let units: Vec<f64> = (0..system.size()).map(unit).collect();
        Self { system: system.clone(), place: vec![0.0; units.len()], units }
    }

    /// A state, or any row of components, in these units.
    pub fn down(&self, state: &[f64]) -> Vec<f64> {
        state.iter().zip(self.units.iter().cycle()).map(|(value, unit)| value / unit).collect()
    }

    /// A state, or any row of components, in the units of the system.
    pub fn up(&self, state: &[f64]) -> Vec<f64> {
        state.iter().zip(self.units.iter().cycle()).map(|(value, unit)| value * unit).collect()
    }
}

impl<U: Unfolded> Unfolded for Scaled<U> {
    fn size(&self) -> usize {
        self.units.len()
    }

    fn parameters(&self) -> usize {
        self.system.parameters()
    }

    fn rate(&mut self, z: &[f64], parameters: &[f64], rate: &mut [f64]) {
        let places = self.place.iter_mut().zip(z).zip(&self.units);
        places.for_each(|((place, value), unit)| *place = value * unit);
        self.system.rate(&self.place, parameters, rate);
        rate.iter_mut().zip(&self.units).for_each(|(rate, unit)| *rate /= unit);
    }

    fn directions(&mut self, z: &[f64]) -> Vec<Vec<f64>> {
        let place = self.up(z);
        self.system.directions(&place).iter().map(|direction| self.down(direction)).collect()
    }

    fn scale(&self, component: usize) -> f64 {
        self.system.scale(component) / self.units[component]
    }
}
