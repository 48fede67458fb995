//! No code: its manifest has the features that programs of this workspace share.
#![no_std]
