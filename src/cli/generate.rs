//! `lapjury generate`: a domain from a recipe to a file.

use std::path::PathBuf;

use super::{Common, Exit, print};
use crate::exchange::{self, Format};
use crate::suite::Recipe;

/// Write a generated domain to a mesh file
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  lapjury generate icosphere:levels=3 --out sphere.off
  lapjury generate 'random-delaunay:seed=7 | flip:count=20' --out bad.obj

Without --out the mesh is printed in OFF form (a graph as Matrix Market). 'lapjury explain icosphere' names the settings.")]
pub(super) struct Generate {
    /// The recipe
    recipe: String,
    /// The file: .off or .obj for surfaces, .mtx for graphs, .xyz for points, .mesh for tetrahedra
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
}

impl Generate {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let recipe: Recipe = self.recipe.parse()?;
        let domain = recipe.build(&common.root)?;
        match &self.out {
            Some(path) => common.write_domain(path, &domain, Format::of(path)?)?,
            None => {
                print(&exchange::write_domain(&domain, exchange::native_format(&domain))?)?;
                common.say_what_is_lost(&domain);
            }
        }
        Ok(Exit::AsExpected)
    }
}
