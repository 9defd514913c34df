#!/bin/sh
# Remakes every published page to the same bytes; needs a release build, and ../shared/recordings for
# the pages on the real MTi-G. About fifteen minutes of processor time. Pages without sources (the blind
# checks, coverage_sensitivity, coverage_tuning, rare_failures) have their tables from the commands that they name; here
# only their text is filled in.
set -eu
cd "$(dirname "$0")/../.."
for page in results/published/*/page.json; do
  page=$(dirname "$page")
  [ "$page" = results/published/index ] || build/release/gyrostat publish "$page" "$@"
done
build/release/gyrostat publish results/published/index
