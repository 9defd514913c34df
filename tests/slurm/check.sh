#!/bin/sh
# check.sh GYROSTAT
#
# Runs a study as a job array on a real Slurm: a controller and two node daemons on this machine, on
# loopback, with their own key, ports and folders. One task is killed, the controller is restarted, and
# the merged shards are the single run byte for byte. Says SKIPPED with a reason where that cannot be.
set -eu

program=$1
skip() { echo "SKIPPED: $1"; exit 0; }
[ "$(id -u)" -eq 0 ] || skip "the daemons of a Slurm are started as root"
for tool in slurmctld slurmd munged mungekey sbatch squeue scontrol sinfo; do
  PATH=$PATH:/usr/sbin command -v $tool >/dev/null || skip "$tool is not there (apt-get install slurm-wlm munge)"
done
PATH=$PATH:/usr/sbin
id munge >/dev/null 2>&1 || skip "there is no user munge"

root=$(mktemp -d /tmp/gyrostat_slurm_XXXXXX)
chmod 755 "$root"
daemons=""
end() {
  code=$?
  scancel --state=PENDING --user=root 2>/dev/null || true
  for pid in $daemons $(cat "$root"/ctld.pid "$root"/d*.pid 2>/dev/null); do kill "$pid" 2>/dev/null || true; done
  sleep 1
  [ "$code" -eq 0 ] || tail -n 20 "$root"/*.log 2>/dev/null || true
  rm -rf "$root"
}
trap end EXIT

# ---- a cluster of two nodes
host=$(hostname -s)
port=$((20000 + $$ % 20000))
mkdir "$root/munge" "$root/state" "$root/spool1" "$root/spool2"
mungekey --create --keyfile="$root/munge/key" 2>/dev/null
chown -R munge: "$root/munge"
chmod 711 "$root/munge"
chmod 400 "$root/munge/key"
setpriv --reuid=munge --regid=munge --clear-groups munged --foreground --key-file="$root/munge/key" \
  --socket="$root/munge/socket" --pid-file="$root/munge/pid" --log-file="$root/munge/log" \
  --seed-file="$root/munge/seed" >"$root/munged.log" 2>&1 &
daemons="$daemons $!"
cat >"$root/slurm.conf" <<CONF
ClusterName=loopback
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$root/munge/socket
CredType=cred/munge
SlurmctldPort=$port
SlurmctldPidFile=$root/ctld.pid
SlurmdPidFile=$root/d%n.pid
SlurmdSpoolDir=$root/spool_%n
StateSaveLocation=$root/state
SlurmctldLogFile=$root/slurmctld.log
SlurmdLogFile=$root/slurmd_%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=bf_interval=1,sched_interval=1,requeue_delay=0
JobRequeue=1
ReturnToService=2
SlurmctldTimeout=30
SlurmdTimeout=60
MinJobAge=300
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF="$root/slurm.conf"
controller() { slurmctld -D -f "$SLURM_CONF" >>"$root/controller.log" 2>&1 & ctld=$!; daemons="$daemons $ctld"; }
for i in $(seq 50); do [ -S "$root/munge/socket" ] && break; sleep 0.1; done
[ -S "$root/munge/socket" ] || skip "munged does not start: $(cat "$root/munged.log")"
controller
for node in n1 n2; do
  slurmd -D -N $node -f "$SLURM_CONF" >>"$root/daemon_$node.log" 2>&1 &
  daemons="$daemons $!"
done
idle() { sinfo --noheader --states=idle --format=%D 2>/dev/null | head -n 1; }
for i in $(seq 60); do [ "$(idle)" = 2 ] && break; sleep 0.5; done
[ "$(idle)" = 2 ] || skip "two nodes do not come up: $(tail -n 1 "$root"/slurmctld.log "$root"/slurmd_n1.log 2>/dev/null | tr '\n' ' ')"

# ---- the single run, and the array
cd "$root"
cat >s.json <<'STUDY'
{"seed": 5, "cells": [
  {"name": "a", "trials": 9000, "scenario": {"duration_s": 60, "rate_hz": 100},
   "filters": ["none", "kf", "sr_rsukf", "oracle"]},
  {"name": "b", "trials": 400, "scenario": {"duration_s": 30, "rate_hz": 50}, "filters": ["none", "stf"]}]}
STUDY
"$program" run s.json --out single >/dev/null 2>&1
"$program" export single --out single.csv
"$program" slurm s.json --shards 4
job=$(sbatch --parsable s.sbatch)
echo "job $job: $(squeue --noheader --format=%i --array | wc -l) tasks on two nodes"

# ---- a task is killed once it has something in its store
finished_in() { "$program" export "$1" 2>/dev/null | wc -l; }
victim() { pgrep -f "^$program run .*/shard_1_of_4" | head -n 1; }
for i in $(seq 200); do pid=$(victim) && [ -n "$pid" ] && break; sleep 0.05; done
[ -n "$pid" ] || { echo "no task to kill"; exit 1; }
# At once when there is something: it is fast.
for i in $(seq 200); do [ "$(finished_in runs/s/shard_1_of_4)" -gt 50 ] && break; sleep 0.05; done
kill -9 "$pid"
before=$(finished_in runs/s/shard_1_of_4)
echo "killed the program of task 1 when its store had $before lines"

# ---- the controller is restarted in the midst of it
kill "$ctld"
wait "$ctld" 2>/dev/null || true
echo "the controller is down"
sleep 1
controller
for i in $(seq 60); do scontrol ping 2>/dev/null | grep -q UP && break; sleep 0.5; done
waiting=$(squeue --noheader --array | wc -l)
[ "$waiting" -gt 0 ] || { echo "nothing was left for the new controller"; exit 1; }
echo "the controller is up again, $waiting tasks to go"

# A task that ends while the controller is down can be taken for running until the nodes are asked again.
wait_for_jobs() {
  for i in $(seq 480); do
    [ "$i" -ne 80 ] || scontrol reconfigure 2>/dev/null || true
    left=$(squeue --noheader 2>/dev/null | wc -l) && [ "$left" -eq 0 ] && squeue --noheader >/dev/null 2>&1 && return
    sleep 0.5
  done
  echo "jobs do not end"; squeue; exit 1
}
wait_for_jobs
code=0
"$program" merge runs/s runs/s/shard_* || code=$?
[ "$code" -eq 4 ] || { echo "shard 1 was killed, yet nothing is missing ($code)"; exit 1; }

# ---- the task that failed is sent again, alone, and runs only what it lacks
sbatch --parsable --array=1 s.sbatch >/dev/null
sleep 1
wait_for_jobs
"$program" merge runs/s runs/s/shard_*
"$program" export runs/s --out merged.csv
cmp single.csv merged.csv
"$program" run s.json >/dev/null 2>&1
cmp single/tables.json runs/s/tables.json
cmp single/outcomes.csv.gz runs/s/outcomes.csv.gz

# ---- a task picks its shard up by itself
sbatch --parsable --array=7-8 --output=env.log --open-mode=append \
  --wrap "'$program' run s.json --trials 20 --out env_\$SLURM_ARRAY_TASK_ID" >/dev/null
sleep 1
wait_for_jobs
"$program" merge env env_7 env_8
"$program" run s.json --trials 20 --out few >/dev/null 2>&1
"$program" export few --out few.csv
"$program" export env | cmp few.csv
echo "PASSED: the merged shards are the single run, byte for byte"
