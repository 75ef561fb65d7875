//! The weak problem against the strong operator: `L` and the consistent `M` are symmetric and local, `M⁻¹L` is neither.

use std::cmp::Ordering;

use super::poll::{Case, Every, Search};
use super::world::excerpt::on_triangulation;
use super::world::triangulations::{Triangulation, describe_world, doubled_area, world};
use super::{Experiment, Finding, Setting};
use crate::laplacian::cotan::stiffness_in_plane;
use crate::linalg::Dense;
use crate::property::Statement;
use crate::scalar::{Rational, Scalar};

/// The catalogue entry.
pub static ENTRY: Experiment = Experiment {
    id: "weak-and-strong",
    name: "The weak cotangent problem and its strong matrices",
    statement: "the cotangent stiffness L is symmetric, local and positive semi-definite, the consistent mass M symmetric, \
                local and positive definite; with the barycentric mass M⁻¹L is local; with the consistent one it is in \
                general neither symmetric nor local",
    sources: &["wardetzky-primer", "wardetzky2007"],
    parts: &[
        "weak-matrices-are-symmetric-psd",
        "weak-matrices-are-local",
        "lumped-strong-matrix-is-local",
        "consistent-strong-matrix-is-not-symmetric",
        "consistent-strong-matrix-is-not-local",
    ],
    run,
};

fn run(setting: &Setting) -> Vec<Finding> {
    let largest = setting.pick(4, 5);
    let (mut definite, mut local, mut lumped) = (Every::default(), Every::default(), Every::default());
    let (mut asymmetric, mut far) = (Search::default(), Search::default());
    for t in world(largest) {
        let Some(l) = stiffness_in_plane::<Rational>(&t.surface()).map(|l| Dense::from_csr(&l)) else {
            definite.ask(Some(Case::told(format!("no cotangent stiffness on {}", t.describe()))));
            continue;
        };
        let m = consistent_mass(&t);
        definite.ask(not_a_weak_problem(&t, &l, &m));
        local.ask(far_entry(&t, &l, "L").or_else(|| far_entry(&t, &m, "M")));
        lumped.ask(far_entry(&t, &strong(&l, &barycentric(&m)), "M⁻¹L"));
        let strong = m.solve(&l).unwrap_or_else(|| m.clone());
        asymmetric.ask(asymmetry(&t, &strong));
        far.ask(far_entry(&t, &strong, "M⁻¹L"));
    }
    let cases = describe_world(largest);
    let question = |text: &str| format!("{text} Cases: {cases}.");
    vec![
        definite.answer(
            "weak-matrices-are-symmetric-psd",
            question(
                "Are L and M symmetric, L positive semi-definite with the constants as kernel, M positive definite?",
            ),
            "triangulations",
        ),
        local.answer(
            "weak-matrices-are-local",
            question("Do entries of L and M vanish where no triangle contains both vertices?"),
            "triangulations",
        ),
        lumped.answer(
            "lumped-strong-matrix-is-local",
            question("Does the same hold for M⁻¹L with the barycentric mass?"),
            "triangulations",
        ),
        asymmetric.answer(
            "consistent-strong-matrix-is-not-symmetric",
            question("Is M⁻¹L with the consistent mass asymmetric somewhere?"),
            "triangulations",
        ),
        far.answer(
            "consistent-strong-matrix-is-not-local",
            question("Has M⁻¹L with the consistent mass an entry for two vertices without a common triangle?"),
            "triangulations",
        ),
    ]
}

/// The mass matrix of linear elements: each triangle of area A adds A/6 on the diagonal and A/12 off it.
fn consistent_mass(t: &Triangulation) -> Dense<Rational> {
    let n = t.points().len();
    let mut m = Dense::from_fn(n, n, |_, _| Rational::zero());
    for f in t.faces() {
        let [a, b, c] = f.map(|v| t.points()[v]);
        for (&i, &j) in f.iter().flat_map(|i| f.iter().map(move |j| (i, j))) {
            let share: u8 = if i == j { 12 } else { 24 };
            m.add_to(i, j, Rational::from_parts(doubled_area(a, b, c).into(), share.into()));
        }
    }
    m
}

/// The row sums of the consistent mass: a third of the area around each vertex.
fn barycentric(m: &Dense<Rational>) -> Vec<Rational> {
    m.mul(&vec![Rational::ONE; m.rows()])
}

fn strong(l: &Dense<Rational>, mass: &[Rational]) -> Dense<Rational> {
    Dense::from_fn(l.rows(), l.rows(), |i, j| (l.at(i, j).clone() / mass[i].clone()).reduced())
}

fn not_a_weak_problem(t: &Triangulation, l: &Dense<Rational>, m: &Dense<Rational>) -> Option<Case> {
    let problem = if let Some([i, j]) = l.asymmetry() {
        format!("L_{i}{j} ≠ L_{j}{i}")
    } else if let Some([i, j]) = m.asymmetry() {
        format!("M_{i}{j} ≠ M_{j}{i}")
    } else {
        let (stiffness, mass) = (l.eliminate(), m.eliminate());
        let kernel = stiffness.kernel();
        if !stiffness.is_semidefinite() {
            "L has a negative eigenvalue".to_string()
        } else if kernel.len() != 1 || kernel[0].iter().any(|v| *v != kernel[0][0]) {
            format!("the kernel of L has dimension {}", kernel.len())
        } else if !mass.is_definite() {
            "M is not positive definite".to_string()
        } else {
            return None;
        }
    };
    Some(Case::told(format!("{problem} on {}", t.describe())))
}

fn asymmetry(t: &Triangulation, a: &Dense<Rational>) -> Option<Case> {
    let [i, j] = a.asymmetry()?;
    let text = format!("entry ({i}, {j}) is {}, entry ({j}, {i}) is {} on {}", a.at(i, j), a.at(j, i), t.describe());
    let statement = Statement::Asymmetry { i, j, threshold: 0.0 };
    Some(Case::shown(text, on_triangulation(statement, t, a, &[i, j])))
}

/// The first entry for two vertices that no triangle contains both.
fn far_entry(t: &Triangulation, a: &Dense<Rational>, name: &str) -> Option<Case> {
    let together = |i: usize, j: usize| t.faces().iter().any(|f| f.contains(&i) && f.contains(&j));
    let places = (0..a.rows()).flat_map(|i| (0..a.columns()).map(move |j| (i, j)));
    let (i, j) =
        places.into_iter().find(|&(i, j)| i != j && a.at(i, j).cmp_zero() != Ordering::Equal && !together(i, j))?;
    let statement = Statement::FarEntry { i, j, rings: rings(t, i, j) };
    let text = format!("entry ({i}, {j}) of {name} is {} on {}", a.at(i, j), t.describe());
    Some(Case::shown(text, on_triangulation(statement, t, a, &[i])))
}

/// The graph distance between two vertices.
fn rings(t: &Triangulation, i: usize, j: usize) -> Option<usize> {
    let mut reached = vec![i];
    (0..t.points().len()).find(|_| {
        let found = reached.contains(&j);
        let next: Vec<usize> = reached.iter().flat_map(|&v| t.neighbours(v)).collect();
        reached.extend(next);
        found
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::world::triangulations::triangulations;

    fn square() -> Triangulation {
        triangulations(&[[0, 0], [1, 0], [1, 1], [0, 1]]).remove(0)
    }

    fn stiffness(t: &Triangulation) -> Dense<Rational> {
        Dense::from_csr(&stiffness_in_plane(&t.surface()).unwrap())
    }

    #[test]
    fn the_consistent_mass_of_the_right_triangle_is_the_textbook_one() {
        let t = triangulations(&[[0, 0], [1, 0], [0, 1]]).remove(0);
        let expected = |i, j| Rational::from_parts(1.into(), if i == j { 12u8 } else { 24u8 }.into());
        assert_eq!(consistent_mass(&t), Dense::from_fn(3, 3, expected));
    }

    #[test]
    fn a_negative_mass_a_wrong_stiffness_and_a_wrong_sign_are_found() {
        let (t, l, m) = (square(), stiffness(&square()), consistent_mass(&square()));
        assert!(not_a_weak_problem(&t, &l, &m).is_none());
        let minus = |a: &Dense<Rational>| Dense::from_fn(4, 4, |i, j| -a.at(i, j).clone());
        assert!(not_a_weak_problem(&t, &minus(&l), &m).is_some());
        assert!(not_a_weak_problem(&t, &l, &minus(&m)).is_some());
        let mut lopsided = l.clone();
        lopsided.add_to(0, 1, Rational::ONE);
        assert!(not_a_weak_problem(&t, &lopsided, &m).is_some());
        let mut heavy = l.clone();
        heavy.add_to(0, 0, Rational::ONE);
        assert!(not_a_weak_problem(&t, &heavy, &m).is_some(), "the constants are no longer in the kernel");
    }

    #[test]
    fn a_far_entry_is_found_with_its_distance() {
        let t = square();
        let [far] = (0..4)
            .flat_map(|i| (i + 1..4).map(move |j| [i, j]))
            .filter(|e| rings(&t, e[0], e[1]) == Some(2))
            .collect::<Vec<_>>()[..]
        else {
            panic!("one pair of corners is not joined")
        };
        let mut l = stiffness(&t);
        assert!(far_entry(&t, &l, "L").is_none());
        l.add_to(far[0], far[1], Rational::ONE);
        let found = far_entry(&t, &l, "L").unwrap();
        assert_eq!(found.evidence[0].statement, Statement::FarEntry { i: far[0], j: far[1], rings: Some(2) });
    }
}
