//! Where a formula changes along one of its variables: corners, jumps, and the intervals over which it is all but a polynomial.
//!
//! The formula is followed part by part, innermost first, so that a pulse a millionth of the interval long is not looked for by luck: the
//! part inside it is long and known by then, with its zeros and extremes, and the pulse lies there.
//! Equation (Z2), docs/theory/19-events.md.

use super::guards::Guards;
use super::lobatto::{FINE, Lobatto};
use super::program::{Node, Program, Role};
use super::stretches::{Stretch, of_sign, of_slope, turns};

/// Changes of a formula along a variable. (Z2)
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes {
    /// Corners and jumps, ascending: places known to rounding that depend on this variable alone.
    pub breaks: Vec<f64>,
    /// Ends of the intervals, ascending, over each of which the formula and all its parts are nearly polynomials: where the formula changes
    /// quickly they lie close together. The breaks are among them, and so are both ends.
    pub ends: Vec<f64>,
    /// Evaluations of the formula.
    pub evaluations: u64,
    /// False if the evaluations allowed did not suffice: there are changes between the ends that are not known.
    pub complete: bool,
}

/// Distance from a polynomial, relative to the largest value of a part, that counts as none: far less than a quadrature may overlook.
pub const FLAT: f64 = 1e-8;
/// Rounding of the variable, in units of its own, that values over a short interval show.
const VARIABLE_ROUNDING: f64 = 8.0 * f64::EPSILON;
/// Errors of the values that count as rounding.
const ROUNDINGS: f64 = 8.0;
/// Length of the shortest interval, relative to the whole: what changes within is a jump.
const SHORTEST_INTERVAL: f64 = 1e-13;
/// First intervals: no simple fraction of the whole, so that no period fits them.
const FIRST: [f64; 4] = [0.0, 0.236_067_977, 0.618_033_989, 1.0];
/// Passes in which neighbours are joined.
const PASSES: usize = 24;

/// Finds the changes along one of the variables. (Z2)
pub fn changes(program: &Program, along: usize, at: &[f64], ends: [f64; 2], budget: u64) -> Changes {
    let mut path = |x: f64, variables: &mut Vec<f64>| {
        variables.clear();
        variables.extend_from_slice(at);
        variables[along] = x;
    };
    follow(program, &|variable| variable == along, (&mut path, 0.0), ends, budget)
}

/// Finds the changes along a path on which every variable may move: `path` gives the variables at a place of it. (Z2)
pub fn changes_on_path(program: &Program, path: &mut Path, ends: [f64; 2], budget: u64) -> Changes {
    follow(program, &|_| true, (path, f64::EPSILON), ends, budget)
}

/// Variables at a place of a path.
pub type Path<'p> = dyn FnMut(f64, &mut Vec<f64>) + 'p;

fn follow(
    program: &Program,
    moves: &dyn Fn(usize) -> bool,
    (path, relative): (&mut Path, f64),
    ends: [f64; 2],
    budget: u64,
) -> Changes {
    let [from, to] = ends;
    if !(to > from) {
        return Changes { complete: true, ..Changes::default() };
    }
    let mut scan = Scan { relative, ..Scan::new(program, moves, path, ends, budget) };
    for index in std::mem::take(&mut scan.guards.order) {
        if scan.follows[index] && !matches!(scan.nodes[index].role, Role::Variable(_)) {
            scan.part(index);
        }
    }
    scan.join();
    let Scan { edges, evaluations, budget, .. } = scan;
    let breaks = edges.iter().filter(|edge| edge.breaks && edge.x > from && edge.x < to);
    Changes {
        breaks: breaks.map(|edge| edge.x).collect(),
        ends: edges.iter().map(|edge| edge.x).collect(),
        evaluations,
        complete: evaluations < budget,
    }
}

/// End of intervals.
#[derive(Clone, Copy, Debug)]
struct Edge {
    x: f64,
    /// Whether it is a corner or a jump whose place depends on the one variable alone.
    breaks: bool,
}

/// A part of the formula, or the difference of two whose order decides.
#[derive(Clone, Copy, Debug)]
enum Part {
    Node(usize),
    Gap(usize, usize),
}

/// Scan of a formula along a path.
struct Scan<'p, 'v> {
    program: &'p Program,
    nodes: Vec<Node>,
    /// Whether a node depends on what moves, on it alone, and whether what acts on the node may act in a short part of its range.
    follows: Vec<bool>,
    alone: Vec<bool>,
    narrowed: Vec<bool>,
    guards: Guards,
    path: &'p mut Path<'v>,
    variables: Vec<f64>,
    /// Relative error of the variables.
    relative: f64,
    lobatto: Lobatto,
    edges: Vec<Edge>,
    /// Largest value of each node.
    scales: Vec<f64>,
    shortest: f64,
    values: Vec<f64>,
    errors: Vec<f64>,
    evaluations: u64,
    budget: u64,
}

impl<'p, 'v> Scan<'p, 'v> {
    fn new(
        program: &'p Program,
        moves: &dyn Fn(usize) -> bool,
        path: &'p mut Path<'v>,
        [from, to]: [f64; 2],
        budget: u64,
    ) -> Self {
        let nodes = program.nodes();
        let (mut follows, mut alone) = (vec![false; nodes.len()], vec![true; nodes.len()]);
        let mut narrowed = follows.clone();
        for (index, Node { role, operands }) in nodes.iter().enumerate() {
            let moved = matches!(role, Role::Variable(variable) if moves(*variable));
            follows[index] = moved || operands.iter().any(|of| follows[*of]);
            let other = matches!(role, Role::Variable(variable) if !moves(*variable));
            alone[index] = !other && operands.iter().all(|of| alone[*of]);
            if role.is_narrow() {
                operands.iter().for_each(|of| narrowed[*of] = true);
            }
        }
        let known: Vec<bool> =
            follows.iter().zip(&alone).map(|(follows, alone)| *follows && *alone).collect();
        let edge = |share: f64| Edge { x: from + share * (to - from), breaks: false };
        let mut edges: Vec<Edge> = FIRST.iter().map(|share| edge(*share)).collect();
        edges[FIRST.len() - 1].x = to;
        Self {
            program,
            scales: vec![0.0; nodes.len()],
            guards: Guards::of(&nodes, &known),
            nodes,
            follows,
            alone,
            narrowed,
            path,
            variables: Vec::new(),
            relative: 0.0,
            lobatto: Lobatto::new(),
            edges,
            shortest: SHORTEST_INTERVAL * (to - from).max(from.abs()).max(to.abs()),
            values: Vec::new(),
            errors: Vec::new(),
            evaluations: 0,
            budget,
        }
    }

    /// Follows a part whose own parts are known.
    fn part(&mut self, index: usize) {
        let Node { role, operands } = self.nodes[index].clone();
        match (role, operands.as_slice()) {
            (Role::Corner, [of]) => self.split_at_zeros(Part::Node(*of), self.alone[*of]),
            (Role::Choice, [a, b]) => {
                let alone = self.alone[*a] && self.alone[*b];
                self.resolve(Part::Gap(*a, *b), alone);
                if self.follows[*a] && self.follows[*b] {
                    self.split_at_extremes(Part::Gap(*a, *b));
                }
                self.split_at_zeros(Part::Gap(*a, *b), alone);
            }
            _ => {}
        }
        self.scales[index] = self.resolve(Part::Node(index), self.alone[index]);
        if self.narrowed[index] {
            self.split_at_zeros(Part::Node(index), false);
            self.split_at_extremes(Part::Node(index));
        }
    }

    fn is_spent(&self) -> bool {
        self.evaluations >= self.budget
    }

    /// Value of a part.
    fn value(&mut self, part: Part, x: f64) -> f64 {
        let last = match part {
            Part::Node(index) => index,
            Part::Gap(a, b) => a.max(b),
        };
        self.trace(x, last);
        match part {
            Part::Node(index) => self.values[index],
            Part::Gap(a, b) => self.values[a] - self.values[b],
        }
    }

    fn trace(&mut self, x: f64, last: usize) {
        self.evaluations += 1;
        (self.path)(x, &mut self.variables);
        self.program.trace(&self.variables, last, &mut self.values);
    }

    fn places(&self, from: f64, to: f64) -> [f64; FINE] {
        let mut places = self.lobatto.points.map(|point| from + point * (to - from));
        places[FINE - 1] = to;
        places
    }

    /// Whether a factor of a part is zero over an interval, so that the part does not matter there.
    fn is_masked(&mut self, part: Part, [from, to]: [f64; 2]) -> bool {
        let (Part::Node(index) | Part::Gap(index, _)) = part;
        let factors = self.guards.factors[index].clone();
        factors.into_iter().any(|factor| self.sampled(Part::Node(factor), from, to) == [0.0; FINE])
    }

    /// Values of a part over an interval; inside its ends where these are corners or jumps. Zeros, once the evaluations are spent.
    fn sampled(&mut self, part: Part, from: f64, to: f64) -> [f64; FINE] {
        if self.is_spent() {
            return [0.0; FINE];
        }
        let inside = 4.0 * f64::EPSILON;
        let (low, high) = (from + inside * from.abs(), to - inside * to.abs());
        self.places(from, to)
            .map(|x| if low < high { self.value(part, x.clamp(low, high)) } else { f64::NAN })
    }

    /// Bound of the error (Z2) of a part at a place.
    fn error(&mut self, part: Part, x: f64) -> f64 {
        self.evaluations += 1;
        (self.path)(x, &mut self.variables);
        let (Part::Node(a) | Part::Gap(a, _)) = part;
        let b = if let Part::Gap(_, b) = part { b } else { a };
        self.program.errors((&self.variables, self.relative), a.max(b), &mut self.errors);
        if a == b { self.errors[a] } else { self.errors[a] + self.errors[b] }
    }

    /// Distance from a polynomial that the rounding of a part over an interval may leave.
    fn noise(&mut self, part: Part, from: f64, to: f64) -> f64 {
        let errors = [from, 0.5 * (from + to), to].map(|x| self.error(part, x));
        ROUNDINGS * errors.into_iter().fold(0.0, f64::max)
    }

    /// Halves intervals until a part is nearly a polynomial in each, or no number at all; returns its largest value. What is not in the
    /// shortest interval jumps.
    fn resolve(&mut self, part: Part, alone: bool) -> f64 {
        let cells: Vec<[Edge; 2]> = self.edges.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        let largest = |values: &[f64; FINE]| {
            values.iter().filter(|value| value.is_finite()).fold(0.0_f64, |most, value| most.max(value.abs()))
        };
        let sample = |[from, to]: &[Edge; 2]| {
            let masked = self.is_masked(part, [from.x, to.x]);
            if masked { [0.0; FINE] } else { self.sampled(part, from.x, to.x) }
        };
        let sampled: Vec<_> = cells.iter().map(sample).collect();
        let mut scale = sampled.iter().map(largest).fold(0.0, f64::max);
        let mut stack: Vec<_> = cells.into_iter().zip(sampled).rev().collect();
        let mut edges = vec![self.edges[0]];
        while let Some(([from, mut to], values)) = stack.pop() {
            scale = scale.max(largest(&values));
            let middle = 0.5 * (from.x + to.x);
            let nothing = values.iter().all(|value| !value.is_finite());
            let flat = FLAT * scale + rounding(&values, from.x, to.x);
            let defect = self.lobatto.defect(&values);
            if nothing || defect <= flat || self.is_spent() || defect <= flat + self.noise(part, from.x, to.x)
            {
                edges.push(to);
            } else if to.x - from.x <= self.shortest || middle <= from.x || middle >= to.x {
                to.breaks |= alone;
                edges.push(to);
            } else {
                let middle = Edge { x: middle, breaks: false };
                for [from, to] in [[middle, to], [from, middle]] {
                    stack.push(([from, to], self.sampled(part, from.x, to.x)));
                }
            }
        }
        self.edges = edges;
        scale
    }

    /// Places and values of a part over all intervals, ascending.
    fn history(&mut self, part: Part) -> Vec<[f64; 2]> {
        let edges: Vec<f64> = self.edges.iter().map(|edge| edge.x).collect();
        let mut history = Vec::with_capacity(FINE * edges.len());
        for pair in edges.windows(2) {
            if self.is_spent() {
                break;
            }
            if self.is_masked(part, [pair[0], pair[1]]) {
                continue;
            }
            for x in self.places(pair[0], pair[1]).into_iter().skip(usize::from(!history.is_empty())) {
                history.push([x, self.value(part, x)]);
            }
        }
        history
    }

    /// Makes the zeros at which a part changes its sign ends of intervals.
    fn split_at_zeros(&mut self, part: Part, breaks: bool) {
        let history = self.history(part);
        let known = self.beyond_rounding(part, of_sign(&history));
        let found =
            turns(&known).map(|(ends, sign)| Edge { x: self.zero(part, ends, sign), breaks }).collect();
        self.split(found);
    }

    /// Stretches of a part that are more than its rounding.
    fn beyond_rounding(&mut self, part: Part, mut stretches: Vec<Stretch>) -> Vec<Stretch> {
        if stretches.len() > 1 {
            stretches.retain(|stretch| {
                let error = stretch.shown.iter().map(|x| self.error(part, *x)).fold(0.0, f64::max);
                stretch.size > ROUNDINGS * error
            });
        }
        stretches
    }

    /// Place between two where a part changes its sign, to rounding.
    fn zero(&mut self, part: Part, [mut low, mut high]: [f64; 2], sign: f64) -> f64 {
        while !self.is_spent() {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            let value = self.value(part, middle);
            if value == 0.0 {
                return middle;
            }
            if value * sign > 0.0 { low = middle } else { high = middle }
        }
        high
    }

    /// Makes the places where a part is largest or least ends of intervals.
    fn split_at_extremes(&mut self, part: Part) {
        let history = self.history(part);
        let known = self.beyond_rounding(part, of_slope(&history));
        let place = |(ends, slope)| Edge { x: self.extreme(part, ends, slope), breaks: false };
        let found = turns(&known).map(place).collect();
        self.split(found);
    }

    /// Place of the largest value (slope 1 before it) or the least (−1) in an interval, by sections of equal share.
    fn extreme(&mut self, part: Part, [mut low, mut high]: [f64; 2], slope: f64) -> f64 {
        let share = 0.381_966_011_250_105_15;
        let inner = |low: f64, high: f64| [low + share * (high - low), high - share * (high - low)];
        let [mut a, mut b] = inner(low, high);
        let (mut at_a, mut at_b) = (slope * self.value(part, a), slope * self.value(part, b));
        while high - low > self.shortest && a > low && b < high && !self.is_spent() {
            if at_a > at_b {
                (high, b, at_b) = (b, a, at_a);
                a = inner(low, high)[0];
                at_a = slope * self.value(part, a);
            } else {
                (low, a, at_a) = (a, b, at_b);
                b = inner(low, high)[1];
                at_b = slope * self.value(part, b);
            }
        }
        0.5 * (low + high)
    }

    /// Adds ends of intervals.
    fn split(&mut self, found: Vec<Edge>) {
        if found.is_empty() {
            return;
        }
        self.edges.extend(found);
        self.edges.sort_by(|a, b| a.x.total_cmp(&b.x));
        self.edges.dedup_by(|later, kept| {
            let same = later.x == kept.x;
            kept.breaks |= same && later.breaks;
            same
        });
    }

    /// Joins neighbours over which every part is nearly a polynomial as well. (Z2)
    fn join(&mut self) {
        for _ in 0..PASSES {
            let before = self.edges.len();
            let edges = std::mem::take(&mut self.edges);
            let mut kept = vec![edges[0]];
            let mut index = 1;
            while index < edges.len() {
                let pair = edges.get(index + 1).filter(|_| !edges[index].breaks && !self.is_spent());
                let joined = pair.filter(|end| self.is_even(kept[kept.len() - 1].x, edges[index].x, end.x));
                index += 1 + usize::from(joined.is_some());
                kept.push(joined.copied().unwrap_or(edges[index - 1]));
            }
            self.edges = kept;
            if self.edges.len() == before {
                return;
            }
        }
    }

    /// Whether every part is nearly a polynomial over two neighbouring intervals, at the points of each too.
    fn is_even(&mut self, from: f64, middle: f64, to: f64) -> bool {
        let last = self.nodes.len() - 1;
        let mut all = vec![[0.0; FINE]; self.nodes.len()];
        for [from, to] in [[from, middle], [middle, to], [from, to]] {
            for (i, x) in self.places(from, to).into_iter().enumerate() {
                self.trace(x, last);
                all.iter_mut().zip(&self.values).for_each(|(row, value)| row[i] = *value);
            }
            let is_zero = |factor: &usize| all[*factor] == [0.0; FINE];
            let masked = |index: &usize| self.guards.factors[*index].iter().any(is_zero);
            let parts = (0..=last).filter(|index| self.follows[*index] && !masked(index));
            let flat = |index: usize| FLAT * self.scale(index) + rounding(&all[index], from, to);
            if !parts.into_iter().all(|index| self.lobatto.defect(&all[index]) <= flat(index)) {
                return false;
            }
        }
        true
    }

    /// Largest value of a node; of the variable itself the end of the whole.
    fn scale(&self, index: usize) -> f64 {
        match self.nodes[index].role {
            Role::Variable(_) => f64::INFINITY,
            _ => self.scales[index],
        }
    }
}

/// What the rounding of the variable changes in values over an interval.
fn rounding(values: &[f64; FINE], from: f64, to: f64) -> f64 {
    let [least, most] = values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| {
        [least.min(*value), most.max(*value)]
    });
    VARIABLE_ROUNDING * from.abs().max(to.abs()) / (to - from) * (most - least)
}

#[cfg(test)]
#[path = "changes_tests.rs"]
mod tests;
