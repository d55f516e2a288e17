"""Settings from keyword arguments."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from . import _wildpoint

#: The method when none is named: the default of the program.
METHOD = "two-sided"


def settings_of(
    method: str = METHOD,
    *,
    preset: str = "default",
    rate: str | None = None,
    checks: Iterable[str] = (),
    period: float | str | None = None,
    **settings: Any,
) -> _wildpoint.Settings:
    """A method with its settings; errors are those of ``wildpoint clean``."""
    period = None if period is None else str(period)
    return _wildpoint.Settings(method, preset, rate, list(checks), period, settings)
