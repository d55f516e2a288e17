"""The same with the kernel, one for each partition: python spark_kernel.py ARCHIVE SESSION TRACK TIME CHANNEL..."""
import hashlib, subprocess, sys, tempfile
import pyarrow as pa


def lines(batches, command):
    with tempfile.TemporaryFile() as rows:
        writer = None
        for batch in batches:
            writer = writer or pa.ipc.new_stream(rows, batch.schema)
            writer.write_batch(batch)
        if writer:
            writer.close()
            rows.seek(0)
            made = subprocess.run(command, stdin=rows, stdout=subprocess.PIPE, check=True).stdout
            yield from pa.ipc.open_stream(made).read_all().select(["line"]).to_batches()


def digest(spark, archive, session, track, time, *channels, judge=lines):
    command = ["wildpoint-kernel", "--session", session, "--track", track, "--time", time, "--emit", "summary"]
    rows = spark.read.parquet(archive).select(track, time, *channels).repartition(track)
    made = rows.sortWithinPartitions(track, time).mapInArrow(lambda batches: judge(batches, command), "line string")
    return hashlib.sha256("".join(sorted(row.line for row in made.collect())).encode()).hexdigest()


if __name__ == "__main__":
    from pyspark.sql import SparkSession

    print(digest(SparkSession.builder.getOrCreate(), *sys.argv[1:]))
