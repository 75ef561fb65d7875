//! A whole run: header, cases, claims, atlas, exhibits, timing — each line handed on as soon as it is known.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::cases::{self, CaseError, Decided, Parts};
use super::claims;
use super::plan::Plan;
use super::recipe::Recipe;
use crate::domain::{Domain, Facts};
use crate::property::Status;
use crate::record::{BrokenLine, Cell, Exhibit, Header, Line, SCHEMA, Timing, WriteError};

/// How a plan is run.
pub struct Options {
    /// The directory that file recipes are relative to.
    pub root: PathBuf,
    /// How many threads; all processors if absent.
    pub threads: Option<usize>,
    /// Provenance that is never compared.
    pub environment: BTreeMap<String, String>,
}

/// Somebody who watches a run: a progress bar, a log, nobody.
pub trait Observer {
    /// The number of cases, before the first.
    fn planned(&mut self, cases: usize);
    /// Another case is done.
    fn decided(&mut self, done: usize);
    /// All cases are done; the claims come next.
    fn testing_claims(&mut self, claims: usize);
}

/// Nobody watches.
impl Observer for () {
    fn planned(&mut self, _: usize) {}
    fn decided(&mut self, _: usize) {}
    fn testing_claims(&mut self, _: usize) {}
}

/// Why a run came to no end. What was decided before has been handed on.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A line could not be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The threads could not be started.
    #[error("{0} threads could not be started; ask for fewer with --threads")]
    Threads(usize),
}

/// Runs a plan and hands each line of its record but the footer to `write`, in an order that does not depend on the number
/// of threads.
///
/// # Errors
/// A line that could not be written, threads that could not be started.
pub fn run(
    plan: &Plan,
    options: &Options,
    observer: &mut dyn Observer,
    write: &mut dyn FnMut(&Line) -> Result<(), WriteError>,
) -> Result<(), RunError> {
    let start = Instant::now();
    let threads = options.threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().map_err(|_| RunError::Threads(threads))?;
    write(&header(plan, options))?;
    observer.planned(plan.cases.len());
    let mut results = Results::default();
    cases::decide_all(&plan.cases, &options.root, &pool, |at, decided| {
        results.lines(&plan.cases[at].class, decided).iter().try_for_each(&mut *write)?;
        observer.decided(at + 1);
        Ok::<(), WriteError>(())
    })?;
    observer.testing_claims(plan.claims.len());
    let claims_start = Instant::now();
    let outcomes = pool.install(|| claims::test(&plan.claims, &results.facts, &results.cells, &plan.setting));
    results.parts.insert("claims".into(), claims_start.elapsed().as_secs_f64());
    outcomes.into_iter().map(Line::Claim).try_for_each(|line| write(&line))?;
    if let Some(atlas) = &plan.atlas {
        let atlas_start = Instant::now();
        let lines = pool.install(|| atlas.search());
        results.parts.insert("atlas".into(), atlas_start.elapsed().as_secs_f64());
        lines.into_iter().map(Line::Atlas).try_for_each(|line| write(&line))?;
    }
    exhibits(&results, &options.root).into_iter().map(Line::Exhibit).try_for_each(|line| write(&line))?;
    let (seconds, threads) = (start.elapsed().as_secs_f64(), pool.current_num_threads());
    Ok(write(&Line::Timing(Timing { seconds, threads, parts: results.parts }))?)
}

fn header(plan: &Plan, options: &Options) -> Line {
    Line::Header(Header {
        schema: SCHEMA,
        suite: plan.suite.clone(),
        seed: plan.setting.seed,
        version: env!("CARGO_PKG_VERSION").to_string(),
        environment: options.environment.clone(),
    })
}

/// What the later parts of a run need of the earlier ones.
#[derive(Default)]
struct Results {
    cells: Vec<Cell>,
    facts: BTreeMap<String, Facts>,
    parts: Parts,
}

impl Results {
    /// Takes in what a case of this class came to, and gives its lines back.
    fn lines(&mut self, class: &str, decided: Result<Decided, CaseError>) -> Vec<Line> {
        let decided = match decided {
            Ok(decided) => decided,
            Err(CaseError { recipe, error }) => {
                return vec![Line::Broken(BrokenLine { recipe, class: class.into(), error: error.to_string() })];
            }
        };
        for (part, seconds) in decided.parts {
            *self.parts.entry(part).or_default() += seconds;
        }
        for line in &decided.lines {
            match line {
                Line::Domain(domain) => drop(self.facts.insert(domain.recipe.clone(), domain.facts.clone())),
                Line::Cell(cell) => self.cells.push(cell.clone()),
                _ => {}
            }
        }
        decided.lines
    }
}

/// The smallest failing case of each (operator, property): fewest vertices, then faces, then first in the plan.
fn exhibits(results: &Results, root: &Path) -> Vec<Exhibit> {
    type Best<'a> = (&'a Cell, (usize, usize));
    let mut smallest: BTreeMap<(&str, &str), Best> = BTreeMap::new();
    for cell in results.cells.iter().filter(|c| c.verdict.status() == Status::Fails) {
        let size = results.facts.get(&cell.recipe).map_or((usize::MAX, 0), |f| (f.vertices, f.faces));
        smallest
            .entry((&cell.laplacian, &cell.property))
            .and_modify(|best| {
                if size < best.1 {
                    *best = (cell, size);
                }
            })
            .or_insert((cell, size));
    }
    smallest
        .into_values()
        .filter_map(|(cell, _)| {
            // It was built once in this run, so it builds again; if a file vanished meanwhile, there is no picture.
            let domain = cell.recipe.parse::<Recipe>().ok()?.build(root).ok()?;
            Some(exhibit(cell, &domain))
        })
        .collect()
}

/// A failing cell with its mesh.
pub fn exhibit(cell: &Cell, domain: &Domain) -> Exhibit {
    Exhibit {
        laplacian: cell.laplacian.clone(),
        property: cell.property.clone(),
        recipe: cell.recipe.clone(),
        positions: domain.positions().map_or_else(|| on_a_circle(domain.vertex_count()), <[_]>::to_vec),
        faces: domain.as_surface().map_or_else(Vec::new, |s| s.faces().to_vec()),
        edges: domain.edges().to_vec(),
    }
}

fn on_a_circle(n: usize) -> Vec<[f64; 3]> {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / n.max(1) as f64;
    (0..n).map(|k| [angle(k).cos(), angle(k).sin(), 0.0]).collect()
}
