//! Comparing the operators that a construction makes of related domains.
//!
//! An entry of row i is measured by the thresholds of the row ([`rounding`](crate::property::measure::rounding)), the larger of those on the two
//! domains, with the displacement of vertices by rounded coordinates, relative to the larger of the two row scales. A
//! mass is quadratic in lengths and may cancel (Voronoi areas): its scale is the largest row near i, times Q².
//!
//! Rows where rounding would explain more than [`LARGEST_EXPLAINED`] of the scale — beside slivers at the limit of `f64`, or
//! degenerate faces that rounded coordinates may have turned into proper ones — cannot be compared and are counted.

use super::image::Image;
use crate::linalg::Csr;
use crate::operator::Operator;
use crate::property::tolerance::Threshold;
use crate::property::{Construction, Evidence, Level, Statement, Trial, Verdict, evidence::Which};

/// Where rounding explains a thousandth of the scale, agreement says nothing.
const LARGEST_EXPLAINED: f64 = 1.0 / 1024.0;

/// The largest difference found, over its threshold.
struct Difference {
    /// Over what rounding explains.
    margin: f64,
    /// Over what only a defect explains.
    severity: f64,
    statement: Statement,
}

/// What comparing came to so far.
#[derive(Default)]
struct Tally {
    entries: usize,
    left_out: usize,
    rows: usize,
    worst: Option<Difference>,
    strange: Option<String>,
}

/// Decides whether the construction respects every image; a refusal makes the relation not applicable.
pub(crate) fn decide(trial: &Trial, construction: &Construction, images: Vec<Image>) -> Verdict {
    let mut tally = Tally::default();
    let mut transformations = Vec::new();
    for image in images {
        let after = match construction(&image.domain) {
            Ok(after) => after,
            Err(why) => {
                return Verdict::not_applicable(format!(
                    "the construction refuses the domain after {}: {why}",
                    image.words
                ));
            }
        };
        if after.size() != image.domain.vertex_count() {
            return Verdict::not_applicable(format!(
                "after {} the construction has {} rows for {} vertices",
                image.words,
                after.size(),
                image.domain.vertex_count()
            ));
        }
        if after.mass().is_some() != trial.operator.mass().is_some() {
            return Verdict::not_applicable(format!("after {} only one of the operators has a mass", image.words));
        }
        tally.compare(trial, &image, &after);
        transformations.push(image.words);
    }
    tally.verdict(transformations)
}

impl Tally {
    fn compare(&mut self, trial: &Trial, image: &Image, after: &Operator) {
        let original = trial.rounding();
        let Ok(transformed) = Trial::new(&image.domain, after, trial.seed) else { return };
        let transformed = transformed.rounding();
        let n = trial.operator.size();
        let displaced = image.displaced;
        for place in &image.places {
            let mut back = vec![None; image.domain.vertex_count()];
            place.iter().enumerate().for_each(|(i, &p)| back[p] = Some(i));
            let relative = |i: usize| {
                let own = original.row_displaced(i, displaced);
                // Lengths on the image are to those of the original as the root of the mass factors.
                own.max(transformed.row_displaced(place[i], displaced * length_factor(image)))
            };
            let pairing = Pairing { image, place, back: &back };
            let (before, now) = (trial.operator.stiffness(), after.stiffness());
            let scales = (before.row_scales(), now.row_scales());
            for i in (0..n).filter(|&i| image.rows.as_ref().is_none_or(|rows| rows[i])) {
                let scale = scales.0[i].max(scales.1[place[i]] / image.stiffness);
                self.row(&pairing, Which::Stiffness, (before, now), i, relative(i), scale);
            }
            let (Some(before), Some(now)) = (trial.operator.mass(), after.mass()) else { continue };
            let (before, now) = (before.matrix(), now.matrix());
            let scales = (before.row_scales(), now.row_scales());
            let stiffness = trial.operator.stiffness();
            for i in (0..n).filter(|&i| image.rows.as_ref().is_none_or(|rows| rows[i])) {
                let near = |k: usize| scales.0[k].max(scales.1[place[k]] / image.mass);
                let scale = stiffness.row(i).map(|(k, _)| near(k)).fold(near(i), f64::max);
                let quality = original.quality(i).max(transformed.quality(place[i])).powi(2);
                self.row(&pairing, Which::Mass, (before, now), i, relative(i).times(quality), scale);
            }
        }
    }

    fn row(
        &mut self,
        pairing: &Pairing,
        matrix: Which,
        (before, now): (&Csr, &Csr),
        i: usize,
        relative: Threshold,
        scale: f64,
    ) {
        self.rows += 1;
        if relative.explained.is_nan() || relative.explained > LARGEST_EXPLAINED {
            self.left_out += 1;
            return;
        }
        let threshold = relative.defect * scale;
        for (j, was, is) in pairing.entries(matrix, before, now, i) {
            self.entries += 1;
            let difference = (is - was).abs();
            if !difference.is_finite() {
                let words = &pairing.image.words;
                self.strange.get_or_insert(format!("after {words} entry ({i}, {j}) is not finite"));
                continue;
            }
            let over = |limit: f64| if difference == 0.0 { 0.0 } else { difference / (limit * scale) };
            let (margin, severity) = (over(relative.explained), over(relative.defect));
            let key = |margin: f64, severity: f64| (if severity > 1.0 { severity } else { 0.0 }, margin);
            if self.worst.as_ref().is_none_or(|w| key(margin, severity) > key(w.margin, w.severity)) {
                let transformation = pairing.image.words.clone();
                let statement = Statement::Changed { transformation, matrix, i, j, before: was, after: is, threshold };
                self.worst = Some(Difference { margin, severity, statement });
            }
        }
    }

    fn verdict(self, transformations: Vec<String>) -> Verdict {
        if let Some(strange) = self.strange {
            return Verdict::undecided(strange);
        }
        let note = (self.left_out > 0)
            .then(|| format!("{} of {} rows are too ill-conditioned to compare", self.left_out, self.rows));
        let margin = self.worst.as_ref().map_or(0.0, |w| w.margin);
        let verdict = match self.worst {
            Some(worst) if worst.severity > 1.0 => {
                Verdict::fails(Level::Measured, Evidence::bare(worst.statement)).with_margin(worst.severity)
            }
            Some(worst) if margin > 1.0 => {
                let place = match worst.statement {
                    Statement::Changed { i, j, before, after, .. } => {
                        format!("({i}, {j}): {before:e} became {after:e}")
                    }
                    _ => String::new(),
                };
                Verdict::undecided(format!("entry {place}, {margin:.1} times what rounding explains"))
            }
            None if self.left_out > 0 || self.rows == 0 => {
                Verdict::not_applicable("no row is conditioned well enough to be compared")
            }
            _ => {
                let level = if margin == 0.0 { Level::Exact } else { Level::Measured };
                let statement = Statement::Compared { transformations, entries: self.entries };
                Verdict::holds(level, Evidence::bare(statement)).with_margin(margin)
            }
        };
        match note {
            Some(note) => verdict.with_note(note),
            None => verdict,
        }
    }
}

/// The factor of lengths: a mass on a surface has the units of an area.
fn length_factor(image: &Image) -> f64 {
    if image.mass == image.stiffness { 1.0 } else { (image.mass / image.stiffness).sqrt() }
}

/// Entries of the original paired with those of the image.
struct Pairing<'a> {
    image: &'a Image,
    place: &'a [usize],
    back: &'a [Option<usize>],
}

impl Pairing<'_> {
    /// `(column, before, after)` for every place of row i where either matrix stores an entry, the image brought back to the
    /// numbering and scale of the original. A column of the image that is no vertex of this copy keeps its number there; it
    /// should be empty.
    fn entries(&self, matrix: Which, before: &Csr, now: &Csr, i: usize) -> Vec<(usize, f64, f64)> {
        let factor = if matrix == Which::Stiffness { self.image.stiffness } else { self.image.mass };
        let row = self.place[i];
        let mut list: Vec<_> = before.row(i).map(|(j, v)| (j, *v, now.at(row, self.place[j]) / factor)).collect();
        for (column, &v) in now.row(row) {
            match self.back[column] {
                Some(j) if before.get(i, j).is_some() => {}
                Some(j) => list.push((j, 0.0, v / factor)),
                None => list.push((column, 0.0, v / factor)),
            }
        }
        list
    }
}
