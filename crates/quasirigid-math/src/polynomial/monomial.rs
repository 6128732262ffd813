//! Order of the monomials `x^i y^j z^k` of one degree: `i` falls first, then `j`.
//!
//! With `r = j + k` the index of a monomial is `r(r+1)/2 + k`, whatever its degree. So multiplying by `x` keeps the
//! index, and the product of two monomials is the sum of their pairs `(r, k)`.

/// Number of monomials of a degree in three variables.
#[inline]
#[must_use]
pub const fn count(degree: usize) -> usize {
    (degree + 1) * (degree + 2) / 2
}

/// Index of a monomial among those of its degree.
#[inline]
#[must_use]
pub fn index([_, j, k]: [usize; 3]) -> usize {
    let r = j + k;
    r * (r + 1) / 2 + k
}

/// Place of a monomial in a list of all by ascending degree.
#[inline]
#[must_use]
pub fn place(exponents: [usize; 3]) -> usize {
    let degree: usize = exponents.iter().sum();
    degree * (degree + 1) * (degree + 2) / 6 + index(exponents)
}

/// Exponents of every monomial of a degree, in order.
pub fn exponents(degree: usize) -> impl Iterator<Item = [usize; 3]> {
    (0..=degree).flat_map(move |r| (0..=r).map(move |k| [degree - r, r - k, k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn monomials_are_numbered_in_order() {
        for degree in 0..9 {
            let all: Vec<_> = exponents(degree).collect();
            assert_eq!(all.len(), count(degree));
            for (position, monomial) in all.iter().enumerate() {
                assert_eq!(index(*monomial), position);
                assert_eq!(monomial.iter().sum::<usize>(), degree);
            }
        }
        assert_eq!(exponents(2).nth(1), Some([1, 1, 0]));
        let all: Vec<_> = (0..9).flat_map(exponents).collect();
        assert!(all.iter().enumerate().all(|(position, monomial)| place(*monomial) == position));
    }
}
