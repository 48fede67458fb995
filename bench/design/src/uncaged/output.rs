//! A block of a screw without cage as words, bytes and Rust.

use std::fmt::Write as _;
use std::path::Path;

use epas_friction::scene::FoldedBall;

use super::{FoldedUncaged, NODES, RowFigures, UncagedBlock};
use crate::Failure;
use crate::output::{listed, write_module};

impl UncagedBlock {
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
        fn of<const N: usize>(block: &FoldedBall<N>, digest: u64) -> Result<Vec<u32>, Failure> {
            let mut words = vec![0; FoldedBall::<N>::WORDS];
            block.write(digest, &mut words)?;
            Ok(words)
        }
        match self {
            Self::One(block) => of(block, digest),
            Self::Range(block) => of(block, digest),
        }
    }
}

impl FoldedUncaged {
    /// The block's words.
    ///
    /// # Errors
    /// None that is known.
    pub fn words(&self) -> Result<Vec<u32>, Failure> {
        self.block.words(self.digest)
    }

    /// The block's bytes, each word with its least significant byte first: for a calibration page.
    ///
    /// # Errors
    /// As [`Self::words`].
    pub fn bytes(&self) -> Result<Vec<u8>, Failure> {
        let words = self.words()?;
        Ok(words.iter().flat_map(|word| word.to_le_bytes()).collect())
    }

    /// What was folded, over which domain, and how exact it is: lines for the comment above a block.
    #[must_use]
    pub fn summary(&self) -> Vec<String> {
        let gear = &self.fold.gear.gear;
        let parameters = gear.design.parameters();
        let (least, largest) = self.block.friction_range();
        let [from, to] = self.fold.axial_load;
        let [screw, nut] = self.fold.gear.deviations;
        let mut lines = vec![
            "Folded by epas-design; not to be edited.".into(),
            format!("digest of the inputs: {:016x}", self.digest),
            format!(
                "pitch radius {} m, lead {} m, ball radius {} m, contact angle {} rad, clearance {} m",
                parameters.pitch_radius,
                parameters.lead,
                parameters.ball_radius,
                parameters.contact_angle,
                gear.clearance.gap(),
            ),
            format!(
                "holds for friction coefficients {least} to {largest}, axial loads of {from} to {to} N a ball, both signs, and deviations of \
                 {screw} rad on the screw and {nut} rad in the nut"
            ),
        ];
        let certificate = &self.certificate;
        for (name, figures) in [
            ("without friction between balls", &certificate.smooth),
            (
                "with a coefficient of 0.1 between balls",
                &certificate.rubbing,
            ),
        ] {
            let RowFigures {
                rows,
                flagged,
                torque,
                forces,
                unflagged_forces,
                ..
            } = figures;
            lines.push(format!(
                "certificate (seed {}): {rows} rows of {} balls {name}: torque rms {:.1e}, largest {:.1e}, mean {:.1e}; forces over the row's \
                 largest rms {:.1e}, unflagged {:.1e}; {:.0} % flagged",
                certificate.seed,
                certificate.balls,
                torque.rms,
                torque.largest,
                torque.mean,
                forces.rms,
                unflagged_forces.rms,
                100.0 * flagged,
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
            "\n/// The ball of a screw without cage: `folded` of an `UncagedBallScrewConfiguration<{nodes}>`.\n\
             pub static {name}: epas_friction::scene::FoldedBall<{nodes}> =\n    \
             match epas_friction::scene::FoldedBall::read(&{name}_BLOCK) {{\n        \
             Ok(folded) => folded,\n        \
             Err(_) => panic!(\"the block is damaged, or of another version of epas-friction\"),\n    }};\n\n\
             #[rustfmt::skip]\nconst {name}_BLOCK: [u32; {}] = [\n",
            words.len()
        );
        text.push_str(&listed(&words));
        text.push_str("];\n");
        Ok(text)
    }

    /// Writes [`Self::rust`] to `folder` as a file with the name in small letters, for `include!`: what a `build.rs` calls.
    ///
    /// # Errors
    /// [`Failure::File`] where it cannot be written.
    pub fn write_rust(&self, name: &str, folder: impl AsRef<Path>) -> Result<(), Failure> {
        write_module(&self.rust(name)?, name, folder.as_ref())
    }
}
