#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Kills a survey of 200 pings (60 for fewer than 20 kills) at random times and lets it go on, until COUNT kills are done. The
# result must have the bytes of a survey in one go, no finished block may be made twice, and nothing may be left over.
# Kills hit within the time that the survey takes on this machine; a survey that ends before its kills is begun again.
# Fails after 60 s, or 10 s for each kill if that is more.
#   kill_survey.sh alone|parallel|slurm COUNT SEED [build/release/bin/insonify]
#   kill_survey.sh full-disk                       the same on a disk that fills up: exit code 4, then it goes on
# Exit code 77: the engine is not installed, or (Slurm, a disk of its own) this is not root.
set -euo pipefail
engine=${1:?alone, parallel, slurm or full-disk} count=${2:-1} RANDOM=${3:-1}
root=$(cd "$(dirname "$0")/../.." && pwd)
tool=$(realpath "${4:-$root/build/release/bin/insonify}")
case $engine in
  parallel) command -v parallel >/dev/null || { echo "GNU parallel is not installed"; exit 77; } ;;
  slurm) [[ $EUID == 0 ]] && command -v slurmctld munged >/dev/null || { echo "Slurm is not installed, or this is not root"; exit 77; } ;;
  alone | full-disk) ;;
  *) echo "kill_survey.sh: no engine is called '$engine'; there are alone, parallel, slurm, full-disk" >&2; exit 2 ;;
esac
die() { echo "kill_survey.sh $engine: $*" >&2; exit 1; }

work=$(mktemp -d) runner=
finish() {
  [[ -z $runner ]] || kill -- "-$runner" 2>/dev/null || true
  for pid in $(victims); do kill -9 "$pid" 2>/dev/null || true; done
  mountpoint -q "$work/disk" 2>/dev/null && umount "$work/disk"
  rm -rf "$work"
}
# Processes of the tool that run now: engines start the tool by the script `launch`, which leaves its process number.
victims() {
  local file
  for file in "$work"/processes/*; do
    [[ "/proc/${file##*/}/exe" -ef $tool ]] && echo "${file##*/}"
  done || true
}
trap finish EXIT
cd "$work"
mkdir processes
printf '#!/bin/sh\n: >"%s/processes/$$"\nexec "%s" "$@"\n' "$work" "$tool" >launch
chmod +x launch
milliseconds() { echo $((${EPOCHREALTIME/[.,]/} / 1000)); }

"$tool" make-scene harbour -o harbour.ply --points 6000 -q >/dev/null
metres=$((count < 20 ? 3 : 10))
cat >m.toml <<TOML
schema = 1
[survey]
scene = "harbour.ply"
seed = 7
[trajectory]
waypoints_m = [[0, 0, -3], [$metres, 0, -3]]
speed_m_s = 0.2
[[head]]
name = "fls"
sonar = "p900-45"
range = "1:6"
set = ["sonar.beams=16"]
pitch_deg = -20
rate_hz = 2
[[head]]
name = "turning"
sonar = "ping360"
range = "1:6"
rate_hz = 2
[head.scan]
stop_deg = 360
step_deg = 9
[ping]
noise = true
scatterers_per_cell = 0
TOML
options=(m.toml -q --pings-per-block 5)

# Digests of all that a survey is; its status is of the run that wrote it last.
digests() { (cd "$1" && find . -type f ! -name 'status*.json' -print0 | sort -z | xargs -0 sha256sum); }
begin=$(milliseconds)
"$tool" survey "${options[@]}" -o whole -j2 >/dev/null
# How long one process of the engine has work to do, about: a survey that goes on has less than one that begins.
lifetime=$(($(milliseconds) - begin))
case $engine in
  alone) lifetime=$((lifetime / 2)) ;;
  *) lifetime=$((lifetime / 4)) ;;
esac
"$tool" merge whole -q >/dev/null
digests whole >whole.txt
pings=$(sed -n 's/.*"pings": \([0-9]*\),.*/\1/p' whole/status.json)

# verify RUN: merges it and compares.
verify() {
  "$tool" merge "$1" -q >/dev/null || die "the survey is not whole after $kills kills"
  digests "$1" >run.txt
  cmp -s whole.txt run.txt || { diff whole.txt run.txt >&2 || true; die "the result differs after $kills kills"; }
  [[ -z $(find "$1" -name '*.tmp*' -o -type d -empty) ]] || die "left over: $(find "$1" -name '*.tmp*' -o -type d -empty)"
}

if [[ $engine == full-disk ]]; then
  mkdir disk
  kills=0
  half=$(($(du -sk whole | cut -f1) / 2))
  if mount -t tmpfs -o "size=${half}k" tmpfs disk 2>/dev/null; then
    how="a tmpfs of half the size"
    limited() { "$tool" survey "${options[@]}" -o disk/run; }
    widen() { mount -o remount,size=64m disk; }
  else
    how="a limit of 40 kB for each file"
    limited() { (trap '' XFSZ && ulimit -f 40 && exec "$tool" survey "${options[@]}" -o disk/run); }
    widen() { :; }
  fi
  code=0
  limited >/dev/null 2>message.txt || code=$?
  [[ $code == 4 ]] || die "exit code $code on a full disk: $(cat message.txt)"
  kept=$(find disk -name '*.done' | wc -l)
  widen
  "$tool" survey "${options[@]}" -o disk/run >/dev/null
  verify disk/run
  echo "full-disk: $how: exit code 4 ($(head -c 140 message.txt | tr -d "\n")...); $kept blocks kept; then $pings pings with the same bytes"
  exit
fi

# Each engine starts what was killed again, until all is done.
run_alone() { until ./launch survey "${options[@]}" -o run -j2; do :; done; }
run_parallel() {
  until parallel --will-cite -j2 ./launch survey "${options[@]}" -o run -j1 --shard '{}/8' ::: $(seq 0 7); do :; done
}
run_slurm() {
  cat >job.sh <<JOB
#!/bin/sh
#SBATCH --array=0-7 --cpus-per-task=1 --requeue --open-mode=append --output=task-%a.txt
./launch survey ${options[*]} -o run -j "\$SLURM_CPUS_PER_TASK" --shard "\$SLURM_ARRAY_TASK_ID/\$SLURM_ARRAY_TASK_COUNT" && exit
scontrol requeue "\${SLURM_ARRAY_JOB_ID}_\$SLURM_ARRAY_TASK_ID" && sleep 30
JOB
  "$root/tests/tool/slurm_node.sh" slurm.log sbatch --wait job.sh
}
start() {
  rm -rf run
  made=()
  setsid bash -c "$(declare -f "run_$engine"); $(declare -p tool options root); cd '$work'; run_$engine" >engine.txt 2>&1 &
  runner=$!
}
# Finished blocks must stay the files that they are.
declare -A made=()
check_made() {
  local mark cube id
  for mark in run/*/blocks/*.done; do
    [[ -e $mark ]] || continue
    cube=${mark%.done}.h5 id=$(stat -c '%i %y' "${mark%.done}.h5")
    [[ ${made[$cube]:-$id} == "$id" ]] || die "$cube was finished and made again"
    made[$cube]=$id
  done
}

# Kills one process after the other, each after a random part of a process's lifetime.
kills=0 rounds=1
SECONDS=0
most_seconds=$((count > 6 ? 10 * count : 60))
start
while ((kills < count)); do
  ((SECONDS < most_seconds)) || die "$kills of $count kills in $most_seconds s: is this machine busy?"
  if ! kill -0 "$runner" 2>/dev/null; then
    wait "$runner" || die "the engine failed: $(tail -5 engine.txt)"
    check_made
    verify run
    rounds=$((rounds + 1))
    start
    continue
  fi
  [[ -n $(victims) ]] || { sleep 0.01; continue; }
  printf -v wait_s '%d.%03d' $((wait = RANDOM * lifetime / 32768, wait / 1000)) $((wait % 1000))
  sleep "$wait_s"
  mapfile -t running < <(victims)
  ((${#running[@]} > 0)) || continue
  kill -9 "${running[RANDOM % ${#running[@]}]}" 2>/dev/null || continue
  kills=$((kills + 1))
  check_made
done
for ((; SECONDS < most_seconds; )); do
  kill -0 "$runner" 2>/dev/null || break
  sleep 0.1
done
kill -0 "$runner" 2>/dev/null && die "$kills kills, but the survey has not ended after $most_seconds s: $(tail -5 engine.txt)"
wait "$runner" || die "the engine failed: $(tail -5 engine.txt)"
runner=
check_made
verify run
echo "$engine: $kills kills in $rounds surveys of $pings pings, $SECONDS s: same bytes, no finished block made twice, nothing left over"
