//! Principal curvatures of a gothic-arch groove at a contact point: [`GothicArch`] at set-up; the other forms are called directly.
//!
//! | form | needs | error of the first curvature on the 31 catalogue sizes, contact angles 0 to 70 degrees |
//! |---|---|---|
//! | [`LiteratureCurvature`] | pitch and ball radius | up to 1.2 (that is 120 %): no lead |
//! | [`CircularGrooveCurvature`] | and the lead, the groove radius | up to 9.5e-3 |
//! | [`FittedCurvature`] | and the offsets; a set-up | 7e-7 |
//! | [`GothicArch`] | the same; exact, both curvatures | 6e-7 (rounding) |
//!
//! Signs: the normal points into the metal. The screw's first curvature is positive, the nut's
//! negative; the second is about `-1 / groove_radius` for both. Every form is scale free. Source: Bertolino, De Martin, Mauro, Sorli 2023
//! (Machines 11(2):261).

pub(crate) mod fitted;
mod gothic_arch;
mod literature;

#[doc(hidden)]
pub use fitted::CHEBYSHEV;
pub use fitted::{DEFAULT_FIT_RANGE, FittedCurvature};
pub use gothic_arch::{GothicArch, PrincipalCurvatures, RelativeCurvatures};
pub use literature::{CircularGrooveCurvature, LiteratureCurvature};
