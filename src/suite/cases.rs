//! Running a plan: parallel over cases, results in the order of the plan.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::mpsc;
use std::time::Instant;

use rayon::prelude::*;

use super::choice::Choice;
use super::plan::Case;
use super::recipe::RecipeError;
use crate::domain::{Domain, Facts};
use crate::property::recheck::{self, Rechecked, Refusal};
use crate::property::{Property, Status, Trial, Verdict};
use crate::record::{Cell, DomainLine, Line, OperatorLine, Recheck};

/// Seconds spent, by part.
pub type Parts = BTreeMap<String, f64>;

/// What one case came to.
pub struct Decided {
    /// Its lines: the domain, then each operator with its cells.
    pub lines: Vec<Line>,
    /// Seconds spent on it.
    pub parts: Parts,
}

/// A domain that could not be made: the run goes on, the record says so, and the run counts as incomplete.
#[derive(Debug, thiserror::Error)]
#[error("{recipe}: {error}")]
pub struct CaseError {
    /// The recipe.
    pub recipe: String,
    /// What went wrong.
    pub error: Box<RecipeError>,
}

/// Decides every case on the pool and hands the results to `each` in the order of the plan, as soon as all earlier ones are
/// in. The results do not depend on the number of threads. An error of `each` ends it: no case is begun after that.
///
/// # Errors
/// The error of `each`.
pub fn decide_all<E>(
    cases: &[Case],
    root: &Path,
    pool: &rayon::ThreadPool,
    mut each: impl FnMut(usize, Result<Decided, CaseError>) -> Result<(), E>,
) -> Result<(), E> {
    let (sender, receiver) = mpsc::channel();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            pool.install(|| {
                // Once the receiver is gone nobody asks for more.
                let send = |sender: &mut mpsc::Sender<_>, (at, case)| sender.send((at, decide(case, root))).ok();
                let _ = cases.par_iter().enumerate().with_max_len(1).try_for_each_with(sender, send);
            });
        });
        let mut waiting = BTreeMap::new();
        let mut next = 0;
        for (at, result) in receiver {
            waiting.insert(at, result);
            while let Some(result) = waiting.remove(&next) {
                each(next, result)?;
                next += 1;
            }
        }
        Ok(())
    })
}

/// Makes the domain of a case and decides every property of every operator on it.
///
/// # Errors
/// A recipe that makes no domain.
pub fn decide(case: &Case, root: &Path) -> Result<Decided, CaseError> {
    let mut clock = Clock::default();
    let recipe = case.recipe.to_string();
    let domain = clock
        .time("generate", || case.recipe.build(root))
        .map_err(|error| CaseError { recipe: recipe.clone(), error: Box::new(error) })?;
    let facts = clock.time("facts", || domain.facts());
    let mut lines = vec![Line::Domain(DomainLine {
        recipe: recipe.clone(),
        class: case.class.clone(),
        digest: domain.digest(),
        facts: facts.clone(),
        notices: domain.notices().to_vec(),
    })];
    let accepted = |choice: &&Choice| choice.laplacian.accepts.contains(&domain.kind());
    for choice in case.choices.iter().filter(accepted) {
        lines.extend(judge(case, &recipe, choice, &domain, &facts, &mut clock));
    }
    Ok(Decided { lines, parts: clock.0 })
}

/// Builds one operator and decides its properties.
fn judge(case: &Case, recipe: &str, choice: &Choice, domain: &Domain, facts: &Facts, clock: &mut Clock) -> Vec<Line> {
    let label = choice.to_string();
    let built = clock.time(&format!("build/{}", choice.laplacian.id), || choice.build(domain));
    let line = |refused, notes| {
        Line::Operator(OperatorLine { recipe: recipe.to_string(), laplacian: label.clone(), refused, notes })
    };
    let operator = match built {
        Ok(operator) => operator,
        Err(refusal) => return vec![line(Some(refusal.to_string()), Vec::new())],
    };
    let trial = match Trial::new(domain, &operator, seed_of(recipe)) {
        Ok(trial) => trial,
        Err(mismatch) => return vec![line(Some(mismatch.to_string()), Vec::new())],
    };
    let construction = |domain: &Domain| choice.build(domain).map_err(|refusal| refusal.to_string());
    let mut lines = vec![line(None, operator.provenance().notes.clone())];
    for property in &case.properties {
        let verdict = clock.time(&format!("decide/{}", property.id), || property.decide(&trial, Some(&construction)));
        let recheck = clock.time("recheck", || recheck_verdict(&verdict, property, &trial));
        let telling = matches!(verdict.status(), Status::Fails | Status::Undecided);
        let replay = if telling { replay(recipe, &label, property.id) } else { String::new() };
        let promised = choice.promises(property.id, facts);
        lines.push(Line::Cell(Cell {
            recipe: recipe.to_string(),
            class: case.class.clone(),
            laplacian: label.clone(),
            property: property.id.to_string(),
            as_expected: as_expected(promised, &verdict),
            verdict,
            promised,
            recheck,
            replay,
        }));
    }
    lines
}

/// The cell of one property of one operator on a domain that this recipe makes; `None` where the construction refuses it.
pub fn cell(choice: &Choice, property: &'static Property, domain: &Domain, recipe: &str) -> Option<Cell> {
    let case = Case {
        class: "witness".into(),
        recipe: recipe.parse().ok()?,
        choices: vec![choice.clone()],
        properties: vec![property],
    };
    let lines = judge(&case, recipe, choice, domain, &domain.facts(), &mut Clock::default());
    lines.into_iter().find_map(|line| match line {
        Line::Cell(cell) => Some(cell),
        _ => None,
    })
}

/// A verdict contradicts a promise only when it fails what was promised to hold; what rounding leaves open contradicts
/// nothing.
pub fn as_expected(promised: Option<bool>, verdict: &Verdict) -> bool {
    promised != Some(true) || verdict.status() != Status::Fails
}

/// The command that repeats a cell alone, as a POSIX shell reads it.
pub fn replay(recipe: &str, laplacian: &str, property: &str) -> String {
    format!("lapjury check --domain {} --laplacian {} --property {property}", quoted(recipe), quoted(laplacian))
}

/// A word in single quotes, within which only they themselves mean anything.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// The seed of what a check draws at random on a domain: its recipe's, so that a replay draws the same.
pub fn seed_of(recipe: &str) -> u64 {
    crate::generate::Stream::new(0, recipe).bits()
}

/// Sends a verdict through JSON, as a reader of the record would get it, and verifies its evidence against the operator.
pub fn recheck_verdict(verdict: &Verdict, property: &Property, trial: &Trial) -> Recheck {
    if verdict.evidence().is_none() {
        return Recheck::Nothing;
    }
    match serde_json::to_string(verdict).and_then(|text| serde_json::from_str::<Verdict>(&text)) {
        Ok(read) => told(recheck::of_verdict(&read, property.id, trial.domain, trial.operator)),
        Err(error) => Recheck::Refused(format!("the evidence does not survive JSON: {error}")),
    }
}

/// The answer of the recheck as the record keeps it.
pub fn told(answer: Result<Option<Rechecked>, Refusal>) -> Recheck {
    match answer {
        Ok(None) => Recheck::Nothing,
        Ok(Some(Rechecked::Exact)) => Recheck::Exact,
        Ok(Some(Rechecked::Bounded)) => Recheck::Bounded,
        Ok(Some(Rechecked::Open(why))) => Recheck::Open(why),
        Err(refusal) => Recheck::Refused(refusal.to_string()),
    }
}

/// Adds up seconds by part.
#[derive(Default)]
struct Clock(Parts);

impl Clock {
    fn time<T>(&mut self, part: &str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        *self.0.entry(part.to_string()).or_default() += start.elapsed().as_secs_f64();
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::{Choice, Recipe};

    fn plan(recipes: &[&str]) -> Vec<Case> {
        let case = |text: &&str| Case {
            class: "class".into(),
            recipe: text.parse::<Recipe>().unwrap(),
            choices: vec!["graph".parse::<Choice>().unwrap()],
            properties: vec![crate::property::find("SYM").unwrap()],
        };
        recipes.iter().map(case).collect()
    }

    fn pool(threads: usize) -> rayon::ThreadPool {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
    }

    #[test]
    fn results_come_in_the_order_of_the_plan_for_any_number_of_threads() {
        // The first case takes longest, so that with two threads its result is in last.
        let plan = plan(&["grid:nx=40,ny=40", "grid:nx=2,ny=2", "no-such.off", "grid:nx=3,ny=2", "grid:nx=2,ny=3"]);
        for threads in [1, 2] {
            let mut seen = Vec::new();
            decide_all(&plan, Path::new("."), &pool(threads), |at, decided| {
                seen.push((at, decided.map(|d| d.lines.len()).map_err(|e| e.recipe)));
                Ok::<(), ()>(())
            })
            .unwrap();
            let expected = [Ok(3), Ok(3), Err("no-such.off".to_string()), Ok(3), Ok(3)];
            assert_eq!(seen, expected.into_iter().enumerate().collect::<Vec<_>>());
        }
    }

    #[test]
    fn an_error_of_the_reader_ends_the_run() {
        let plan = plan(&["grid:nx=2,ny=2"; 500]);
        let mut seen = 0;
        let end = decide_all(&plan, Path::new("."), &pool(1), |at, _| {
            seen += 1;
            if at == 2 { Err("disk full") } else { Ok(()) }
        });
        assert_eq!((end, seen), (Err("disk full"), 3));
    }

    #[test]
    fn a_path_with_a_quote_in_it_is_one_word_of_the_replay_command() {
        assert_eq!(
            replay("it's.off", "cotan:mass=mixed", "POS"),
            r"lapjury check --domain 'it'\''s.off' --laplacian 'cotan:mass=mixed' --property POS"
        );
    }
}
