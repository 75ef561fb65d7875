//! Certificates of equilibrium as evidence, verified again from their JSON.

use crate::domain::Surface;
use crate::laplacian::equilibrium::{self, Certificate, Decision, Lift, Net};
use crate::property::evidence::Fraction;
use crate::property::recheck::{self, Rechecked};
use crate::property::{Evidence, Excerpt, Statement};
use crate::scalar::Rational;

/// The whole mesh.
pub fn whole(surface: &Surface) -> Excerpt {
    Excerpt {
        positions: surface.positions().iter().copied().enumerate().collect(),
        faces: surface.faces().iter().map(<[usize]>::to_vec).enumerate().collect(),
        ..Excerpt::default()
    }
}

/// A certificate as evidence, with the numbers that follow from it. `None` for a mesh that has none.
pub fn evidence(surface: &Surface, certificate: &Certificate) -> Option<Evidence> {
    let (net, lift) = (Net::of(surface)?, Lift::of(surface)?);
    let listed = |edges: Vec<[usize; 2]>, numbers: &[Rational]| {
        edges.into_iter().zip(numbers.iter().map(Fraction::from)).collect::<Vec<_>>()
    };
    let statement = match certificate {
        Certificate::Heights(heights) => Statement::Lift {
            heights: heights.iter().map(Fraction::from).enumerate().collect(),
            weights: listed(lift.edges().collect(), &lift.weights(heights)),
        },
        Certificate::Weights(weights) => Statement::Equilibrium { weights: listed(net.edges().to_vec(), weights) },
        Certificate::Motion(motion) => {
            let moves = |(_, y): &(usize, &[Rational; 2])| y.iter().any(|x| *x != Rational::ZERO);
            let entry = |(v, [a, b]): (usize, &[Rational; 2])| (v, [Fraction::from(a), Fraction::from(b)]);
            Statement::Motion {
                motion: motion.iter().enumerate().filter(moves).map(entry).collect(),
                rates: listed(net.edges().to_vec(), &net.rates(motion)),
            }
        }
    };
    Some(Evidence::new(statement, whole(surface)))
}

/// A certificate that survived the recheck.
pub struct Certified {
    /// How it was found.
    pub decision: Decision,
    /// As it is written down.
    pub evidence: Evidence,
}

/// Decides a triangulation, writes the certificate as JSON, reads it back and verifies it from nothing else.
///
/// # Errors
/// Why there is no certificate, or why it was refused.
pub fn certified(surface: &Surface) -> Result<Certified, String> {
    let decision = equilibrium::decide(surface).ok_or("not a planar triangulation")?;
    let written = evidence(surface, &decision.certificate).ok_or("not a planar triangulation")?;
    let evidence = verified(&written)?;
    Ok(Certified { decision, evidence })
}

/// Evidence through its JSON and the recheck.
///
/// # Errors
/// Why it was refused.
pub fn verified(evidence: &Evidence) -> Result<Evidence, String> {
    let text = serde_json::to_string(evidence).map_err(|e| e.to_string())?;
    let read: Evidence = serde_json::from_str(&text).map_err(|e| e.to_string())?;
    match recheck::from_excerpt(&read) {
        Ok(Rechecked::Exact) => Ok(read),
        Ok(other) => Err(format!("{other:?}")),
        Err(refusal) => Err(refusal.to_string()),
    }
}
