#!/bin/bash
# A study over a Slurm array on a local Slurm of this machine, by the script that `reach study sbatch` writes: the bytes of one process, also
# after a task was put back while it worked. $1 is the build folder. Needs slurm-wlm and munge, and to be root.
set -euo pipefail
build=$(realpath "$1")
work=$(mktemp -d)
slurm=$work/slurm
mkdir -p "$slurm"/{state,spool,log}
host=$(hostname -s)
cat > "$slurm/slurm.conf" <<CONF
ClusterName=lab
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CryptoType=crypto/munge
AuthInfo=socket=$slurm/munge.sock
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/ctld.pid
SlurmdPidFile=$slurm/d.pid
SlurmctldLogFile=$slurm/log/ctld.log
SlurmdLogFile=$slurm/log/d.log
SlurmctldPort=17817
SlurmdPort=17818
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
SchedulerParameters=sched_interval=1,bf_interval=1
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=lab Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$slurm/slurm.conf
ended() {
  for pid in "$slurm/ctld.pid" "$slurm/d.pid" "$slurm/munged.pid"; do [[ -s $pid ]] && kill "$(cat "$pid")" 2> /dev/null || true; done
  rm -rf "$work"
}
trap ended EXIT
chmod 755 "$work" "$slurm"
mungekey -c -k "$slurm/munge.key"
munged --force --key-file="$slurm/munge.key" --socket="$slurm/munge.sock" --pid-file="$slurm/munged.pid" --log-file="$slurm/log/munged.log" --seed-file="$slurm/seed"
slurmctld -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF"
for _ in $(seq 30); do sinfo -h -o %T 2> /dev/null | grep -q idle && break; sleep 1; done

cat > "$work/study.json" <<'STUDY'
{ "schema_version": 1, "name": "array", "experiment": "chain-moderate", "subjects": 60, "trials": 20, "chunk_trials": 100, "vary": { "subject.noise": [0.5, 1] } }
STUDY
export PATH=$build/cli:$PATH
cd "$work"
reach study study.json --out one 2> /dev/null
reach study sbatch study.json --out array --tasks 5 > job.sh
job=$(sbatch --parsable job.sh)
sleep 2
scontrol requeue "${job}_2" || true  # in the middle, or after its end: both must do no harm
for _ in $(seq 300); do [[ -z $(squeue -h -j "$job" 2> /dev/null) ]] && break; sleep 1; done
reach study study.json --out array --resume 2> /dev/null  # what a task that was taken away left
cmp one/trials.csv.gz array/trials.csv.gz
cmp one/trials.h5 array/trials.h5
echo "a Slurm array of 5 gives the bytes of one process"
