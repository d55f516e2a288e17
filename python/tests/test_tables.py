"""`clean` against `wildpoint-kernel` on the same rows, and what comes back for each kind of table."""

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
import wildpoint
from conftest import ROOT, record, run

polars = pytest.importorskip("polars")

SESSION = """format = 1
[data]
file = "none.csv"
sha256 = ""
rows = 0
time = "t"
track = "pass"
[[channel]]
name = "v"
method = "hampel"
settings = { k = 4 }
[[channel]]
name = "w"
method = "two-sided"
"""


def frame(tracks=3):
    parts = []
    for track in range(tracks):
        t, v = record(seed=track)
        parts.append(pd.DataFrame({"pass": f"p{track}", "t": t, "v": v, "w": record(seed=track + 9)[1]}))
    return pd.concat(parts, ignore_index=True)


@pytest.fixture
def session(tmp_path):
    path = tmp_path / "s.toml"
    path.write_text(SESSION)
    return path


def kernel(table, session, *options):
    """What the kernel gives for a table whose rows are in order."""
    stream = pa.BufferOutputStream()
    with pa.ipc.new_stream(stream, table.schema) as writer:
        writer.write_table(table)
    made = run("wildpoint-kernel", "--session", session, *options, input=stream.getvalue().to_pybytes(), text=False)
    return pa.ipc.open_stream(made).read_all()


@pytest.mark.parametrize("emit", ["samples", "flags", "summary"])
def test_a_session_gives_what_the_kernel_gives(session, emit):
    table = pa.Table.from_pandas(frame(), preserve_index=False)
    expected = kernel(table, session, "--emit", emit)
    made = wildpoint.clean(table, session, emit=emit)
    if emit == "flags":
        # The kernel counts the rows of each track, and this table those of the table.
        start = {f"p{n}": n * 600 for n in range(3)}
        for name in ("row", "run_start"):
            rows = [None if r is None else r + start[p] for r, p in zip(expected[name].to_pylist(), expected["pass"].to_pylist())]
            expected = expected.set_column(expected.schema.get_field_index(name), name, pa.array(rows, pa.int64()))
    assert made.column_names == expected.column_names
    for name in made.column_names:
        assert made[name].combine_chunks().equals(expected[name].combine_chunks()), name


def of_any(made, name):
    """A column, None where there is nothing."""
    column = made[name]
    values = column.to_pylist() if hasattr(column, "to_pylist") else column.to_list()
    return [None if pd.isna(value) else value for value in values]


@pytest.mark.parametrize("kind", ["pandas", "polars", "pyarrow", "batch", "capsule"])
@pytest.mark.parametrize("emit", ["samples", "flags", "summary"])
def test_every_kind_of_table_gives_the_same(session, kind, emit):
    rows = frame().sample(frac=1, random_state=4)
    table = pa.Table.from_pandas(rows, preserve_index=False)
    whole = pa.RecordBatch.from_pandas(rows, preserve_index=False)

    class Capsule:
        def __arrow_c_stream__(self, requested_schema=None):
            return table.__arrow_c_stream__(requested_schema)

    given = {"pandas": rows, "polars": polars.from_arrow(table), "pyarrow": table, "batch": whole, "capsule": Capsule()}[kind]
    made = wildpoint.clean(given, session, emit=emit)
    expected = wildpoint.clean(table, session, emit=emit)
    types = {"pandas": pd.DataFrame, "polars": polars.DataFrame, "batch": pa.RecordBatch if emit == "samples" else pa.Table}
    assert isinstance(made, types.get(kind, pa.Table))
    names = list(made.schema.names if hasattr(made, "schema") and kind != "polars" else made.columns)
    assert names == expected.column_names
    for name in names:
        assert of_any(made, name) == of_any(expected, name), name
    if kind == "pandas" and emit == "samples":
        assert made.index.equals(rows.index) and list(made["v_verdict"].cat.categories)[0] == "normal"
        assert "v_verdict" not in rows.columns


def test_settings_are_those_of_a_new_session_on_each_track():
    rows = frame(2)
    made = wildpoint.clean(rows, time="t", track="pass", channels="v", method="hampel", k=5)
    again = wildpoint.clean(rows, {"method": "hampel", "k": 5}, time="t", track="pass", channels=["v"])
    pd.testing.assert_frame_equal(made, again)
    for track, own in rows.groupby("pass"):
        found = wildpoint.detect(own["v"], own["t"], "hampel", k=5)
        of_track = made[made["pass"] == track]
        assert [wildpoint.Verdict(v).name.lower() for v in found.verdicts] == list(of_track["v_verdict"])
        np.testing.assert_array_equal(of_track["v_clean"], found.clean)
    assert {"v_clean", "w_clean"} <= set(wildpoint.clean(rows, time="t", track="pass").columns)


def test_the_index_of_pandas_can_be_the_time():
    t, v = record()
    seconds = pd.DataFrame({"t": t, "v": v})
    index = pd.to_datetime(np.round(t * 1e9).astype("int64"))
    for zone in (None, "Asia/Shanghai"):
        dated = pd.DataFrame({"v": v}, index=index.tz_localize("UTC").tz_convert(zone) if zone else index)
        made = wildpoint.clean(dated)
        assert list(made["v_verdict"]) == list(wildpoint.clean(dated.rename_axis("when").reset_index(), time="when")["v_verdict"])
        flags = wildpoint.clean(dated, emit="flags")
        assert (flags["time"] == dated.index[flags["row"] - 1]).all()
    assert (made["v_verdict"].to_numpy() == wildpoint.clean(seconds, time="t")["v_verdict"].to_numpy()).mean() > 0.99


def test_whole_numbers_of_nanoseconds_keep_every_digit():
    t, v = record()
    ns = 1_700_000_000_000_000_000 + np.round(t * 1e9).astype("int64")
    whole = wildpoint.clean(pd.DataFrame({"t_ns": ns, "v": v}), time="t_ns", emit="summary")
    dates = wildpoint.clean(pd.DataFrame({"t_ns": pd.to_datetime(ns), "v": v}), time="t_ns", emit="summary")
    assert whole["digest"].tolist() == dates["digest"].tolist()
    told = wildpoint.clean(pd.DataFrame({"n": ns, "v": v}), time="n", time_unit="ns", emit="summary")
    assert told["digest"].tolist() == dates["digest"].tolist()


def test_a_session_with_decisions_is_refused_and_one_on_the_record_is_read():
    decided = ROOT / "sessions" / "descent_decisions.toml"
    session = wildpoint.Session.load(decided)
    assert session.decisions > 0 and session.channels
    table = pd.DataFrame({name: np.zeros(3) for name in {*session.columns, session.time}})
    with pytest.raises(wildpoint.Error, match="decisions=TRACK"):
        wildpoint.clean(table, session)


@pytest.mark.parametrize(
    "call, error, words",
    [
        (lambda f, s: wildpoint.clean(f.drop(columns="w"), s), wildpoint.Error, "w: no such column"),
        (lambda f, s: wildpoint.clean(f, s, time="tt"), wildpoint.Error, r"tt: no such column, the time \(time= names"),
        (lambda f, s: wildpoint.clean(f, s, k=3), wildpoint.Error, "give one of them"),
        (lambda f, s: wildpoint.clean(f), wildpoint.Error, "name it with time="),
        (lambda f, s: wildpoint.clean(f, s, emit="all"), wildpoint.Error, "samples, flags, summary"),
        (lambda f, s: wildpoint.clean(f, s, time_unit="min"), wildpoint.Error, "s, ms, us, ns"),
        (lambda f, s: wildpoint.clean(f["v"], s), wildpoint.Error, "detect"),
        (lambda f, s: wildpoint.clean(pa.chunked_array([f["v"]]), s), wildpoint.Error, "no table"),
        (lambda f, s: wildpoint.clean(f, "absent.toml"), FileNotFoundError, "absent.toml"),
        (lambda f, s: wildpoint.clean(f.assign(v="x"), s), wildpoint.Error, "v: .* is no number"),
        (lambda f, s: wildpoint.clean(f.assign(**{"v_clean": 1.0}), s), wildpoint.Error, "v_clean"),
        (lambda f, s: wildpoint.clean(polars.from_pandas(f).lazy(), s), wildpoint.Error, "collect"),
    ],
)
def test_what_does_not_fit_is_an_error_with_the_way_out(session, call, error, words):
    with pytest.raises(error, match=words):
        call(frame(1), session)


def test_a_row_without_a_track_is_an_error(session):
    rows = frame(1)
    rows.loc[5, "pass"] = None
    with pytest.raises(wildpoint.Error, match="names no track"):
        wildpoint.clean(rows, session)
