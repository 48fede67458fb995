//! What goes into a timed call and what comes out of it.

use epas_friction::curvature::PrincipalCurvatures;
use epas_friction::geometry::ContactAngle;
use epas_friction::hertz::{ContactEllipse, HertzContact};
use epas_friction::{Inputs, Outputs};

pub trait Feed: Copy {
    /// The same number, `by` being zero; the processor does not know.
    fn shifted(self, by: f32) -> Self;
}

impl Feed for f32 {
    fn shifted(self, by: f32) -> Self {
        self + by
    }
}

impl Feed for f64 {
    fn shifted(self, by: f32) -> Self {
        self + Self::from(by)
    }
}

impl Feed for ContactAngle {
    fn shifted(self, by: f32) -> Self {
        Self {
            cos: self.cos + by,
            sin: self.sin + by,
        }
    }
}

impl Feed for Inputs {
    fn shifted(self, by: f32) -> Self {
        Self {
            nut_speed: self.nut_speed + by,
            axial_load: self.axial_load + by,
        }
    }
}

pub trait Taken {
    fn value(&self) -> f32;
}

impl Taken for f32 {
    fn value(&self) -> f32 {
        *self
    }
}

impl Taken for f64 {
    fn value(&self) -> f32 {
        *self as f32
    }
}

impl Taken for (f32, f32) {
    fn value(&self) -> f32 {
        self.0
    }
}

impl Taken for PrincipalCurvatures {
    fn value(&self) -> f32 {
        self.kappa1
    }
}

impl Taken for epas_reference::curvature::PrincipalCurvatures {
    fn value(&self) -> f32 {
        self.kappa1 as f32
    }
}

impl Taken for HertzContact {
    fn value(&self) -> f32 {
        self.axis_ratio()
    }
}

impl Taken for ContactEllipse {
    fn value(&self) -> f32 {
        self.semi_major
    }
}

impl Taken for Outputs {
    fn value(&self) -> f32 {
        self.friction_torque
    }
}
