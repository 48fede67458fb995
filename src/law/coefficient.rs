//! stub
/// stub
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoefficientLaw(f32);
/// stub
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoefficientAtTemperature(f32);
impl CoefficientLaw {
    /// stub
    pub const fn constant(f: f32) -> Self {
        Self(f)
    }
    /// stub
    pub fn extremes(&self) -> (f32, f32) {
        (self.0, self.0)
    }
    /// stub
    pub fn at_temperature(&self, _: f32) -> CoefficientAtTemperature {
        CoefficientAtTemperature(self.0)
    }
}
impl CoefficientAtTemperature {
    /// stub
    pub fn at(&self, _: f32) -> f32 {
        self.0
    }
    /// stub
    pub fn churning(&self, _: f32) -> f32 {
        0.0
    }
}
