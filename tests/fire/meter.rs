//! What is allocated, by the whole process: nothing else may run meanwhile.

use std::alloc::System;
use std::hint::black_box;

use cap::Cap;

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// The bytes that `f` asks for in all, freed ones counted again; no less than what it holds at any time.
pub fn requested<T>(f: impl FnOnce() -> T) -> (T, usize) {
    let before = ALLOCATOR.total_allocated();
    let result = f();
    (result, ALLOCATOR.total_allocated() - before)
}

/// The most that `f` holds at any time. The allocator remembers the highest mark of the process only: memory that is asked
/// for and never touched lifts the level to that mark first.
pub fn peak<T>(f: impl FnOnce() -> T) -> (T, usize) {
    let gap = ALLOCATOR.max_allocated().saturating_sub(ALLOCATOR.allocated());
    let mut ballast = Vec::<u8>::new();
    if ballast.try_reserve_exact(gap).is_err() {
        // After very many measurements the mark is out of reach: what was requested in all is no less.
        return requested(f);
    }
    let ballast = black_box(ballast);
    let before = ALLOCATOR.allocated();
    let result = f();
    let peak = ALLOCATOR.max_allocated().saturating_sub(before);
    drop(black_box(ballast));
    (result, peak)
}
