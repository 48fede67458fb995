//! A contact that slips along its major axis: what the lead does to every contact of a ball screw.

use core::f32::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI};

use crate::contact::FrictionMap;
use crate::error::Error;
use crate::math;

/// Points of interpolation outside the contact.
const POINTS: usize = 10;

/// Chebyshev points in the order of Leja, in which Newton's form loses no digits.
const CHEBYSHEV: [f32; POINTS] = [
    0.987_688_36,
    -0.987_688_36,
    -0.156_434_46,
    0.453_990_5,
    -FRAC_1_SQRT_2,
    FRAC_1_SQRT_2,
    -0.453_990_5,
    0.891_006_5,
    -0.891_006_5,
    0.156_434_46,
];

/// Panels of the quarter circle over which a chord's direction is integrated, at set-up.
const PANELS: u8 = 16;

/// Gauss-Legendre nodes on -1 to 1 and their weights.
const GAUSS: [(f32, f32); 5] = [
    (-0.906_179_85, 0.236_926_88),
    (-0.538_469_3, 0.478_628_67),
    (0.0, 0.568_888_9),
    (0.538_469_3, 0.478_628_67),
    (0.906_179_85, 0.236_926_88),
];

/// Power series of the potential inside the contact: exact.
///
/// With the velocity centre at `(x a, y b)`, `x` from slip along the minor axis and `y` from slip along
/// the major axis, the dissipation of a contact is `mu F a |w|` times
///
/// ```text
/// P = p + p_x x² + p_y y² + p_xx x⁴ + p_xy x² y² + p_yy y⁴        x² + y² <= 1
/// ```
///
/// Along every line through the velocity centre the integral of Lin 2019, eq. (3.68), is elementary, and
/// what remains are moments of `g = sqrt(cos² + k² sin²)` over a half turn. `p`, `p_x`, `p_xx` are the
/// coefficients of [`FrictionMap`]; three moments follow from them, and from these the other three.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct Quartic {
    pub(super) spin: f32,
    pub(super) along: f32,
    pub(super) across: f32,
    pub(super) along_along: f32,
    pub(super) both: f32,
    pub(super) across_across: f32,
}

impl Quartic {
    pub(super) fn new(map: &FrictionMap) -> Self {
        let spin = map.spin_moment();
        let along = 0.5 * map.slope();
        let along_along = -0.25 * (map.slope() - map.force(1.0));
        // Moments of 1, cos², sin² cos² and cos⁴ over 3/4.
        let whole = 4.0 * spin;
        let cos2 = (2.0 * along + whole) * (1.0 / 3.0);
        let sin2 = whole - cos2;
        let mixed = 0.2 * sin2 - 0.8 * along_along;
        let cos4 = cos2 - mixed;
        Self {
            spin,
            along,
            across: sin2 - 0.5 * cos2,
            along_along,
            both: 7.5 * mixed - whole,
            across_across: 0.25 * cos4 - mixed,
        }
    }
}

/// Friction of one contact that slips along its major axis and spins, as a function of the cube root of
/// its load.
///
/// In a ball screw the lead makes screw and nut turn against each other about the ball's path, so that
/// every contact slips across the track with the velocity `V`, and friction along the track only adds
/// to that. With spin `w`, the velocity centre lies at `D = V/(|w| b)` semi-minor axes on the minor axis.
/// Inside the contact everything is a polynomial in `D²` ([`Quartic`]). Outside it `drag` and `give` are
/// interpolated in `1/(1 + k D)`, which keeps the logarithmic singularities of the slender ellipse at
/// the same distance for every axis ratio `k`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(super) struct AcrossMap {
    inside: Quartic,
    axis_ratio: f32,
    /// `mu F V` of the power loss, and `mu F/V` of the slope of the force along the track.
    power: [f32; POINTS],
    slope: [f32; POINTS],
}

/// One contact under one load, per unit of nut speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Across {
    /// Power loss over `mu F`, m.
    pub(super) drag: f32,
    /// Slip along the track over the friction force that resists it, times `mu F`, m.
    pub(super) give: f32,
    /// Friction force across the track over `mu F`.
    pub(super) share: f32,
    /// Change of `ln drag` with the logarithm of the cube root of the load.
    pub(super) drag_growth: f32,
    /// Change of `ln give` with it.
    pub(super) give_growth: f32,
}

impl AcrossMap {
    pub(super) fn new(axis_ratio: f32) -> Result<Self, Error> {
        let inside = Quartic::new(&FrictionMap::new(axis_ratio)?);
        let mut power = [0.0; POINTS];
        let mut slope = [0.0; POINTS];
        for ((point, power), slope) in CHEBYSHEV.iter().zip(&mut power).zip(&mut slope) {
            // From the largest nearness 1/(1 + k) of the rim down to none.
            let nearness = 0.5 * (1.0 + point) / (1.0 + axis_ratio);
            (*power, *slope) = outside(axis_ratio, nearness);
        }
        Ok(Self {
            inside,
            axis_ratio,
            power: divided_differences(power),
            slope: divided_differences(slope),
        })
    }

    /// Axis ratio of the ellipse.
    #[inline]
    pub(super) const fn axis_ratio(&self) -> f32 {
        self.axis_ratio
    }

    /// Slope of the share of sliding friction across the track by `D`, at the centre.
    #[inline]
    pub(super) fn share_slope(&self) -> f32 {
        2.0 * self.inside.across / self.axis_ratio
    }

    /// Drag, give and share where `slip` (m, per unit of nut speed) meets a contact whose spin moves its
    /// rim by `rim` along the major axis (`a |w|`, m, per unit of nut speed).
    #[inline]
    pub(super) fn at(&self, slip: f32, rim: f32) -> Across {
        let narrow_rim = self.axis_ratio * rim;
        if slip <= narrow_rim {
            let offset = slip / narrow_rim;
            let square = offset * offset;
            let along = 2.0 * (self.inside.along + self.inside.both * square);
            let quartic = self.inside.across_across * square;
            let power = self.inside.spin + square * (self.inside.across + quartic);
            let force = 2.0 * offset * (self.inside.across + 2.0 * quartic);
            let inverse = 1.0 / (along * power);
            Across {
                drag: rim * power,
                give: rim * power * inverse,
                share: force / self.axis_ratio,
                drag_growth: 1.0 - offset * force * along * inverse,
                give_growth: 1.0 + 4.0 * self.inside.both * square * power * inverse,
            }
        } else {
            // rim/slip = a w/V = 1/(k D).
            let nearness = rim / (rim + slip);
            let place = 2.0 * (1.0 + self.axis_ratio) * nearness - 1.0;
            let stretch = 2.0 * (1.0 + self.axis_ratio) * nearness * (1.0 - nearness);
            let (power, power_slope) = newton(&self.power, place);
            let (slope, slope_slope) = newton(&self.slope, place);
            let inverse = 1.0 / (power * slope);
            let growth = power_slope * stretch;
            Across {
                drag: slip * power,
                give: slip * power * inverse,
                share: power - growth,
                drag_growth: growth * slope * inverse,
                give_growth: -slope_slope * stretch * power * inverse,
            }
        }
    }
}

/// Power loss over `mu F V` and slope along the track times `V/(mu F)` at `nearness = 1/(1 + k D)`, `D >= 1`.
///
/// The integral over the direction of the chords through the velocity centre; both are even in it.
fn outside(axis_ratio: f32, nearness: f32) -> (f32, f32) {
    // 1/D, from D k = 1/nearness - 1.
    let closeness = axis_ratio * nearness / (1.0 - nearness);
    let mut power = 0.0;
    let mut slope = 0.0;
    for panel in 0..PANELS {
        let middle = f32::from(panel) + 0.5;
        for (node, weight) in GAUSS {
            // More panels where the chord runs along the minor axis and the slender ellipse is sharp.
            let part = (middle + 0.5 * node) / f32::from(PANELS);
            let angle = FRAC_PI_2 * part * part;
            let (sin, cos) = math::sin_cos(angle);
            let weight = weight * part / f32::from(PANELS);
            let sin_chord = closeness * sin;
            let cos_chord = math::sqrt((1.0 - sin_chord) * (1.0 + sin_chord));
            let (across, along) = (sin_chord, axis_ratio * cos_chord);
            let length = math::sqrt(across * across + along * along);
            let square = cos * cos;
            // d(angle) cos/(e cos_chord), all over e.
            let turn = weight * cos * square / cos_chord;
            power +=
                turn * (cos_chord * cos_chord + 0.25 * square * closeness * closeness) * length;
            slope += turn * along * along / (length * length * length);
        }
    }
    // 3/4, both halves, and pi/2 over the slip k of the far field.
    let scale = 0.75 * PI / axis_ratio;
    (scale * power, scale * slope * axis_ratio * axis_ratio)
}

fn divided_differences(mut values: [f32; POINTS]) -> [f32; POINTS] {
    for order in 1..POINTS {
        let mut before = values;
        before.rotate_right(1);
        let pairs = CHEBYSHEV.iter().skip(order).zip(&CHEBYSHEV);
        let entries = values.iter_mut().zip(before).skip(order);
        for ((value, before), (here, there)) in entries.zip(pairs) {
            *value = (*value - before) / (here - there);
        }
    }
    values
}

/// Newton's form and its derivative.
#[inline]
fn newton(differences: &[f32; POINTS], place: f32) -> (f32, f32) {
    let mut value = 0.0;
    let mut slope = 0.0;
    for (difference, point) in differences.iter().zip(&CHEBYSHEV).rev() {
        let distance = place - point;
        slope = slope * distance + value;
        value = value * distance + difference;
    }
    (value, slope)
}
