//! Files that store arrays under names: HDF5 (NetCDF-4 and MAT 7.3 are such files, too) and NetCDF-3.
//!
//! Arrays along one axis make a table: those along one dimension where the file names its dimensions, else those of one
//! length. Such a table is read as the CSV text that says the same ([`text`]), like a file that stores columns. Moments in
//! the units of the CF conventions (`seconds since 1970-01-01`) are written in ISO 8601.

use std::io::{Read as _, Seek as _, SeekFrom};

use super::packing::{Look, Opened, Packing, Stream, Unpackable};
use super::view::Want;
use crate::memory::Share;

mod array;
mod attributes;
mod cells;
mod cf_time;
mod columns;
mod errors;
mod filters;
mod hdf5;
mod matlab;
mod netcdf;
mod scalar;
mod tables;
mod text;

use array::Store;
use errors::Trouble;
pub(super) use matlab::BEGINNING as MATLAB_BEGINNING;
use tables::Tables;

/// HDF5 and NetCDF-4.
pub(super) fn unpack_hdf5<'a>(
    file: Box<dyn Look + 'a>,
    packed: Stream<'a>,
    want: Want,
) -> Result<Opened<'a>, Unpackable> {
    unpack(&super::packing::HDF5, hdf5::open, (file, packed), want)
}

/// MAT 7.3.
pub(super) fn unpack_matlab<'a>(
    file: Box<dyn Look + 'a>,
    packed: Stream<'a>,
    want: Want,
) -> Result<Opened<'a>, Unpackable> {
    unpack(&super::packing::MATLAB, hdf5::open, (file, packed), want)
}

/// NetCDF-3.
pub(super) fn unpack_netcdf<'a>(
    file: Box<dyn Look + 'a>,
    packed: Stream<'a>,
    want: Want,
) -> Result<Opened<'a>, Unpackable> {
    unpack(&super::packing::NETCDF, netcdf::open, (file, packed), want)
}

/// Finds the arrays in the bytes of a file.
type Open = fn(Vec<u8>) -> Result<Store, Trouble>;

fn unpack<'a>(
    packing: &Packing,
    open: Open,
    (mut file, packed): (Box<dyn Look + 'a>, Stream<'a>),
    want: Want,
) -> Result<Opened<'a>, Unpackable> {
    let told = |trouble: Trouble| trouble.told(packing);
    let length = file.seek(SeekFrom::End(0)).map_err(|e| told(e.into()))?;
    // The bytes, and what the library keeps of them.
    let share = Share::of(length.saturating_mul(2)).map_err(|full| told(full.into()))?;
    file.seek(SeekFrom::Start(0)).map_err(|e| told(e.into()))?;
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or_default());
    file.read_to_end(&mut bytes).map_err(|e| told(e.into()))?;
    let store = open(bytes).map_err(told)?;
    let tables = Tables::of(&store).map_err(told)?;
    let chosen = tables.chosen(want).map_err(told)?;
    text::text((store, share), chosen, (packed, length)).map_err(told)
}
