//! Every reader under random input: no panic, no hang, no memory beyond ten times the input and a stated constant.
//!
//! ```sh
//! cargo run --release --example readers_under_fire -- [inputs per reader] [seed] [reader …]
//! ```
//! The same seed draws the same inputs. Where something breaks, the smallest input that still breaks is written to
//! `under-fire-<reader>.bin` in the system's folder for temporary files, and the program ends with 1.

#[path = "../tests/fire/mod.rs"]
mod fire;

use std::cell::Cell;
use std::process::ExitCode;
use std::time::Instant;

use fire::judge::{self, Cost};
use fire::{Reader, input, numbers};
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};

/// What all inputs of a reader came to.
#[derive(Clone, Copy, Default)]
struct Sum {
    inputs: usize,
    accepted: usize,
    longest: usize,
    bytes: usize,
    worst: Cost,
}

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let number = |at: usize, plain: u64| words.get(at).map_or(Ok(plain), |w| w.parse());
    let (Ok(cases), Ok(seed)) = (number(0, 10_000), number(1, 1)) else {
        eprintln!("usage: readers_under_fire [inputs per reader] [seed] [reader …]");
        return ExitCode::from(2);
    };
    let chosen = |reader: &Reader| words.len() < 3 || words[2..].iter().any(|w| w == reader.name());
    println!(
        "| reader | inputs | accepted | refused | bytes: mean, most | memory: bytes, × length | slowest | total |"
    );
    println!("| --- | --: | --: | --: | --: | --: | --: | --: |");
    for reader in Reader::ALL.into_iter().filter(chosen) {
        let start = Instant::now();
        match run(reader, cases as u32, seed) {
            Ok(sum) => println!(
                "| {} | {} | {} | {} | {}, {} | {}, {:.1} | {:.0} µs | {:.0} s |",
                reader.name(),
                sum.inputs,
                sum.accepted,
                sum.inputs - sum.accepted,
                sum.bytes / sum.inputs.max(1),
                sum.longest,
                sum.worst.peak,
                sum.worst.ratio,
                sum.worst.time.as_secs_f64() * 1e6,
                start.elapsed().as_secs_f64()
            ),
            Err((why, bytes)) => {
                let path = std::env::temp_dir().join(format!("under-fire-{}.bin", reader.name()));
                let saved =
                    std::fs::write(&path, &bytes).map_or_else(|e| e.to_string(), |()| path.display().to_string());
                println!("{}: {why}\ninput: '{}'\nsaved: {saved}", reader.name(), bytes.escape_ascii());
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}

/// Fires at one reader; what breaks comes back with the smallest input that breaks it.
fn run(reader: Reader, cases: u32, seed: u64) -> Result<Sum, (String, Vec<u8>)> {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 20_000, ..Config::default() };
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    key[8..].iter_mut().zip(reader.name().bytes()).for_each(|(k, b)| *k = b);
    let mut runner = TestRunner::new_with_rng(config, TestRng::from_seed(RngAlgorithm::ChaCha, &key));
    let sum = Cell::new(Sum::default());
    let result = runner.run(&numbers(), |numbers| {
        let (bytes, expected) = input(reader, &numbers);
        let mut so_far = sum.get();
        let cost = judge::judge(reader, &bytes, expected, so_far.worst.ratio).map_err(TestCaseError::fail)?;
        so_far.inputs += 1;
        so_far.accepted += usize::from(cost.accepted);
        so_far.longest = so_far.longest.max(bytes.len());
        so_far.bytes += bytes.len();
        so_far.worst.time = so_far.worst.time.max(cost.time);
        so_far.worst.peak = so_far.worst.peak.max(cost.peak);
        so_far.worst.ratio = so_far.worst.ratio.max(cost.ratio);
        sum.set(so_far);
        Ok(())
    });
    match result {
        Ok(()) => Ok(sum.get()),
        Err(TestError::Fail(why, numbers)) => Err((why.to_string(), input(reader, &numbers).0)),
        Err(TestError::Abort(why)) => Err((why.to_string(), Vec::new())),
    }
}
