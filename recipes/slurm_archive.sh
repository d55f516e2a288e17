#!/bin/sh
#SBATCH --array=0-99 --cpus-per-task=1 --output=/dev/null
# The digest of an archive under Slurm: sbatch slurm_archive.sh RECIPES ARCHIVE SESSION TRACK TIME LINES
# RECIPES is the folder of archive_part.py: Slurm runs a copy of this file. When all tasks have ended:
# cat LINES/part.* | LC_ALL=C sort | sha256sum
set -eu
task=$SLURM_ARRAY_TASK_ID
export RAYON_NUM_THREADS="${SLURM_CPUS_PER_TASK:-1}"
mkdir -p "$6"
python3 "$1/archive_part.py" "$task" "$SLURM_ARRAY_TASK_COUNT" "$2" "$3" "$4" "$5" > "$6/unfinished.$task"
# A task that was killed has no part, and is run again with --array=TASK.
mv "$6/unfinished.$task" "$6/part.$task"
