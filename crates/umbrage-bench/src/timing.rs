//! Medians of interleaved runs, so that what slows the machine slows all that is compared.

use cpu_time::ProcessTime;
use std::hint::black_box;
use std::time::Instant;

/// Processor time of a closure, seconds: all threads together, and none of what other programs take.
pub fn processor_seconds(run: &mut dyn FnMut()) -> f64 {
    let start = ProcessTime::now();
    run();
    start.elapsed().as_secs_f64()
}

/// Wall time of a closure, seconds.
pub fn wall_seconds(run: &mut dyn FnMut()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64()
}

/// The median of so many runs of each way, all ways run in turn. `clock` measures one run.
///
/// # Panics
/// If `rounds` is 0.
pub fn medians(rounds: usize, clock: fn(&mut dyn FnMut()) -> f64, ways: &mut [&mut dyn FnMut()]) -> Vec<f64> {
    let mut taken = vec![Vec::with_capacity(rounds); ways.len()];
    for _ in 0..rounds {
        for (way, taken) in ways.iter_mut().zip(&mut taken) {
            taken.push(clock(*way));
        }
    }
    let median = |mut taken: Vec<f64>| {
        taken.sort_by(f64::total_cmp);
        taken[taken.len() / 2]
    };
    taken.into_iter().map(median).collect()
}

/// How many times as much two threads do as one, of work that shares nothing: the median over so many rounds. 2 where nothing
/// else runs on the machine.
pub fn spin(rounds: usize, steps: u64) -> f64 {
    let turn = || {
        let mut state = black_box(1u64);
        for _ in 0..steps {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        }
        black_box(state);
    };
    let two = || {
        std::thread::scope(|scope| {
            scope.spawn(turn);
            turn();
        });
    };
    let taken = medians(rounds, wall_seconds, &mut [&mut { turn }, &mut { two }]);
    2.0 * taken[0] / taken[1]
}
