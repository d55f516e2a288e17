#!/bin/sh
# The digest of an archive with GNU parallel: parallel_archive.sh ARCHIVE SESSION TRACK TIME [JOBS]
set -eu
jobs=${5:-$(nproc)}
parts=$((jobs * 4))
lines=$(mktemp)
trap 'rm -f "$lines"' EXIT
export RAYON_NUM_THREADS=1
# A part whose process was killed is run once more.
seq 0 $((parts - 1)) | parallel --jobs "$jobs" --retries 2 \
    python3 "$(dirname "$0")/archive_part.py" {} "$parts" "$1" "$2" "$3" "$4" > "$lines"
LC_ALL=C sort "$lines" | sha256sum | cut -d' ' -f1
