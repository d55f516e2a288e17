//! Files of arrays, which are read as tables.

use super::super::arrays::{MATLAB_BEGINNING, unpack_hdf5, unpack_matlab, unpack_netcdf};
use super::{Form, Packing};

/// HDF5, and so NetCDF-4.
pub(in super::super) const HDF5: Packing = Packing {
    name: "HDF5",
    ending: ".h5",
    known: |start| start.starts_with(b"\x89HDF\r\n\x1a\n"),
    tool: "h5dump -d /NAME FILE, or in Python: h5py.File('FILE')['NAME'][:]",
    joins: false,
    unpack: unpack_hdf5,
    form: Form::Arrays,
};

/// MAT 7.3, which is HDF5 after a text of 512 bytes.
pub(in super::super) const MATLAB: Packing = Packing {
    name: "MAT 7.3",
    ending: ".mat",
    known: |start| start.starts_with(MATLAB_BEGINNING),
    tool: "writematrix([t x], 'OUT.csv')",
    joins: false,
    unpack: unpack_matlab,
    form: Form::Arrays,
};

/// NetCDF-3: classic, with offsets of 64 bits, or with sizes of 64 bits.
pub(in super::super) const NETCDF: Packing = Packing {
    name: "NetCDF",
    ending: ".nc",
    known: |start| matches!(start, [b'C', b'D', b'F', 1 | 2 | 5, ..]),
    tool: "ncdump -v NAME FILE, or in Python: xarray.open_dataset('FILE').to_dataframe().to_csv('OUT.csv')",
    joins: false,
    unpack: unpack_netcdf,
    form: Form::Arrays,
};
