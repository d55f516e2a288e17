"""The digest of an archive under Dask: python dask_archive.py ARCHIVE SESSION TRACK TIME CHANNEL..."""
import hashlib, sys
import dask.dataframe as dd, wildpoint


def lines(frame, session, track, time):
    return wildpoint.clean(frame, session, track=track, time=time, emit="summary")[["line"]].astype(object)


def digest(archive, session, track, time, *channels, judge=lines):
    rows = dd.read_parquet(archive, columns=[track, time, *channels]).shuffle(track)
    found = rows.map_partitions(judge, session, track, time, meta={"line": object}).compute()
    return hashlib.sha256("".join(sorted(found["line"])).encode()).hexdigest()


if __name__ == "__main__":
    from dask.distributed import Client

    with Client():
        print(digest(*sys.argv[1:]))
