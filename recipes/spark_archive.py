"""The digest of an archive under Spark: python spark_archive.py ARCHIVE SESSION TRACK TIME CHANNEL..."""
import hashlib, sys
import wildpoint


def lines(table, session, track, time):
    return wildpoint.clean(table, session, track=track, time=time, emit="summary").select(["line"])


def digest(spark, archive, session, track, time, *channels, judge=lines):
    rows = spark.read.parquet(archive).select(track, time, *channels).groupBy(track)
    found = rows.applyInArrow(lambda table: judge(table, session, track, time), "line string").collect()
    return hashlib.sha256("".join(sorted(row.line for row in found)).encode()).hexdigest()


if __name__ == "__main__":
    from pyspark.sql import SparkSession

    print(digest(SparkSession.builder.getOrCreate(), *sys.argv[1:]))
