#!/bin/sh
# Diagnoses the real recordings again; needs a release build and ../shared/recordings, and a quarter of an hour. Causes
# are found on one span or unit and judged on another; then every axis of every recording is diagnosed whole.
set -eu
cd "$(dirname "$0")/../../.."
recordings=${GYROSTAT_RECORDINGS:-../shared/recordings}
out=results/published/recordings
program=${GYROSTAT:-build/release/gyrostat}

# NAME FILE [options]: looks for causes, writes NAME.json, and NAME.study.json where there are any.
find_causes() {
  name=$1 file=$2
  shift 2
  $program diagnose "$recordings/$file.csv.gz" --json "$out/$name.json" --scenario "$out/$name.study.json" "$@" > /dev/null
}

# NAME FOUND FILE [options]: judges what was found as FOUND.
judge() {
  grep -q '"effect"' "$out/$2.study.json" || return 0  # nothing was found there
  name=$1 found=$2 file=$3
  shift 3
  $program diagnose "$recordings/$file.csv.gz" --claim "$out/$found.study.json" --json "$out/$name.json" "$@" > /dev/null
}

find_causes mtig_first mtig_static_a --to 1000
judge mtig_second mtig_first mtig_static_a --from 1000
for axis in x y z; do
  find_causes adis_1_$axis adis16405_static_1 --axis $axis --to 1800
  judge adis_1_${axis}_later adis_1_$axis adis16405_static_1 --axis $axis --from 1800
  judge adis_2_$axis adis_1_$axis adis16405_static_2 --axis $axis
  find_causes mpu6050_$axis mpu6050_static --axis $axis --to 330
  judge mpu6050_${axis}_later mpu6050_$axis mpu6050_static --axis $axis --from 330
done

# A line of every.jsonl for each axis of each recording that is diagnosed, in the order of their names.
whole=$(mktemp -d)
trap 'rm -r "$whole"' EXIT
: > "$out/every.jsonl"
for path in "$recordings"/*.csv.gz; do
  file=$(basename "$path" .csv.gz)
  for column in $(gzip -dc "$path" | head -1 | tr , '\n' | grep '^gyro_'); do
    axis=${column#gyro_} axis=${axis%dps} axis=${axis%_}  # nothing where there is one gyro alone
    if $program diagnose "$path" ${axis:+--axis "$axis"} --json "$whole/found.json" > /dev/null; then
      "$out/page.py" --line "$whole/found.json" "$file" "$axis" >> "$out/every.jsonl"
    fi
  done
done
