"""The compiled part; what users call is in the package."""

from collections.abc import Sequence
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

Floats = NDArray[np.float64]
Times = NDArray[np.float64] | NDArray[np.int64]

class Error(ValueError): ...

class Settings:
    def __new__(
        cls,
        method: str,
        preset: str,
        rate: str | None,
        checks: list[str],
        period: str | None,
        settings: dict[str, Any],
    ) -> Settings: ...
    def json(self) -> str: ...

class Columns:
    @property
    def names(self) -> list[str]: ...
    def column(self, index: int) -> Any: ...
    def __arrow_c_stream__(self, requested_schema: object = None) -> object: ...

def main(args: Sequence[str]) -> int: ...
def detect(
    values: Floats, times: Times | None, rate: Floats | None, settings: Settings
) -> tuple[NDArray[np.uint8], Floats, Floats, Floats, list[str]]: ...
def advise(
    values: Floats, times: Times | None, rate: Floats | None, methods: list[str], seed: int
) -> tuple[str, list[str]]: ...
def columns(names: list[str], given: list[object]) -> Columns: ...
def methods() -> str: ...
def session(path: str | PathLike[str]) -> str: ...
def judge(
    table: object,
    how: tuple[str | PathLike[str], str | None] | tuple[Settings, list[str]],
    time: str | None,
    track: str | None,
    unit_ns: int | None,
    emit: str,
    whole: bool,
) -> Columns: ...
