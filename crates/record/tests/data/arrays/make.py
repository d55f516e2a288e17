"""Writes the files of this folder with h5py and netCDF4: python make.py FOLDER (pip install h5py netCDF4)."""

import sys
from pathlib import Path

import h5py
import netCDF4
import numpy as np

ROWS = 60
I = np.arange(ROWS)
# 20.00, 20.25, ... in a saw of 17 rows, with a wild point in row 30.
SAW = 20.0 + (I * 7 % 17) / 4.0
WILD = np.where(I == 30, 99.5, SAW)


def classic(path):
    """NetCDF-3: one packed variable, one with missing values, flags, and text."""
    with netCDF4.Dataset(path, "w", format="NETCDF3_CLASSIC") as nc:
        nc.createDimension("time", None)
        nc.createDimension("letters", 4)
        time = nc.createVariable("time", "f8", ("time",))
        time.units = "seconds since 2021-03-04 10:00:00 +01:00"
        time.calendar = "standard"
        temp = nc.createVariable("temp", "i2", ("time",), fill_value=-32768)
        temp.units, temp.long_name = "degC", "sea water temperature"
        temp.scale_factor, temp.add_offset = np.float32(0.01), 20.0
        pres = nc.createVariable("pres", "f4", ("time",))
        pres.units, pres.missing_value = "dbar", np.float32(-999.0)
        state = nc.createVariable("temp_state", "i1", ("time",))
        state.flag_values, state.flag_meanings = np.array([1, 4], "i1"), "good bad"
        who = nc.createVariable("who", "S1", ("time", "letters"))
        time[:] = I * 0.5
        temp[:] = np.ma.masked_where(I == 5, WILD)
        pres[:] = np.where(I == 7, -999.0, 10.0 + I / 8.0)
        state[:] = np.where(I == 30, 4, 1)
        who[:] = netCDF4.stringtochar(np.where(I % 2 == 0, "ab", "c,d").astype("S4"))


def offset64(path):
    """NetCDF-3 with offsets of 64 bits: days since 1950 as doubles, a station axis of one, nothing written in places."""
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as nc:
        nc.createDimension("JULD", ROWS)
        nc.createDimension("station", 1)
        time = nc.createVariable("JULD", "f8", ("JULD",))
        time.units, time.standard_name = "days since 1950-01-01T00:00:00Z", "time"
        level = nc.createVariable("level", "f8", ("JULD", "station"))
        level.units = "m"
        # 2021-03-04 10:00:00 and every ten seconds.
        time[:] = 25995.0 + 10.0 / 24.0 + I * 10.0 / 86400.0
        level[:20, 0] = WILD[:20]
        level[21:, 0] = WILD[21:]


def netcdf4(path):
    """NetCDF-4: milliseconds since 1970, a variable of three columns, another table, one that is too wide."""
    with netCDF4.Dataset(path, "w", format="NETCDF4") as nc:
        nc.createDimension("time", None)
        nc.createDimension("axis", 3)
        nc.createDimension("freq", ROWS)
        time = nc.createVariable("time", "i8", ("time",), zlib=True)
        time.units = "milliseconds since 1970-01-01"
        wind = nc.createVariable("wind", "f4", ("time", "axis"), zlib=True, shuffle=True, fletcher32=True)
        wind.units = "m s-1"
        freq = nc.createVariable("freq", "f4", ("freq",))
        freq.units = "Hz"
        spectrum = nc.createVariable("spectrum", "f4", ("time", "freq"), zlib=True)
        time[:] = 1614852000000 + I * 250
        wind[:] = np.stack([WILD, SAW + 1.0, SAW + 2.0], axis=1)
        freq[:] = I / 10.0
        spectrum[:] = np.zeros((ROWS, ROWS))


def groups(path):
    """HDF5: groups of two lengths, each with times of its own; gzip, LZF and none."""
    with h5py.File(path, "w") as f:
        gps = f.create_group("gps")
        gps.create_dataset("t", data=I[:20] * 1.0)
        gps.create_dataset("lat", data=51.0 + I[:20] / 1000.0)
        imu = f.create_group("imu")
        imu.create_dataset("t", data=I * 0.01)
        imu["t"].attrs["units"] = "s"
        ax = imu.create_dataset("ax", data=WILD.astype("f4"), chunks=(16,), compression="lzf", shuffle=True)
        ax.attrs["units"] = "m/s2"
        imu.create_dataset("ay", data=(SAW * 4).astype(">i2"), chunks=(16,), compression="gzip")
        imu.create_dataset("ok", data=I != 30)
        f.attrs["title"] = "a flight"


def latest(path):
    """HDF5 of the newest form: times as text, dimension scales, numbers that are none, a matrix the other way round."""
    with h5py.File(path, "w", libver="latest") as f:
        stamp = ["2021-03-04T10:%02d:%06.3fZ" % (i // 60, i % 60) for i in range(ROWS)]
        f.create_dataset("stamp", data=stamp, dtype=h5py.string_dtype())
        f.create_dataset("height", data=np.where(I == 3, np.nan, WILD), chunks=(7,), maxshape=(None,))
        f["height"].attrs["unit"] = "m"
        f.create_dataset("position", data=np.stack([SAW, SAW * 2]))
        f.create_dataset("z", data=(SAW + 1j * I).astype("c16"))
        f.create_dataset("version", data=3)


def table(path):
    """HDF5: a table of records, with a truth, a name and a nested pair."""
    kind = np.dtype([("time", "i8"), ("range", "f8"), ("name", "S8"), ("good", "?"), ("xy", "f4", (2,))])
    rows = np.zeros(ROWS, kind)
    rows["time"] = 1614852000000000000 + I * 1000000000
    rows["range"] = WILD
    rows["name"] = np.where(I % 2 == 0, b"a", b"#b")
    rows["good"] = I != 30
    rows["xy"] = np.stack([SAW, SAW + 0.5], axis=1)
    with h5py.File(path, "w") as f:
        f.create_group("log").create_dataset("track", data=rows, chunks=(25,), compression="gzip")


def matlab(path):
    """MAT 7.3 as Matlab lays it out: a text of 512 bytes before, vectors of two axes, classes in attributes."""
    with h5py.File(path, "w", userblock_size=512) as f:

        def put(name, data, kind):
            f.create_dataset(name, data=data).attrs["MATLAB_class"] = np.bytes_(kind)

        # 2021-03-04 10:00:00 and every second.
        put("t", (738219.0 + (36000.0 + I) / 86400.0).reshape(1, ROWS), "double")
        f.create_group("s").attrs["MATLAB_class"] = np.bytes_("struct")
        put("s/alt", WILD.reshape(1, ROWS), "double")
        put("s/ok", (I != 30).astype("u1").reshape(ROWS, 1), "logical")
        put("xyz", np.stack([SAW, SAW + 1.0, SAW + 2.0]), "double")
        put("note", np.frombuffer("flight".encode("utf-16-le"), "u2").reshape(6, 1), "char")
    header = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Thu Mar  4 10:00:00 2021 HDF5 schema 1.00 ."
    with open(path, "r+b") as f:
        f.write(header.ljust(124) + b"\x00\x02IM")


def sparse(path):
    """HDF5: eight terabytes of which nothing was written."""
    with h5py.File(path, "w") as f:
        f.create_dataset("t", shape=(1 << 40,), chunks=(1024,), dtype="f8")
        f.create_dataset("x", shape=(1 << 40,), chunks=(1024,), dtype="f8")


def main(folder):
    for make, name in [
        (classic, "classic.nc"),
        (offset64, "offset64.nc"),
        (netcdf4, "netcdf4.nc"),
        (groups, "groups.h5"),
        (latest, "latest.h5"),
        (table, "table.h5"),
        (matlab, "matlab.mat"),
        (sparse, "sparse.h5"),
    ]:
        make(Path(folder) / name)


main(sys.argv[1])
