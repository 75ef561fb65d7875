//! `lapjury export`: a built-in operator as Matrix Market files, bit for bit.

use std::path::PathBuf;

use super::{Common, Exit};
use crate::exchange;
use crate::suite::{Choice, Recipe};

/// Write a built-in operator as Matrix Market files
#[derive(clap::Args)]
#[command(after_help = "\
Example:
  lapjury export cotan:mass=mixed fixtures/meshes/spot.ply --out spot

writes spot.L.mtx, spot.M.mtx and spot.off; 'lapjury check --mesh spot.off --stiffness spot.L.mtx --mass spot.M.mtx' reads
them again, bit for bit.")]
pub(super) struct Export {
    /// The operator, with settings as in three-point:p=2
    laplacian: String,
    /// The domain: a mesh file or a recipe
    domain: String,
    /// The files' common stem
    #[arg(long, short, value_name = "STEM")]
    out: PathBuf,
}

impl Export {
    pub(super) fn execute(&self, common: &Common) -> anyhow::Result<Exit> {
        let choice: Choice = self.laplacian.parse()?;
        let domain = self.domain.parse::<Recipe>()?.build(&common.root)?;
        let operator = choice.build(&domain)?;
        common.write(&self.path("L.mtx"), &exchange::write_matrix_market(operator.stiffness()))?;
        if let Some(mass) = operator.mass() {
            common.write(&self.path("M.mtx"), &exchange::write_matrix_market(mass.matrix()))?;
        }
        let format = exchange::native_format(&domain);
        common.write_domain(&self.path(format.extension()), &domain, format)?;
        Ok(Exit::AsExpected)
    }

    /// The stem with an extension. The stem may have points of its own, as in `spot.v2`.
    fn path(&self, extension: &str) -> PathBuf {
        let mut path = self.out.clone().into_os_string();
        path.push(".");
        path.push(extension);
        path.into()
    }
}
