#!/bin/sh
# A dataset by a Slurm job array, one shard a task. Submit from a folder that all nodes see, which holds the program:
#
#   sbatch --array=1-250 slurm-array.sh 250 phase-500 --events 10000
#
# With several times as many tasks as there are workers none waits long for the last. A task that is killed or requeued goes
# on in its folder; those that failed can be submitted again alone (sbatch --array=1,3 slurm-array.sh 250 ...). When all have
# succeeded:
#
#   ./xtask merge shards/* --out dataset
#
#SBATCH --cpus-per-task=1
#SBATCH --mem=1G
#SBATCH --time=04:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
shards=$1
preset=$2
shift 2
exec ./xtask gen-dataset --preset "$preset" "$@" --shard "auto/$shards" \
    --jobs "${SLURM_CPUS_PER_TASK:-1}" --out "shards/$SLURM_ARRAY_TASK_ID"
