//! Vectors of three numbers.

/// A vector.
pub type Vector = [f64; 3];

/// Scalar product.
pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product.
pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `x a + y b + z c`.
pub fn combined([x, y, z]: Vector, [a, b, c]: [Vector; 3]) -> Vector {
    [0, 1, 2].map(|i| x * a[i] + y * b[i] + z * c[i])
}

/// The direction of a vector; none for zero and for a vector that is not finite. Does not overflow.
pub fn direction(a: Vector) -> Option<Vector> {
    let largest = a.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let scaled = a.map(|x| x / largest);
    let norm = dot(scaled, scaled).sqrt();
    let unit = scaled.map(|x| x / norm);
    unit.iter().all(|x| x.is_finite()).then_some(unit)
}
