//! A content digest that depends on coordinates and connectivity only.

use sha2::{Digest, Sha256};

use super::Domain;

/// SHA-256 over kind, counts, coordinates bit for bit and connectivity, in hexadecimal.
pub(super) fn digest(domain: &Domain) -> String {
    let mut hash = Sha256::new();
    hash.update(domain.kind().to_string());
    let number = |hash: &mut Sha256, n: usize| hash.update((n as u64).to_le_bytes());
    number(&mut hash, domain.vertex_count());
    for x in domain.positions().unwrap_or(&[]).iter().flatten() {
        // Both zeros are the same place.
        hash.update((x + 0.0).to_bits().to_le_bytes());
    }
    let list = |hash: &mut Sha256, corners: &[usize]| {
        number(hash, corners.len());
        corners.iter().for_each(|&v| number(hash, v));
    };
    match domain {
        Domain::Surface(s) => s.faces().iter().for_each(|f| list(&mut hash, f)),
        Domain::Volume(v) => v.tetrahedra().iter().for_each(|t| list(&mut hash, t)),
        Domain::Graph(g) => {
            g.edges().iter().for_each(|e| list(&mut hash, e));
            g.weights().unwrap_or(&[]).iter().for_each(|w| hash.update(w.to_bits().to_le_bytes()));
            g.boundary().iter().for_each(|&b| hash.update([u8::from(b)]));
        }
        Domain::Points(p) => {
            p.normals().unwrap_or(&[]).iter().flatten().for_each(|x| hash.update(x.to_bits().to_le_bytes()));
        }
    }
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
