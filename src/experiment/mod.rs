//! Experiments: theorems and measurements that are more than property × operator × domain, one a file.
//!
//! An experiment asks a number of questions, its parts, and answers each with a [`Finding`]: how many cases were decided,
//! whether they agree, and the first case that does not. Nothing is declared; the answer comes from the cases.
//!
//! To add one: write the file and name it below, in the `catalogue`.

mod calculus;
pub mod limit;
mod poll;
pub mod world;

catalogue! {
    /// Every experiment, in the order of the claims.
    Experiment:
    smooth_functions,
    codifferential,
    harmonic_forms,
    hodge_decomposition,
    fourier_expansion,
    eigenvector_expansion,
    kernels_and_minmax,
    metric_from_cotangents,
    graph_form,
    graph_positivity,
    mean_value_property,
    maximum_principle,
    weak_and_strong,
    negative_weights,
    heat_flow,
    linear_precision_of_graphs,
    cotangent_sign,
    cheeger_inequality,
    isospectral_graphs,
    isospectral_drums,
    cheeger_sweep,
    cheeger_on_surfaces,
    dual_faces,
    family_positivity,
    orthogonal_duals,
    pub no_free_lunch,
    rippa_in_the_plane,
    rippa_in_space,
    spectral_rippa,
    tutte_embedding,
    flips_in_the_plane,
    flips_on_tori,
    convergence,
    consistency,
    point_cloud_consistency,
    schwarz_lantern,
}

use crate::figure::Figure;
use crate::property::{Evidence, Level};

/// A catalogue entry.
pub struct Experiment {
    /// The id, in kebab case; the file has the same name in snake case.
    pub id: &'static str,
    /// What it is called.
    pub name: &'static str,
    /// What exactly is asked, of which cases.
    pub statement: &'static str,
    /// Keys of `references.bib`.
    pub sources: &'static [&'static str],
    /// The names of the questions; [`Experiment::run`] gives one finding for each, in this order.
    pub parts: &'static [&'static str],
    /// Runs the cases.
    pub run: fn(&Setting) -> Vec<Finding>,
}

/// What an experiment is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Setting {
    /// The seed of whatever is drawn at random.
    pub seed: u64,
    /// How many cases to try.
    pub effort: Effort,
}

/// How many cases to try: the questions are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum Effort {
    /// The smallest worlds and few random cases: all experiments together take some five seconds.
    Smoke,
    /// Larger worlds and more random cases: all experiments together take some fifteen seconds.
    #[default]
    Full,
}

impl std::fmt::Display for Effort {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Effort::Smoke => "smoke",
            Effort::Full => "full",
        })
    }
}

impl Setting {
    /// One of two numbers, by effort.
    fn pick(&self, smoke: usize, full: usize) -> usize {
        match self.effort {
            Effort::Smoke => smoke,
            Effort::Full => full,
        }
    }
}

/// The answer to one question of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Which of [`Experiment::parts`].
    pub part: &'static str,
    /// What was asked, in words, with the cases that were tried.
    pub question: String,
    /// Whether the answer is yes. Meaningless where nothing was decided.
    pub agrees: bool,
    /// Cases that were decided.
    pub decided: usize,
    /// Cases that were left open.
    pub open: usize,
    /// How they were decided.
    pub level: Level,
    /// The numbers, and the first counterexample or the witness.
    pub finding: String,
    /// Witnesses with their own excerpts of matrix and mesh.
    pub evidence: Vec<Evidence>,
    /// What there is to look at.
    pub figures: Vec<Figure>,
}
