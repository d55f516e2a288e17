"""Tables with one track or many: pandas, polars, pyarrow, and whatever else hands over Arrow."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from . import _wildpoint
from ._detection import Verdict, as_values
from ._session import Session
from ._settings import settings_of

_WORDS = [verdict.name.lower() for verdict in Verdict]
_UNITS = {"s": 1_000_000_000, "ms": 1_000_000, "us": 1_000, "ns": 1}


def clean(
    table: Any,
    session: Session | str | os.PathLike[str] | Mapping[str, Any] | None = None,
    *,
    time: str | None = None,
    time_unit: str | None = None,
    track: str | None = None,
    channels: str | Iterable[str] | None = None,
    emit: str = "samples",
    decisions: str | None = None,
    **settings: Any,
) -> Any:
    """Finds and repairs the wild points in the channels of a table, and gives a table of the same kind.

    ``table``
        A pandas or polars frame, a pyarrow table, or an object with ``__arrow_c_stream__``. Its rows may be in any order.
    ``session``
        A saved session or its path; or a dictionary with ``method`` and other settings, which may as well be given as
        keywords: ``clean(frame, time="t", method="hampel", k=4)``. Those of `detect` are known; ``rate`` is the name of a
        column here.
    ``time``
        Column of the time: a timestamp, or a number. Without it that of the session, or a ``DatetimeIndex`` of pandas.
    ``time_unit``
        Unit of a time that is a number: ``"s"``, ``"ms"``, ``"us"``, ``"ns"``. Without it that of the session, of the name
        (``t_ms``), or seconds.
    ``track``
        Column that tells tracks apart; each is judged alone.
    ``channels``
        Columns to judge. Without them those of the session, or all columns of numbers.
    ``emit``
        ``"samples"``: the table with ``CHANNEL_verdict`` (normal, outlier, suspect, unchecked, missing) and
        ``CHANNEL_clean`` beside it. ``"flags"``: a row for each sample that is not normal, with what was expected; ``row``
        counts the rows of the table from 1. ``"summary"``: counts and digest of each channel of each track.
    ``decisions``
        Id of the track that the analyst's decisions of the session are for; they hold where time and value are the same.
        A session with decisions is refused without it.

    Raises `Error` for a table or a session that does not fit.
    """
    kind = _kind_of(table)
    if isinstance(session, Mapping):
        settings = {**session, **settings}
        session = None
    if session is not None:
        if settings or channels is not None:
            what = ", ".join([*settings, *(["channels"] if channels is not None else [])])
            raise _wildpoint.Error(f"a session and {what}\n  give one of them: the session says what is done")
        if not isinstance(session, Session):
            session = Session.load(session)
        how: Any = (os.fspath(session.path), decisions)
        time, track = time or session.time, track or session.track
        needed = list(session.columns)
    else:
        time = time or kind.time
        chosen = settings_of(**settings)
        if isinstance(channels, str):
            channels = [channels]
        needed = [name for name in kind.numbers if name not in (time, track)] if channels is None else list(channels)
        how = (chosen, needed)
        rate = settings.get("rate")
        if channels is None and rate in needed:
            needed.remove(rate)
        needed = [*needed, *([rate] if rate and rate not in needed else [])]
    if time is None:
        raise _wildpoint.Error(f"no column is named as the time\n  name it with time=; columns: {', '.join(kind.names)}")
    if time_unit is not None and time_unit not in _UNITS:
        raise _wildpoint.Error(f"time_unit {time_unit}: there is no such unit\n  {', '.join(_UNITS)}")
    unit_ns = None if time_unit is None else _UNITS[time_unit]
    given = kind.handed_over(time, track, needed)
    made = _wildpoint.judge(given, how, time, track, unit_ns, emit, kind.whole)
    if emit != "samples":
        return kind.rows(made, time, track)
    twice = [] if kind.whole else [name for name in made.names if name in kind.names]
    if twice:
        raise _wildpoint.Error(f"{twice[0]}: the table has such a column already\n  leave it out, or rename it")
    return kind.samples(made)


def _kind_of(table: Any) -> _Kind:
    for library, kind in [("pandas", _Pandas), ("polars", _Polars), ("pyarrow", _Pyarrow)]:
        # What was not imported cannot have made the table.
        module = sys.modules.get(library)
        if module is not None and isinstance(table, getattr(module, "Series", ())):
            raise _no_table(table)
        if module is not None and kind.makes(module, table):
            return kind(module, table)
    if hasattr(table, "__arrow_c_stream__"):
        return _Kind(None, table)
    raise _no_table(table)


def _no_table(given: Any) -> _wildpoint.Error:
    help = "give a frame of pandas or polars, or a table of Arrow; detect() judges arrays"
    return _wildpoint.Error(f"{type(given).__name__}: no table\n  {help}")


class _Kind:
    """A kind of table: any that hands over Arrow."""

    #: True when the columns of the input come back from Arrow, too.
    whole = True

    def __init__(self, module: Any, table: Any) -> None:
        self.module, self.table = module, table
        #: The column of the time, where the table itself says so.
        self.time: str | None = None

    @staticmethod
    def makes(module: Any, table: Any) -> bool:
        """Whether the library ``module`` has made ``table``."""
        raise NotImplementedError

    @property
    def names(self) -> list[str]:
        """The names of its columns."""
        if hasattr(self.table, "column_names"):
            return list(self.table.column_names)
        return [str(name) for name in getattr(self.table, "columns", [])]

    @property
    def numbers(self) -> list[str]:
        """The names of its columns of numbers."""
        raise _wildpoint.Error("no channels are named\n  name them with channels=")

    def handed_over(self, time: str, track: str | None, needed: list[str]) -> Any:
        """The table as Arrow."""
        return self.table

    def samples(self, made: _wildpoint.Columns) -> Any:
        """The table with the new columns."""
        return self.rows(made, "", None)

    def rows(self, made: _wildpoint.Columns, time: str, track: str | None) -> Any:
        """Another table of the same kind."""
        own = getattr(type(self.table), "from_arrow", None)
        if own is not None:
            return own(made)
        try:
            import pyarrow
        except ImportError:
            return made
        return pyarrow.table(made)


class _Polars(_Kind):
    whole = False

    @staticmethod
    def makes(module: Any, table: Any) -> bool:
        if isinstance(table, module.LazyFrame):
            raise _wildpoint.Error("a LazyFrame has no rows yet\n  give frame.collect()")
        return isinstance(table, module.DataFrame)

    @property
    def numbers(self) -> list[str]:
        return [name for name, kind in self.table.schema.items() if kind.is_numeric()]

    def handed_over(self, time: str, track: str | None, needed: list[str]) -> Any:
        wanted = {time, track, *needed}
        return self.table.select([name for name in self.table.columns if name in wanted])

    def samples(self, made: _wildpoint.Columns) -> Any:
        return self.table.hstack(self.module.DataFrame(made))

    def rows(self, made: _wildpoint.Columns, time: str, track: str | None) -> Any:
        return self.module.DataFrame(made)


class _Pyarrow(_Kind):
    whole = False

    @staticmethod
    def makes(module: Any, table: Any) -> bool:
        return isinstance(table, (module.Table, module.RecordBatch))

    @property
    def numbers(self) -> list[str]:
        types = self.module.types
        number = lambda kind: types.is_integer(kind) or types.is_floating(kind) or types.is_decimal(kind)
        return [column.name for column in self.table.schema if number(column.type)]

    def handed_over(self, time: str, track: str | None, needed: list[str]) -> Any:
        wanted = {time, track, *needed}
        return self.table.select([name for name in self.table.schema.names if name in wanted])

    def samples(self, made: _wildpoint.Columns) -> Any:
        out = self.table
        new = self.module.table(made)
        if isinstance(out, self.module.RecordBatch):
            new = new.combine_chunks()
        for name, column in zip(new.column_names, new.columns):
            out = out.append_column(name, column.chunk(0) if isinstance(out, self.module.RecordBatch) else column)
        return out

    def rows(self, made: _wildpoint.Columns, time: str, track: str | None) -> Any:
        return self.module.table(made)


class _Pandas(_Kind):
    """Through numpy: pandas hands over Arrow only where pyarrow is."""

    whole = False

    def __init__(self, module: Any, table: Any) -> None:
        super().__init__(module, table)
        if isinstance(table.index, (module.DatetimeIndex, module.TimedeltaIndex)):
            self.time = table.index.name or "index"

    @staticmethod
    def makes(module: Any, table: Any) -> bool:
        return isinstance(table, module.DataFrame)

    @property
    def names(self) -> list[str]:
        return [str(name) for name in self.table.columns]

    @property
    def numbers(self) -> list[str]:
        api = self.module.api.types
        number = lambda column: api.is_numeric_dtype(column) and not api.is_bool_dtype(column)
        return [name for name, column in self.table.items() if isinstance(name, str) and number(column)]

    def _column(self, name: str) -> Any:
        if name in self.table.columns:
            column = self.table[name]
            if column.ndim == 2:
                raise _wildpoint.Error(f"{name}: two columns have this name\n  rename one of them")
            return column
        if name in self.table.index.names or name == self.time:
            level = self.table.index.names.index(name) if name in self.table.index.names else 0
            return self.table.index.get_level_values(level).to_series()
        return None

    def handed_over(self, time: str, track: str | None, needed: list[str]) -> Any:
        names, given = [], []
        for name in dict.fromkeys([time, *([track] if track else []), *needed]):
            column = self._column(name)
            # A name that is not there is told by who needs it.
            if column is not None:
                names.append(name)
                given.append(self._words(column) if name == track else self._numbers(name, column))
        return _wildpoint.columns(names, given)

    def _words(self, column: Any) -> Any:
        codes, words = self.module.factorize(column)
        return codes.astype(np.int32), [str(word) for word in words]

    def _numbers(self, name: str, column: Any) -> Any:
        kind = column.dtype
        if getattr(kind, "tz", None) is not None:
            column = column.dt.tz_convert("UTC").dt.tz_localize(None)
        elif not (self.module.api.types.is_numeric_dtype(kind) or kind.kind in "mM"):
            raise _wildpoint.Error(
                f"{name}: {kind} is no number and no time\n  convert it with pandas.to_numeric or pandas.to_datetime"
            )
        if getattr(kind, "kind", "") in "mM":
            array = column.to_numpy()
            unit = "datetime64[ns]" if array.dtype.kind == "M" else "timedelta64[ns]"
            return np.ascontiguousarray(array.astype(unit)).view(np.int64), "ns"
        if kind in (np.dtype("int64"), np.dtype("int32"), np.dtype("int16"), np.dtype("int8")):
            return np.ascontiguousarray(column.to_numpy(dtype=np.int64))
        return as_values(column)

    def samples(self, made: _wildpoint.Columns) -> Any:
        out = self.table.copy(deep=False)
        for at, name in enumerate(made.names):
            column = made.column(at)
            if isinstance(column, list):
                column = self.module.Categorical(column, categories=_WORDS)
            out[name] = column
        return out

    def rows(self, made: _wildpoint.Columns, time: str, track: str | None) -> Any:
        names = made.names
        columns = {at: made.column(at) for at in range(len(names))}
        if "row" in names and "verdict" in names:
            # Time and track as the frame has them.
            last = {name: at for at, name in enumerate(names)}
            places = columns[last["row"]] - 1
            columns[last["time"]] = self._column(time).iloc[places].array
            if track is not None:
                columns[0] = self._column(track).iloc[places].array
        out = self.module.DataFrame(columns)
        out.columns = names
        return out
