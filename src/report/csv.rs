//! Tables as comma-separated values: the taxonomy, the cells, the domains, the claims and their tests.

use super::taxonomy::Count;
use crate::record::{AtlasFound, AtlasLine, Cell, ClaimLine, DomainLine, Index, Recheck, Record, TestLine};

/// A CSV file.
pub type Table = Result<Vec<u8>, csv::Error>;

/// `taxonomy.csv`: a row for each operator and property that has a case.
pub fn taxonomy(index: &Index) -> Table {
    let head = [
        "laplacian",
        "property",
        "verdict",
        "holds",
        "fails",
        "undecided",
        "not_applicable",
        "unexpected",
        "rechecked_exactly",
        "rechecked_bounded",
        "recheck_refused",
        "largest_margin",
    ];
    let pairs = index.laplacians.iter().flat_map(|l| index.properties.iter().map(move |p| (l, p)));
    let rows = pairs.map(|(l, p)| (l, p, Count::of(index.cells(l, p).iter().copied()))).filter(|r| r.2.total() > 0);
    table(
        head,
        rows.map(|(l, p, c)| {
            [
                l.to_string(),
                p.to_string(),
                c.word().text().to_string(),
                c.holds.to_string(),
                c.fails.to_string(),
                c.undecided.to_string(),
                c.not_applicable.to_string(),
                c.unexpected.to_string(),
                c.rechecked_exactly.to_string(),
                c.rechecked_bounded.to_string(),
                c.refused.to_string(),
                optional(c.largest_margin),
            ]
        }),
    )
}

/// `cells.csv`: a row for each verdict.
pub fn cells(record: &Record) -> Table {
    let head = [
        "domain",
        "class",
        "laplacian",
        "property",
        "status",
        "level",
        "margin",
        "violations",
        "zeros",
        "open",
        "places",
        "promised",
        "as_expected",
        "recheck",
        "replay",
    ];
    table(head, record.cells.iter().map(cell))
}

fn cell(c: &Cell) -> [String; 15] {
    let tally = c.verdict.tally.as_ref();
    [
        c.recipe.clone(),
        c.class.clone(),
        c.laplacian.clone(),
        c.property.clone(),
        c.verdict.status().to_string(),
        c.verdict.level.to_string(),
        optional(c.verdict.margin),
        optional(tally.map(|t| t.violations)),
        optional(tally.map(|t| t.zeros)),
        optional(tally.map(|t| t.undecided)),
        optional(tally.map(|t| t.total)),
        match c.promised {
            Some(true) => "holds".into(),
            Some(false) => "fails".into(),
            None => String::new(),
        },
        c.as_expected.to_string(),
        recheck(&c.recheck),
        c.replay.clone(),
    ]
}

/// What the recheck made of the evidence, in a word or with the reason of its refusal.
pub fn recheck(recheck: &Recheck) -> String {
    match recheck {
        Recheck::Exact => "exact".into(),
        Recheck::Bounded => "bounded".into(),
        Recheck::Open(why) => format!("open: {why}"),
        Recheck::Nothing => "nothing".into(),
        Recheck::Refused(why) => format!("refused: {why}"),
    }
}

/// `domains.csv`: a row for each domain.
pub fn domains(record: &Record) -> Table {
    let head = [
        "domain",
        "class",
        "kind",
        "vertices",
        "edges",
        "faces",
        "components",
        "boundary_vertices",
        "genus",
        "closed",
        "manifold",
        "planar",
        "delaunay",
        "non_delaunay_edges",
        "non_delaunay_within_rounding",
        "cocircular_edges",
        "degenerate_faces",
        "min_angle_deg",
        "max_angle_deg",
        "area",
        "digest",
        "notices",
    ];
    table(head, record.domains.iter().map(domain))
}

fn domain(d: &DomainLine) -> [String; 22] {
    let s = d.facts.surface.as_ref();
    [
        d.recipe.clone(),
        d.class.clone(),
        d.facts.kind.to_string(),
        d.facts.vertices.to_string(),
        d.facts.edges.to_string(),
        d.facts.faces.to_string(),
        d.facts.components.to_string(),
        d.facts.boundary_vertices.to_string(),
        optional(s.and_then(|s| s.genus)),
        optional(s.map(|s| s.closed)),
        optional(s.map(|s| s.manifold)),
        optional(s.map(|s| s.planar)),
        optional(s.and_then(|s| s.delaunay)),
        optional(s.and_then(|s| s.non_delaunay_edges)),
        optional(s.and_then(|s| s.non_delaunay_within_rounding)),
        optional(s.and_then(|s| s.cocircular_edges)),
        optional(s.map(|s| s.degenerate_faces)),
        optional(s.map(|s| s.min_angle_deg)),
        optional(s.map(|s| s.max_angle_deg)),
        optional(s.map(|s| s.area)),
        d.digest.clone(),
        d.notices.join("; "),
    ]
}

/// `atlas.csv`: a row for each operator and property that a small world was searched for.
pub fn atlas(record: &Record) -> Table {
    let head = [
        "laplacian",
        "property",
        "world",
        "size",
        "searched",
        "decided",
        "open",
        "silent",
        "refused",
        "level",
        "vertices",
        "faces",
        "width",
        "height",
        "recheck",
        "recipe",
    ];
    table(
        head,
        record.atlas.iter().map(|line: &AtlasLine| {
            let of = |number: fn(&AtlasFound) -> String| line.found.as_deref().map(number).unwrap_or_default();
            [
                line.laplacian.clone(),
                line.property.clone(),
                line.world.clone(),
                line.size.to_string(),
                line.searched.to_string(),
                line.decided.to_string(),
                line.open.to_string(),
                line.silent.to_string(),
                line.refused.to_string(),
                optional(line.level),
                of(|f| f.exhibit.positions.len().to_string()),
                of(|f| f.exhibit.faces.len().to_string()),
                of(|f| f.extent[0].to_string()),
                of(|f| f.extent[1].to_string()),
                of(|f| recheck(&f.cell.recheck)),
                of(|f| f.cell.recipe.clone()),
            ]
        }),
    )
}

/// `claims.csv`: a row for each claim.
pub fn claims(record: &Record) -> Table {
    let head =
        ["claim", "outcome", "expected", "as_expected", "statement", "amendment", "source", "tests", "tests_in_favour"];
    table(
        head,
        record.claims.iter().map(|c: &ClaimLine| {
            [
                c.id.clone(),
                c.outcome.to_string(),
                c.expected.to_string(),
                (!c.is_unexpected()).to_string(),
                c.statement.clone(),
                c.amendment.clone().unwrap_or_default(),
                c.source.clone(),
                c.tests.len().to_string(),
                c.tests.iter().filter(|t| t.agrees).count().to_string(),
            ]
        }),
    )
}

/// `tests.csv`: a row for each test of a claim.
pub fn tests(record: &Record) -> Table {
    let head = ["claim", "form", "question", "agrees", "decided", "open", "level", "finding", "replay"];
    let rows = record.claims.iter().flat_map(|c| c.tests.iter().map(move |t| (c, t)));
    table(
        head,
        rows.map(|(c, t): (&ClaimLine, &TestLine)| {
            [
                c.id.clone(),
                t.form.clone(),
                t.question.clone(),
                t.agrees.to_string(),
                t.decided.to_string(),
                t.open.to_string(),
                t.level.to_string(),
                t.finding.clone(),
                t.replay.clone().unwrap_or_default(),
            ]
        }),
    )
}

fn optional<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(String::new, |v| v.to_string())
}

/// A table from its head and rows.
pub(super) fn table<const N: usize>(head: [&str; N], rows: impl Iterator<Item = [String; N]>) -> Table {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(head)?;
    for row in rows {
        writer.write_record(&row)?;
    }
    writer.into_inner().map_err(|e| csv::Error::from(e.into_error()))
}
