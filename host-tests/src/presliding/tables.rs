//! Tables of elements in proportion, as the stored cases were made with them.
//!
//! Each table is a broken line through zero that follows a backbone; it has a corner at every angle, and its slope falls there by the
//! element's stiffness.

use super::backbone::Backbone;
use super::elements::Elements;

/// A table of elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Table {
    /// Name.
    pub name: &'static str,
    /// Backbone that it follows.
    pub backbone: Backbone,
    /// Angles at which the elements slip, rising.
    pub angles: &'static [f64],
    /// Share of each element in the limit; they sum to one.
    pub shares: &'static [f64],
}

impl Table {
    /// The table of that name.
    pub fn named(name: &str) -> Option<Self> {
        TABLES.into_iter().find(|table| table.name == name)
    }

    /// Elements of this table, nothing remembered.
    pub fn elements(&self) -> Elements {
        Elements::proportional(self.angles, self.shares)
    }
}

/// 4 elements of slip across.
#[rustfmt::skip]
pub const SLIP_4: Table = Table {
    name: "slip4",
    backbone: Backbone::Slip,
    angles: &[
        0.25914523587290433, 0.5389148264248238, 0.7821204946459092, 0.9694551436218249,
    ],
    shares: &[
        0.0667063490450698, 0.1567635786519815, 0.27706175232837815, 0.4994683199745707,
    ],
};

/// 6 elements of slip across.
#[rustfmt::skip]
pub const SLIP_6: Table = Table {
    name: "slip6",
    backbone: Backbone::Slip,
    angles: &[
        0.1763644323245703, 0.37369257214266316, 0.5572464176371523, 0.7243886850290617,
        0.8697209064194441, 0.9817362342437534,
    ],
    shares: &[
        0.029719937826499596, 0.06756814506942913, 0.11052254087601582, 0.1628874084162669,
        0.23820748926022176, 0.39109447855156687,
    ],
};

/// 8 elements of slip across.
#[rustfmt::skip]
pub const SLIP_8: Table = Table {
    name: "slip8",
    backbone: Backbone::Slip,
    angles: &[
        0.1304717789862705, 0.2806615938099426, 0.4241936123553502, 0.5601694854249676,
        0.6872354898430025, 0.8037213257346847, 0.9061703680205586, 0.9864110194594911,
    ],
    shares: &[
        0.0161169065440953, 0.03648837351647821, 0.0586722983351577, 0.08347196684671258,
        0.11259816337981175, 0.15005683269439749, 0.20757246871546958, 0.3350229899678774,
    ],
};

/// 10 elements of slip across.
#[rustfmt::skip]
pub const SLIP_10: Table = Table {
    name: "slip10",
    backbone: Backbone::Slip,
    angles: &[
        0.10348428770926547, 0.22418881099805626, 0.3414765208248393, 0.45471798932784424,
        0.5631350470479864, 0.6659412039516044, 0.7622105489617564, 0.8504446850812941,
        0.928211022088721, 0.9895967348908069,
    ],
    shares: &[
        0.010038626124545098, 0.022740711607539175, 0.03641596867455395, 0.05124367529778563,
        0.06756526435366889, 0.08620316826377279, 0.10851237373724335, 0.13780753827386877,
        0.18530394874069953, 0.2941687249263228,
    ],
};

/// 4 elements of spin.
#[rustfmt::skip]
pub const SPIN_4: Table = Table {
    name: "spin4",
    backbone: Backbone::Spin,
    angles: &[
        0.35059003285736345, 0.7562458933563067, 1.4660543486825293, 3.7537162409535325,
    ],
    shares: &[
        0.24227654934672027, 0.35571954429170644, 0.28031325620928355, 0.1216906501522898,
    ],
};

/// 6 elements of spin.
#[rustfmt::skip]
pub const SPIN_6: Table = Table {
    name: "spin6",
    backbone: Backbone::Spin,
    angles: &[
        0.2283959104156727, 0.47157639454450506, 0.7578864668596252, 1.1880723290096347,
        2.273914591565547, 7.214935965980136,
    ],
    shares: &[
        0.09093723186104091, 0.20951038877504571, 0.2422024100710904, 0.2442792356877437,
        0.16928325908900457, 0.04378747451607476,
    ],
};

/// 8 elements of spin.
#[rustfmt::skip]
pub const SPIN_8: Table = Table {
    name: "spin8",
    backbone: Backbone::Spin,
    angles: &[
        0.1839680620308618, 0.3656542826532255, 0.5702564978323921, 0.793000150181226,
        1.1650315292895521, 1.808101458967738, 2.9580485841209105, 7.043059581729238,
    ],
    shares: &[
        0.049499507696247176, 0.13427806378294327, 0.17798680617496665, 0.18225272702053377,
        0.2116550490795682, 0.12758170573556923, 0.08207030900501976, 0.03467583150515194,
    ],
};

/// 10 elements of spin.
#[rustfmt::skip]
pub const SPIN_10: Table = Table {
    name: "spin10",
    backbone: Backbone::Spin,
    angles: &[
        0.1822731887963244, 0.329576689386184, 0.4764081326979209, 0.6671439843202783,
        0.8883928181020262, 1.1528865053135133, 1.5592168836688454, 2.3097026930378592,
        4.1301479856713055, 9.904029834333228,
    ],
    shares: &[
        0.045978143536215925, 0.08614977689662266, 0.1413114564376113, 0.15989231410787322,
        0.14336419099764414, 0.14359873402133874, 0.11347073711547463, 0.098175553402528,
        0.0507805018511259, 0.017278591633565446,
    ],
};

/// Every table.
pub const TABLES: [Table; 8] = [
    SLIP_4, SLIP_6, SLIP_8, SLIP_10, SPIN_4, SPIN_6, SPIN_8, SPIN_10,
];
