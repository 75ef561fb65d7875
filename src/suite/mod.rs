//! Suites: what to try, in which order, and what is expected of it.
//!
//! A [`Suite`] is read from TOML, drawn into a [`Plan`] of [`Case`]s, run in parallel with results in the order of the plan,
//! and its claims are tested on the cells and by experiments.

pub mod atlas;
pub mod call;
pub mod cases;
pub mod choice;
pub mod claims;
pub mod plan;
pub mod recipe;
pub mod run;
pub mod schema;
pub mod shrink;
pub mod witness;

pub use choice::{Choice, ChoiceError};
pub use plan::{Case, Plan};
pub use recipe::{Recipe, RecipeError};
pub use run::{Observer, Options, RunError, run};
pub use schema::{Suite, SuiteError};
