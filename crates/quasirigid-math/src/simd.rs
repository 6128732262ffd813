//! Choice of the processor's fastest arithmetic at run time.
//!
//! A task is compiled twice: for any x86-64 (or other) processor, and for those with fused multiply-add on four numbers
//! at once. The two round differently in the last bit; one machine always takes the same one.

/// Arithmetic: the way in which `a·b + c` is computed.
pub trait Arithmetic: Copy + Default {
    /// `a·b + c`.
    fn mul_add(a: f64, b: f64, c: f64) -> f64;

    /// Does the work by this arithmetic in a function of its own, which is compiled once however often it is called.
    fn call<T: Task>(task: T) -> T::Output;
}

/// Two roundings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

/// One rounding, in one instruction. Private, because only [`dispatch`] knows that the processor has it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Fused;

impl Arithmetic for Plain {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        a * b + c
    }

    fn call<T: Task>(task: T) -> T::Output {
        plain(task)
    }
}

impl Arithmetic for Fused {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }

    fn call<T: Task>(task: T) -> T::Output {
        // SAFETY: only `dispatch` starts work by this arithmetic, after it has asked the processor.
        #[cfg(target_arch = "x86_64")]
        return unsafe { fused(task) };
        #[cfg(not(target_arch = "x86_64"))]
        unreachable!("no processor but x86-64 is asked for it")
    }
}

/// Work that gains from the processor's vector arithmetic.
pub trait Task {
    /// Result of the work.
    type Output;

    /// Does the work; mark it `#[inline(always)]`, so that it is compiled for the arithmetic chosen.
    fn run<A: Arithmetic>(self) -> Self::Output;
}

/// Runs a task with the fastest arithmetic this processor has.
pub fn dispatch<T: Task>(task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma") {
        // SAFETY: the processor has the features that the function is compiled for.
        return unsafe { fused(task) };
    }
    plain(task)
}

#[inline(never)]
fn plain<T: Task>(task: T) -> T::Output {
    task.run::<Plain>()
}

#[cfg(target_arch = "x86_64")]
#[inline(never)]
#[target_feature(enable = "avx2,fma")]
fn fused<T: Task>(task: T) -> T::Output {
    task.run::<Fused>()
}

/// `a·b + c`, component by component.
#[inline(always)]
#[must_use]
pub fn scaled_sum<A: Arithmetic, const N: usize>(a: [f64; N], b: f64, c: [f64; N]) -> [f64; N] {
    let mut sum = c;
    let mut i = 0;
    // A closure or an iterator would be a call where little is optimised, and `mul_add` in it no instruction.
    while i < N {
        sum[i] = A::mul_add(a[i], b, c[i]);
        i += 1;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `0.1·10 − 1`, which one rounding tells from zero.
    #[derive(Clone, Copy)]
    struct Remainder;

    impl Task for Remainder {
        type Output = f64;

        #[inline(always)]
        fn run<A: Arithmetic>(self) -> f64 {
            A::mul_add(std::hint::black_box(0.1), 10.0, -1.0)
        }
    }

    /// The same in a function of its own.
    struct Called;

    impl Task for Called {
        type Output = [f64; 2];

        #[inline(always)]
        fn run<A: Arithmetic>(self) -> [f64; 2] {
            [A::call(Remainder), scaled_sum::<A, 1>([0.1], 10.0, [-1.0])[0]]
        }
    }

    #[test]
    fn processor_does_all_work_by_one_arithmetic() {
        let rounded = dispatch(Remainder);
        assert!([0.0, 0.25 * f64::EPSILON].contains(&rounded), "{rounded:e}");
        assert_eq!(dispatch(Called), [rounded; 2]);
        assert_eq!(Plain::call(Remainder), 0.0);
    }
}
