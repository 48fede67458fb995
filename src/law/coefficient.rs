//! Friction coefficient by speed, temperature and direction; churning drag.
