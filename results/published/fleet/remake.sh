#!/bin/sh
# Diagnoses both fleets again, axis by axis, into fleet.json; needs a release build and
# ../shared/recordings. About three minutes of processor time. page.py then fills the page.
set -eu
cd "$(dirname "$0")/../../.."
recordings=${GYROSTAT_RECORDINGS:-$PWD/../shared/recordings}
page=results/published/fleet/page.py
program=$PWD/build/release/gyrostat
found=$(mktemp -d)
trap 'rm -rf "$found"' EXIT

# NAME FILE…: the diagnoses of one fleet.
diagnose_fleet() {
  name=$1
  shift
  for axis in x y z; do
    (cd "$recordings" && $program diagnose "$@" --axis $axis --json "$found/${name}_$axis.json" > /dev/null)
  done
}

diagnose_fleet dot xsens_dot_01_static.csv.gz xsens_dot_02_static.csv.gz xsens_dot_03_static.csv.gz \
  xsens_dot_04_static.csv.gz xsens_dot_05_static.csv.gz
diagnose_fleet adis adis16405_static_1.csv.gz adis16405_static_2.csv.gz
$page --collect "$found"
$page
