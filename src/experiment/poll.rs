//! Counts the cases of one question.

use super::Finding;
use crate::property::{Evidence, Level};

/// A case worth showing: what it is, in words, with its witnesses.
#[derive(Clone)]
pub struct Case {
    /// The case in words.
    pub text: String,
    /// Its witnesses.
    pub evidence: Vec<Evidence>,
}

impl Case {
    /// A case that words alone describe.
    pub fn told(text: impl Into<String>) -> Self {
        Case { text: text.into(), evidence: Vec::new() }
    }

    /// With a witness.
    pub fn shown(text: impl Into<String>, witness: Evidence) -> Self {
        Case { text: text.into(), evidence: vec![witness] }
    }
}

/// "Is it so in every case?": no if a case speaks against it, and the first one that does is kept. Without one the question is open as soon as
/// a single case is: what was not decided could be the exception.
#[derive(Default)]
pub struct Every {
    decided: usize,
    against: usize,
    first: Option<Case>,
    open: Vec<String>,
}

impl Every {
    /// Counts a case that decides nothing, and says why.
    pub fn leave_open(&mut self, why: impl Into<String>) {
        self.open.push(why.into());
    }

    /// Counts a case; `violation` is what speaks against the statement there.
    pub fn ask(&mut self, violation: Option<Case>) {
        self.decided += 1;
        if let Some(case) = violation {
            self.against += 1;
            self.first.get_or_insert(case);
        }
    }

    /// The answer; `cases` says what a case is.
    pub fn answer(self, part: &'static str, question: impl Into<String>, cases: &str) -> Finding {
        let (agrees, open) = (self.decided > 0 && self.against == 0 && self.open.is_empty(), self.open.len());
        let (mut text, mut evidence) = (format!("{} {cases}: no exception", self.decided), Vec::new());
        if let Some(first) = self.first {
            text = format!("{} of {} {cases} are exceptions; the first: {}", self.against, self.decided, first.text);
            evidence = first.evidence;
        }
        if let Some(first) = self.open.first() {
            text += &format!("; {open} left open, the first: {first}");
        }
        let decided = if self.against == 0 && open > 0 { 0 } else { self.decided };
        Finding { open, ..finding(part, question, agrees, decided, text, evidence) }
    }
}

/// "Is there a case?": yes as soon as one is found, and the first one, the smallest in the order of the search, is kept.
#[derive(Default)]
pub struct Search {
    searched: usize,
    found: usize,
    first: Option<(usize, Case)>,
}

impl Search {
    /// Counts a case that was searched; `instance` is what is found there.
    pub fn ask(&mut self, instance: Option<Case>) {
        self.searched += 1;
        if let Some(case) = instance {
            self.found += 1;
            self.first.get_or_insert((self.searched, case));
        }
    }

    /// The answer; `cases` says what a case is.
    pub fn answer(self, part: &'static str, question: impl Into<String>, cases: &str) -> Finding {
        let (searched, found) = (self.searched, self.found);
        let (text, evidence) = match self.first {
            Some((at, case)) => {
                (format!("found in {found} of {searched} {cases}, first in number {at}: {}", case.text), case.evidence)
            }
            None => (format!("none among {searched} {cases}"), Vec::new()),
        };
        finding(part, question, found > 0, searched, text, evidence)
    }
}

fn finding(
    part: &'static str,
    question: impl Into<String>,
    agrees: bool,
    decided: usize,
    finding: String,
    evidence: Vec<Evidence>,
) -> Finding {
    let (question, level, figures) = (question.into(), Level::Exact, Vec::new());
    Finding { part, question, agrees, decided, open: 0, level, finding, evidence, figures }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_exception_among_many_is_a_no_that_names_it() {
        let mut every = Every::default();
        (0..5).for_each(|k| every.ask((k >= 3).then(|| Case::told(format!("case {k}")))));
        let answer = every.answer("p", "?", "cases");
        assert_eq!((answer.agrees, answer.decided), (false, 5));
        assert_eq!(answer.finding, "2 of 5 cases are exceptions; the first: case 3");
    }

    #[test]
    fn one_open_case_leaves_the_question_open_unless_another_decides_it() {
        let ask = |cases: &[Option<bool>]| {
            let mut every = Every::default();
            for case in cases {
                match case {
                    Some(agrees) => every.ask((!agrees).then(|| Case::told("no"))),
                    None => every.leave_open("too noisy"),
                }
            }
            let answer = every.answer("p", "?", "cases");
            (answer.agrees, answer.decided, answer.open, answer.finding)
        };
        assert_eq!(ask(&[None]), (false, 0, 1, "0 cases: no exception; 1 left open, the first: too noisy".into()));
        assert_eq!(
            ask(&[Some(true), None]),
            (false, 0, 1, "1 cases: no exception; 1 left open, the first: too noisy".into())
        );
        let text = "1 of 2 cases are exceptions; the first: no; 1 left open, the first: too noisy";
        assert_eq!(ask(&[Some(true), Some(false), None]), (false, 2, 1, text.into()));
    }

    #[test]
    fn no_case_at_all_is_not_a_yes() {
        assert!(!Every::default().answer("p", "?", "cases").agrees);
        assert!(!Search::default().answer("p", "?", "cases").agrees);
    }

    #[test]
    fn the_first_instance_of_a_search_is_kept_with_its_number() {
        let mut some = Search::default();
        (0..5).for_each(|k| some.ask((k == 2 || k == 4).then(|| Case::told(format!("case {k}")))));
        let answer = some.answer("p", "?", "cases");
        assert!(answer.agrees);
        assert_eq!(answer.finding, "found in 2 of 5 cases, first in number 3: case 2");
    }
}
