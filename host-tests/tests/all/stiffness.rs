//! Stiffness before sliding, breakaway angles, and the friction coefficient by speed and temperature, against the float64
//! reference, published limits and tabulated figures.

mod coefficient;
mod contact;
mod drag;
mod screw;
