#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# One node of Slurm without systemd, for a test: runs a command with Slurm's tools on it, then stops it all. Needs root.
#   slurm_node.sh LOG COMMAND...     LOG: where the log of the scheduler is kept
set -euo pipefail
log=$1
shift
folder=$(mktemp -d)  # with a short path: that of a socket has 107 letters at most
chmod 755 "$folder"
name=$(hostname -s)
port=$((20000 + $$ % 20000))
pids=()
stop() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  for pid in "${pids[@]}"; do wait "$pid" 2>/dev/null || true; done
  cp "$folder/slurmctld.log" "$log" 2>/dev/null || true
  rm -rf "$folder"
}
trap stop EXIT
trap 'exit 1' TERM INT

# Keys: a munge of our own.
dd if=/dev/urandom of="$folder/munge.key" bs=128 count=1 status=none
chmod 400 "$folder/munge.key"
munged --foreground --force --socket="$folder/munge.socket" --key-file="$folder/munge.key" --pid-file="$folder/munge.pid" \
  --log-file="$folder/munge.log" --seed-file="$folder/munge.seed" --num-threads=1 >"$folder/munge.out" 2>&1 &
pids+=($!)

# A requeued task waits until the credentials of its first run have expired: cred_expire.
cat >"$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
ReturnToService=2
MaxArraySize=100
NodeName=$name NodeAddr=127.0.0.1 CPUs=2
PartitionName=all Nodes=ALL Default=YES State=UP
CONF
mkdir "$folder/state" "$folder/spool"
export SLURM_CONF=$folder/slurm.conf
for _ in $(seq 100); do [[ -S $folder/munge.socket ]] && break || sleep 0.05; done
slurmctld -D -f "$SLURM_CONF" >"$folder/slurmctld.out" 2>&1 &
pids+=($!)
slurmd -D -f "$SLURM_CONF" -N "$name" >"$folder/slurmd.out" 2>&1 &
pids+=($!)
for _ in $(seq 100); do [[ $(sinfo -h -o %T 2>/dev/null) == idle ]] && break || sleep 0.1; done
[[ $(sinfo -h -o %T) == idle ]] || { cat "$folder"/*.log >&2; exit 1; }
"$@"
