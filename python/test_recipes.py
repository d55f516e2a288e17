"""The recipes give the digest that `wildpoint replay --archive` gives, also when a worker is killed in mid-job.

20 tracks of 2,000 rows and two channels, each spread over two files, one of them shuffled; times that come twice.
"""
import os, pathlib, signal, subprocess, sys, tempfile
import numpy as np, pandas as pd

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "recipes"))
import dask_archive

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


def killed_once(frame, session, track, time):
    """The kernel, in a worker that is killed the first time that it is asked."""
    marker = pathlib.Path(session).with_name("killed")
    try:
        marker.touch(exist_ok=False)
    except FileExistsError:
        return dask_archive.kernel(frame, session, track, time)
    os.kill(os.getpid(), signal.SIGKILL)


def under_dask(archive, session, judge):
    from dask.distributed import Client, LocalCluster

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        client.run(sys.path.insert, 0, str(ROOT / "recipes"))
        client.run(sys.path.insert, 0, str(ROOT / "python"))
        return dask_archive.digest(archive, session, "pass", "t", "v", "w", judge=judge)


def main():
    import test_recipes

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "archive").mkdir()
        write_archive(folder / "archive")
        session = folder / "s.toml"
        session.write_text(SESSION)
        replay = ["wildpoint", "replay", session, "--archive", folder / "archive"]
        printed = subprocess.run(replay, check=True, capture_output=True, text=True).stdout
        assert ": 20 tracks, 40000 rows, " in printed, printed
        expected = printed.split()[-1]
        for what, judge in [("", dask_archive.kernel), (", a worker killed", test_recipes.killed_once)]:
            found = under_dask(str(folder / "archive"), str(session), judge)
            assert found == expected, f"Dask{what}: {found}, replay says {expected}"
            print(f"Dask{what}: the digest of replay")
        assert (folder / "killed").exists(), "a worker was killed"


if __name__ == "__main__":
    main()
