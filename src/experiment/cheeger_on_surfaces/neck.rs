//! Dumbbells: the sweep cuts them at the neck.

use std::collections::BTreeMap;

use super::isoline::{Cut, cut, sweep};
use super::patchwork::{Boundary, Modes, Patchwork};
use super::{ENTRY, Polls, sketch};
use crate::experiment::poll::{Case, Every};
use crate::experiment::{Finding, Setting};
use crate::figure::{Axis, Chart, Figure, Mark, Series};
use crate::generate;

/// A dumbbell with its first mode and the best level set.
struct Dumbbell {
    neck: f64,
    length: f64,
    mesh: Patchwork,
    modes: Modes,
    cut: Cut,
}

/// A generated closed surface.
fn generated(id: &str, given: &[(&str, String)]) -> Option<Patchwork> {
    let given: BTreeMap<String, String> = given.iter().map(|(k, v)| (k.to_string(), v.clone())).collect();
    let domain = generate::find(id)?.run(None, &given, 0).ok()?;
    Patchwork::of(domain.as_surface()?, domain.boundary())
}

impl Dumbbell {
    fn new(levels: usize, neck: f64, length: f64) -> Option<Self> {
        let given = [("levels", levels.to_string()), ("neck", neck.to_string()), ("length", length.to_string())];
        let mesh = generated("dumbbell", &given)?;
        let modes = mesh.modes(Boundary::Closed, 1).ok()?;
        let cut = sweep(&mesh, &modes.vectors[0], Boundary::Closed)?;
        Some(Dumbbell { neck, length, mesh, modes, cut })
    }

    /// How far the cut reaches from the middle, along the axis.
    fn reach(&self) -> f64 {
        self.cut.points(&self.mesh).flatten().map(|p| p[0].abs()).fold(0.0, f64::max)
    }

    /// What speaks against the cut being one closed curve on the neck.
    fn violation(&self) -> Option<Case> {
        let (reach, curves) = (self.reach(), self.cut.curves());
        let is_on_the_neck = curves == 1 && reach <= 0.5 * self.length;
        let text = || {
            format!("neck {}, length {}: {curves} curves, as far as {reach} from the middle", self.neck, self.length)
        };
        (!is_on_the_neck).then(|| Case::told(text()))
    }

    fn row(&self) -> String {
        let (neck, length, ratio) = (self.neck, self.length, self.cut.ratio());
        let half = 0.5 * self.mesh.total();
        format!(
            "; neck {neck}, length {length}: best level set {ratio:.5} within {:.1e} of the middle, {:.4} of half the area, \
             λ₁ = {:.5}, 2√λ₁ = {:.5}",
            self.reach(),
            self.cut.area / half,
            self.modes.values[0],
            2.0 * self.modes.values[0].sqrt()
        )
    }

    /// The ratio over where the level set is, half a hundred level sets.
    fn profile(&self) -> Series {
        let u = &self.modes.vectors[0];
        let (low, high) = u.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
        let at = |k: usize| {
            let cut = cut(&self.mesh, u, low + (high - low) * k as f64 / 50.0, Boundary::Closed);
            let places: Vec<f64> = cut.points(&self.mesh).flatten().map(|p| p[0]).collect();
            [places.iter().sum::<f64>() / places.len() as f64, cut.ratio()]
        };
        let name = format!("neck {}, length {}", self.neck, self.length);
        Series::new(name, Mark::Both, (1..50).map(at).collect::<Vec<_>>())
    }
}

/// Dumbbells with several necks; all closed surfaces here are asked for the certificate too.
pub(super) fn run(setting: &Setting, polls: &mut Polls) -> Finding {
    let levels = setting.pick(1, 2);
    let necks: &[f64] = if setting.pick(0, 1) == 0 { &[0.1, 0.4] } else { &[0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6] };
    let mut every = Every::default();
    let (mut rows, mut profiles) = (String::new(), Vec::new());
    for &neck in necks {
        for length in [0.5, 2.0] {
            let Some(dumbbell) = Dumbbell::new(levels, neck, length) else {
                every.ask(Some(Case::told(format!("neck {neck}, length {length}: no eigenfunction"))));
                continue;
            };
            every.ask(dumbbell.violation());
            rows += &dumbbell.row();
            if length == 2.0 && profiles.len() < 3 {
                profiles.push(dumbbell.profile());
            }
            certify(polls, "dumbbell", &dumbbell.modes, &dumbbell.cut);
        }
    }
    for (id, given) in
        [("torus", vec![]), ("genus", vec![("genus", "2".into())]), ("genus", vec![("genus", "3".into())])]
    {
        let made = generated(id, &given).and_then(|mesh| {
            let modes = mesh.modes(Boundary::Closed, 1).ok()?;
            let cut = sweep(&mesh, &modes.vectors[0], Boundary::Closed)?;
            Some((modes, cut))
        });
        match made {
            Some((modes, cut)) => certify(polls, id, &modes, &cut),
            None => polls.certified.ask(Some(Case::told(format!("{id}: no eigenfunction")))),
        }
    }
    let part = ENTRY.parts[ENTRY.parts.len() - 1];
    let question = "Is the best level set of the first eigenfunction one closed curve on the neck?";
    let mut finding = every.answer(part, question, "dumbbells");
    finding.finding += &rows;
    finding.finding += "; an upper bound of λ_C: that no other cut is better is not shown";
    let (x, y) = (Axis::linear("place of the level set along the axis"), Axis::logarithmic("length / smaller area"));
    let title = "Level sets of the first eigenfunction of dumbbells".to_string();
    finding.figures.push(Figure::Chart(Chart { title, x, y, series: profiles }));
    finding.figures.extend(drawn());
    finding
}

fn certify(polls: &mut Polls, name: &str, modes: &Modes, cut: &Cut) {
    polls.certify(name, cut, modes.values[0], modes.error, modes.certified);
}

fn drawn() -> Option<Figure> {
    let dumbbell = Dumbbell::new(0, 0.25, 1.0)?;
    let title = format!("Dumbbell: the first eigenfunction and its best level set, {:.4}", dumbbell.cut.ratio());
    Some(Figure::Sketch(sketch(title, &dumbbell.mesh, &dumbbell.modes.vectors[0], &dumbbell.cut)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cut_of_a_dumbbell_has_the_length_of_its_neck_and_halves_it() {
        let dumbbell = Dumbbell::new(1, 0.2, 1.0).unwrap();
        assert!(dumbbell.violation().is_none());
        // A regular polygon of sixteen sides in a circle of radius 0.2.
        let polygon = 16.0 * 2.0 * 0.2 * (std::f64::consts::PI / 16.0).sin();
        assert!((dumbbell.cut.length / polygon - 1.0).abs() < 1e-6, "{}", dumbbell.cut.length);
        assert!((2.0 * dumbbell.cut.area / dumbbell.mesh.total() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_cut_elsewhere_and_a_cut_in_several_curves_are_noticed() {
        let mut dumbbell = Dumbbell::new(1, 0.2, 1.0).unwrap();
        let along = |f: fn(&[f64; 3]) -> f64, d: &Dumbbell| d.mesh.positions.iter().map(f).collect::<Vec<f64>>();
        // Across: from pole to pole.
        let y = along(|p| p[1], &dumbbell);
        dumbbell.cut = sweep(&dumbbell.mesh, &y, Boundary::Closed).unwrap();
        assert!(dumbbell.violation().is_some());
        // Around one of the spheres.
        let x = along(|p| p[0], &dumbbell);
        dumbbell.cut = cut(&dumbbell.mesh, &x, 1.0, Boundary::Closed);
        assert!(dumbbell.violation().is_some());
        // Around both ends of the neck.
        let both = along(|p| p[0].abs(), &dumbbell);
        dumbbell.cut = cut(&dumbbell.mesh, &both, 0.3, Boundary::Closed);
        assert!(dumbbell.reach() <= 0.5 && dumbbell.violation().is_some());
    }
}
