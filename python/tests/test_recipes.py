"""The recipes give the digest that `wildpoint replay --archive` gives, also when a worker is killed in mid-job.

20 tracks of 2,000 rows and two channels, each spread over two files, one of them shuffled; times that come twice.
"""

import os
import pathlib
import shutil
import signal
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from conftest import ROOT, run

RECIPES = ROOT / "recipes"
sys.path[:0] = [os.fspath(RECIPES)]
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


def write_archive(folder):
    random = np.random.default_rng(1)
    tracks = []
    for track in range(20):
        t = np.arange(2000) * 0.1
        t[::500] += 0.1  # the time of the row after it
        v, w = np.cumsum(random.normal(size=2000)), random.normal(size=2000)
        v[random.integers(0, 2000, 20)] += 50
        w[random.integers(0, 2000, 20)] = np.nan
        tracks.append(pd.DataFrame({"pass": f"p{track:02}", "t": t, "v": v, "w": w}))
    rows = pd.concat(tracks, ignore_index=True)
    first = rows.index % 2 == 0
    rows[first].to_parquet(folder / "a.parquet", index=False)
    rows[~first].sample(frac=1, random_state=1).to_parquet(folder / "b.parquet", index=False)


class Archive:
    def __init__(self, folder):
        self.path, self.session = os.fspath(folder / "archive"), os.fspath(folder / "s.toml")
        (folder / "archive").mkdir()
        write_archive(folder / "archive")
        (folder / "s.toml").write_text(SESSION)
        printed = run("wildpoint", "replay", self.session, "--archive", self.path)
        assert ": 20 tracks, 40000 rows, " in printed, printed
        self.digest = printed.split()[-1]
        self.killed = folder / "killed"


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    return Archive(tmp_path_factory.mktemp("archive"))


def killed_once(marker, judge, *arguments):
    """`judge`, in a process that is killed the first time that it is asked."""
    try:
        pathlib.Path(marker).touch(exist_ok=False)
    except FileExistsError:
        return judge(*arguments)
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.parametrize("killed", [False, True])
def test_dask(archive, killed, tmp_path):
    distributed = pytest.importorskip("distributed", reason="no Dask from PyPI")
    import functools

    import dask_archive

    judge = functools.partial(killed_once, tmp_path / "killed", dask_archive.lines) if killed else dask_archive.lines
    paths = [os.fspath(RECIPES), os.fspath(pathlib.Path(__file__).parent)]
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            client.run(sys.path.extend, paths)
            assert dask_archive.digest(archive.path, archive.session, "pass", "t", "v", "w", judge=judge) == archive.digest
    assert (tmp_path / "killed").exists() == killed


@pytest.fixture(scope="module")
def spark():
    sql = pytest.importorskip("pyspark.sql", reason="no Spark from PyPI")
    if shutil.which("java") is None:
        pytest.skip("no java: Spark was not tried")
    # Workers find the recipes, the package and the interpreter that this process has.
    os.environ["PYSPARK_PYTHON"] = sys.executable
    os.environ["PYTHONPATH"] = os.pathsep.join([os.fspath(RECIPES), os.fspath(ROOT / "python" / "tests"), *sys.path])
    session = sql.SparkSession.builder.master("local-cluster[2,1,1024]").appName("recipes")
    quiet = {"spark.ui.enabled": "false", "spark.sql.shuffle.partitions": "4", "spark.log.level": "OFF"}
    for key, value in quiet.items():
        session = session.config(key, value)
    session = session.getOrCreate()
    yield session
    session.stop()


@pytest.mark.parametrize("recipe", ["spark_archive", "spark_kernel"])
@pytest.mark.parametrize("killed", [False, True])
def test_spark(archive, spark, recipe, killed, tmp_path):
    module = __import__(recipe)
    judge = killed_executor(tmp_path / "killed", module.lines) if killed else module.lines
    found = module.digest(spark, archive.path, archive.session, "pass", "t", "v", "w", judge=judge)
    assert found == archive.digest
    assert (tmp_path / "killed").exists() == killed


def killed_executor(marker, judge):
    """`judge`, of which the first call kills the Java process of its executor and with it all of its workers."""
    marker = os.fspath(marker)

    def judged(*arguments):
        import os, pathlib, signal

        try:
            pathlib.Path(marker).touch(exist_ok=False)
        except FileExistsError:
            return judge(*arguments)
        daemon = os.getppid()
        with open(f"/proc/{daemon}/stat") as about:
            executor = int(about.read().rpartition(")")[2].split()[1])
        os.kill(executor, signal.SIGKILL)
        os.kill(os.getpid(), signal.SIGKILL)

    return judged


def test_parallel(archive):
    if shutil.which("parallel") is None:
        pytest.skip("no GNU parallel: its recipe was not tried")
    printed = run(RECIPES / "parallel_archive.sh", archive.path, archive.session, "pass", "t", "2", env=environment())
    assert printed.strip() == archive.digest


def test_slurm(archive, tmp_path):
    """The script with the variables that Slurm sets; the second task is killed, and run again."""
    script = [RECIPES / "slurm_archive.sh", RECIPES, archive.path, archive.session, "pass", "t", tmp_path / "lines"]
    for task in range(3):
        env = environment() | {"SLURM_ARRAY_TASK_ID": str(task), "SLURM_ARRAY_TASK_COUNT": "3"}
        if task == 1:
            child = subprocess.Popen(script, env=env, start_new_session=True)
            os.killpg(child.pid, signal.SIGKILL)
            child.wait()
            assert not (tmp_path / "lines" / "part.1").exists()
        run(*script, env=env)
    end = f"cat {tmp_path}/lines/part.* | LC_ALL=C sort | sha256sum"
    assert run("sh", "-c", end).split()[0] == archive.digest


def environment():
    """That of this process, with the interpreter and the package that it has."""
    path = os.pathsep.join([os.fspath(pathlib.Path(sys.executable).parent), os.environ["PATH"]])
    return os.environ | {"PATH": path, "PYTHONPATH": os.pathsep.join(sys.path)}
