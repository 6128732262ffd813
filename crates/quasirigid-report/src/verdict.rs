//! The three verdicts, in words, colour and shape.

use maud::{Markup, html};
use quasirigid_io::record::ValidityRecord;

/// Verdict, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The criterion or the run holds.
    Holds,
    /// Roughly.
    Marginal,
    /// Not at all.
    Fails,
}

impl Verdict {
    /// Verdict of one criterion. A word that is not in the contract counts as a failure.
    pub fn of_criterion(word: &str) -> Self {
        match word {
            "holds" => Self::Holds,
            "marginal" => Self::Marginal,
            _ => Self::Fails,
        }
    }

    /// Verdict of all criteria: as the record tells; of a record without one, the worst criterion; a record that calls itself invalid is at
    /// best marginal, and fails when no criterion says why.
    pub fn of_all(validity: &ValidityRecord) -> Self {
        if !validity.overall.is_empty() {
            return Self::of_criterion(&validity.overall);
        }
        let worst = validity.criteria.iter().map(|criterion| Self::of_criterion(&criterion.verdict)).max();
        match worst {
            None | Some(Self::Holds) if !validity.valid => Self::Fails,
            None => Self::Holds,
            Some(worst) => worst,
        }
    }

    /// CSS class of the colour.
    pub fn class(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Marginal => "marginal",
            Self::Fails => "fails",
        }
    }

    /// The verdict on a whole run.
    pub fn words(self) -> &'static str {
        match self {
            Self::Holds => "Valid",
            Self::Marginal => "Marginal",
            Self::Fails => "Not valid",
        }
    }

    /// A tick in a disc, an exclamation mark in a triangle, a cross in a square: told apart without colour.
    pub fn icon(self) -> Markup {
        let (outline, mark) = match self {
            Self::Holds => ("M12 1a11 11 0 1 0 0 22a11 11 0 1 0 0-22z", "M6.5 12.5l3.8 3.8l7.2-8.3"),
            Self::Marginal => ("M12 1.5L23.5 22.5H.5z", "M12 9v6M12 18.6v.1"),
            Self::Fails => ("M2 2h20v20H2z", "M7 7l10 10M17 7L7 17"),
        };
        html! {
            svg.icon.(self.class()) viewBox="0 0 24 24" aria-hidden="true" focusable="false" {
                path.outline d=(outline) {}
                path.mark d=(mark) {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use quasirigid_io::record::CriterionRecord;

    use super::*;

    fn validity(valid: bool, verdicts: &[&str]) -> ValidityRecord {
        let criterion = |verdict: &&str| CriterionRecord {
            name: String::new(),
            symbol: String::new(),
            value: 0.0,
            limit: 1.0,
            verdict: (*verdict).into(),
            sentence: String::new(),
        };
        let criteria = verdicts.iter().map(criterion).collect();
        ValidityRecord {
            valid,
            verdict: String::new(),
            overall: String::new(),
            T1: 0.0,
            T2: None,
            T3: 0.0,
            frequencies: vec![],
            decay_rates: vec![],
            relaxations: vec![],
            criteria,
        }
    }

    #[test]
    fn verdict_is_the_worst_that_is_known() {
        let cases: [(bool, &[&str], Verdict); 6] = [
            (true, &[], Verdict::Holds),
            (true, &["holds", "marginal"], Verdict::Marginal),
            (false, &["holds", "marginal"], Verdict::Marginal),
            (true, &["fails", "holds"], Verdict::Fails),
            (false, &["holds"], Verdict::Fails),
            (true, &["perhaps"], Verdict::Fails),
        ];
        for (valid, verdicts, expected) in cases {
            assert_eq!(Verdict::of_all(&validity(valid, verdicts)), expected, "{valid} {verdicts:?}");
        }
    }

    /// Undamped vibrations make one criterion marginal, and leave the verdict on the equations.
    #[test]
    fn verdict_is_that_of_the_record() {
        let told = ValidityRecord { overall: "holds".into(), ..validity(true, &["holds", "marginal"]) };
        assert_eq!(Verdict::of_all(&told), Verdict::Holds);
    }
}
