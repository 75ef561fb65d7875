//! A question to the cells of a run: whether every operator on every domain that meets some conditions, or some, has the
//! verdicts that a claim leads to expect.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::test::Form;
use crate::domain::Facts;
use crate::laplacian::Fact;
use crate::property::{self, Level, Status};
use crate::record::{Cell, Recheck, TestLine};
use crate::suite::cases;

/// A question, every name of it looked up.
#[derive(Clone, Debug)]
pub struct Question {
    /// How many must agree.
    pub quantifier: Quantifier,
    /// The operators asked, by catalogue id; all if empty.
    pub laplacians: Vec<&'static str>,
    /// Only domains with these facts are asked.
    pub facts: Vec<Fact>,
    /// Only domains and operators with these verdicts are asked.
    pub given: Vec<Condition>,
    /// The verdicts that they should have.
    pub then: Vec<Condition>,
}

/// How many of the selected cells must agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantifier {
    /// All that are decided, and at least one.
    Every,
    /// At least one. That a run has none decides nothing: there may be one elsewhere.
    Some,
}

/// A property with the verdict asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// The property's id.
    pub property: &'static str,
    /// Whether it should hold or fail.
    pub holds: bool,
}

/// What became of conditions at one operator on one domain.
#[derive(Clone, Copy)]
enum Met<'a> {
    /// All are met, this one by the weakest evidence.
    Yes(&'a Cell),
    /// This one is clearly not met.
    No(&'a Cell),
    /// Rounding left one open, or its evidence did not survive the recheck.
    Open,
    /// One was not asked here or is not applicable.
    Nothing,
}

impl Met<'_> {
    fn level(&self) -> Option<Level> {
        match self {
            Met::Yes(cell) | Met::No(cell) => Some(cell.verdict.level),
            Met::Open | Met::Nothing => None,
        }
    }
}

impl Condition {
    /// Reads "PROPERTY holds" or "PROPERTY fails"; nothing if it is neither.
    pub(super) fn read(text: &str) -> Option<Self> {
        let (id, status) = text.split_once(' ')?;
        let holds = match status {
            "holds" => true,
            "fails" => false,
            _ => return None,
        };
        Some(Condition { property: property::find(id)?.id, holds })
    }

    fn met<'a>(self, cells: &BTreeMap<&str, &'a Cell>) -> Met<'a> {
        let Some(&cell) = cells.get(self.property) else { return Met::Nothing };
        match cell.verdict.status() {
            Status::NotApplicable => Met::Nothing,
            Status::Undecided => Met::Open,
            _ if matches!(cell.recheck, Recheck::Refused(_)) => Met::Open,
            status if (status == Status::Holds) == self.holds => Met::Yes(cell),
            _ => Met::No(cell),
        }
    }
}

impl std::fmt::Display for Condition {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", self.property, if self.holds { "holds" } else { "fails" })
    }
}

/// All of the conditions: not met if one is clearly not met; else what the weakest of them is.
fn all_met<'a>(conditions: &[Condition], cells: &BTreeMap<&str, &'a Cell>) -> Met<'a> {
    let all: Vec<Met> = conditions.iter().map(|condition| condition.met(cells)).collect();
    let first = |which: fn(&Met) -> bool| all.iter().copied().find(which);
    first(|met| matches!(met, Met::No(_)))
        .or_else(|| first(|met| matches!(met, Met::Nothing)))
        .or_else(|| first(|met| matches!(met, Met::Open)))
        .or_else(|| all.iter().copied().max_by_key(Met::level))
        .unwrap_or(Met::Nothing)
}

/// What was counted over operators and domains.
#[derive(Default)]
struct Count<'a> {
    agree: usize,
    disagree: usize,
    open: usize,
    /// The weakest level of those that agree.
    level: Option<Level>,
    favour: Option<&'a Cell>,
    against: Option<&'a Cell>,
}

impl<'a> Count<'a> {
    fn add(&mut self, met: Met<'a>) {
        match met {
            Met::Nothing => {}
            Met::Open => self.open += 1,
            Met::Yes(cell) => {
                self.agree += 1;
                self.level = self.level.max(Some(cell.verdict.level));
                strongest(&mut self.favour, cell);
            }
            Met::No(cell) => {
                self.disagree += 1;
                strongest(&mut self.against, cell);
            }
        }
    }
}

/// Keeps the example with the strongest level of evidence, the first of several.
fn strongest<'a>(example: &mut Option<&'a Cell>, cell: &'a Cell) {
    if example.is_none_or(|known| cell.verdict.level < known.verdict.level) {
        *example = Some(cell);
    }
}

impl Question {
    /// Whether it asks for the verdict on this property of this operator.
    pub(super) fn asks(&self, laplacian: &str, property: &str) -> bool {
        (self.laplacians.is_empty() || self.laplacians.contains(&laplacian))
            && self.given.iter().chain(&self.then).any(|condition| condition.property == property)
    }

    /// Asks every operator on every domain.
    pub(super) fn ask(&self, docket: &Docket, form: Form) -> TestLine {
        let mut count = Count::default();
        for (&(recipe, laplacian), cells) in &docket.pairs {
            let id = laplacian.split(':').next().unwrap_or_default();
            let known = docket.facts.get(recipe);
            let selected = (self.laplacians.is_empty() || self.laplacians.contains(&id))
                && self.facts.iter().all(|fact| known.is_some_and(|known| fact.is_true_of(known)))
                && self.given.iter().all(|condition| matches!(condition.met(cells), Met::Yes(_)));
            if selected {
                count.add(all_met(&self.then, cells));
            }
        }
        self.line(&count, form)
    }

    fn line(&self, count: &Count, form: Form) -> TestLine {
        let Count { agree, disagree, open, .. } = *count;
        // A counterexample decides "every", a witness decides "some"; else it is all cells together, or none.
        let (agrees, decided, open, example) = match self.quantifier {
            Quantifier::Every => (agree > 0 && disagree == 0, agree + disagree, open, count.against),
            Quantifier::Some if agree > 0 => (true, agree + disagree, open, count.favour),
            Quantifier::Some => (false, 0, disagree + open, None),
        };
        let level = example.map_or(count.level, |cell| Some(cell.verdict.level));
        let mut finding = format!("{agree} of {} agree", agree + disagree);
        if count.open > 0 {
            finding += &format!(", {} left open by rounding", count.open);
        }
        if let Some(cell) = example {
            finding += &format!("; {} on {}", cell.laplacian, cell.recipe);
        }
        TestLine {
            question: self.to_string(),
            form: form.name().into(),
            agrees,
            decided,
            open,
            level: level.unwrap_or(Level::Exact),
            finding,
            replay: example.map(|c| cases::replay(&c.recipe, &c.laplacian, &c.property)),
            evidence: example.and_then(|c| c.verdict.evidence()).cloned().into_iter().collect(),
            figures: Vec::new(),
        }
    }
}

impl std::fmt::Display for Question {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let who = if self.laplacians.is_empty() { "any operator".to_string() } else { self.laplacians.join(", ") };
        let which = match self.quantifier {
            Quantifier::Every => "every",
            Quantifier::Some => "some",
        };
        let facts = self.facts.iter().map(|f| f.name().to_string());
        let given: Vec<String> = facts.chain(self.given.iter().map(Condition::to_string)).collect();
        let with = if given.is_empty() { "" } else { " with " };
        let then: Vec<String> = self.then.iter().map(Condition::to_string).collect();
        write!(f, "{who}: on {which} domain{with}{}, {}", given.join(" and "), then.join(" and "))
    }
}

/// The cells by (domain, operator), then by property.
pub(super) struct Docket<'a> {
    facts: &'a BTreeMap<String, Facts>,
    pairs: BTreeMap<(&'a str, &'a str), BTreeMap<&'a str, &'a Cell>>,
}

impl<'a> Docket<'a> {
    pub(super) fn new(cells: &'a [Cell], facts: &'a BTreeMap<String, Facts>) -> Self {
        let mut pairs: BTreeMap<_, BTreeMap<_, _>> = BTreeMap::new();
        for cell in cells {
            pairs
                .entry((cell.recipe.as_str(), cell.laplacian.as_str()))
                .or_default()
                .insert(cell.property.as_str(), cell);
        }
        Docket { facts, pairs }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::evidence::Which;
    use crate::property::{Evidence, Excerpt, Statement, Verdict};

    /// A cell on the domain and of the operator of these names; the evidence is not looked at here.
    fn cell(recipe: &str, laplacian: &str, property: &str, status: Status) -> Cell {
        let statement = Statement::NotFinite { matrix: Which::Stiffness, i: 0, j: 0, value: "NaN".into() };
        let evidence = Evidence { statement, excerpt: Excerpt::default() };
        let verdict = match status {
            Status::Holds => Verdict::holds(Level::Bounded, evidence),
            Status::Fails => Verdict::fails(Level::Exact, evidence),
            Status::Undecided => Verdict::undecided("rounding"),
            Status::NotApplicable => Verdict::not_applicable("no interior vertex"),
        };
        let (class, promised, as_expected, recheck) = (String::new(), None, true, Recheck::Exact);
        let [recipe, laplacian, property] = [recipe, laplacian, property].map(str::to_string);
        let replay = String::new();
        Cell { recipe, class, laplacian, property, verdict, promised, as_expected, recheck, replay }
    }

    fn question(quantifier: Quantifier, given: &[&str], then: &[&str]) -> Question {
        let read = |list: &[&str]| list.iter().map(|text| text.parse().unwrap()).collect();
        Question { quantifier, laplacians: vec!["cotan"], facts: Vec::new(), given: read(given), then: read(then) }
    }

    fn ask(question: &Question, cells: &[Cell]) -> TestLine {
        question.ask(&Docket::new(cells, &BTreeMap::new()), Form::Stated)
    }

    /// Agrees, decided, open.
    fn counts(line: &TestLine) -> (bool, usize, usize) {
        (line.agrees, line.decided, line.open)
    }

    use Quantifier::{Every, Some as There};
    use Status::{Fails, Holds, NotApplicable, Undecided};

    #[test]
    fn every_and_some_count_what_is_decided_and_show_the_cell_that_decides() {
        let cells = |statuses: &[Status]| -> Vec<Cell> {
            statuses.iter().enumerate().map(|(k, s)| cell(&format!("d{k}"), "cotan", "POS", *s)).collect()
        };
        let (every, there) = (question(Every, &[], &["POS holds"]), question(There, &[], &["POS holds"]));
        for (statuses, of_every, of_some) in [
            (&[][..], (false, 0, 0), (false, 0, 0)),
            (&[NotApplicable], (false, 0, 0), (false, 0, 0)),
            (&[Undecided, NotApplicable], (false, 0, 1), (false, 0, 1)),
            (&[Holds, Holds, NotApplicable], (true, 2, 0), (true, 2, 0)),
            (&[Holds, Undecided], (true, 1, 1), (true, 1, 1)),
            (&[Holds, Fails, Undecided], (false, 2, 1), (true, 2, 1)),
            // No finite run refutes that there is one.
            (&[Fails, Fails, Undecided], (false, 2, 1), (false, 0, 3)),
        ] {
            assert_eq!(counts(&ask(&every, &cells(statuses))), of_every, "every of {statuses:?}");
            assert_eq!(counts(&ask(&there, &cells(statuses))), of_some, "some of {statuses:?}");
        }
        let mixed = cells(&[Holds, Fails, Fails]);
        assert_eq!(ask(&every, &mixed).replay, Some(cases::replay("d1", "cotan", "POS")));
        assert_eq!(ask(&every, &mixed).level, Level::Exact, "the counterexample is exact");
        assert_eq!(ask(&there, &mixed).replay, Some(cases::replay("d0", "cotan", "POS")));
        assert_eq!(ask(&every, &mixed[..1]).level, Level::Bounded, "what holds is as weak as its weakest verdict");
        assert_eq!(ask(&every, &mixed[..1]).finding, "1 of 1 agree");
        assert_eq!(ask(&every, &mixed).finding, "1 of 3 agree; cotan on d1");
    }

    #[test]
    fn evidence_that_was_refused_decides_nothing() {
        for status in [Holds, Fails] {
            let mut bad = cell("d", "cotan", "POS", status);
            bad.recheck = Recheck::Refused("a bug".into());
            for quantifier in [Every, There] {
                assert_eq!(counts(&ask(&question(quantifier, &[], &["POS holds"]), &[bad.clone()])), (false, 0, 1));
            }
            assert_eq!(counts(&ask(&question(Every, &["POS holds"], &["POS holds"]), &[bad.clone()])), (false, 0, 0));
        }
    }

    #[test]
    fn several_verdicts_are_asked_together_and_one_that_is_not_met_decides() {
        let both = question(Every, &[], &["SYM holds", "PSD holds"]);
        for (sym, psd, expected) in [
            (Holds, Holds, (true, 1, 0)),
            (Fails, Holds, (false, 1, 0)),
            (Fails, Undecided, (false, 1, 0)),
            (Undecided, Fails, (false, 1, 0)),
            (NotApplicable, Fails, (false, 1, 0)),
            (Holds, Undecided, (false, 0, 1)),
            (Holds, NotApplicable, (false, 0, 0)),
            (Undecided, NotApplicable, (false, 0, 0)),
        ] {
            let cells = [cell("d", "cotan", "SYM", sym), cell("d", "cotan", "PSD", psd)];
            assert_eq!(counts(&ask(&both, &cells)), expected, "{sym} {psd}");
        }
        let cells = [cell("d", "cotan", "SYM", Fails), cell("d", "cotan", "PSD", Holds)];
        assert_eq!(
            ask(&both, &cells).replay,
            Some(cases::replay("d", "cotan", "SYM")),
            "the one that is not met is shown"
        );
        assert_eq!(counts(&ask(&both, &cells[1..])), (false, 0, 0), "a property that was not asked decides nothing");
    }

    #[test]
    fn operators_facts_and_given_verdicts_select() {
        let cells = [
            cell("d", "cotan:mass=mixed", "POS", Holds),
            cell("d", "cotan:mass=mixed", "PSD", Holds),
            cell("e", "cotan", "POS", Fails),
            cell("e", "cotan", "PSD", Fails),
            cell("e", "mean-value", "POS", Holds),
            cell("e", "mean-value", "PSD", Fails),
        ];
        let given = question(Every, &["POS holds"], &["PSD holds"]);
        assert_eq!(counts(&ask(&given, &cells)), (true, 1, 0));
        assert_eq!(given.to_string(), "cotan: on every domain with POS holds, PSD holds");
        let any = Question { laplacians: Vec::new(), ..given };
        assert_eq!(counts(&ask(&any, &cells)), (false, 2, 0));
        let planar = Question { facts: vec![Fact::Planar], ..question(There, &[], &["PSD fails"]) };
        assert_eq!(counts(&ask(&planar, &cells)), (false, 0, 0), "nothing is known of the domains");
        let domain = crate::generate::find("grid").unwrap().run(None, &BTreeMap::new(), 0).unwrap();
        let facts = BTreeMap::from([("e".to_string(), domain.facts())]);
        let line = planar.ask(&Docket::new(&cells, &facts), Form::Amended);
        assert_eq!((counts(&line), line.form.as_str()), ((true, 1, 0), "amended"));
        assert_eq!(planar.to_string(), "cotan: on some domain with planar, PSD fails");
    }
}
