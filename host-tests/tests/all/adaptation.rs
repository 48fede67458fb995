//! A friction level that follows the vehicle: how well, how safely, and across ignition.

mod covariance;
mod gate;
mod health;
mod level;
mod stored;
mod total;
mod trace;
mod trial;
