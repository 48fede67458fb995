//! Functions of which a step runs the parts, or the same formulas in another form.

use super::promise::Promise;

/// [`CoefficientAtTemperature::at`](crate::law::coefficient::CoefficientAtTemperature::at). A step with memory takes the
/// coefficient of both directions at once ([`both`](crate::law::coefficient::CoefficientAtTemperature::both)).
pub const FRICTION_COEFFICIENT: Promise = Promise {
    function: "CoefficientAtTemperature::at",
    domain: "0.1 to 500 rad/s, -20 to 120 C, the default's film and lubricant",
    error: "over boundary less full film, against a film by Hamrock and Dowson",
    largest: 8.1e-2,
    rms: 3.8e-2,
    mean: 1.5e-2,
    outside: "boundary at standstill, full film at any higher speed; temperatures: those of the ends",
    not_finite: "NaN: standstill, the warmest; infinity: full film, the warmest",
    tiny: "standstill",
    cycles: 52,
    counted: &["friction_coefficient"],
};

/// [`CoefficientLaw::at_temperature`](crate::law::coefficient::CoefficientLaw::at_temperature), then the same. A step
/// with memory calls the first where the temperature is another one than in the tick before.
pub const FRICTION_COEFFICIENT_WARMING: Promise = Promise {
    function: "CoefficientLaw::at_temperature, then at",
    cycles: 76,
    counted: &["friction_coefficient_warming"],
    ..FRICTION_COEFFICIENT
};

/// [`AnalyticLinearBall::speed_deviation`](crate::ball::AnalyticLinearBall::speed_deviation). A step of a linear
/// bearing computes its closed form once, for a ball that is turned by one radian, and scales it by each ball's deviations.
pub const ANALYTIC_BALL: Promise = Promise {
    function: "AnalyticLinearBall::speed_deviation",
    domain: "side-force ratios to 0.8, contact angles within 3 deg of each other",
    error: "speed deviation over v/2",
    largest: 1.5e-2,
    rms: 2e-3,
    mean: 1e-3,
    outside: "from a ratio of 0.88 on it misses two-point rolling, which its scene flags",
    not_finite: "angles: deviation 0; forces: no load",
    tiny: "no load: the compliance of 3e-14 N",
    cycles: 122,
    counted: &["linear_ball_speed"],
};

/// [`DeviationMap::at`](crate::DeviationMap::at): a step looks the same table up in integers, at the place of each ball.
pub const DEVIATION_MAP: Promise = Promise {
    function: "DeviationMap::at",
    domain: "one wave in a period",
    error: "over its amplitude",
    largest: 1.3e-3,
    rms: 6.5e-4,
    mean: 1e-5,
    outside: "every phase is inside; 5e-3 for two waves, 0.08 for eight",
    not_finite: "phases are integers",
    tiny: "no deviation: 0",
    cycles: 21,
    counted: &["deviation_map"],
};

/// [`Train::step`](crate::train::Train::step): forces between balls and their positions from speeds and impedances in a list. A
/// step of a scene hands them over ball by ball, by the same phases.
pub const TRAIN: Promise = Promise {
    function: "Train::step",
    domain: "rows of touching balls; cycles for 37 balls",
    cycles: 4700,
    counted: &["train_37"],
    ..PRESS
};

/// [`Press::solve`](crate::train::Press::solve). Steps of scenes and [`Train::step`](crate::train::Train::step) join and settle
/// balls by the same code, but take them in one by one.
pub const PRESS: Promise = Promise {
    function: "Press::solve",
    domain: "2 to 64 balls, impedances that differ by up to 1e6; cycles for 37 balls",
    error: "force over the largest force",
    largest: 2e-6,
    rms: 4e-7,
    mean: 1e-7,
    outside: "1e-5 for impedances up to 1e12; free speeds beyond 1 or impedances beyond 1e-9 to 1e9: no forces, and it says so",
    not_finite: "free speeds and impedances as outside; rooms that are NaN: no contact",
    tiny: "rooms up to 0: contact",
    cycles: 7300,
    counted: &["press_37"],
};
