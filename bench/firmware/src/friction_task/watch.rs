//! The background: looks at the calibration page, checks it, and makes the model's constants of it.
//!
//! No interrupt makes them: their block alone is 1.7 KiB, which is copied.

use super::gear::{self, Constants};
use super::page::{Calibration, CalibrationPage, Refused};

/// A calibration that may be taken, with the constants that it makes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offer {
    /// The numbers.
    pub calibration: Calibration,
    /// What the model runs with.
    pub constants: Constants,
}

/// What was found of the calibration page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PageReport {
    /// Why the page as it stands is refused; `None` where its numbers are in use, or on their way.
    pub refused: Option<Refused>,
    /// Pages that were refused since the start.
    pub pages_refused: u32,
}

impl PageReport {
    /// At the start.
    pub const START: Self = Self {
        refused: None,
        pages_refused: 0,
    };
}

/// What the background has for itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watch {
    /// The last good numbers.
    calibration: Calibration,
    /// Checksum of the page that was looked at last.
    seen: u32,
    report: PageReport,
}

impl Watch {
    /// A watch that begins with a page whose numbers are in use.
    #[must_use]
    pub const fn new(calibration: &Calibration) -> Self {
        Self {
            calibration: *calibration,
            seen: CalibrationPage::of(*calibration).sum(),
            report: PageReport::START,
        }
    }

    /// Looks at the page; an offer where it has other numbers than before, and they may be taken.
    pub fn look(&mut self, page: &CalibrationPage) -> Option<Offer> {
        let sum = page.sum();
        let is_new = sum != self.seen;
        self.seen = sum;
        match page
            .checked()
            .and_then(|calibration| self.offer(calibration))
        {
            Ok(offer) => {
                self.report.refused = None;
                self.calibration = offer.map_or(self.calibration, |offer| offer.calibration);
                offer
            }
            Err(refused) => {
                if is_new || self.report.refused != Some(refused) {
                    self.report.pages_refused = self.report.pages_refused.wrapping_add(1);
                }
                self.report.refused = Some(refused);
                None
            }
        }
    }

    fn offer(&self, calibration: Calibration) -> Result<Option<Offer>, Refused> {
        if calibration == self.calibration {
            return Ok(None);
        }
        let constants = gear::constants(&calibration).map_err(|_| Refused::Together)?;
        Ok(Some(Offer {
            calibration,
            constants,
        }))
    }

    /// What was found.
    #[must_use]
    pub const fn report(&self) -> PageReport {
        self.report
    }
}
