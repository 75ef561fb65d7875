//! Reading excerpts, and holding them against what they were copied from.

use std::collections::BTreeSet;

use super::Refusal;
use crate::domain::{Domain, LARGEST_COORDINATE};
use crate::linalg::Csr;
use crate::operator::Operator;
use crate::property::evidence::{Excerpt, Row, Statement};

/// A row: stored entries, columns ascending.
pub(super) type Entries<'a> = &'a [(usize, f64)];

/// Things by number. Where all numbers are there, a number is its own place.
struct Numbered<T>(Vec<(usize, T)>);

impl<T: Copy> Numbered<T> {
    /// Sorts by number; the error is a number that occurs twice.
    fn new(mut things: Vec<(usize, T)>) -> Result<Self, usize> {
        things.sort_by_key(|t| t.0);
        match things.windows(2).find(|w| w[0].0 == w[1].0) {
            Some(w) => Err(w[0].0),
            None => Ok(Numbered(things)),
        }
    }

    fn get(&self, number: usize) -> Option<T> {
        if let Some(thing) = self.0.get(number).filter(|t| t.0 == number) {
            return Some(thing.1);
        }
        self.0.binary_search_by_key(&number, |t| t.0).ok().map(|at| self.0[at].1)
    }
}

/// Rows of one of the two matrices, by number.
pub(super) struct Rows<'a> {
    what: &'static str,
    rows: Numbered<Entries<'a>>,
}

impl<'a> Rows<'a> {
    fn read(what: &'static str, rows: &'a [Row]) -> Result<Self, Refusal> {
        for row in rows {
            let malformed = |problem| Refusal::Malformed { what, index: row.row, problem };
            if row.entries.windows(2).any(|w| w[0].0 >= w[1].0) {
                return Err(malformed("has columns that do not ascend"));
            }
            if row.entries.iter().any(|(_, v)| !v.is_finite()) {
                return Err(malformed("has an entry that is not finite"));
            }
        }
        match Numbered::new(rows.iter().map(|r| (r.row, r.entries.as_slice())).collect()) {
            Ok(rows) => Ok(Rows { what, rows }),
            Err(index) => Err(Refusal::Malformed { what, index, problem: "is given twice" }),
        }
    }

    /// Row `i`.
    pub fn row(&self, i: usize) -> Result<Entries<'a>, Refusal> {
        self.rows.get(i).ok_or(Refusal::Missing { what: self.what, index: i })
    }

    /// The entry `(i, j)`, zero where nothing is stored.
    pub fn entry(&self, i: usize, j: usize) -> Result<f64, Refusal> {
        let row = self.row(i)?;
        Ok(row.binary_search_by_key(&j, |e| e.0).map_or(0.0, |at| row[at].1))
    }

    /// All rows, ascending.
    pub fn iter(&self) -> impl Iterator<Item = (usize, Entries<'a>)> + '_ {
        self.rows.0.iter().copied()
    }

    /// Whether row `i` is there.
    pub fn contains(&self, i: usize) -> bool {
        self.rows.get(i).is_some()
    }

    /// How many rows there are.
    pub fn len(&self) -> usize {
        self.rows.0.len()
    }

    /// Refuses a non-zero entry in a column that has no row and is not excused.
    pub fn check_closed(&self, excused: impl Fn(usize) -> bool) -> Result<(), Refusal> {
        let columns = self.rows.0.iter().flat_map(|r| r.1).filter(|e| e.1 != 0.0).map(|e| e.0);
        match columns.into_iter().find(|&j| !self.contains(j) && !excused(j)) {
            Some(index) => Err(Refusal::Missing { what: self.what, index }),
            None => Ok(()),
        }
    }
}

/// An excerpt that was read and found to be well formed.
pub(super) struct Material<'a> {
    /// Rows of the stiffness matrix.
    pub rows: Rows<'a>,
    /// Rows of the mass matrix.
    pub mass: Rows<'a>,
    /// Faces with their numbers.
    pub faces: &'a [(usize, Vec<usize>)],
    /// Edges.
    pub edges: &'a [[usize; 2]],
    positions: Numbered<[f64; 3]>,
}

impl<'a> Material<'a> {
    /// Reads an excerpt.
    pub fn read(excerpt: &'a Excerpt) -> Result<Self, Refusal> {
        for &(index, p) in &excerpt.positions {
            if p.iter().any(|x| !x.is_finite() || x.abs() > LARGEST_COORDINATE) {
                return Err(Refusal::Malformed { what: "position", index, problem: "has a coordinate out of range" });
            }
        }
        let positions = Numbered::new(excerpt.positions.clone()).map_err(|index| Refusal::Malformed {
            what: "position",
            index,
            problem: "is given twice",
        })?;
        let mut numbers = BTreeSet::new();
        for (index, corners) in &excerpt.faces {
            let malformed = |problem| Refusal::Malformed { what: "face", index: *index, problem };
            if !numbers.insert(*index) {
                return Err(malformed("is given twice"));
            }
            if corners.len() < 3 {
                return Err(malformed("has fewer than three corners"));
            }
            let mut sorted = corners.clone();
            sorted.sort_unstable();
            if sorted.windows(2).any(|w| w[0] == w[1]) {
                return Err(malformed("names a corner twice"));
            }
        }
        let mut seen = BTreeSet::new();
        for (index, &[a, b]) in excerpt.edges.iter().enumerate() {
            let malformed = |problem| Refusal::Malformed { what: "edge", index, problem };
            if a == b {
                return Err(malformed("has the same vertex at both ends"));
            }
            if !seen.insert([a.min(b), a.max(b)]) {
                return Err(malformed("is given twice"));
            }
        }
        Ok(Material {
            rows: Rows::read("row", &excerpt.rows)?,
            mass: Rows::read("mass row", &excerpt.mass_rows)?,
            faces: &excerpt.faces,
            edges: &excerpt.edges,
            positions,
        })
    }

    /// The position of a vertex.
    pub fn position(&self, vertex: usize) -> Result<[f64; 3], Refusal> {
        self.positions.get(vertex).ok_or(Refusal::Missing { what: "position", index: vertex })
    }

    /// Whether there is neither a face nor an edge.
    pub fn has_no_mesh(&self) -> bool {
        self.faces.is_empty() && self.edges.is_empty()
    }

    /// Whether the lists that a statement about everything needs were left out.
    pub fn is_partial(&self, statement: &Statement) -> bool {
        match statement {
            Statement::Energy { .. } => self.rows.len() == 0 || self.faces.is_empty(),
            Statement::MassTotal { .. } => self.mass.len() == 0 || self.faces.is_empty(),
            Statement::HeatLoss { .. } => self.rows.len() == 0 || self.mass.len() == 0,
            _ => self.rows.len() == 0,
        }
    }
}

/// Everything there is, as an excerpt.
pub(super) fn whole(domain: &Domain, operator: &Operator) -> Excerpt {
    let surface = domain.as_surface();
    Excerpt {
        rows: all_rows(operator.stiffness()),
        mass_rows: operator.mass().map_or_else(Vec::new, |m| all_rows(m.matrix())),
        positions: domain.positions().unwrap_or(&[]).iter().copied().enumerate().collect(),
        faces: surface.map_or_else(Vec::new, |s| s.faces().iter().map(<[usize]>::to_vec).enumerate().collect()),
        edges: if surface.is_some() { Vec::new() } else { domain.edges().to_vec() },
    }
}

fn all_rows(matrix: &Csr) -> Vec<Row> {
    (0..matrix.rows()).map(|i| Row { row: i, entries: matrix.row(i).map(|(j, v)| (j, *v)).collect() }).collect()
}

/// Refuses an excerpt that differs from operator or domain in any bit.
pub(super) fn check_copy(excerpt: &Excerpt, domain: &Domain, operator: &Operator) -> Result<(), Refusal> {
    excerpt.rows.iter().try_for_each(|r| check_row("row", r, Some(operator.stiffness())))?;
    let mass = operator.mass().map(|m| m.matrix());
    excerpt.mass_rows.iter().try_for_each(|r| check_row("mass row", r, mass))?;
    for &(index, p) in &excerpt.positions {
        let actual = domain.positions().and_then(|all| all.get(index));
        let same = actual.is_some_and(|a| a.iter().zip(&p).all(|(x, y)| x.to_bits() == y.to_bits()));
        if !same {
            return Err(not_copied("position", index, &p, &actual));
        }
    }
    for (index, corners) in &excerpt.faces {
        let actual = domain.as_surface().and_then(|s| s.faces().get(*index));
        if actual != Some(corners) {
            return Err(not_copied("face", *index, corners, &actual));
        }
    }
    for (index, &[a, b]) in excerpt.edges.iter().enumerate() {
        if domain.edges().binary_search(&[a.min(b), a.max(b)]).is_err() {
            return Err(not_copied("edge", index, &[a, b], &None::<usize>));
        }
    }
    Ok(())
}

fn check_row(what: &'static str, row: &Row, matrix: Option<&Csr>) -> Result<(), Refusal> {
    let Some(matrix) = matrix.filter(|m| row.row < m.rows()) else {
        return Err(not_copied(what, row.row, &row.entries, &None::<usize>));
    };
    let actual = matrix.row(row.row);
    let same = actual.len() == row.entries.len()
        && actual.clone().zip(&row.entries).all(|((j, v), (k, w))| j == *k && v.to_bits() == w.to_bits());
    if same { Ok(()) } else { Err(not_copied(what, row.row, &row.entries, &actual.collect::<Vec<_>>())) }
}

fn not_copied(
    what: &'static str,
    index: usize,
    copied: &impl std::fmt::Debug,
    actual: &impl std::fmt::Debug,
) -> Refusal {
    Refusal::NotCopied { what, index, copied: format!("{copied:?}"), actual: format!("{actual:?}") }
}

/// Refuses an excerpt that leaves out part of the star, of the edge or of the triangulation of which its statement speaks.
pub(super) fn check_whole(statement: &Statement, excerpt: &Excerpt, domain: &Domain) -> Result<(), Refusal> {
    let n = domain.vertex_count();
    let in_range = |v: usize| if v < n { Ok(()) } else { Err(Refusal::Missing { what: "vertex", index: v }) };
    match *statement {
        Statement::FarEntry { i, j, .. } => {
            in_range(i).and(in_range(j))?;
            check_star(i, excerpt, domain)
        }
        Statement::MassShare { i, .. } => {
            in_range(i)?;
            check_star(i, excerpt, domain)
        }
        Statement::Weight { i, j, .. } | Statement::Inaccurate { i, j, .. } => {
            in_range(i).and(in_range(j))?;
            let Some(surface) = domain.as_surface() else { return Ok(()) };
            let sides = surface.topology().edge_between(i, j).map_or(&[][..], |e| surface.topology().sides(e));
            check_faces(sides.iter().map(|s| s.face()), excerpt)
        }
        Statement::Lift { .. }
        | Statement::Equilibrium { .. }
        | Statement::Motion { .. }
        | Statement::NoLift { .. }
        | Statement::FlipsToDelaunay { .. }
        | Statement::PositiveExtension { .. }
        | Statement::NotEmbedded { .. }
        | Statement::DelaunayEigenvalue { .. } => {
            // Those that are there were found to be faces of the domain, each once.
            let (there, all) = (excerpt.faces.len(), domain.as_surface().map_or(0, |s| s.faces().len()));
            if there == all {
                Ok(())
            } else {
                Err(Refusal::Missing { what: "every face, of which there are", index: all })
            }
        }
        _ => Ok(()),
    }
}

fn check_star(vertex: usize, excerpt: &Excerpt, domain: &Domain) -> Result<(), Refusal> {
    if let Some(surface) = domain.as_surface() {
        return check_faces(surface.topology().star(vertex).iter().map(|c| c.face()), excerpt);
    }
    let at_vertex = |e: &&[usize; 2]| e.contains(&vertex);
    if excerpt.edges.iter().filter(at_vertex).count() == domain.edges().iter().filter(at_vertex).count() {
        return Ok(());
    }
    Err(Refusal::Missing { what: "every edge at vertex", index: vertex })
}

fn check_faces(needed: impl Iterator<Item = usize>, excerpt: &Excerpt) -> Result<(), Refusal> {
    for index in needed {
        if !excerpt.faces.iter().any(|f| f.0 == index) {
            return Err(Refusal::Missing { what: "face", index });
        }
    }
    Ok(())
}
