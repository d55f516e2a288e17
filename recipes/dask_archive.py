"""The digest of an archive under Dask: python dask_archive.py ARCHIVE SESSION TRACK TIME CHANNEL..."""
import hashlib, subprocess, sys
import dask.dataframe as dd, pandas as pd, pyarrow as pa


def kernel(frame, session, track, time):
    frame = frame.sort_values([track, time])
    table, stream = pa.Table.from_pandas(frame, preserve_index=False), pa.BufferOutputStream()
    with pa.ipc.new_stream(stream, table.schema) as writer:
        writer.write_table(table)
    command = ["wildpoint-kernel", "--session", session, "--track", track, "--time", time, "--emit", "summary"]
    done = subprocess.run(command, input=stream.getvalue(), capture_output=True)
    if done.returncode:
        raise RuntimeError(done.stderr.decode())
    return pa.ipc.open_stream(done.stdout).read_all().to_pandas()[["line"]].astype(object)


def digest(archive, session, track, time, *channels, judge=kernel):
    rows = dd.read_parquet(archive, columns=[track, time, *channels]).shuffle(track)
    lines = rows.map_partitions(judge, session, track, time, meta=pd.DataFrame({"line": pd.Series(dtype=object)}))
    return hashlib.sha256("".join(sorted(lines.compute()["line"])).encode()).hexdigest()


if __name__ == "__main__":
    from dask.distributed import Client

    with Client():
        print(digest(*sys.argv[1:]))
