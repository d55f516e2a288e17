"""What the tests share: the program, and records with wild points of a fixed seed."""

import os
import pathlib
import subprocess

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def run(*arguments, **options):
    """What a program of the workspace prints; it must succeed."""
    command = [os.fspath(argument) for argument in arguments]
    done = subprocess.run(command, capture_output=True, text=options.pop("text", True), **options)
    assert done.returncode == 0, done.stderr
    return done.stdout


def record(seed=1, rows=600):
    """Times, values of a manoeuvre with noise, wild points and missing values."""
    random = np.random.default_rng(seed)
    # Times count to the nanosecond; here each has six decimals.
    t = np.round(np.cumsum(random.uniform(0.08, 0.12, rows)), 6)
    v = 250 * np.sin(t / 9) + random.normal(size=rows)
    v[random.integers(0, rows, 12)] += random.choice([-60, 35, 400], 12)
    v[random.integers(0, rows, 5)] = np.nan
    return t, v


@pytest.fixture
def sessions():
    """The sessions of the repository without decisions, with a table that has their columns."""
    return sorted((ROOT / "sessions").glob("*.toml"))
