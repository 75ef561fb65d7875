//! Which statements decide which property, and how much of the matrix each speaks of.

use super::Refusal;
use crate::property::evidence::Statement;

/// The properties whose predicates this module knows.
const KNOWN: &[&str] = &[
    "FIN",
    "LOC",
    "SYM",
    "NULL",
    "KER",
    "POS",
    "POS0",
    "POS-boundary",
    "PSD",
    "LIN",
    "FLUX",
    "ENERGY",
    "ACC",
    "MVP",
    "MASS",
    "MAX-local",
    "MAX-global",
    "MAX-heat",
    "PERM",
    "RIGID",
    "SCALE",
    "ISO",
    "REACH",
    "UNION",
];

/// Relations between constructions.
const RELATIONS: &[&str] = &["PERM", "RIGID", "SCALE", "ISO", "REACH", "UNION"];

/// Name of a kind, whether it is a witness, and the properties that it decides.
fn describe(statement: &Statement) -> (&'static str, bool, &'static [&'static str]) {
    match statement {
        Statement::NotFinite { .. } => ("not-finite", true, &["FIN", "MASS"]),
        Statement::FarEntry { .. } => ("far-entry", true, &["LOC", "KER"]),
        Statement::Asymmetry { .. } => ("asymmetry", true, &["SYM"]),
        Statement::RowSum { .. } => ("row-sum", true, &["NULL", "KER", "MVP"]),
        Statement::KernelVector { .. } => ("kernel-vector", true, &["KER"]),
        Statement::Weight { .. } => ("weight", true, &["POS", "POS0", "POS-boundary"]),
        Statement::NegativeEnergy { .. } => ("negative-energy", true, &["PSD"]),
        Statement::Moment { boundary: None, .. } => ("moment", true, &["LIN"]),
        Statement::Moment { .. } => ("moment", true, &["FLUX"]),
        Statement::Energy { .. } => ("energy", true, &["ENERGY"]),
        Statement::Inaccurate { .. } => ("inaccurate", true, &["ACC"]),
        Statement::BothSigns { .. } => ("both-signs", true, &["MAX-local"]),
        Statement::NoWeight { .. } => ("no-weight", true, &["MAX-local"]),
        Statement::NotConvex { .. } => ("not-convex", true, &["MVP"]),
        Statement::Overshoot { .. } => ("overshoot", true, &["MAX-global"]),
        Statement::Singular { .. } => ("singular", true, &["MAX-global"]),
        Statement::HeatLoss { .. } => ("heat-loss", true, &["MAX-heat"]),
        Statement::MassTotal { .. } => ("mass-total", true, &["MASS"]),
        Statement::MassAsymmetry { .. } => ("mass-asymmetry", true, &["MASS"]),
        Statement::MassNotPositive { .. } => ("mass-not-positive", true, &["MASS"]),
        Statement::MassShare { .. } => ("mass-share", true, &["MASS"]),
        Statement::Changed { .. } => ("changed", true, RELATIONS),
        Statement::BelowCheeger { .. } => ("below-cheeger", true, &[]),
        Statement::Lift { .. } => ("lift", true, &[]),
        Statement::Equilibrium { .. } => ("equilibrium", true, &[]),
        Statement::Motion { .. } => ("motion", true, &[]),
        Statement::NoLift { .. } => ("no-lift", true, &[]),
        Statement::Scan { .. } => (
            "scan",
            false,
            &[
                "FIN",
                "LOC",
                "SYM",
                "NULL",
                "POS",
                "POS0",
                "POS-boundary",
                "LIN",
                "FLUX",
                "ENERGY",
                "ACC",
                "MVP",
                "MASS",
                "MAX-local",
            ],
        ),
        Statement::SumOfSquares => ("sum-of-squares", false, &["PSD"]),
        Statement::ShiftedFactor { .. } => ("shifted-factor", false, &["PSD"]),
        Statement::InertiaCount { .. } => ("inertia-count", false, &["KER"]),
        Statement::ClosedClasses { .. } => ("closed-classes", false, &["KER"]),
        Statement::SingularValues { .. } => ("singular-values", false, &["KER"]),
        Statement::SignPattern { .. } => ("sign-pattern", false, &["MAX-global", "MAX-heat"]),
        Statement::Solved { .. } => ("solved", false, &["MAX-global", "MAX-heat"]),
        Statement::Compared { .. } => ("compared", false, RELATIONS),
        Statement::FlipsToDelaunay { .. } => ("flips-to-delaunay", false, &[]),
        Statement::DelaunayNotMinimal { .. } => ("delaunay-not-minimal", true, &[]),
        Statement::PositiveExtension { .. } => ("positive-extension", false, &[]),
        Statement::NotEmbedded { .. } => ("not-embedded", true, &[]),
        Statement::TorusFlips { .. } => ("torus-flips", false, &[]),
        Statement::Cospectral { .. } => ("cospectral", false, &[]),
        Statement::Transplantation { .. } => ("transplantation", false, &[]),
        Statement::SpectraDiffer { .. } => ("spectra-differ", true, &[]),
        Statement::DelaunayEigenvalue { .. } => ("delaunay-eigenvalue", true, &[]),
        Statement::HarmonicForm { .. } => ("harmonic-form", true, &[]),
    }
}

/// The kind of a statement as JSON calls it.
pub(super) fn kind(statement: &Statement) -> &'static str {
    describe(statement).0
}

/// Whether it shows that a property fails.
pub(super) fn is_witness(statement: &Statement) -> bool {
    describe(statement).1
}

/// Refuses a statement that decides nothing about a property that we know.
pub(super) fn check(statement: &Statement, property: &str) -> Result<(), Refusal> {
    let (kind, _, properties) = describe(statement);
    if KNOWN.contains(&property) && !properties.contains(&property) {
        return Err(Refusal::Irrelevant { kind, property: property.into() });
    }
    Ok(())
}

/// Whether a witness speaks of all rows.
pub(super) fn needs_everything(statement: &Statement) -> bool {
    matches!(
        statement,
        Statement::KernelVector { .. }
            | Statement::Energy { .. }
            | Statement::Overshoot { .. }
            | Statement::Singular { .. }
            | Statement::HeatLoss { .. }
            | Statement::MassTotal { .. }
            | Statement::BelowCheeger { .. }
    )
}
