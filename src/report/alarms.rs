//! The campaign for false alarms as tables, as a page, and in a few lines.

use super::csv::{Table, table};
use super::{File, RenderError, html};
use crate::record::alarms::{AlarmLine, AlarmTally, Alarms};

/// Every file: the tallies, the verdicts that should not be, the data, the page.
///
/// # Errors
/// What a writer of tables refuses.
pub fn render(alarms: &Alarms) -> Result<Vec<File>, RenderError> {
    let file = |path: &str, bytes| File { path: path.into(), bytes };
    Ok(vec![
        file("tallies.csv", tallies(alarms)?),
        file("alarms.csv", lines(alarms)?),
        file("campaign.json", serde_json::to_vec(alarms)?),
        file("campaign.html", html::alarms_page(alarms)?.into_bytes()),
    ])
}

/// `tallies.csv`: a row for each operator, property and class of domains.
pub fn tallies(alarms: &Alarms) -> Table {
    let head = [
        "operator",
        "property",
        "class",
        "holds",
        "undecided",
        "undecided_although_angles_1deg",
        "not_applicable",
        "false_alarms",
    ];
    table(
        head,
        alarms.tallies.iter().map(|t| {
            [
                t.operator.clone(),
                t.property.clone(),
                t.class.clone(),
                t.holds.to_string(),
                t.undecided.to_string(),
                t.undecided_healthy.to_string(),
                t.not_applicable.to_string(),
                t.fails.to_string(),
            ]
        }),
    )
}

/// `alarms.csv`: a row for each promised property that fails, or is undecided although all angles are at least 1°.
pub fn lines(alarms: &Alarms) -> Table {
    let rows = alarms.alarms.iter().map(|a| ("fails", a)).chain(alarms.open.iter().map(|a| ("undecided", a)));
    let row = |(status, a): (&str, &AlarmLine)| {
        [
            status.to_string(),
            a.operator.clone(),
            a.property.clone(),
            a.class.clone(),
            a.recipe.clone(),
            a.says.clone(),
            a.replay.clone(),
        ]
    };
    table(["status", "operator", "property", "class", "recipe", "says", "replay"], rows.map(row))
}

/// A share as a percentage with two digits; "0" only if there is none.
pub fn share(part: usize, whole: usize) -> String {
    match (part, whole) {
        (0, _) | (_, 0) => "0".into(),
        _ => match 100.0 * part as f64 / whole as f64 {
            percent if percent < 0.01 => "< 0.01 %".into(),
            percent => format!("{percent:.2} %"),
        },
    }
}

/// What a terminal shows: totals, undecided shares by property, and each verdict that should not be.
///
/// # Errors
/// What JSON cannot say (nothing in this schema).
pub fn text(alarms: &Alarms) -> Result<String, RenderError> {
    let all = alarms.sum(|_| true);
    let mut text = format!(
        "{} domains of {} to {} vertices ({} with all angles at least 1°, {} refused), {} verdicts on promised properties\n",
        alarms.cases,
        alarms.vertices[0],
        alarms.vertices[1],
        alarms.healthy_cases,
        alarms.refused,
        all.total()
    );
    text += &format!(
        "{} false alarms, {} undecided ({}), {} undecided although all angles are at least 1°\n",
        all.fails,
        all.undecided,
        share(all.undecided, all.decidable()),
        all.undecided_healthy
    );
    let properties = alarms.distinct(|t| &t.property);
    let shares: Vec<String> = properties
        .iter()
        .map(|p| (p, alarms.sum(|t| t.property == *p)))
        .filter(|(_, t)| t.undecided > 0)
        .map(|(p, t)| format!("{p} {}", share(t.undecided, t.decidable())))
        .collect();
    if !shares.is_empty() {
        text += &format!("undecided: {}\n", shares.join(", "));
    }
    let told = alarms.alarms.iter().map(|a| ("false alarm", a)).chain(alarms.open.iter().map(|a| ("undecided", a)));
    for (word, a) in told.take(40) {
        text += &format!("{word}: {} of {}: {}\n    {}\n", a.property, a.operator, a.says, a.replay);
    }
    Ok(text + &format!("digest {}\n", alarms.digest()?))
}

/// The tallies of a property on a class, over all operators.
pub fn on(alarms: &Alarms, property: &str, class: &str) -> AlarmTally {
    alarms.sum(|t| t.property == property && t.class == class)
}
