//! An example to start from: a friction task of 1 kHz under a current loop of 20 kHz, with plain interrupts.
//!
//! | part | what | priority |
//! |---|---|---|
//! | [`fast`] | encoder to torque, every 50 us: [`between`](epas_friction::FrictionModel::between) | `SysTick`, high |
//! | [`slow`] | load, temperature, balls, adaptation, every ms: [`step`](epas_friction::FrictionModel::step) | `PendSV`, lowest |
//! | [`watch`] | the calibration page, checked and made into constants | background |
//! | [`gear`] | the scene and its constants from the calibration | |
//! | [`reaction`] | what becomes of the torque while something is missing: hold, fade, never a jump | |
//! | [`page`] | the calibration page: one table of names, units, limits and values; its checks | |
//! | [`measured`] | what the task shows to a tool | |
//! | `memory` | where both stand, at addresses that a tool outside reads and writes | |
//! | [`vehicle`], [`judge`] | a simulated vehicle with sensors that drop out, and what the run has to show | |
//!
//! Replace [`vehicle`] by drivers, drop [`judge`], and put your gear into [`gear`].

pub mod fast;
pub mod gear;
pub mod judge;
pub mod measured;
pub mod page;
pub mod reaction;
pub mod slow;
pub mod table;
pub mod vehicle;
pub mod watch;

#[cfg(all(target_arch = "arm", not(target_has_atomic = "64")))]
pub mod memory;

/// Time between two ticks of the current loop, s.
pub const FAST_TICK: f32 = 50e-6;

/// Time between two ticks of the friction task, s.
pub const SLOW_TICK: f32 = 1e-3;

/// Ticks of the current loop in one of the friction task.
pub const RATIO: u32 = 20;
