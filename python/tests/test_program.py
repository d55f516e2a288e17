"""The package carries the program."""

import doctest
import os
import pathlib
import subprocess
import sys

import wildpoint
from conftest import ROOT, run


def program(*arguments):
    return subprocess.run([sys.executable, "-m", "wildpoint", *arguments], capture_output=True, text=True)


def test_the_program_is_the_same(tmp_path):
    demo = ROOT / "data" / "demo.csv"
    arguments = ["clean", os.fspath(demo), "--json"]
    assert program(*arguments).stdout == run("wildpoint", *arguments)
    assert program("--version").stdout == run("wildpoint", "--version")


def test_its_exit_status_is_that_of_the_program():
    missing = program("clean", "absent.csv")
    assert missing.returncode == 2 and "absent.csv" in missing.stderr and "Traceback" not in missing.stderr
    wrong = program("clean", "--no-such-option")
    assert wrong.returncode == 2 and "--no-such-option" in wrong.stderr


def test_the_examples_of_the_package_and_of_its_page_run(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    assert doctest.testmod(wildpoint).failed == 0
    page = pathlib.Path(__file__).resolve().parent.parent / "README.md"
    done = doctest.testfile(os.fspath(page), module_relative=False, optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    assert done.attempted > 5 and done.failed == 0


def test_every_public_name_says_what_it_is():
    for name in wildpoint.__all__:
        if name != "__version__":
            assert getattr(wildpoint, name).__doc__, name
