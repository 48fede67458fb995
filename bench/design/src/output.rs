//! A block as Rust, C, TOML and bytes.
//!
//! All hold the same words; text forms say above them what was folded, over which domain, and how exact it is.

use std::fmt::Write as _;
use std::path::Path;

use epas_friction::scene::{CagedBallScrewConfiguration, FoldedBall};

use crate::c99;
use crate::caged::{Block, CagedDesign, NODES};
use crate::uncaged::{self, UncagedBlock};
use crate::{Failure, Folded, FoldedUncaged};

const IN_A_LINE: usize = 6;

/// Words and forms of a block, and of what was folded with its certificate.
macro_rules! forms {
    ($block:ident, $folded:ident, $of:ident, $nodes:expr) => {
        impl $block {
            /// Number of friction coefficients.
            #[must_use]
            pub const fn nodes(&self) -> usize {
                match self {
                    Self::One(_) => 1,
                    Self::Range(_) => $nodes,
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
            pub fn words(&self, digest: u64) -> Result<Vec<u32>, Failure> {
                fn of<const N: usize>(block: &$of<N>, digest: u64) -> Result<Vec<u32>, Failure> {
                    let mut words = vec![0; $of::<N>::WORDS];
                    block.write(digest, &mut words)?;
                    Ok(words)
                }
                match self {
                    Self::One(block) => of(block, digest),
                    Self::Range(block) => of(block, digest),
                }
            }
        }

        impl $folded {
            /// The block's words.
            pub fn words(&self) -> Result<Vec<u32>, Failure> {
                self.block.words(self.digest)
            }

            /// The block's bytes, each word with its least significant byte first: for a calibration page.
            pub fn bytes(&self) -> Result<Vec<u8>, Failure> {
                let words = self.words()?;
                Ok(words.iter().flat_map(|word| word.to_le_bytes()).collect())
            }

            /// A Rust module with a `static` of this name.
            pub fn rust(&self, name: &str) -> Result<String, Failure> {
                let declared = self.declared(name);
                Ok(rust(&self.summary(), &declared, name, &self.words()?))
            }

            /// A C header with an array of this name.
            pub fn c(&self, name: &str) -> Result<String, Failure> {
                Ok(c(&self.summary(), name, &self.words()?))
            }

            /// TOML: the summary as comments, the words as one array.
            pub fn toml(&self) -> Result<String, Failure> {
                Ok(toml(&self.summary(), self.digest, &self.words()?))
            }

            /// Writes [`Self::rust`] to `folder` as a file with the name in small letters, for `include!`: what a `build.rs` calls.
            ///
            /// Into the folder of a build script it also tells cargo that the script alone decides what is folded: an edit elsewhere does
            /// not fold again.
            pub fn write_rust(&self, name: &str, folder: impl AsRef<Path>) -> Result<(), Failure> {
                write(&self.rust(name)?, name, folder.as_ref())
            }
        }
    };
}

forms!(Block, Folded, CagedBallScrewConfiguration, NODES);
forms!(UncagedBlock, FoldedUncaged, FoldedBall, uncaged::NODES);

impl Folded {
    /// Version of the block's layout.
    pub fn version(&self) -> Result<u32, Failure> {
        Ok(self.words()?.get(1).copied().unwrap_or(0))
    }

    /// What was folded, over which domain, and how exact it is: lines for the comment above a block.
    #[must_use]
    pub fn summary(&self) -> Vec<String> {
        let gear = &self.fold.gear;
        let mut lines = Vec::from(head(self.digest));
        lines.extend([
            format!("{}, {} balls", drawn(gear), gear.loaded_balls),
            holds(self.block.friction_range(), self.fold.axial_load),
        ]);
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

    /// C99 with step and memory, see [`c99::files`].
    pub fn c99(&self, names: [&str; 2], memory: &c99::Memory) -> Result<c99::Files, Failure> {
        let summary = self.summary();
        Ok(match &self.block {
            Block::One(block) => c99::files(&summary, names, block, memory),
            Block::Range(block) => c99::files(&summary, names, block, memory),
        }?)
    }

    fn declared(&self, name: &str) -> Declared {
        let nodes = self.block.nodes();
        Declared {
            doc: format!(
                "A caged ball screw: `FrictionModel::<CagedBallScrew<{nodes}>, _>::of(&{name})`."
            ),
            of: format!("epas_friction::scene::CagedConstants<{nodes}>"),
            from: "epas_friction::scene::CagedConstants::from_block",
        }
    }
}

impl FoldedUncaged {
    /// What was folded, over which domain, and how exact it is: lines for the comment above a block.
    #[must_use]
    pub fn summary(&self) -> Vec<String> {
        let [screw, nut] = self.fold.gear.deviations;
        let mut lines = Vec::from(head(self.digest));
        lines.extend([
            drawn(&self.fold.gear.gear),
            holds(self.block.friction_range(), self.fold.axial_load),
            format!(
                "and for deviations of the contact angles to {screw} rad on the screw and {nut} rad in the nut"
            ),
        ]);
        let certificate = &self.certificate;
        let rows = [
            ("without friction between balls", &certificate.smooth),
            ("with friction between balls", &certificate.rubbing),
            (
                "in waves, without friction between balls",
                &certificate.waves,
            ),
            (
                "in waves, with friction between balls",
                &certificate.rubbing_waves,
            ),
        ];
        for (which, figures) in rows {
            lines.push(format!(
                "certificate: {} rows of {} balls that were not fitted (seed {}), {which}: torque, relative, largest {:.2e}, rms {:.2e}, mean \
                 {:.1e}, of unflagged rows largest {:.2e}, rms {:.2e}; forces between balls over the largest of their row, rms {:.2e}, of unflagged rows \
                 {:.2e}; flagged {:.0} %",
                figures.rows,
                certificate.balls,
                certificate.seed,
                figures.torque.largest,
                figures.torque.rms,
                figures.torque.mean,
                figures.unflagged_torque.largest,
                figures.unflagged_torque.rms,
                figures.forces.rms,
                figures.unflagged_forces.rms,
                100.0 * figures.flagged,
            ));
        }
        lines
    }

    fn declared(&self, name: &str) -> Declared {
        let nodes = self.block.nodes();
        Declared {
            doc: format!(
                "The ball of a screw without cage: `folded: &{name}` of an `UncagedBallScrewConfiguration<{nodes}>`."
            ),
            of: format!("epas_friction::scene::FoldedBall<{nodes}>"),
            from: "epas_friction::scene::FoldedBall::read",
        }
    }
}

struct Declared {
    doc: String,
    of: String,
    /// The function that makes it from the words.
    from: &'static str,
}

fn head(digest: u64) -> [String; 2] {
    [
        "Folded by epas-design; not to be edited.".into(),
        format!("digest of the inputs: {digest:016x}"),
    ]
}

fn drawn(gear: &CagedDesign) -> String {
    let parameters = gear.design.parameters();
    format!(
        "pitch radius {} m, lead {} m, ball radius {} m, contact angle {} rad, clearance {} m",
        parameters.pitch_radius,
        parameters.lead,
        parameters.ball_radius,
        parameters.contact_angle,
        gear.clearance.gap(),
    )
}

fn holds((least, largest): (f32, f32), [from, to]: [f32; 2]) -> String {
    format!(
        "holds for friction coefficients {least} to {largest} and axial loads of {from} to {to} N a ball, both signs"
    )
}

fn commented(summary: &[String], mark: &str) -> String {
    let mut text = String::new();
    for line in summary {
        let _ = writeln!(text, "{mark} {line}");
    }
    text
}

fn rust(summary: &[String], declared: &Declared, name: &str, words: &[u32]) -> String {
    let Declared { doc, of, from } = declared;
    let mut text = commented(summary, "//");
    let _ = write!(
        text,
        "\n/// {doc}\n\
         pub static {name}: {of} =\n    \
         match {from}(&{name}_BLOCK) {{\n        \
         Ok(constants) => constants,\n        \
         Err(_) => panic!(\"the block is damaged, or of another version of epas-friction\"),\n    }};\n\n\
         #[rustfmt::skip]\n\
         #[allow(clippy::large_const_arrays, clippy::unreadable_literal, reason = \"read while compiling alone\")]\n\
         const {name}_BLOCK: [u32; {}] = [\n",
        words.len()
    );
    text.push_str(&listed(words));
    text.push_str("];\n");
    text
}

fn c(summary: &[String], name: &str, words: &[u32]) -> String {
    let mut text = commented(summary, "//");
    let _ = write!(
        text,
        "\n#ifndef {name}_BLOCK_H\n#define {name}_BLOCK_H\n\n#include <stdint.h>\n\n\
         static const uint32_t {name}_BLOCK[{}] = {{\n",
        words.len()
    );
    text.push_str(&listed(words));
    text.push_str("};\n\n#endif\n");
    text
}

fn toml(summary: &[String], digest: u64, words: &[u32]) -> String {
    let mut text = commented(summary, "#");
    let _ = write!(text, "digest = \"{digest:016x}\"\nwords = [\n");
    text.push_str(&listed(words));
    text.push_str("]\n");
    text
}

fn write(text: &str, name: &str, folder: &Path) -> Result<(), Failure> {
    let path = folder.join(format!("{}.rs", name.to_lowercase()));
    std::fs::write(path, text)?;
    if std::env::var_os("OUT_DIR").is_some_and(|own| folder == Path::new(&own)) {
        println!("cargo::rerun-if-changed=build.rs");
    }
    Ok(())
}

fn listed(words: &[u32]) -> String {
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
