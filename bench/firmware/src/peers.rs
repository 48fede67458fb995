//! Friction models in use today, for comparison: LuGre, whose state is the deflection of bristles, and a Stribeck curve.

/// Friction of one joint by the LuGre model (Canudas de Wit, Olsson, Åström, Lischinsky 1995), one
/// explicit step: `dz/dt = v - s0 |v| z / g(v)`, `F = s0 z + s1 dz/dt + s2 v`,
/// `g(v) = Fc + (Fs - Fc) exp(-(v/vs)²)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LuGre {
    /// Curve of steady sliding.
    pub stribeck: Stribeck,
    /// Stiffness `s0` of the bristles, N m/rad.
    pub stiffness: f32,
    /// Damping `s1` of the bristles, N m s/rad.
    pub damping: f32,
    /// Time from one step to the next, s.
    pub period: f32,
    /// Deflection `z` of the bristles, rad.
    pub deflection: f32,
}

/// Stribeck curve with viscous friction: `sgn(v) g(v) + s2 v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stribeck {
    /// Coulomb friction `Fc`, N m.
    pub coulomb: f32,
    /// Static less Coulomb friction, N m.
    pub excess: f32,
    /// One over the Stribeck speed `vs`, s/rad.
    pub inverse_speed: f32,
    /// Viscous friction `s2`, N m s/rad.
    pub viscous: f32,
}

impl Stribeck {
    /// `g(v)`.
    #[inline]
    fn level(&self, speed: f32) -> f32 {
        let ratio = speed * self.inverse_speed;
        self.coulomb + self.excess * libm::expf(-(ratio * ratio))
    }

    /// Friction torque at a speed, N m.
    #[inline]
    #[must_use]
    pub fn torque(&self, speed: f32) -> f32 {
        self.level(speed).copysign(speed) + self.viscous * speed
    }
}

impl LuGre {
    /// Friction torque, N m, after one step at a speed, rad/s.
    #[inline]
    pub fn step(&mut self, speed: f32) -> f32 {
        let pull = self.stiffness * self.deflection;
        let rate = speed - pull * speed.abs() / self.stribeck.level(speed);
        self.deflection += rate * self.period;
        self.stiffness * self.deflection + self.damping * rate + self.stribeck.viscous * speed
    }
}
