"""Sessions that were saved in the workbench or by ``wildpoint clean --save-session``."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any


from . import _wildpoint


@dataclass(frozen=True)
class Session:
    """Which methods with which settings a session has, by the names of channels."""

    #: Where it was read.
    path: Path
    #: Name of the column of the time, if it has one.
    time: str | None
    #: Name of the column that tells tracks apart, if it has one.
    track: str | None
    #: The method of each channel.
    channels: dict[str, str]
    #: Method, settings, checks and repair of each channel.
    setups: dict[str, dict[str, Any]] = field(repr=False)
    #: How many decisions of an analyst it has.
    decisions: int
    #: The columns that it needs.
    columns: tuple[str, ...] = field(repr=False)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Session:
        """Reads the session file at ``path``. Raises `Error` for one that cannot be used."""
        about = json.loads(_wildpoint.session(os.fspath(path)))
        plans = about["channels"]
        return cls(
            path=Path(path),
            time=about["time"],
            track=about["track"],
            channels={plan["channel"]: plan["setup"]["method"] for plan in plans},
            setups={plan["channel"]: plan["setup"] for plan in plans},
            decisions=sum(plan["decisions"] for plan in plans),
            columns=tuple(about["columns"]),
        )
