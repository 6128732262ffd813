//! Elimination of linear equations, one after the other: each gives one component by components that stay unknown.

use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A component of a node, 0 to 5.
pub(super) type Component = (usize, usize);
/// Components with their factors.
pub(super) type Form = BTreeMap<Component, f64>;

/// Factor over the greatest of its equation up to which it is rounding.
const ROUNDING: f64 = 1e-10;
/// Factor of the first term over the greatest from which it is the one that the equation gives.
const FIRST: f64 = 0.1;

/// Components that equations give, by those that stay unknown.
#[derive(Default)]
pub(super) struct Elimination {
    pub given: BTreeMap<Component, Form>,
    /// Given components in which an unknown one stands.
    users: HashMap<Component, BTreeSet<Component>>,
}

impl Elimination {
    /// Takes the equation `form = 0`, for a component that `may` be given, that of the `first` node where its factor allows.
    /// Whether there is such a component, or the equation follows from those before.
    pub fn take(&mut self, form: &Form, first: usize, may: impl Fn(Component) -> bool) -> bool {
        let greatest = |form: &Form| form.values().fold(0.0, |most: f64, factor| most.max(factor.abs()));
        let least = ROUNDING * greatest(form);
        let mut sum = Form::new();
        for (component, factor) in form {
            match self.given.get(component) {
                Some(given) => add(&mut sum, *factor, given),
                None => *sum.entry(*component).or_default() += factor,
            }
        }
        sum.retain(|_, factor| factor.abs() > least);
        if sum.is_empty() {
            return true;
        }
        let size = |(_, factor): &(&Component, &f64)| factor.abs();
        let offered = || sum.iter().filter(|(component, _)| may(**component));
        let Some(best) = offered().max_by(|a, b| size(a).total_cmp(&size(b))) else { return false };
        let own = offered().filter(|(component, _)| component.0 == first);
        let own =
            own.max_by(|a, b| size(a).total_cmp(&size(b))).filter(|own| size(own) >= FIRST * size(&best));
        let (pivot, factor) = own.unwrap_or(best);
        let (pivot, factor) = (*pivot, *factor);
        sum.remove(&pivot);
        self.give(pivot, sum.into_iter().map(|(component, other)| (component, -other / factor)).collect());
        true
    }

    /// Gives a component, also where it stands in others that are given.
    fn give(&mut self, pivot: Component, form: Form) {
        let mut changed = self.users.remove(&pivot).unwrap_or_default();
        for user in &changed {
            let row = self.given.get_mut(user).expect("users are given");
            let factor = row.remove(&pivot).unwrap_or_default();
            add(row, factor, &form);
        }
        changed.insert(pivot);
        for component in form.keys() {
            self.users.entry(*component).or_default().extend(&changed);
        }
        self.given.insert(pivot, form);
    }
}

/// Adds a multiple of a form.
fn add(sum: &mut Form, factor: f64, form: &Form) {
    for (component, other) in form {
        *sum.entry(*component).or_default() += factor * other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn form(terms: &[(usize, usize, f64)]) -> Form {
        terms.iter().map(|(node, component, factor)| ((*node, *component), *factor)).collect()
    }

    #[test]
    fn what_is_given_stands_by_unknowns_alone() {
        let mut all = Elimination::default();
        // u = 2 v, v = 3 w − x, and their sum, which says nothing new
        assert!(all.take(&form(&[(0, 0, 1.0), (1, 0, -2.0)]), 0, |_| true));
        assert!(all.take(&form(&[(1, 0, 1.0), (2, 0, -3.0), (3, 1, 1.0)]), 1, |_| true));
        assert!(all.take(&form(&[(0, 0, 1.0), (1, 0, -1.0), (2, 0, -3.0), (3, 1, 1.0)]), 0, |_| true));
        assert_eq!(all.given.len(), 2);
        assert_eq!(all.given[&(0, 0)], form(&[(2, 0, 6.0), (3, 1, -2.0)]));
        assert_eq!(all.given[&(1, 0)], form(&[(2, 0, 3.0), (3, 1, -1.0)]));
        // none of the unknowns may be given
        assert!(!all.take(&form(&[(0, 0, 1.0), (2, 1, 1.0)]), 0, |(node, _)| node > 5));
    }

    #[test]
    fn a_small_factor_is_not_divided_by() {
        let mut all = Elimination::default();
        assert!(all.take(&form(&[(0, 0, 1e-3), (1, 0, -1.0)]), 0, |_| true));
        assert_eq!(all.given[&(1, 0)], form(&[(0, 0, 1e-3)]));
    }
}
