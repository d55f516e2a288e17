"""`detect` against `wildpoint clean` on the same record, number by number."""

import csv
import json

import numpy as np
import pytest
import wildpoint
from conftest import record, run

METHODS = [method.id for method in wildpoint.methods() if not method.needs_rate]


def write(path, t, **columns):
    cell = lambda value: "" if np.isnan(value) else repr(float(value))
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["t", *columns])
        writer.writerows(zip(map(cell, t), *(map(cell, column) for column in columns.values()), strict=True))


def of_program(path, *options):
    """Verdict, expected value and tolerance of each row, from the table of diagnostics."""
    table = path.with_suffix(".diagnostics.csv")
    run("wildpoint", "clean", path, "--diagnostics", table, "--force", "--json", "--channel", "v", *options)
    with open(table) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    number = lambda text: float(text) if text else np.nan
    return [row["verdict"] for row in rows], *(np.array([number(row[c]) for row in rows]) for c in ("expected", "tolerance"))


def same(found, program):
    verdicts, expected, tolerance = program
    assert [wildpoint.Verdict(v).name.lower() for v in found.verdicts] == verdicts
    np.testing.assert_array_equal(found.expected, expected)
    # The table leaves out a tolerance of 0 that flags nothing.
    np.testing.assert_array_equal(np.where(np.isnan(tolerance), np.nan, found.tolerance), tolerance)


@pytest.mark.parametrize("method", METHODS)
def test_every_method_says_what_the_program_says(method, tmp_path):
    t, v = record()
    write(tmp_path / "r.csv", t, v=v)
    found = wildpoint.detect(v, t, method)
    same(found, of_program(tmp_path / "r.csv", "--method", method))
    assert found.method == method and len(found.clean) == len(v)


def test_settings_presets_checks_and_periods_are_those_of_the_program(tmp_path):
    t, v = record(seed=2)
    write(tmp_path / "r.csv", t, v=v % 360)
    options = "--method hampel --set k=5 --set window=31 --check valid-range:low=1,high=350 --period 360".split()
    found = wildpoint.detect(v % 360, t, "hampel", k=5, window=31, checks=["valid-range:low=1,high=350"], period=360)
    same(found, of_program(tmp_path / "r.csv", *options))
    paper = wildpoint.detect(v % 360, t, "poly-window", preset="paper")
    same(paper, of_program(tmp_path / "r.csv", "--method", "poly-window", "--preset", "paper"))


def test_a_rate_goes_beside_the_values(tmp_path):
    t, v = record(seed=3)
    rate = np.gradient(np.nan_to_num(v), t)
    write(tmp_path / "r.csv", t, v=v, rate=rate)
    same(wildpoint.detect(v, t, "matched", rate=rate), of_program(tmp_path / "r.csv", "--method", "matched", "--rate", "rate"))
    with pytest.raises(wildpoint.Error, match="rate"):
        wildpoint.detect(v, t, "matched")


def test_times_may_be_dates_or_none(tmp_path):
    t, v = record()
    ns = np.round(t * 1e9).astype(np.int64)
    seconds = wildpoint.detect(v, ns / 1e9)
    dates = wildpoint.detect(v, np.datetime64("2024-05-01", "ns") + ns)
    np.testing.assert_array_equal(seconds.verdicts, dates.verdicts)
    counted = wildpoint.detect(v)
    np.testing.assert_array_equal(counted.verdicts, wildpoint.detect(v, np.arange(len(v))).verdicts)
    without = t.copy()
    without[7] = np.nan
    assert wildpoint.detect(v, without).verdicts[7] in (wildpoint.Verdict.MISSING, wildpoint.Verdict.UNCHECKED)


def test_rows_may_be_in_any_order():
    t, v = record()
    order = np.random.default_rng(5).permutation(len(v))
    sorted_, mixed = wildpoint.detect(v, t), wildpoint.detect(v[order], t[order])
    np.testing.assert_array_equal(sorted_.verdicts[order], mixed.verdicts)
    np.testing.assert_array_equal(sorted_.expected[order], mixed.expected)
    np.testing.assert_array_equal(sorted_.clean[order], mixed.clean)


def test_a_repair_stands_where_an_outlier_was_and_nowhere_else():
    t, v = record()
    found = wildpoint.detect(v, t)
    assert 8 <= found.outlier.sum() <= 14
    changed = ~((found.clean == v) | (np.isnan(found.clean) & np.isnan(v)))
    assert (changed <= (found.outlier | found.missing)).all() and changed[found.outlier].all()
    assert found.missing.sum() == np.isnan(v).sum()
    assert repr(found).startswith("Detection(two-sided: 600 samples, ")


@pytest.mark.parametrize(
    "arguments, words",
    [
        (dict(method="hampl"), "did you mean hampel"),
        (dict(method="hampel", windw=5), "windw"),
        (dict(method="hampel", k=-1), "k"),
        (dict(preset="best"), "default, paper"),
        (dict(checks=["valid-rang:low=1"]), "valid-range"),
        (dict(period="north"), "period"),
        (dict(times=[1.0, 2.0]), "same length"),
    ],
)
def test_what_does_not_fit_is_an_error_with_the_way_out(arguments, words):
    _, v = record()
    with pytest.raises(wildpoint.Error, match=words):
        wildpoint.detect(v, **arguments)
    assert issubclass(wildpoint.Error, ValueError)
    with pytest.raises(wildpoint.Error, match="2 dimensions"):
        wildpoint.detect(np.zeros((2, 2)))


def test_methods_are_those_of_the_program():
    listed = json.loads(run("wildpoint", "methods", "--json"))
    assert [m.id for m in wildpoint.methods()] == [m["id"] for m in listed]
    first = wildpoint.methods()[0]
    assert [p.key for p in first.parameters] == [p["key"] for p in listed[0]["parameters"]]


def test_advice_is_that_of_the_program(tmp_path):
    t, v = record(rows=400)
    write(tmp_path / "r.csv", t, v=v)
    told = json.loads(run("wildpoint", "advise", tmp_path / "r.csv", "--channel", "v", "--json"))
    advice = wildpoint.advise(v, t)
    assert advice.method == told["methods"][told["recommended"]]["setup"]["method"]
    assert [m["recall"] for m in advice.measured["methods"]] == [m["recall"] for m in told["methods"]]
    assert wildpoint.advise(v[:5]).method is None and wildpoint.advise(v[:5]).reasons


def test_other_threads_run_while_a_record_is_judged():
    import threading

    v = np.random.default_rng(1).normal(size=400_000)
    over, counted = threading.Event(), 0
    worker = threading.Thread(target=lambda: (wildpoint.detect(v), over.set()))
    worker.start()
    while not over.wait(0.001):
        counted += 1
    worker.join()
    # Held for the whole call, the lock would let this loop go on once or twice.
    assert counted > 5


def test_plot_draws_each_kind(tmp_path):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("svg")
    t, v = record()
    axes = wildpoint.detect(v, t).plot()
    labels = {text.get_text() for text in axes.get_legend().get_texts()}
    assert {"tolerance", "measured", "outlier", "repaired"} <= labels
    axes.figure.savefig(tmp_path / "plot.svg")
