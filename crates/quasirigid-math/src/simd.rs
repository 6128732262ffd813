//! Choice of the processor's fastest arithmetic at run time.
//!
//! A task is compiled for any processor, and on x86-64 for vectors of four and of eight numbers, each with and without fused multiply-add.
//! Only the fused one rounds differently, in the last bit; the width of the vectors changes none. One machine always takes the same one.
//! A build without full optimisation has no vectors of eight.
#![allow(unsafe_code)]

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::{
    __m256d, _mm256_add_pd, _mm256_fmadd_pd, _mm256_loadu_pd, _mm256_mul_pd, _mm256_set1_pd, _mm256_storeu_pd,
};
use std::marker::PhantomData;

/// Arithmetic: the way in which `a·b + c` is computed.
pub trait Arithmetic: Copy + Default {
    /// `a·b + c`.
    fn mul_add(a: f64, b: f64, c: f64) -> f64;

    /// `a·b + c` of four numbers, component by component.
    #[inline(always)]
    fn mul_add_four(a: [f64; 4], b: f64, c: [f64; 4]) -> [f64; 4] {
        scaled_sum::<Self, 4>(a, b, c)
    }

    /// `a·b + c` of three times four numbers, component by component.
    #[inline(always)]
    fn mul_add_each(a: [f64; 4], b: [f64; 4], c: [f64; 4]) -> [f64; 4] {
        let mut sum = c;
        let mut i = 0;
        while i < 4 {
            sum[i] = Self::mul_add(a[i], b[i], c[i]);
            i += 1;
        }
        sum
    }

    /// Does the work by this arithmetic in a function of its own, which is compiled once however often it is called.
    fn call<T: Task>(task: T) -> T::Output;
}

/// Bits of a result: as fast as the processor allows, or the same everywhere.
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rounding {
    /// Fused multiply-add where the processor has it: one rounding in place of two.
    #[default]
    Fastest,
    /// Two roundings, with the same bits on every processor.
    Reproducible,
}

/// Two roundings, in the registers that every processor has.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unfused;

/// How often `a·b + c` is rounded.
trait MulAdd: Copy + Default {
    fn mul_add(a: f64, b: f64, c: f64) -> f64;
}

/// The same of four numbers in one register, which the compiler does not find in long sums.
#[cfg(target_arch = "x86_64")]
trait RegisterMulAdd: MulAdd {
    /// `a·b + c`.
    ///
    /// # Safety
    /// The processor has AVX2 and FMA.
    unsafe fn register(a: __m256d, b: __m256d, c: __m256d) -> __m256d;

    /// The same of numbers in memory, on the same condition.
    #[inline(always)]
    unsafe fn four(a: [f64; 4], b: f64, c: [f64; 4]) -> [f64; 4] {
        let mut sum = [0.0; 4];
        // SAFETY: the processor has the features, and the arrays have four numbers.
        unsafe {
            let [a, c] = [_mm256_loadu_pd(a.as_ptr()), _mm256_loadu_pd(c.as_ptr())];
            _mm256_storeu_pd(sum.as_mut_ptr(), Self::register(a, _mm256_set1_pd(b), c));
        }
        sum
    }

    /// The same with a factor for each number.
    #[inline(always)]
    unsafe fn each(a: [f64; 4], b: [f64; 4], c: [f64; 4]) -> [f64; 4] {
        let mut sum = [0.0; 4];
        // SAFETY: the processor has the features, and the arrays have four numbers.
        unsafe {
            let [a, b, c] = [a, b, c].map(|numbers| _mm256_loadu_pd(numbers.as_ptr()));
            _mm256_storeu_pd(sum.as_mut_ptr(), Self::register(a, b, c));
        }
        sum
    }
}

#[cfg(target_arch = "x86_64")]
impl RegisterMulAdd for SingleRounding {
    #[inline(always)]
    unsafe fn register(a: __m256d, b: __m256d, c: __m256d) -> __m256d {
        // SAFETY: the processor has the features.
        unsafe { _mm256_fmadd_pd(a, b, c) }
    }
}

#[cfg(target_arch = "x86_64")]
impl RegisterMulAdd for Unfused {
    #[inline(always)]
    unsafe fn register(a: __m256d, b: __m256d, c: __m256d) -> __m256d {
        // SAFETY: the processor has the features.
        unsafe { _mm256_add_pd(_mm256_mul_pd(a, b), c) }
    }
}

/// One rounding, in one instruction.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SingleRounding;

impl MulAdd for SingleRounding {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        a.mul_add(b, c)
    }
}

impl MulAdd for Unfused {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        a * b + c
    }
}

/// Registers of so many numbers. Private, because only the functions that dispatch work know that the processor has them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Vector<M, const NUMBERS: usize>(PhantomData<M>);

/// One rounding, in registers of four numbers.
#[cfg(all(test, target_arch = "x86_64"))]
pub(crate) type Fused = Vector<SingleRounding, 4>;

impl Arithmetic for Unfused {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        <Self as MulAdd>::mul_add(a, b, c)
    }

    fn call<T: Task>(task: T) -> T::Output {
        plain(task)
    }
}

#[cfg(target_arch = "x86_64")]
impl<M: RegisterMulAdd> Arithmetic for Vector<M, 4> {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        M::mul_add(a, b, c)
    }

    #[inline(always)]
    fn mul_add_four(a: [f64; 4], b: f64, c: [f64; 4]) -> [f64; 4] {
        // SAFETY: only `dispatch`, `dispatch_unfused` and `dispatch_lanes` start work by this arithmetic, after they have asked the processor.
        unsafe { M::four(a, b, c) }
    }

    #[inline(always)]
    fn mul_add_each(a: [f64; 4], b: [f64; 4], c: [f64; 4]) -> [f64; 4] {
        // SAFETY: only `dispatch`, `dispatch_unfused` and `dispatch_lanes` start work by this arithmetic, after they have asked the processor.
        unsafe { M::each(a, b, c) }
    }

    fn call<T: Task>(task: T) -> T::Output {
        // SAFETY: only `dispatch`, `dispatch_unfused` and `dispatch_lanes` start work by this arithmetic, after they have asked the processor.
        unsafe { four::<M, T>(task) }
    }
}

#[cfg(target_arch = "x86_64")]
impl<M: RegisterMulAdd> Arithmetic for Vector<M, 8> {
    #[inline(always)]
    fn mul_add(a: f64, b: f64, c: f64) -> f64 {
        M::mul_add(a, b, c)
    }

    #[inline(always)]
    fn mul_add_four(a: [f64; 4], b: f64, c: [f64; 4]) -> [f64; 4] {
        // SAFETY: only `dispatch_lanes` starts work by this arithmetic, after it has asked the processor.
        unsafe { M::four(a, b, c) }
    }

    #[inline(always)]
    fn mul_add_each(a: [f64; 4], b: [f64; 4], c: [f64; 4]) -> [f64; 4] {
        // SAFETY: only `dispatch_lanes` starts work by this arithmetic, after it has asked the processor.
        unsafe { M::each(a, b, c) }
    }

    fn call<T: Task>(task: T) -> T::Output {
        // SAFETY: only `dispatch_lanes` starts work by this arithmetic, after it has asked the processor.
        unsafe { eight::<M, T>(task) }
    }
}

/// Work that gains from the processor's vector arithmetic.
pub trait Task {
    /// Result of the work.
    type Output;

    /// Does the work; mark it `#[inline(always)]`, so that it is compiled for the arithmetic chosen.
    fn run<A: Arithmetic>(self) -> Self::Output;
}

/// Runs a task on numbers that fill at most four places of a register.
pub fn dispatch<T: Task>(rounding: Rounding, task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    if rounding == Rounding::Fastest && has_four() {
        // SAFETY: the processor has the features that the function is compiled for.
        return unsafe { four::<SingleRounding, T>(task) };
    }
    plain(task)
}

/// Runs a task by two roundings, in registers of four numbers where the processor has them: the same bits everywhere.
pub fn dispatch_unfused<T: Task>(task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    if has_four() {
        // SAFETY: the processor has the features that the function is compiled for.
        return unsafe { four::<Unfused, T>(task) };
    }
    plain(task)
}

/// Runs a task on [`Lanes`](crate::lanes::Lanes), in the widest registers that the processor has and the build is for.
pub fn dispatch_lanes<T: Task>(rounding: Rounding, task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    {
        let fused = rounding == Rounding::Fastest;
        if cfg!(vectors_of_eight) && has_four() && std::arch::is_x86_feature_detected!("avx512f") {
            // SAFETY: the processor has the features that the functions are compiled for.
            return unsafe {
                if fused { eight::<SingleRounding, T>(task) } else { eight::<Unfused, T>(task) }
            };
        }
        if has_four() {
            // SAFETY: the processor has the features that the functions are compiled for.
            return unsafe { if fused { four::<SingleRounding, T>(task) } else { four::<Unfused, T>(task) } };
        }
    }
    plain(task)
}

#[cfg(target_arch = "x86_64")]
fn has_four() -> bool {
    std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
}

#[inline(never)]
fn plain<T: Task>(task: T) -> T::Output {
    task.run::<Unfused>()
}

#[cfg(target_arch = "x86_64")]
#[inline(never)]
#[target_feature(enable = "avx2,fma")]
fn four<M: RegisterMulAdd, T: Task>(task: T) -> T::Output {
    task.run::<Vector<M, 4>>()
}

#[cfg(target_arch = "x86_64")]
#[inline(never)]
#[target_feature(enable = "avx512f,avx2,fma")]
fn eight<M: RegisterMulAdd, T: Task>(task: T) -> T::Output {
    task.run::<Vector<M, 8>>()
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
        let rounded = dispatch(Rounding::Fastest, Remainder);
        assert!([0.0, 0.25 * f64::EPSILON].contains(&rounded), "{rounded:e}");
        assert_eq!(dispatch(Rounding::Fastest, Called), [rounded; 2]);
        assert_eq!(dispatch_lanes(Rounding::Fastest, Called), [rounded; 2]);
        for exact in [
            dispatch(Rounding::Reproducible, Called),
            dispatch_lanes(Rounding::Reproducible, Called),
            dispatch_unfused(Called),
        ] {
            assert_eq!(exact, [0.0; 2]);
        }
        assert_eq!(Unfused::call(Remainder), 0.0);
    }
}
