//! Makes every fitted coefficient of the crate again, from its definition and in float64, and compares it with the stored one; and shows,
//! for every constant that was chosen and not derived, that the chosen value lies where nothing is gained by another one.
//!
//! | module | stored in |
//! |---|---|
//! | `axis_ratio` | `hertz` |
//! | `backbones` | `law::memory` |
//! | `cube_roots` | `math::own`, `math::powers` |
//! | `sine` | `math::own` |
//! | `nodes` | nodes of interpolation and quadrature, tables of sines, numbers with a name |
//! | `sagitta` | `kinematics::path` |
//! | `preload` | `ball::preload` |

mod axis_ratio;
mod backbones;
mod cube_roots;
mod nodes;
mod preload;
mod remez;
mod sagitta;
mod sine;
