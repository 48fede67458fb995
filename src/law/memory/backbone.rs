//! Backbones as sums of elements: where each one starts to slide, and what it carries then.
//!
//! A backbone is the first friction after rest over the turn; by Masing's rule (1926) every later branch is the same curve
//! at twice its size. `z` is the turn over the breakaway angle; friction is over that of gross sliding.
//!
//! | tables | backbone | from |
//! |---|---|---|
//! | `SLIP_N` | `1 - (1 - z)^(3/2)` up to `z = 1` | slip across the path (Cattaneo 1938, Mindlin 1949) |
//! | `SPIN_N` | `1.5 z / sqrt(1 + 2.25 z²)` | spin of an elliptic contact, within 0.003 of a contact integral |
//!
//! Both start with the slope 1.5. Errors in percent of gross sliding: against the backbone, beside the least that as many
//! elements can have; and against exact Masing branches over random loops within loops, with amplitudes to one and a half breakaway angles.
//!
//! | table | backbone | least | loops: rms | loops: largest |
//! |---|---|---|---|---|
//! | `SLIP_4` | 0.53 | 0.48 | 0.77 | 3.3 |
//! | `SLIP_6` | 0.25 | 0.22 | 0.37 | 1.6 |
//! | `SLIP_8` | 0.16 | 0.13 | 0.22 | 1.0 |
//! | `SLIP_10` | 0.11 | 0.08 | 0.14 | 0.6 |
//! | `SPIN_4` | 2.0 | 1.4 | 2.5 | 10 |
//! | `SPIN_6` | 1.1 | 0.7 | 1.1 | 5.1 |
//! | `SPIN_8` | 0.8 | 0.4 | 0.7 | 3.0 |
//! | `SPIN_10` | 0.4 | 0.25 | 0.5 | 2.2 |
//!
//! Below a turn of the first angle no element slides: such a loop has no loss, the exact one less than 0.4 % of that of sliding.
//! `host-tests/tests/generators/backbones.rs` finds the tables, `host-tests/tests/all/law/golden.rs` goes round the loops.

/// One element of a backbone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct BackboneElement {
    /// Turn from rest at which it starts to slide, over the breakaway angle: 1e-6 to 1e3.
    pub angle: f32,
    /// Its share of the friction of gross sliding: 1e-9 to 1.
    pub weight: f32,
}

/// A backbone of `N` elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Backbone<const N: usize> {
    /// The elements, by the angle at which they start to slide.
    pub elements: [BackboneElement; N],
    /// Largest difference from the curve that it replaces, over the friction of gross sliding.
    pub error: f32,
}

impl<const N: usize> Backbone<N> {
    const fn new(angles: [f32; N], weights: [f32; N], error: f32) -> Self {
        let mut elements = [BackboneElement {
            angle: 1.0,
            weight: 0.0,
        }; N];
        let mut index = 0;
        while index < N {
            (elements[index].angle, elements[index].weight) = (angles[index], weights[index]);
            index += 1;
        }
        Self { elements, error }
    }
}

/// Slip across the path by 4 elements.
#[rustfmt::skip]
pub const SLIP_4: Backbone<4> = Backbone::new(
    [0.259_145_23, 0.538_914_8, 0.782_120_47, 0.969_455_1],
    [0.066_706_35, 0.156_763_58, 0.277_061_76, 0.499_468_33],
    0.00534,
);

/// Slip across the path by 6 elements.
#[rustfmt::skip]
pub const SLIP_6: Backbone<6> = Backbone::new(
    [0.176_364_44, 0.373_692_57, 0.557_246_45, 0.724_388_66, 0.869_720_94, 0.981_736_24],
    [0.029_719_938, 0.067_568_146, 0.110_522_54, 0.162_887_41, 0.238_207_49, 0.391_094_48],
    0.00247,
);

/// Slip across the path by 8 elements.
#[rustfmt::skip]
pub const SLIP_8: Backbone<8> = Backbone::new(
    [0.130_471_78, 0.280_661_58, 0.424_193_62, 0.560_169_46, 0.687_235_5, 0.803_721_3, 0.906_170_37,
     0.986_411_04],
    [0.016_116_906, 0.036_488_373, 0.058_672_298, 0.083_471_97, 0.112_598_166, 0.150_056_84, 0.207_572_48,
     0.335_023],
    0.00159,
);

/// Slip across the path by 10 elements.
#[rustfmt::skip]
pub const SLIP_10: Backbone<10> = Backbone::new(
    [0.103_484_29, 0.224_188_8, 0.341_476_53, 0.454_718, 0.563_135, 0.665_941_2, 0.762_210_55,
     0.850_444_7, 0.928_211_03, 0.989_596_7],
    [0.010_038_626, 0.022_740_712, 0.036_415_968, 0.051_243_674, 0.067_565_26, 0.086_203_165,
     0.108_512_37, 0.137_807_53, 0.185_303_94, 0.294_168_7],
    0.00107,
);

/// Spin by 4 elements.
#[rustfmt::skip]
pub const SPIN_4: Backbone<4> = Backbone::new(
    [0.350_590_02, 0.756_245_9, 1.466_054_3, 3.753_716_2],
    [0.242_276_55, 0.355_719_54, 0.280_313_25, 0.121_690_65],
    0.02014,
);

/// Spin by 6 elements.
#[rustfmt::skip]
pub const SPIN_6: Backbone<6> = Backbone::new(
    [0.228_395_91, 0.471_576_4, 0.757_886_47, 1.188_072_3, 2.273_914_6, 7.214_936],
    [0.090_937_234, 0.209_510_39, 0.242_202_42, 0.244_279_24, 0.169_283_26, 0.043_787_476],
    0.01051,
);

/// Spin by 8 elements.
#[rustfmt::skip]
pub const SPIN_8: Backbone<8> = Backbone::new(
    [0.183_968_07, 0.365_654_3, 0.570_256_5, 0.793_000_16, 1.165_031_6, 1.808_101_4, 2.958_048_6,
     7.043_059_3],
    [0.049_499_508, 0.134_278_06, 0.177_986_8, 0.182_252_72, 0.211_655_05, 0.127_581_7, 0.082_070_306,
     0.034_675_833],
    0.00800,
);

/// Spin by 10 elements.
#[rustfmt::skip]
pub const SPIN_10: Backbone<10> = Backbone::new(
    [0.182_273_2, 0.329_576_7, 0.476_408_12, 0.667_144, 0.888_392_8, 1.152_886_5, 1.559_216_9,
     2.309_702_6, 4.130_148, 9.904_03],
    [0.045_978_144, 0.086_149_774, 0.141_311_45, 0.159_892_32, 0.143_364_19, 0.143_598_74, 0.113_470_74,
     0.098_175_555, 0.050_780_5, 0.017_278_591],
    0.00404,
);
