"""The methods, and which of them to take."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

from numpy.typing import ArrayLike

from . import _wildpoint
from ._detection import as_times, as_values


@dataclass(frozen=True)
class Parameter:
    """A parameter of a method."""

    #: The keyword of `detect`.
    key: str
    #: What it does.
    help: str
    #: Its unit; empty for a plain number.
    unit: str
    #: Which values are legal.
    values: str
    #: The value where none is given.
    default: Any
    #: The value of the source document, where that is another.
    paper: Any = None


@dataclass(frozen=True)
class Method:
    """A published method."""

    id: str
    name: str
    family: str
    #: The source: number of the document, and where in it.
    source: str
    #: When to take it.
    advice: str
    #: True when it needs the argument ``rate``.
    needs_rate: bool
    parameters: tuple[Parameter, ...] = field(repr=False)


def methods() -> list[Method]:
    """All methods with their parameters."""
    return [_method(about) for about in json.loads(_wildpoint.methods())]


def _method(about: dict[str, Any]) -> Method:
    keys = ("key", "help", "unit", "values", "default", "paper")
    parameters = tuple(Parameter(**{key: p[key] for key in keys if key in p}) for p in about["parameters"])
    return Method(**{**about, "parameters": parameters})


@dataclass(frozen=True)
class Advice:
    """Which method finds most on a channel: all were tried with wild points of known size in copies of it."""

    #: Id of the best method; None where the channel cannot be asked.
    method: str | None
    #: Why, one line each.
    reasons: tuple[str, ...]
    #: All that was measured, as ``wildpoint advise --json`` prints it.
    measured: dict[str, Any] = field(repr=False)


def advise(
    values: ArrayLike,
    times: ArrayLike | None = None,
    *,
    rate: ArrayLike | None = None,
    methods: Iterable[str] = (),
    seed: int = 1,
) -> Advice:
    """Says which method to take on a channel; arrays as in `detect`.

    ``methods``
        Ids of the methods that are tried; without them all that vote.
    ``seed``
        Seed of the random wild points: the same one gives the same advice.
    """
    measured_rate = None if rate is None else as_values(rate)
    text, reasons = _wildpoint.advise(as_values(values), as_times(times)[0], measured_rate, list(methods), seed)
    measured = json.loads(text)
    best = measured["recommended"]
    method = None if best is None else measured["methods"][best]["setup"]["method"]
    return Advice(method, tuple(reasons), measured)
