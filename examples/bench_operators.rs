//! A worker that repeats one construction or one trial on a mesh and says how long it took: our side of
//! `scripts/bench_peers.py`, which speaks the same lines to a worker of each other library in turn.
//!
//! ```text
//! cargo run --release --example bench_operators -- MESH TASK [REPEATS]
//! ```
//! reads the mesh, then for each line of the input (or `REPEATS` times) runs the task once and prints one line of JSON:
//! `seconds`, `cpu_seconds` of all threads, and where the task has parts `parts`, the seconds of each. The task `memory:TASK` runs it once and prints
//! `peak_bytes`, by how much the resident memory of the process rose above what it was with the mesh in it (Linux only).
//!
//! | task | what is timed |
//! | --- | --- |
//! | `cotan` | validated surface with its connectivity → L and barycentric M |
//! | `cotan+topology` | positions and faces → validated surface, connectivity, L and barycentric M |
//! | `intrinsic` | validated surface with its connectivity → flips, L and barycentric M |
//! | `intrinsic+topology` | positions and faces → validated surface, connectivity, flips, L and barycentric M |
//! | `verdicts` | domain, L and M as they come from a file → every structural verdict; one part each |
//! | `spectrum:K` | L and M → the first K eigenpairs of cotan, factorisations and the inertia count included |
//!
//! The number of threads is that of `RAYON_NUM_THREADS`.

use std::error::Error;
use std::io::{BufRead, Write};
use std::path::Path;
use std::time::Instant;

use lapjury::domain::Faces;
use lapjury::linalg::spectrum::lowest;
use lapjury::operator::Provenance;
use lapjury::{Domain, Mass, MassKind, Operator, Surface, Trial, laplacian, property};

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The properties that read matrix and mesh once, without solving anything.
const STRUCTURAL: [&str; 13] =
    ["FIN", "LOC", "SYM", "NULL", "POS", "POS0", "POS-boundary", "LIN", "ENERGY", "FLUX", "MVP", "MASS", "MAX-local"];

/// The seconds that something took, and those of its parts.
struct Timed {
    seconds: f64,
    cpu_seconds: f64,
    parts: Vec<(&'static str, f64)>,
}

/// A clock for the wall and one for the processor.
struct Clock(Instant, f64);

impl Clock {
    fn start() -> Self {
        let cpu = cpu_seconds();
        Clock(Instant::now(), cpu)
    }

    fn stop(&self, parts: Vec<(&'static str, f64)>) -> Timed {
        let seconds = self.0.elapsed().as_secs_f64();
        Timed { seconds, cpu_seconds: cpu_seconds() - self.1, parts }
    }
}

fn build(id: &str, domain: &Domain) -> Outcome<Operator> {
    Ok(laplacian::find(id).ok_or("no such operator")?.build(domain, &Default::default())?)
}

/// The same operator as it would come from a file: nothing is known of its signs and its mass.
fn as_given(operator: &Operator) -> Outcome<Operator> {
    let provenance = Provenance { id: "given".into(), ..Provenance::default() };
    let mass = operator.mass().ok_or("no mass")?.matrix().clone();
    Ok(Operator::new(operator.stiffness().clone(), provenance)?.with_mass(Mass::full(MassKind::Given, mass))?)
}

/// A task with what it needs at hand.
enum Task {
    Build { id: &'static str, domain: Domain },
    FromFaces { id: &'static str, positions: Vec<[f64; 3]>, faces: Vec<[usize; 3]> },
    Verdicts { domain: Domain, operator: Box<Operator> },
    Spectrum { count: usize, operator: Box<Operator> },
}

impl Task {
    fn prepare(name: &str, domain: Domain) -> Outcome<Self> {
        if let Some(count) = name.strip_prefix("spectrum:") {
            return Ok(Task::Spectrum { count: count.parse()?, operator: Box::new(build("cotan", &domain)?) });
        }
        let (id, with_topology) = match name {
            "cotan" => ("cotan", false),
            "cotan+topology" => ("cotan", true),
            "intrinsic" => ("intrinsic-delaunay", false),
            "intrinsic+topology" => ("intrinsic-delaunay", true),
            "verdicts" => {
                let operator = as_given(&build("cotan", &domain)?)?;
                return Ok(Task::Verdicts { domain, operator: Box::new(operator) });
            }
            _ => return Err(format!("no task {name:?}; see the head of this file").into()),
        };
        if !with_topology {
            return Ok(Task::Build { id, domain });
        }
        let surface = domain.as_surface().ok_or("the mesh must be a surface")?;
        let triangles = (0..surface.faces().len()).map(|f| surface.triangle(f)).collect::<Option<Vec<_>>>();
        let faces = triangles.ok_or("the mesh must be of triangles")?;
        Ok(Task::FromFaces { id, positions: surface.positions().to_vec(), faces })
    }

    fn run(&self) -> Outcome<Timed> {
        match self {
            Task::Build { id, domain } => {
                let clock = Clock::start();
                let operator = build(id, domain)?;
                let timed = clock.stop(Vec::new());
                drop(operator);
                Ok(timed)
            }
            Task::FromFaces { id, positions, faces } => {
                let (positions, faces) = (positions.clone(), Faces::from(faces.clone()));
                let clock = Clock::start();
                let domain = Domain::from(Surface::from_faces(positions, faces)?);
                let topology = clock.0.elapsed().as_secs_f64();
                let operator = build(id, &domain)?;
                let timed = clock.stop(vec![("topology", topology)]);
                drop(operator);
                Ok(timed)
            }
            Task::Spectrum { count, operator } => {
                let mass = operator.mass().ok_or("no mass")?.matrix();
                let clock = Clock::start();
                let spectrum = lowest(operator.stiffness(), mass, *count, 0)?;
                let timed = clock.stop(Vec::new());
                if !spectrum.closure.certified {
                    return Err("the inertia count does not close the spectrum".into());
                }
                Ok(timed)
            }
            Task::Verdicts { domain, operator } => {
                let clock = Clock::start();
                let trial = Trial::new(domain, operator, 0)?;
                let mut parts = Vec::new();
                for id in STRUCTURAL {
                    let before = Instant::now();
                    let verdict = property::find(id).ok_or("no such property")?.decide(&trial, None);
                    parts.push((id, before.elapsed().as_secs_f64()));
                    drop(verdict);
                }
                Ok(clock.stop(parts))
            }
        }
    }
}

/// The seconds that all threads of the process together have spent on a processor; zero where the system tells none.
fn cpu_seconds() -> f64 {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let spent = tasks.filter_map(|t| std::fs::read_to_string(t.path().join("schedstat")).ok());
    spent.filter_map(|s| s.split_whitespace().next()?.parse::<f64>().ok()).sum::<f64>() * 1e-9
}

/// A field of the process's status in bytes; zero where the system tells none.
fn status(field: &str) -> u64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find_map(|l| l.strip_prefix(field));
    let kilobytes = line.and_then(|l| l.trim_start_matches(':').split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) * 1024
}

fn peak(task: &Task) -> Outcome<u64> {
    // "5" sets the high-water mark back to what is resident now.
    std::fs::write("/proc/self/clear_refs", "5")?;
    let before = status("VmRSS");
    task.run()?;
    Ok(status("VmHWM").saturating_sub(before))
}

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [mesh, name, rest @ ..] = arguments.as_slice() else { return Err("usage: MESH TASK [REPEATS]".into()) };
    let domain = lapjury::exchange::read_domain(Path::new(mesh))?;
    if let Some(name) = name.strip_prefix("memory:") {
        let task = Task::prepare(name, domain)?;
        println!("{}", serde_json::json!({ "peak_bytes": peak(&task)? }));
        return Ok(());
    }
    let task = Task::prepare(name, domain)?;
    let mut out = std::io::stdout().lock();
    let mut report = || -> Outcome<()> {
        let Timed { seconds, cpu_seconds, parts } = task.run()?;
        let parts: serde_json::Map<_, _> = parts.into_iter().map(|(id, s)| (id.to_string(), s.into())).collect();
        writeln!(out, "{}", serde_json::json!({ "seconds": seconds, "cpu_seconds": cpu_seconds, "parts": parts }))?;
        Ok(out.flush()?)
    };
    match rest.first() {
        Some(repeats) => (0..repeats.parse::<usize>()?).try_for_each(|_| report()),
        None => {
            println!("ready");
            std::io::stdin().lock().lines().try_for_each(|line| line.map_err(Into::into).and_then(|_| report()))
        }
    }
}
