//! What a promise says.

/// What one function promises.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Promise {
    /// The function.
    pub function: &'static str,
    /// Inputs for which the errors hold.
    pub domain: &'static str,
    /// What the error is of, and in which unit.
    pub error: &'static str,
    /// Largest error.
    pub largest: f64,
    /// Root mean square error.
    pub rms: f64,
    /// Mean error, of either sign: the bias.
    pub mean: f64,
    /// Behaviour outside the domain.
    pub outside: &'static str,
    /// Behaviour for NaN and infinities.
    pub not_finite: &'static str,
    /// Behaviour for zeros of either sign and subnormal numbers.
    pub tiny: &'static str,
    /// Most cycles over the counted inputs, rounded up; those of a scene are for the sizes that stand in its domain.
    pub cycles: u32,
    /// Names under which `bench` counts it.
    pub counted: &'static [&'static str],
}

/// What the image of a program with one scene promises, bytes: all of it, start-up and constants included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Footprint {
    /// The scene, as `bench` names it.
    pub scene: &'static str,
    /// Most flash.
    pub flash: u32,
    /// Most flash built for size.
    pub flash_small: u32,
    /// Most memory for variables; the stack not counted.
    pub ram: u32,
    /// Most stack of a step.
    pub stack: u32,
    /// Most stack of the set-up, [`FrictionModel::of`](crate::FrictionModel::of) of constants that stand in flash, built for speed.
    pub stack_set_up: u32,
}
