//! The reduced equations: polynomials evaluated at many angular velocities in one call, their coefficients, their forms for people.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use quasirigid::model::ReducedBody;
use quasirigid_study::Study;

use crate::failure::Failure;
use crate::watching::interruptible;

/// The reduced equations of a model to an order.
#[pyclass(frozen, module = "quasirigid._core")]
#[derive(Debug)]
pub struct Reduced {
    study: Arc<Study>,
    body: ReducedBody,
    text: String,
}

/// Angular velocities or momenta `(n, 3)`, vectors `(n, 3)` and numbers `(n,)` at each.
type Rows<'py> = PyReadonlyArray2<'py, f64>;
type Vectors<'py> = PyResult<Bound<'py, PyArray2<f64>>>;
type Numbers<'py> = PyResult<Bound<'py, PyArray1<f64>>>;

/// One degree of a polynomial: the degree, exponents of its monomials `(m, 3)`, coefficients `(m, rows)`.
type Part<'py> = (usize, Bound<'py, PyArray2<i64>>, Bound<'py, PyArray2<f64>>);

impl Reduced {
    /// Reduces the body of a study.
    pub fn of(study: Arc<Study>) -> Result<Self, Failure> {
        let equations = study.derive()?;
        let (body, text) = (equations.reduced().clone(), equations.text());
        Ok(Self { study, body, text })
    }

    /// A vector at each angular velocity.
    fn vectors<'py>(
        &self,
        py: Python<'py>,
        omega: &Rows<'py>,
        value: impl Fn(&ReducedBody, [f64; 3]) -> [f64; 3] + Sync,
    ) -> Vectors<'py> {
        let omega = rows(omega)?;
        let values = py.detach(|| omega.iter().flat_map(|omega| value(&self.body, *omega)).collect());
        PyArray1::from_vec(py, values).reshape([omega.len(), 3])
    }

    /// A number at each angular velocity.
    fn numbers<'py>(
        &self,
        py: Python<'py>,
        omega: &Rows<'py>,
        value: impl Fn(&ReducedBody, [f64; 3]) -> f64 + Sync,
    ) -> Numbers<'py> {
        let omega = rows(omega)?;
        let values = py.detach(|| omega.iter().map(|omega| value(&self.body, *omega)).collect());
        Ok(PyArray1::from_vec(py, values))
    }
}

/// Rows of an array `(n, 3)`.
pub fn rows(array: &PyReadonlyArray2<'_, f64>) -> Result<Vec<[f64; 3]>, Failure> {
    if array.shape()[1] != 3 {
        let shape = array.shape();
        return Err(Failure::Input(format!("angular velocities have the shape (n, 3), not {shape:?}")));
    }
    Ok(array.as_array().rows().into_iter().map(|row| [row[0], row[1], row[2]]).collect())
}

#[pymethods]
impl Reduced {
    #[getter]
    fn order(&self) -> usize {
        self.body.order
    }

    #[getter]
    fn mass(&self) -> f64 {
        self.body.mass
    }

    /// Name of the body.
    #[getter]
    fn name(&self) -> &str {
        &self.study.model.name
    }

    #[getter]
    fn notes(&self) -> Vec<String> {
        self.study.model.notes.clone()
    }

    #[getter]
    fn text(&self) -> &str {
        &self.text
    }

    /// The deviation torque.
    fn torque<'py>(&self, py: Python<'py>, omega: Rows<'py>) -> Vectors<'py> {
        self.vectors(py, &omega, ReducedBody::torque)
    }

    /// The angular momentum.
    fn angular_momentum<'py>(&self, py: Python<'py>, omega: Rows<'py>) -> Vectors<'py> {
        self.vectors(py, &omega, ReducedBody::angular_momentum)
    }

    /// The angular velocity of an angular momentum by the energy form.
    fn angular_velocity<'py>(&self, py: Python<'py>, K: Rows<'py>) -> Vectors<'py> {
        self.vectors(py, &K, ReducedBody::angular_velocity)
    }

    /// The rate of the angular momentum by the energy form.
    fn momentum_rate<'py>(&self, py: Python<'py>, K: Rows<'py>) -> Vectors<'py> {
        self.vectors(py, &K, |body, K| body.motion(K).rate)
    }

    /// The rate of the angular velocity without forces.
    fn rate<'py>(&self, py: Python<'py>, omega: Rows<'py>) -> Vectors<'py> {
        self.vectors(py, &omega, |body, omega| body.f.vector(omega))
    }

    /// The power dissipated.
    fn power<'py>(&self, py: Python<'py>, omega: Rows<'py>) -> Numbers<'py> {
        self.numbers(py, &omega, ReducedBody::dissipated_power)
    }

    /// The energy.
    fn energy<'py>(&self, py: Python<'py>, omega: Rows<'py>) -> Numbers<'py> {
        self.numbers(py, &omega, ReducedBody::energy)
    }

    /// Coefficients of a polynomial, degree by degree.
    fn coefficients<'py>(&self, py: Python<'py>, of: &str) -> PyResult<Vec<Part<'py>>> {
        let ReducedBody { f, K, energy, power, .. } = &self.body;
        let parts: Vec<_> = match of {
            "torque" => (3..=f.degree()).map(|degree| self.body.mu(degree)).collect(),
            "angular_momentum" => (1..=K.degree()).map(|degree| K.part(degree).clone()).collect(),
            "rate" => (2..=f.degree()).map(|degree| f.part(degree).clone()).collect(),
            "energy" => (2..=energy.degree()).map(|degree| energy.part(degree).clone()).collect(),
            "power" => (2..=power.degree()).map(|degree| power.part(degree).clone()).collect(),
            _ => return Err(Failure::Input(format!("there is no polynomial {of:?}")).into()),
        };
        let found = parts.iter().map(|part| {
            let terms: Vec<_> = part.terms().collect();
            let exponents = terms.iter().flat_map(|(exponents, _)| exponents.map(|each| each as i64));
            let exponents = PyArray1::from_vec(py, exponents.collect()).reshape([terms.len(), 3])?;
            let values = terms.iter().flat_map(|(_, values)| values.iter().copied()).collect();
            let values = PyArray1::from_vec(py, values).reshape([terms.len(), part.rows()])?;
            Ok((part.degree(), exponents, values))
        });
        found.collect()
    }

    /// The object that `derive --json` prints.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        Ok(interruptible(py, None, |_| Ok(self.study.ending_with_inputs(&self.study.derive()?.json())))?)
    }

    /// Displays for a document that loads amsmath.
    fn latex(&self, py: Python<'_>) -> PyResult<String> {
        Ok(interruptible(py, None, |_| Ok(self.study.derive()?.latex()))?)
    }
}
