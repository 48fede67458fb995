//! Units of variables, by the exponents of their base units.

pub struct Known {
    pub name: &'static str,
    /// Base units with their exponents, zeros left out.
    pub exponents: &'static [(&'static str, i8)],
}

pub const UNITS: [Known; 12] = [
    known("s", &[("s", 1)]),
    known("m", &[("m", 1)]),
    known("m/s", &[("m", 1), ("s", -1)]),
    known("rad", &[("rad", 1)]),
    known("rad/s", &[("s", -1), ("rad", 1)]),
    known("N", &[("kg", 1), ("m", 1), ("s", -2)]),
    known("N.m", &[("kg", 1), ("m", 2), ("s", -2)]),
    known("N.m.s/rad", &[("kg", 1), ("m", 2), ("s", -1), ("rad", -1)]),
    known("Pa", &[("kg", 1), ("m", -1), ("s", -2)]),
    known("kg/m3", &[("kg", 1), ("m", -3)]),
    known("kg.m2", &[("kg", 1), ("m", 2)]),
    known("K", &[("K", 1)]),
];

const fn known(name: &'static str, exponents: &'static [(&'static str, i8)]) -> Known {
    Known { name, exponents }
}
