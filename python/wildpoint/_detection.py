"""One channel in arrays."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _wildpoint
from ._settings import METHOD, settings_of


class Verdict(IntEnum):
    """What is said of a sample."""

    #: Nothing is wrong with it.
    NORMAL = 0
    #: The target cannot have produced it; it is repaired, or removed.
    OUTLIER = 1
    #: It is doubtful, and kept.
    SUSPECT = 2
    #: Nobody could judge it.
    UNCHECKED = 3
    #: There is no value.
    MISSING = 4


@dataclass(frozen=True)
class Detection:
    """What was found in a channel of *n* samples."""

    #: The values that were judged, shape (n,).
    values: NDArray[np.float64] = field(repr=False)
    #: Their times as they were given, shape (n,); None where the samples were counted.
    times: NDArray[Any] | None = field(repr=False)
    #: A `Verdict` for each sample, shape (n,), uint8.
    verdicts: NDArray[np.uint8] = field(repr=False)
    #: What the method expected of each sample, in the unit of the values, shape (n,); NaN where nothing.
    expected: NDArray[np.float64] = field(repr=False)
    #: The largest deviation from it that is not flagged, in the unit of the values, shape (n,); NaN where there is none.
    tolerance: NDArray[np.float64] = field(repr=False)
    #: The values with repairs in place of outliers, shape (n,); NaN where a value is missing or was removed.
    clean: NDArray[np.float64] = field(repr=False)
    #: Id of the method.
    method: str
    #: All of its settings.
    settings: dict[str, Any]
    #: What should be known about this result, one line each.
    warnings: tuple[str, ...]

    @property
    def outlier(self) -> NDArray[np.bool_]:
        """True where a sample is an outlier, shape (n,)."""
        return self.verdicts == Verdict.OUTLIER

    @property
    def suspect(self) -> NDArray[np.bool_]:
        """True where a sample is doubtful, shape (n,)."""
        return self.verdicts == Verdict.SUSPECT

    @property
    def unchecked(self) -> NDArray[np.bool_]:
        """True where nobody could judge a sample, shape (n,)."""
        return self.verdicts == Verdict.UNCHECKED

    @property
    def missing(self) -> NDArray[np.bool_]:
        """True where there is no value, shape (n,)."""
        return self.verdicts == Verdict.MISSING

    def __repr__(self) -> str:
        counts = ", ".join(f"{int(mask.sum())} {what}" for mask, what in self._kinds())
        return f"Detection({self.method}: {len(self.verdicts)} samples, {counts})"

    def _kinds(self) -> list[tuple[NDArray[np.bool_], str]]:
        return [(self.outlier, "outliers"), (self.suspect, "suspects"), (self.unchecked, "unchecked")]

    def plot(self, ax: Any = None) -> Any:
        """Draws values, tolerance band, repairs and flags with matplotlib.

        ``ax``: the axes to draw on; new ones where None. Returns the axes.
        """
        try:
            import matplotlib.pyplot as plt
        except ImportError as error:
            raise ImportError("plot() needs matplotlib\n  pip install matplotlib") from error
        if ax is None:
            ax = plt.subplots(figsize=(10, 4), layout="constrained")[1]
        x = np.arange(len(self.values)) if self.times is None else self.times
        low, high = self.expected - self.tolerance, self.expected + self.tolerance
        ax.fill_between(x, low, high, color="0.9", linewidth=0, label="tolerance")
        ax.plot(x, self.values, ".-", color="0.45", linewidth=0.6, markersize=3, label="measured")
        marks = [("outlier", self.outlier, "x", "tab:red"), ("suspect", self.suspect, "o", "tab:orange")]
        for label, mask, marker, color in marks:
            if mask.any():
                fill = {"facecolors": "none"} if marker == "o" else {}
                edge = {"edgecolors": color} if marker == "o" else {"color": color}
                ax.scatter(x[mask], self.values[mask], marker=marker, label=label, zorder=3, **fill, **edge)
        if self.outlier.any():
            ax.scatter(x[self.outlier], self.clean[self.outlier], s=9, color="tab:blue", label="repaired", zorder=3)
        ax.legend(loc="best")
        return ax


def detect(
    values: ArrayLike,
    times: ArrayLike | None = None,
    method: str = METHOD,
    *,
    preset: str = "default",
    rate: ArrayLike | None = None,
    checks: Iterable[str] = (),
    period: float | str | None = None,
    **settings: Any,
) -> Detection:
    """Finds and repairs the wild points of one channel, as ``wildpoint clean`` does it.

    ``values``
        The measured values, shape (n,); NaN is missing.
    ``times``
        Their times, shape (n,): seconds, or ``datetime64``; they count to the nanosecond. Without times, samples are a
        second apart.
    ``method``
        Id of a method; `methods` lists them.
    ``preset``
        ``"default"``, or ``"paper"`` for the values of the source document.
    ``rate``
        The measured rate of change (unit of the values per second), shape (n,), for methods that need one.
    ``checks``
        Checks before the method, as ``"valid-range:low=0,high=500"``; without them those that the values clearly need.
    ``period``
        Period of a circular channel (360, 24, ``"2pi"``), or ``"off"``.
    ``settings``
        Parameters of the method and of the repair, as ``k=4``, ``window="30s"``, ``repair="linear"``.

    Raises `Error` for arguments that do not fit.
    """
    measured = as_values(values)
    moments, given = as_times(times)
    measured_rate = None if rate is None else as_values(rate)
    chosen = settings_of(
        method,
        preset=preset,
        rate=None if rate is None else "rate",
        checks=checks,
        period=period,
        **settings,
    )
    verdicts, expected, tolerance, clean, warnings = _wildpoint.detect(measured, moments, measured_rate, chosen)
    setup = json.loads(chosen.json())
    return Detection(
        measured, given, verdicts, expected, tolerance, clean, setup["method"], setup["settings"], tuple(warnings)
    )


def as_values(values: ArrayLike) -> NDArray[np.float64]:
    """Numbers in one dimension."""
    if hasattr(values, "to_numpy"):
        try:
            values = values.to_numpy(dtype="float64", na_value=np.nan)
        except TypeError:
            values = values.to_numpy()
    array = np.ascontiguousarray(np.ma.filled(np.ma.asarray(values, dtype=np.float64), np.nan))
    if array.ndim != 1:
        raise _wildpoint.Error(f"an array of {array.ndim} dimensions\n  give one channel, of shape (n,)")
    return array


def as_times(times: ArrayLike | None) -> tuple[NDArray[Any] | None, NDArray[Any] | None]:
    """Times as seconds or as nanoseconds since 1970, and as they were given."""
    if times is None:
        return None, None
    if getattr(getattr(times, "dtype", None), "tz", None) is not None:
        times = (times.dt if hasattr(times, "dt") else times).tz_convert("UTC").tz_localize(None)
    given = np.asarray(times)
    if given.dtype.kind in "mM":
        unit = "datetime64[ns]" if given.dtype.kind == "M" else "timedelta64[ns]"
        return np.ascontiguousarray(given.astype(unit).view(np.int64)), given
    return as_values(given), given
