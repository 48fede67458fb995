//! Exact float64 reference models.

pub mod friction;
