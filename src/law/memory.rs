//! Elements that stick and slip: friction as a hysteresis in angle.
