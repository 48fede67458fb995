//! Exact float64 reference models.
