//! Columns of a measurement file: which a command asks for, and what it gets.

use std::collections::BTreeMap;

use super::mapping::Mapping;
use super::samples::Samples;
use crate::units::{Dimension, Quantity, Unit};

/// A quantity that a command reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wanted {
    /// Its column's name.
    pub name: &'static str,
    /// What it is.
    pub quantity: Quantity,
    /// What it cannot be measured in.
    pub refuses: Option<Dimension>,
}

/// What a command asks for.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// Which quantities.
    pub wanted: &'a [Wanted],
    /// Whose raster is taken: the first of these that the file has.
    pub master: &'a [Quantity],
    /// Which channels, where not by name.
    pub mapping: Option<&'a Mapping>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    pub name: String,
    pub quantity: Quantity,
    pub unit: Unit,
    pub values: Vec<f64>,
}

/// Columns on one raster.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Times, s, which never go back.
    pub times: Vec<f64>,
    /// Columns, as long.
    pub columns: Vec<Column>,
    /// Names of channels that were left aside, the first few.
    pub ignored: Vec<String>,
    /// What was done to the samples.
    pub notes: Vec<String>,
}

/// Times of the groups by their numbers, each with whether it is valid.
pub type Times = BTreeMap<usize, Samples>;
