//! Writing a domain in a format that can hold it.

use super::{Format, write_graph, write_medit, write_obj, write_off, write_xyz};
use crate::domain::{Domain, DomainKind};

/// A format that cannot hold a domain of this kind.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("a {kind} cannot be written as .{asked}; write it as .{native}")]
pub struct WriteError {
    /// The kind of domain.
    pub kind: DomainKind,
    /// The extension asked for.
    pub asked: &'static str,
    /// The extension of a format that holds it.
    pub native: &'static str,
}

/// The format that holds everything a domain is: OFF for a surface, Matrix Market for a graph, XYZ for points, medit for a
/// volume. (The boundary set of a graph has no place in a file.)
pub fn native_format(domain: &Domain) -> Format {
    match domain {
        Domain::Surface(_) => Format::Off,
        Domain::Graph(_) => Format::MatrixMarket,
        Domain::Points(_) => Format::Xyz,
        Domain::Volume(_) => Format::Medit,
    }
}

/// The text of a domain in a format; reading it back gives the same bits.
///
/// # Errors
/// A format that cannot hold a domain of this kind, or that this crate does not write.
pub fn write_domain(domain: &Domain, format: Format) -> Result<String, WriteError> {
    match (domain, format) {
        (Domain::Surface(s), Format::Off) => Ok(write_off(s)),
        (Domain::Surface(s), Format::Obj) => Ok(write_obj(s)),
        (Domain::Graph(g), Format::MatrixMarket) => Ok(write_graph(g)),
        (Domain::Points(p), Format::Xyz) => Ok(write_xyz(p)),
        (Domain::Volume(v), Format::Medit) => Ok(write_medit(v)),
        _ => Err(WriteError {
            kind: domain.kind(),
            asked: format.extension(),
            native: native_format(domain).extension(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Graph;

    #[test]
    fn a_graph_is_no_mesh_and_the_error_says_what_to_write() {
        let graph = Domain::from(Graph::new(2, &[[0, 1]]).unwrap());
        assert!(write_domain(&graph, native_format(&graph)).is_ok());
        let error = write_domain(&graph, Format::Off).unwrap_err();
        assert_eq!(error.to_string(), "a graph cannot be written as .off; write it as .mtx");
    }
}
