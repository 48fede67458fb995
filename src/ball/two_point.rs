//! The two ways in which a ball of a linear bearing rolls: on four contacts that spin, or on two while the other two slide.

use super::linear::LinearBallParameters;
use super::loads::LoadShare;

/// Loss on two points over that on four, below which a ball counts as near two-point rolling: twice the 5 % by which deviations of 3
/// degrees in both grooves raise the loss of the stronger diagonal.
const BORDER_MARGIN: f32 = 1.1;

/// Largest force between two balls over that of the closed form, shortly before the border (measured: friction between balls as in the grooves).
const FORCE_MARGIN: f32 = 1.25;

/// `2^(-4/3)`: a diagonal's force to the power of 4/3 is that of its sum of two equal contact forces, times this.
#[doc(hidden)]
pub const HALF_TO_FOUR_THIRDS: f32 = 0.396_850_26;

/// Friction of a ball with the grooves of a linear bearing, and how near the ball is to two-point rolling.
///
/// A ball under Coulomb friction rolls in the manner that loses least; with the sums `U` and `D` of the forces of both diagonals it loses, over the
/// speed of the carriage:
///
/// ```text
/// four-point rolling: four contacts spin with v tan(beta)/(2 r_b)     spin (U^(4/3) + D^(4/3))
/// two-point rolling:  two contacts slide with v sin²(beta)            mu sin²(beta) D,  D the weaker one
/// ```
///
/// Where the second gets less than the first, the ball's speed jumps. Angle deviations and neighbours move this border.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct GrooveFriction {
    /// Loss of spin over `F^(4/3)` of a diagonal, N^(-1/3).
    spin: f32,
    /// Loss of sliding over the force of the weaker diagonal.
    slide: f32,
    /// Loss of spin at the border over `F^(4/3)` of the stronger diagonal, for the heaviest ball, N^(-1/3).
    border: f32,
    /// Most by which deviations lessen the loss of sliding, over the force of the stronger diagonal: where U is the weaker one, where D is.
    turned: [f32; 2],
    /// Loss of rubbing on neighbours that the lightest ball saves by rolling on two points, over the force between balls.
    rubbing: f32,
    /// Loss of being pressed that it saves, over the square of that force and the compliance.
    pressing: f32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BorderParameters {
    pub(crate) angle: (f32, f32),
    pub(crate) friction: f32,
    pub(crate) ball_friction: f32,
    /// Loss of a ball that spins at four contacts over `U^(4/3) + D^(4/3)`, N^(-1/3).
    pub(crate) spin: f32,
    /// Least and largest deviation of the bottom groove, rad.
    pub(crate) bottom: (f32, f32),
    /// Least and largest deviation of the top groove, rad.
    pub(crate) top: (f32, f32),
    pub(crate) shares: (LoadShare, LoadShare),
}

/// Loss of a ball under the mean load in its grooves, N: power over the speed of the carriage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct GrooveLoss {
    pub(crate) friction: f32,
    /// Loss of two-point over four-point rolling at the least favourable deviations; below zero it loses less.
    reserve: f32,
}

/// Force that deviations take off the weaker diagonal, over that of the stronger one, at the border, `(D - h (U + D cos(2 beta))/sin(2 beta)`:
/// `h` is half the difference of the deviations of both grooves, beside sine and cosine of twice the contact angle.
const fn taken(h: f32, (sin, cos): (f32, f32)) -> f32 {
    h / (sin - h * cos)
}

/// Loss of a ball whose four contacts spin with `v tan(beta)/(2 r_b)`, over the speed `v` of the carriage and over `U^(4/3) + D^(4/3)`,
/// N^(-1/3); `moment` of a contact over `mu F a`.
pub(crate) const fn spin_loss(
    parameters: &LinearBallParameters,
    half_tangent: f32,
    moment: f32,
) -> f32 {
    let LinearBallParameters {
        ball_radius,
        semi_major_coefficient,
        friction,
        ..
    } = *parameters;
    // Two contacts of a diagonal, each under half of its force.
    let drag = 2.0 * moment * friction * semi_major_coefficient * half_tangent / ball_radius;
    HALF_TO_FOUR_THIRDS * drag
}

impl GrooveFriction {
    pub(crate) const fn new(parameters: &BorderParameters) -> Self {
        let BorderParameters {
            angle: (sin, cos),
            friction,
            ball_friction,
            spin,
            bottom,
            top,
            shares: (lightest, heaviest),
        } = *parameters;
        let slide = friction * sin * sin;
        let doubled = (2.0 * sin * cos, cos * cos - sin * sin);
        Self {
            spin,
            slide,
            border: BORDER_MARGIN * spin * heaviest.root(),
            turned: [
                slide * taken(0.5 * (top.1 - bottom.0), doubled),
                slide * taken(0.5 * (bottom.1 - top.0), doubled),
            ],
            // Balls rub with v/cos(beta) in four-point rolling (Lin 2019, (3.52)), and with v in two-point rolling.
            rubbing: FORCE_MARGIN * ball_friction * (1.0 / cos - 1.0) / lightest.share(),
            // The force changes the ball's speed by v/2 times the compliance: half of the product.
            pressing: 0.25 * FORCE_MARGIN * FORCE_MARGIN
                / (lightest.share() * lightest.two_thirds()),
        }
    }

    /// The loss under the forces of both diagonals, each the sum of its two contacts, N, above zero, and their powers of 4/3.
    /// `lean` is the force of the weaker diagonal by the balance of the loads, N: below zero where they lift it off.
    #[inline(always)]
    pub(crate) fn at(
        &self,
        [up, down]: [f32; 2],
        [up_spin, down_spin]: [f32; 2],
        lean: f32,
    ) -> GrooveLoss {
        let [turned_up, turned_down] = self.turned;
        let (weak, strong, strong_spin, turned) = if up < down {
            (up, down, down_spin, turned_up)
        } else {
            (down, up, up_spin, turned_down)
        };
        let four_points = self.spin * (up_spin + down_spin);
        let two_points = self.slide * weak;
        GrooveLoss {
            friction: if two_points < four_points {
                two_points
            } else {
                four_points
            },
            reserve: self.slide * lean - (turned * strong + self.border * strong_spin),
        }
    }

    /// Whether some ball may roll on two points, where the largest force between two balls is `force`, N, and a ball under the
    /// mean load has this `compliance`, 1/N.
    #[inline(always)]
    pub(crate) fn leaves_four_points(
        &self,
        loss: &GrooveLoss,
        force: f32,
        compliance: f32,
    ) -> bool {
        loss.reserve < force * (self.rubbing + self.pressing * force * compliance)
    }
}
