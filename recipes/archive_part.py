"""The lines of every N-th track of an archive: python archive_part.py K N ARCHIVE SESSION TRACK TIME (K: 0 to N - 1)"""
import sys
import pyarrow.compute as pc, pyarrow.dataset as ds, wildpoint

part, parts, archive, session, track, time = sys.argv[1:]
rows = ds.dataset(archive, partitioning="hive")
columns = [track, time, *wildpoint.Session.load(session).columns]
for id in sorted(pc.unique(rows.to_table([track])[track]).to_pylist())[int(part) :: int(parts)]:
    table = rows.to_table(columns, filter=ds.field(track) == id)
    for line in wildpoint.clean(table, session, track=track, time=time, emit="summary")["line"]:
        print(line, end="")
