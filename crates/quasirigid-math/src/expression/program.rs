//! Program of a formula: steps on a stack of numbers.

use super::function::{Binary, Operation, Unary};
use crate::scalar::Smooth;

/// One step.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    Constant(f64),
    Variable(usize),
    /// Power with a constant exponent.
    Power(f64),
    Unary(Unary),
    Binary(Binary),
}

/// Steps that leave the value of a formula on a stack.
#[derive(Clone, Debug, Default)]
pub struct Program {
    steps: Vec<Step>,
    /// Numbers on the stack after the last step.
    height: usize,
    /// Greatest number ever on the stack.
    room: usize,
}

/// A step of a program as a node of a tree.
#[derive(Clone, Debug)]
pub struct Node {
    pub role: Role,
    /// Nodes that it acts on.
    pub operands: Vec<usize>,
}

/// What a step does to the changes of its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    Constant,
    Variable(usize),
    /// As smooth as its operands, and no narrower.
    Even,
    /// The same, and nothing where one of its operands is zero.
    Product,
    /// May act in a short part of the range of its operand: about its zeros and extremes.
    Narrow,
    /// Has a corner or a jump where its operand is zero.
    Corner,
    /// Has a corner where its operands are equal.
    Choice,
}

impl Role {
    /// Whether what a node does may be narrower than its operands.
    pub fn is_narrow(self) -> bool {
        matches!(self, Self::Narrow | Self::Corner | Self::Choice)
    }

    fn of(step: &Step) -> Self {
        match step {
            Step::Constant(_) => Self::Constant,
            Step::Variable(index) => Self::Variable(*index),
            Step::Unary(Unary::Abs | Unary::Step) => Self::Corner,
            Step::Binary(Binary::Min | Binary::Max) => Self::Choice,
            Step::Binary(Binary::Multiply) => Self::Product,
            Step::Unary(Unary::Negate | Unary::Sin | Unary::Cos)
            | Step::Binary(Binary::Add | Binary::Subtract) => Self::Even,
            Step::Power(_) | Step::Unary(_) | Step::Binary(_) => Self::Narrow,
        }
    }
}

/// Height of the stack up to which no memory is allocated; few formulas need more.
const SHALLOW: usize = 12;

impl Program {
    /// Appends a constant.
    pub fn constant(&mut self, value: f64) {
        self.push(Step::Constant(value));
    }

    /// Appends a variable.
    pub fn variable(&mut self, index: usize) {
        self.push(Step::Variable(index));
    }

    /// Appends an operation on the results of the last steps; constants are evaluated at once.
    ///
    /// # Errors
    /// The result of constants, if it is not a finite number.
    pub fn apply(&mut self, operation: Operation) -> Result<(), f64> {
        let step = match operation {
            Operation::Unary(unary) => Step::Unary(unary),
            Operation::Binary(Binary::Power) => self.power(),
            Operation::Binary(binary) => Step::Binary(binary),
        };
        let constants = match (step, self.steps.as_slice()) {
            (Step::Binary(_), [.., Step::Constant(_), Step::Constant(_)]) => 2,
            (Step::Unary(_) | Step::Power(_), [.., Step::Constant(_)]) => 1,
            _ => 0,
        };
        self.push(step);
        if constants == 0 {
            return Ok(());
        }
        let folded = self.steps.split_off(self.steps.len() - constants - 1);
        let value = run(&folded, &[], &mut [0.0; 2]);
        self.steps.push(Step::Constant(value));
        if value.is_finite() { Ok(()) } else { Err(value) }
    }

    /// Whether a variable occurs.
    pub fn uses(&self, variable: usize) -> bool {
        self.steps.iter().any(|step| matches!(step, Step::Variable(index) if *index == variable))
    }

    /// The value at the variables.
    pub fn value<T: Smooth>(&self, variables: &[T]) -> T {
        let zero = T::from(0.0);
        if self.room <= SHALLOW {
            run(&self.steps, variables, &mut [zero; SHALLOW])
        } else {
            run(&self.steps, variables, &mut vec![zero; self.room])
        }
    }

    /// Values after each of the steps up to the last one asked for, in their order.
    pub fn trace(&self, variables: &[f64], last: usize, values: &mut Vec<f64>) {
        values.clear();
        let (mut stack, mut height) = (vec![0.0; self.room], 0);
        for step in &self.steps[..=last] {
            height = taken(step, variables, &mut stack, height);
            values.push(stack[height - 1]);
        }
    }

    /// The steps, in their order.
    pub(super) fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The steps as nodes of a tree: what each does, and on which of those before it.
    pub fn nodes(&self) -> Vec<Node> {
        let (mut nodes, mut stack): (Vec<Node>, Vec<usize>) = (Vec::new(), Vec::new());
        for (index, step) in self.steps.iter().enumerate() {
            let operands = match step {
                Step::Constant(_) | Step::Variable(_) => 0,
                Step::Power(_) | Step::Unary(_) => 1,
                Step::Binary(_) => 2,
            };
            let operands = stack.split_off(stack.len().saturating_sub(operands));
            stack.push(index);
            nodes.push(Node { role: Role::of(step), operands });
        }
        nodes
    }

    /// The step for a power; takes a constant exponent off the steps.
    fn power(&mut self) -> Step {
        let Some(Step::Constant(exponent)) = self.steps.last().copied() else {
            return Step::Binary(Binary::Power);
        };
        self.steps.pop();
        self.height -= 1;
        Step::Power(exponent)
    }

    fn push(&mut self, step: Step) {
        match step {
            Step::Constant(_) | Step::Variable(_) => self.height += 1,
            Step::Power(_) | Step::Unary(_) => {}
            Step::Binary(_) => self.height -= 1,
        }
        self.room = self.room.max(self.height);
        self.steps.push(step);
    }
}

/// Takes the steps and returns the number they leave; the stack has room for the most there ever are.
fn run<T: Smooth>(steps: &[Step], variables: &[T], stack: &mut [T]) -> T {
    let mut height = 0;
    for step in steps {
        height = taken(step, variables, stack, height);
    }
    stack[0]
}

/// Takes a step on a stack of a height, and returns the height after it.
#[inline(always)]
fn taken<T: Smooth>(step: &Step, variables: &[T], stack: &mut [T], height: usize) -> usize {
    match *step {
        Step::Constant(value) => {
            stack[height] = T::from(value);
            height + 1
        }
        Step::Variable(index) => {
            stack[height] = variables[index];
            height + 1
        }
        Step::Power(exponent) => {
            stack[height - 1] = stack[height - 1].powf(exponent);
            height
        }
        Step::Unary(unary) => {
            stack[height - 1] = unary.of(stack[height - 1]);
            height
        }
        Step::Binary(binary) => {
            stack[height - 2] = binary.of(stack[height - 2], stack[height - 1]);
            height - 1
        }
    }
}
