//! The digest of the results: the same for any number of threads, any machine, one run or several merged.

use sha2::{Digest as _, Sha256};

use super::{Header, Line};

/// Adds up the lines that are results; the order in which they come does not matter.
///
/// # Definition
/// Each line's canonical text (compact JSON, fields in the order of the schema, shortest decimal that reads back to the same
/// `f64`) is hashed with SHA-256; the hashes are sorted, and the digest is the SHA-256 of their concatenation. The header
/// takes part without its environment; timing and footer do not. Cost: 32 bytes for each line.
#[derive(Clone, Debug, Default)]
pub struct Digest {
    hashes: Vec<[u8; 32]>,
}

impl Digest {
    /// Adds a line.
    ///
    /// # Errors
    /// What JSON cannot say (nothing in this schema).
    pub fn add(&mut self, line: &Line) -> Result<(), serde_json::Error> {
        match line {
            Line::Timing(_) | Line::Footer(_) => {}
            Line::Header(header) => {
                let bare = Header { environment: Default::default(), ..header.clone() };
                self.add_text(&serde_json::to_string(&Line::Header(bare))?);
            }
            _ => self.add_text(&serde_json::to_string(line)?),
        }
        Ok(())
    }

    /// Adds a line by its canonical text, without the newline. The caller has left out what is no result.
    pub(super) fn add_text(&mut self, text: &str) {
        self.hashes.push(Sha256::digest(text.as_bytes()).into());
    }

    /// The digest of the lines so far, in hexadecimal.
    pub fn value(&self) -> String {
        let mut sorted = self.hashes.clone();
        sorted.sort_unstable();
        let mut all = Sha256::new();
        sorted.iter().for_each(|h| all.update(h));
        all.finalize().iter().map(|b| format!("{b:02x}")).collect()
    }
}
