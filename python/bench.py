"""The measurements of `python/bench`: each in a process of its own, whose CPU time is that of all that it started."""

import contextlib
import ctypes
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "archive.md"
TRACKS, ROWS, FILES = 500, 20_000, 8
PILOT_TRACKS, PILOT_ROWS = 10_000, 100_000
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
[[channel]]
name = "w"
method = "two-sided"
"""


def values(random, rows):
    """A track that turns, with noise, wild points and a channel of noise alone."""
    v = np.cumsum(np.cumsum(random.normal(size=rows)) * 1e-3) + random.normal(size=rows)
    v[random.integers(0, rows, rows // 100)] += 50
    return v, random.normal(size=rows)


def write(folder):
    """The archive as Parquet (each track spread over two files), as one stream of Arrow, and as a CSV file for each track."""
    import pyarrow as pa
    import pyarrow.csv
    import pyarrow.parquet

    random, t = np.random.default_rng(1), np.arange(ROWS) * 0.1
    (folder / "parquet").mkdir()
    (folder / "csv").mkdir()
    parts = [[] for _ in range(FILES)]
    with pa.OSFile(os.fspath(folder / "rows.arrows"), "wb") as file:
        writer = None
        for track in range(TRACKS):
            v, w = values(random, ROWS)
            table = pa.table({"pass": pa.array([f"p{track:03}"] * ROWS), "t": t, "v": v, "w": w})
            writer = writer or pa.ipc.new_stream(file, table.schema)
            writer.write_table(table)
            for half in range(2):
                parts[(track + half * FILES // 2) % FILES].append(table.slice(half * ROWS // 2, ROWS // 2))
            pyarrow.csv.write_csv(table.drop_columns("pass"), folder / "csv" / f"p{track:03}.csv")
        writer.close()
    for at, part in enumerate(parts):
        pyarrow.parquet.write_table(pa.concat_tables(part), folder / "parquet" / f"{at}.parquet")
    (folder / "s.toml").write_text(SESSION)


# Each of these is run in a process of its own: what it does, and how many rows it is.


def kernel(folder):
    with open(folder / "rows.arrows", "rb") as rows:
        command = ["wildpoint-kernel", "--session", folder / "s.toml", "--emit", "samples"]
        subprocess.run(command, stdin=rows, stdout=subprocess.DEVNULL, check=True)


def package(folder):
    import pyarrow as pa
    import wildpoint

    with pa.memory_map(os.fspath(folder / "rows.arrows")) as file:
        table = pa.ipc.open_stream(file).read_all()
    made = wildpoint.clean(table, folder / "s.toml")
    assert made.num_rows == TRACKS * ROWS


def program(folder):
    files = sorted((folder / "csv").glob("*.csv"))
    options = ["--time", "t", "--channel", "v,w", "-o", folder / "cleaned/", "--force", "--quiet"]
    subprocess.run(["wildpoint", "clean", *files, *options], check=True)


def temporary_files(folder):
    """A partition writes its rows, runs the program on them and reads the cleaned file."""
    import pandas as pd
    from dask import delayed
    from dask.distributed import Client, LocalCluster

    def one(path):
        frame = pd.read_parquet(path, filters=[("pass", "in", NAMES_OF_SAMPLE)])
        for _, own in frame.groupby("pass"):
            with tempfile.TemporaryDirectory() as scratch:
                own.drop(columns="pass").to_csv(f"{scratch}/in.csv", index=False)
                command = ["wildpoint", "clean", f"{scratch}/in.csv", "-o", f"{scratch}/out.csv", "--time", "t", "--quiet"]
                subprocess.run(command, check=True)
                pd.read_csv(f"{scratch}/out.csv")

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        client.gather(client.map(one, sorted((folder / "parquet").glob("*.parquet"))))


NAMES_OF_SAMPLE = [f"p{track:03}" for track in range(40)]


def dask(folder):
    import dask_archive
    from dask.distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster):
        print(dask_archive.digest(os.fspath(folder / "parquet"), os.fspath(folder / "s.toml"), "pass", "t", "v", "w"))


def spark(folder, recipe):
    from pyspark.sql import SparkSession

    os.environ["PYSPARK_PYTHON"] = sys.executable
    builder = SparkSession.builder.master("local[2]").config("spark.driver.memory", "4g")
    for key, value in {"spark.ui.enabled": "false", "spark.sql.shuffle.partitions": "8", "spark.log.level": "OFF"}.items():
        builder = builder.config(key, value)
    session = builder.getOrCreate()
    print(recipe.digest(session, os.fspath(folder / "parquet"), os.fspath(folder / "s.toml"), "pass", "t", "v", "w"))
    session.stop()


def spark_package(folder):
    import spark_archive

    spark(folder, spark_archive)


def spark_with_kernel(folder):
    import spark_kernel

    spark(folder, spark_kernel)


def nothing_of_python(folder):
    """What the interpreter and its imports cost, which is taken from the row of the package."""
    import pyarrow as pa
    import wildpoint

    with pa.memory_map(os.fspath(folder / "rows.arrows")) as file:
        pa.ipc.open_stream(file).read_all()


MEASURED = {
    "kernel": ("`wildpoint-kernel --emit samples`", kernel, TRACKS * ROWS),
    "package": ("Python: `wildpoint.clean`", package, TRACKS * ROWS),
    "program": ("`wildpoint clean *.csv -o DIR/`", program, TRACKS * ROWS),
    "dask": ("Dask, `recipes/dask_archive.py`", dask, TRACKS * ROWS),
    "spark": ("Spark, `recipes/spark_archive.py`", spark_package, TRACKS * ROWS),
    "spark-kernel": ("Spark, `recipes/spark_kernel.py`", spark_with_kernel, TRACKS * ROWS),
    "files": ("Dask with temporary CSV files", temporary_files, len(NAMES_OF_SAMPLE) * ROWS),
}


def cost(name, folder):
    """CPU and wall seconds of a measurement, and what it prints."""

    def used():
        about = resource.getrusage(resource.RUSAGE_CHILDREN)
        return about.ru_utime + about.ru_stime

    before, start = used(), time.monotonic()
    done = subprocess.run([sys.executable, __file__, "--one", name, folder], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{name}: {done.stderr[-2000:]}")
    wall = time.monotonic() - start
    # Processes whose parents have ended belong to this one now: Java and its workers.
    with contextlib.suppress(ChildProcessError):
        while True:
            os.wait()
    return used() - before, wall, done.stdout.strip()


def engines():
    """The table of rates."""
    with tempfile.TemporaryDirectory(dir=os.environ.get("WILDPOINT_SCRATCH")) as name:
        folder = pathlib.Path(name)
        write(folder)
        printed = subprocess.run(
            ["wildpoint", "replay", folder / "s.toml", "--archive", folder / "parquet"], check=True, capture_output=True, text=True
        )
        digest = printed.stdout.split()[-1]
        beside = cost("nothing", folder)[0]
        costs = {}
        for name in MEASURED:
            cpu, wall, said = cost(name, folder)
            if name in ("dask", "spark", "spark-kernel"):
                assert said == digest, f"{name}: {said}, replay says {digest}"
            costs[name] = (cpu - beside if name == "package" else cpu, wall)
            print(f"{name}: {cpu:.1f} CPU s, {wall:.1f} s", file=sys.stderr)
        stored = sum(file.stat().st_size for file in (folder / "parquet").iterdir()) / (TRACKS * ROWS)
    told("costs", costs_of_an_archive(costs, stored))
    rows = ["| | rows | rows per CPU second | CPU s | wall s | share of the kernel |", "|---|---:|---:|---:|---:|---:|"]
    per_row = costs["kernel"][0] / (TRACKS * ROWS)
    for name, (title, _, count) in MEASURED.items():
        cpu, wall = costs[name]
        share = f"{100 * per_row * count / cpu:.0f} %" if "dask" in name or "spark" in name else ""
        rows.append(f"| {title} | {count:,} | {count / cpu / 1e6:.2f} million | {cpu:.1f} | {wall:.1f} | {share} |")
    rows.append("")
    rows.append(
        f"{TRACKS} tracks of {ROWS:,} rows and two channels (`hampel`, `two-sided`), each spread over two of {FILES} Parquet files; "
        f"{os.cpu_count()} cores, {time.strftime('%Y-%m-%d')}. The digests under Dask and Spark were those of `wildpoint replay --archive`."
    )
    return "\n".join(rows)


def costs_of_an_archive(costs, stored):
    """The table of what 10^6 tracks of 10^5 rows cost, from the rates that were measured."""
    count, cores, network, storage = 1e11, 32, 10e9 / 8, 1e9
    moved = 8 * 3 + 12  # a row in a shuffle: time, two channels, the id of the track with its length
    lines = ["| nodes | with | CPU hours | read and shuffled | wall | limited by |", "|---:|---|---:|---:|---:|---|"]
    for nodes in (1, 10, 100):
        for title, name, shuffled in [("the kernel, rows already together", "kernel", 0), ("Spark, rows spread", "spark", moved)]:
            cpu = costs[name][0] * count / (TRACKS * ROWS)
            each = {"CPU": cpu / (nodes * cores), "storage": count * stored / (nodes * storage)}
            # Of n nodes each keeps one n-th of what it shuffles.
            each["network"] = count * shuffled * (1 - 1 / nodes) / (nodes * network)
            slowest = max(each, key=each.get)
            wall = each[slowest]
            shown = f"{wall / 3600:.1f} h" if wall >= 3600 else f"{wall / 60:.0f} min"
            moved_in_all = f"{count * stored / 1e12:.1f} TB, {count * shuffled / 1e12:.1f} TB"
            lines.append(f"| {nodes} | {title} | {cpu / 3600:,.0f} | {moved_in_all} | {shown} | {slowest} |")
    lines.append("")
    lines.append(
        f"Computed from the rates above and {stored:.1f} bytes per row in Parquet, for nodes of {cores} cores with 10 Gbit/s of network and 1 GB/s of "
        "storage, each used in full; a wall time is that of the slowest of the three."
    )
    return "\n".join(lines)


def pilot():
    """One hundredth of 10^6 tracks of 10^5 rows through one kernel, made on the way."""
    import pyarrow as pa

    t = np.arange(PILOT_ROWS) * 0.1
    random = np.random.default_rng(1)
    made = [values(random, PILOT_ROWS) for _ in range(20)]
    with tempfile.TemporaryDirectory() as name:
        session = pathlib.Path(name) / "s.toml"
        session.write_text(SESSION)
        command = ["wildpoint-kernel", "--session", session, "--emit", "summary"]
        start = time.monotonic()
        kernel = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        schema = pa.schema([("pass", pa.string()), ("t", pa.float64()), ("v", pa.float64()), ("w", pa.float64())])
        # The summaries of all tracks are more than a pipe holds.
        import threading

        lines = []
        reader = threading.Thread(target=lambda: lines.extend(pa.ipc.open_stream(kernel.stdout).read_all()["line"].to_pylist()))
        reader.start()
        with pa.ipc.new_stream(kernel.stdin, schema) as writer:
            for track in range(PILOT_TRACKS):
                v, w = made[track % len(made)]
                ids = pa.repeat(f"p{track:07}", PILOT_ROWS)
                writer.write_table(pa.table([ids, pa.array(t), pa.array(v + track), pa.array(w)], schema=schema))
        kernel.stdin.close()
        reader.join()
        _, status, about = os.wait4(kernel.pid, 0)
    assert status == 0 and len(lines) == 2 * PILOT_TRACKS
    cpu, wall = about.ru_utime + about.ru_stime, time.monotonic() - start
    count = PILOT_TRACKS * PILOT_ROWS
    return (
        f"A pilot of 1 % ({PILOT_TRACKS:,} tracks of {PILOT_ROWS:,} rows and two channels, made on the way, through one kernel): {cpu:,.0f} CPU "
        f"seconds, {count / cpu / 1e6:.2f} million rows per CPU second, {wall / 60:.0f} minutes, "
        f"at most {about.ru_maxrss / 1024:.0f} MB of memory ({time.strftime('%Y-%m-%d')})."
    )


def told(name, text):
    print(text)
    if os.environ.get("WILDPOINT_UPDATE"):
        page = PAGE.read_text()
        between = re.compile(rf"(<!-- {name} -->\n).*?(\n<!-- /{name} -->)", re.DOTALL)
        assert between.search(page), f"{PAGE}: no place for {name}"
        PAGE.write_text(between.sub(lambda found: found[1] + text + found[2], page))


def main():
    if sys.argv[1:2] == ["--one"]:
        one = {**{name: work for name, (_, work, _) in MEASURED.items()}, "nothing": nothing_of_python}
        one[sys.argv[2]](pathlib.Path(sys.argv[3]))
        return
    ctypes.CDLL(None).prctl(36, 1, 0, 0, 0)  # PR_SET_CHILD_SUBREAPER
    if "--pilot" in sys.argv:
        told("pilot", pilot())
    else:
        told("engines", engines())


if __name__ == "__main__":
    main()
