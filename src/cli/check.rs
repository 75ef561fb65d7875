//! `lapjury check`: one operator on one domain, built in or read from a file.

mod answer;
mod human;
mod shrunk;

use std::path::PathBuf;

use anyhow::{Context, bail};

use super::{Common, Exit, Format, colour, print, print_json};
use crate::domain::{Domain, Facts};
use crate::exchange;
use crate::external::{self, Comparison, DeclaredSign};
use crate::operator::Operator;
use crate::property::{self, Property, Status, Trial, Verdict};
use crate::record::Recheck;
use crate::suite::{Choice, Recipe, cases};

use answer::{Answer, DomainAnswer, OperatorAnswer, VerdictAnswer};
use human::human;

/// Judge one operator on one domain: built in, or a matrix from a file
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  lapjury check --mesh spot.ply --laplacian cotan --mass mixed
  lapjury check --mesh spot.ply --stiffness L.mtx --mass M.mtx --against cotan
  lapjury check --domain 'random-delaunay:seed=7 | flip:count=5' --laplacian cotan --property POS
  lapjury check --mesh spot.ply --laplacian cotan --property POS --shrink small/

The sign of a matrix is read off its diagonal and said; a declared one is checked. A matrix fails nothing that was not
promised: name what it should hold with --promises, and the command ends with 1 where it does not, with 3 where rounding leaves
that open, with 4 where none of the promises says anything on this domain (LIN on a curved surface). Any promise implies FIN.")]
pub(super) struct Check {
    /// A mesh file: off, obj, ply, stl, xyz, mesh, or a graph as mtx; .gz as well
    #[arg(long, value_name = "FILE", required_unless_present = "domain", conflicts_with = "domain")]
    mesh: Option<PathBuf>,
    /// A recipe: a mesh file or a generator, then modifiers
    #[arg(long, value_name = "RECIPE")]
    domain: Option<String>,
    /// A built-in operator, with settings as in three-point:p=2
    #[arg(long, value_name = "ID", required_unless_present = "stiffness", conflicts_with = "stiffness")]
    laplacian: Option<String>,
    /// A stiffness matrix in Matrix Market form
    #[arg(long, value_name = "FILE")]
    stiffness: Option<PathBuf>,
    /// With --laplacian: which mass matrix. With --stiffness: a mass matrix in Matrix Market form
    #[arg(long, value_name = "MASS")]
    mass: Option<String>,
    /// The sign of the stiffness matrix
    #[arg(long, value_enum, default_value_t, conflicts_with = "laplacian")]
    sign: DeclaredSign,
    /// The factor by which the matrix is larger than with cotangent weights ½(cot α + cot β)
    #[arg(long, default_value_t = 1.0, conflicts_with = "laplacian")]
    scale: f64,
    /// Decide only these properties, and those of --promises
    #[arg(long, value_name = "ID,…", value_delimiter = ',')]
    property: Vec<String>,
    /// What the operator is promised to hold, beside what the catalogue promises of it
    #[arg(long, value_name = "ID,…", value_delimiter = ',')]
    promises: Vec<String>,
    /// Compare entry by entry with a built-in operator, within the bound that the mesh's conditioning sets; the mass too where
    /// one is named, as in cotan:mass=mixed
    #[arg(long, value_name = "ID")]
    against: Option<String>,
    /// Shrink the surface while the first failing property of the built-in operator fails, and write the small mesh there
    #[arg(long, value_name = "DIR", requires = "laplacian")]
    shrink: Option<PathBuf>,
    /// How the result is printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// A verdict with what is expected of it.
struct Decided {
    property: &'static Property,
    verdict: Verdict,
    recheck: Recheck,
    /// What the catalogue or the command line promises.
    promised: Option<bool>,
}

impl Check {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let properties = self.properties()?;
        let choice = self.choice()?;
        let against = self.against.as_ref().map(|text| text.parse::<Choice>()).transpose()?;
        let (source, domain) = self.domain(common)?;
        domain.notices().iter().for_each(|n| common.say(format_args!("{source}: {n}")));
        let facts = domain.facts();
        let operator = match &choice {
            Some(choice) => match choice.build(&domain) {
                Ok(operator) => operator,
                Err(refusal) => return self.refuse(DomainAnswer::new(&source, &domain, &facts), &refusal.to_string()),
            },
            None => self.read_operator()?,
        };
        let trial = Trial::new(&domain, &operator, cases::seed_of(&source))?;
        let decided: Vec<Decided> =
            properties.into_iter().map(|property| self.decide(property, &trial, choice.as_ref(), &facts)).collect();
        let comparisons = match &against {
            Some(ours) => compare(&domain, &operator, ours)?,
            None => Vec::new(),
        };
        let differs = comparisons.iter().any(|c| c.beyond > 0);
        match self.format {
            Format::Human => print(&human(&source, &facts, &operator, &decided, &comparisons))?,
            Format::Json => print_json(&Answer {
                domain: DomainAnswer::new(&source, &domain, &facts),
                operator: OperatorAnswer::built(&operator),
                verdicts: decided.iter().map(VerdictAnswer::new).collect(),
                comparison: comparisons.first().cloned(),
                mass_comparison: comparisons.get(1).cloned(),
            })?,
        }
        if let (Some(dir), Some(choice)) = (&self.shrink, &choice) {
            shrunk::write(common, dir, choice, &source, &domain, &decided)?;
        }
        Ok(if differs || decided.iter().any(Decided::is_unexpected) {
            Exit::Unexpected
        } else if self.has_promised(&decided, |status| status == Status::Undecided) {
            Exit::Incomplete
        } else if !self.promises.is_empty() && !self.has_promised(&decided, |status| status != Status::NotApplicable) {
            Exit::Nothing
        } else {
            Exit::AsExpected
        })
    }

    fn domain(&self, common: &Common) -> anyhow::Result<(String, Domain)> {
        match (&self.mesh, &self.domain) {
            (Some(path), _) => Ok((path.display().to_string(), exchange::read_domain(path)?)),
            (None, Some(recipe)) => {
                let recipe: Recipe = recipe.parse()?;
                Ok((recipe.to_string(), recipe.build(&common.root)?))
            }
            (None, None) => bail!("name a domain with --mesh or --domain"),
        }
    }

    /// The properties to decide, in the order of the tables.
    fn properties(&self) -> anyhow::Result<Vec<&'static Property>> {
        for id in self.property.iter().chain(&self.promises) {
            property::find(id).with_context(|| {
                format!("there is no property '{id}'; 'lapjury list properties' names those that there are")
            })?;
        }
        let asked = |p: &Property| self.property.is_empty() || self.property.iter().any(|id| id == p.id);
        Ok(property::ALL.iter().copied().filter(|p| asked(p) || self.promises(p)).collect())
    }

    /// Whether the command line promises the property: by name, or because whatever is promised takes finite entries for granted.
    fn promises(&self, property: &Property) -> bool {
        self.promises.iter().any(|id| id == property.id) || property.id == "FIN" && !self.promises.is_empty()
    }

    /// Whether a property promised by name has such a status.
    fn has_promised(&self, decided: &[Decided], such: impl Fn(Status) -> bool) -> bool {
        decided.iter().any(|d| self.promises.iter().any(|id| id == d.property.id) && such(d.verdict.status()))
    }

    /// The built-in operator, if one is named.
    fn choice(&self) -> anyhow::Result<Option<Choice>> {
        let Some(text) = &self.laplacian else { return Ok(None) };
        let choice: Choice = text.parse()?;
        Ok(Some(match &self.mass {
            Some(mass) => choice.with("mass", mass)?,
            None => choice,
        }))
    }

    fn read_operator(&self) -> anyhow::Result<Operator> {
        let Some(stiffness) = &self.stiffness else { bail!("name an operator with --laplacian or --stiffness") };
        let mass = self.mass.as_ref().map(PathBuf::from);
        Ok(external::read_operator(stiffness, mass.as_deref(), self.sign, self.scale)?)
    }

    /// The construction gave no operator: said on standard error, and as JSON with what is known of the domain.
    fn refuse(&self, domain: DomainAnswer, refusal: &str) -> anyhow::Result<Exit> {
        if self.format == Format::Json {
            let operator = OperatorAnswer::refused(self.laplacian.as_deref().unwrap_or_default(), refusal);
            print_json(&Answer { domain, operator, verdicts: Vec::new(), comparison: None, mass_comparison: None })?;
        }
        bail!("no operator, so no verdict: {refusal}")
    }

    fn decide(&self, property: &'static Property, trial: &Trial, choice: Option<&Choice>, facts: &Facts) -> Decided {
        let verdict = match choice {
            None => property.decide(trial, None),
            Some(choice) => {
                property.decide(trial, Some(&|domain| choice.build(domain).map_err(|refusal| refusal.to_string())))
            }
        };
        let recheck = cases::recheck_verdict(&verdict, property, trial);
        let by_catalogue = choice.and_then(|choice| choice.promises(property.id, facts));
        let promised = by_catalogue.or(self.promises(property).then_some(true));
        Decided { property, verdict, recheck, promised }
    }
}

/// The stiffness compared with that of a built-in operator, and the mass where the choice names one.
fn compare(domain: &Domain, operator: &Operator, choice: &Choice) -> anyhow::Result<Vec<Comparison>> {
    let (ours, label) = (choice.build(domain)?, choice.to_string());
    let mut comparisons = vec![external::compare(domain, operator, &ours, &label)];
    if let (true, Some(theirs), Some(ours)) = (choice.names("mass"), operator.mass(), ours.mass()) {
        comparisons.push(external::compare_mass(domain, theirs, ours, &format!("{label}, mass")));
    }
    Ok(comparisons)
}

impl Decided {
    fn is_unexpected(&self) -> bool {
        matches!(self.recheck, Recheck::Refused(_)) || !cases::as_expected(self.promised, &self.verdict)
    }
}
