#!/bin/sh
# Runs the study again and makes tables.json of what it tells; needs a release build. About four minutes of
# two cores for the run, and one for how it fails. `publish` then makes the page.
set -eu
cd "$(dirname "$0")/../../.."
page=results/published/rare_failures
run=$(mktemp -d)
trap 'rm -rf "$run"' EXIT
build/release/gyrostat run experiments/studies/failures_by_limit.json --out "$run/run" > /dev/null
build/release/gyrostat failure "$run/run" --how --format json > "$run/failure.json"
build/release/gyrostat rank "$run/run" --metric failure --format json > "$run/rank.json"
$page/collect.py "$run/failure.json" "$run/rank.json" > "$run/tables.json"
mv "$run/tables.json" $page/tables.json
build/release/gyrostat publish $page
