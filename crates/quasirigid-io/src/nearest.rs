/// Longest word, and longest list of candidates, that are searched: a suggestion is not worth more time.
const LONGEST_WORD: usize = 40;
const MOST_CANDIDATES: usize = 2_000;

/// The candidate that `word` most likely stands for, if one is near: at most a third of its letters differ.
pub(crate) fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    if word.len() > LONGEST_WORD {
        return None;
    }
    candidates
        .into_iter()
        .take(MOST_CANDIDATES)
        .filter(|candidate| candidate.len().abs_diff(word.len()) <= 4)
        .map(|candidate| (strsim::osa_distance(&word, &candidate.to_lowercase()), candidate))
        .filter(|(distance, candidate)| *distance <= candidate.chars().count().div_ceil(3).min(4))
        .filter(|(distance, candidate)| *distance < candidate.chars().count())
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_of_the_finger_is_undone() {
        let keys = ["mass", "position", "stiffness", "motion"];
        assert_eq!(nearest("stifness", keys), Some("stiffness"));
        assert_eq!(nearest("postion", keys), Some("position"));
        assert_eq!(nearest("Mass", keys), Some("mass"));
        assert_eq!(nearest("msas", keys), Some("mass"));
    }

    #[test]
    fn a_different_word_is_left_alone() {
        assert_eq!(nearest("temperature", ["mass", "position"]), None);
        assert_eq!(nearest("x", ["g", "m"]), None);
        assert_eq!(nearest(&"mass".repeat(1_000_000), ["mass"]), None);
    }
}
