//! Attributes that change from frame to frame, by the animations of SVG (SMIL), which run in an `<img>` too and need no script.
//! All have one length and start together. Numbers move along straight lines between frames that are evenly spaced in time; what is seen or
//! not changes at once.

use std::ops::Range;

use maud::{Markup, html};

/// Length of the picture and number of its frames.
#[derive(Clone, Copy)]
pub struct Clock {
    /// Seconds.
    pub duration: f64,
    /// Frames.
    pub frames: usize,
}

impl Clock {
    /// Animation of an attribute through a value for each frame; none of one that does not change.
    pub fn animate(self, attribute: &str, values: &[String]) -> Markup {
        let changes = values.windows(2).any(|pair| pair[0] != pair[1]);
        html! {
            @if changes {
                animate attributeName=(attribute) dur=(self.length()) repeatCount="indefinite" values=(values.join(";")) {}
            }
        }
    }

    /// Animation of what is seen where a measure, frame by frame, is positive: it changes where the line between two frames meets zero. None
    /// of what is always seen.
    pub fn show(self, measure: &[f64]) -> Markup {
        let seen = |i: usize| measure[i] > 0.0;
        let changes = (1..measure.len()).filter(|i| seen(*i) != seen(i - 1)).map(|i| {
            let (before, after) = (measure[i - 1], measure[i]);
            (self.at(i - 1) + (self.at(i) - self.at(i - 1)) * before / (before - after), seen(i))
        });
        let runs: Vec<(f64, bool)> = [(0.0, seen(0))].into_iter().chain(changes).collect();
        let values: Vec<&str> = runs.iter().map(|(_, seen)| if *seen { "inline" } else { "none" }).collect();
        let times: Vec<String> = runs.iter().map(|(time, _)| part(*time)).collect();
        html! {
            @if runs.iter().any(|(_, seen)| !seen) {
                animate attributeName="display" dur=(self.length()) repeatCount="indefinite" calcMode="discrete"
                    values=(values.join(";")) keyTimes=(times.join(";")) {}
            }
        }
    }

    /// Animation of what is seen in the frames of a range alone.
    pub fn show_in(self, frames: Range<usize>) -> Markup {
        // a change lies close before the first frame, and close after the last
        let measure = |i: usize| match i {
            i if frames.contains(&i) => 1e-3,
            _ => -1.0,
        };
        self.show(&(0..self.frames).map(measure).collect::<Vec<_>>())
    }

    /// Place of a frame in the whole, from 0 to 1: the last frame is at the end, from where the picture begins anew.
    pub fn at(self, frame: usize) -> f64 {
        frame as f64 / (self.frames.max(2) - 1) as f64
    }

    fn length(self) -> String {
        format!("{}s", part(self.duration))
    }
}

/// A number with at most four decimals.
fn part(number: f64) -> String {
    let text = format!("{number:.4}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_told_by_their_times() {
        let clock = Clock { duration: 2.5, frames: 5 };
        let shown = clock.show(&[-1.0, -3.0, 1.0, 2.0, -2.0]).into_string();
        assert!(shown.contains(r#"values="none;inline;none" keyTimes="0;0.4375;0.875""#), "{shown}");
        assert!(shown.contains(r#"dur="2.5s""#));
        assert_eq!(clock.show(&[1.0; 5]).into_string(), "");
        assert!(clock.show(&[-1.0; 5]).into_string().contains(r#"values="none" keyTimes="0""#));
        let shown = clock.show_in(1..3).into_string();
        assert!(shown.contains(r#"values="none;inline;none" keyTimes="0;0.2498;0.5002""#), "{shown}");
        assert_eq!(clock.animate("x", &["1".into(), "1".into()]).into_string(), "");
    }
}
