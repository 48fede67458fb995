//! A block as Rust, C, TOML and bytes.
//!
//! All hold the same words; text forms say above them what was folded, over which domain, and how exact it is.

use std::fmt::Write as _;
use std::path::Path;

use epas_friction::scene::CagedBallScrewConfiguration;

use crate::caged::{Block, NODES};
use crate::{Failure, Folded};

/// Words in a line of a text form.
const IN_A_LINE: usize = 6;

impl Block {
    /// Number of friction coefficients.
    #[must_use]
    pub const fn nodes(&self) -> usize {
        match self {
            Self::One(_) => 1,
            Self::Range(_) => NODES,
        }
    }

    /// Least and largest friction coefficient.
    #[must_use]
    pub const fn friction_range(&self) -> (f32, f32) {
        match self {
            Self::One(block) => block.law.friction_range(),
            Self::Range(block) => block.law.friction_range(),
        }
    }

    /// Its words, with the digest of what it was folded from.
    ///
    /// # Errors
    /// None that is known.
    pub fn words(&self, digest: u64) -> Result<Vec<u32>, Failure> {
        fn of<const N: usize>(
            block: &CagedBallScrewConfiguration<N>,
            digest: u64,
        ) -> Result<Vec<u32>, Failure> {
            let mut words = vec![0; CagedBallScrewConfiguration::<N>::WORDS];
            block.write(digest, &mut words)?;
            Ok(words)
        }
        match self {
            Self::One(block) => of(block, digest),
            Self::Range(block) => of(block, digest),
        }
    }
}

impl Folded {
    /// The block's words.
    ///
    /// # Errors
    /// None that is known.
    pub fn words(&self) -> Result<Vec<u32>, Failure> {
        self.block.words(self.digest)
    }

    /// Version of the block's layout.
    ///
    /// # Errors
    /// As [`Self::words`].
    pub fn version(&self) -> Result<u32, Failure> {
        Ok(self.words()?.get(1).copied().unwrap_or(0))
    }

    /// The block's bytes, each word with its least significant byte first: for a calibration page.
    ///
    /// # Errors
    /// As [`Self::words`].
    pub fn bytes(&self) -> Result<Vec<u8>, Failure> {
        Ok(self
            .words()?
            .iter()
            .flat_map(|word| word.to_le_bytes())
            .collect())
    }

    /// What was folded, over which domain, and how exact it is: lines for the comment above a block.
    #[must_use]
    pub fn summary(&self) -> Vec<String> {
        let gear = &self.fold.gear;
        let parameters = gear.design.parameters();
        let (least, largest) = self.block.friction_range();
        let [from, to] = self.fold.axial_load;
        let mut lines = vec![
            "Folded by epas-design; not to be edited.".into(),
            format!("digest of the inputs: {:016x}", self.digest),
            format!(
                "pitch radius {} m, lead {} m, ball radius {} m, contact angle {} rad, clearance {} m, {} balls",
                parameters.pitch_radius,
                parameters.lead,
                parameters.ball_radius,
                parameters.contact_angle,
                gear.clearance.gap(),
                gear.loaded_balls,
            ),
            format!(
                "holds for friction coefficients {least} to {largest} and axial loads of {from} to {to} N a ball, both signs"
            ),
        ];
        for figure in &self.certificate.figures {
            lines.push(format!(
                "certificate: {}, relative error on {} states that were not fitted (seed {}): largest {:.2e}, rms {:.2e}, mean {:.1e}; \
                 flagged {:.2} %",
                figure.quantity,
                figure.states,
                self.certificate.seed,
                figure.largest,
                figure.rms,
                figure.mean,
                100.0 * figure.flagged,
            ));
        }
        lines
    }

    /// A Rust module with a `static` of this name.
    ///
    /// # Errors
    /// As [`Self::words`].
    pub fn rust(&self, name: &str) -> Result<String, Failure> {
        let words = self.words()?;
        let nodes = self.block.nodes();
        let mut text = String::new();
        for line in self.summary() {
            let _ = writeln!(text, "// {line}");
        }
        let _ = write!(
            text,
            "\n/// A caged ball screw: `FrictionModel::<CagedBallScrew<{nodes}>, _>::of(&{name})`.\n\
             pub static {name}: epas_friction::scene::CagedConstants<{nodes}> =\n    \
             match epas_friction::scene::CagedConstants::from_block(&{name}_BLOCK) {{\n        \
             Ok(constants) => constants,\n        \
             Err(_) => panic!(\"the block is damaged, or of another version of epas-friction\"),\n    }};\n\n\
             #[rustfmt::skip]\nconst {name}_BLOCK: [u32; {}] = [\n",
            words.len()
        );
        text.push_str(&listed(&words));
        text.push_str("];\n");
        Ok(text)
    }

    /// A C header with an array of this name.
    ///
    /// # Errors
    /// As [`Self::words`].
    pub fn c(&self, name: &str) -> Result<String, Failure> {
        let words = self.words()?;
        let mut text = String::new();
        for line in self.summary() {
            let _ = writeln!(text, "// {line}");
        }
        let _ = write!(
            text,
            "\n#ifndef {name}_BLOCK_H\n#define {name}_BLOCK_H\n\n#include <stdint.h>\n\n\
             static const uint32_t {name}_BLOCK[{}] = {{\n",
            words.len()
        );
        text.push_str(&listed(&words));
        text.push_str("};\n\n#endif\n");
        Ok(text)
    }

    /// TOML: the summary as comments, the words as one array.
    ///
    /// # Errors
    /// As [`Self::words`].
    pub fn toml(&self) -> Result<String, Failure> {
        let words = self.words()?;
        let mut text = String::new();
        for line in self.summary() {
            let _ = writeln!(text, "# {line}");
        }
        let _ = write!(text, "digest = \"{:016x}\"\nwords = [\n", self.digest);
        text.push_str(&listed(&words));
        text.push_str("]\n");
        Ok(text)
    }

    /// Writes [`Self::rust`] to `folder` as a file with the name in small letters, for `include!`: what a `build.rs` calls.
    ///
    /// Into the folder of a build script it also tells cargo that the script alone decides what is folded: an edit elsewhere does not fold again.
    ///
    /// # Errors
    /// [`Failure::File`] where it cannot be written.
    pub fn write_rust(&self, name: &str, folder: impl AsRef<Path>) -> Result<(), Failure> {
        write_module(&self.rust(name)?, name, folder.as_ref())
    }
}

/// Writes a module to `folder` as a file with the name in small letters.
pub(crate) fn write_module(text: &str, name: &str, folder: &Path) -> Result<(), Failure> {
    let path = folder.join(format!("{}.rs", name.to_lowercase()));
    std::fs::write(path, text)?;
    if std::env::var_os("OUT_DIR").is_some_and(|own| folder == Path::new(&own)) {
        println!("cargo::rerun-if-changed=build.rs");
    }
    Ok(())
}

/// Words in lines.
pub(crate) fn listed(words: &[u32]) -> String {
    let mut text = String::new();
    for line in words.chunks(IN_A_LINE) {
        text.push_str("   ");
        for word in line {
            let _ = write!(text, " 0x{word:08x},");
        }
        text.push('\n');
    }
    text
}
