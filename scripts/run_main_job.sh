#!/bin/bash
# Installs what is missing, builds Release, runs prm/cantilever.prm and draws its charts and
# picture. What is up to date already is not done again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

job=cantilever
program=build/release/isochor
results=results/$job
picture=$results/picture.png # made last

scripts/install_packages.sh
scripts/build.sh release isochor

up_to_date() {
  [ -f "$picture" ] || return 1
  local source
  for source in "$program" "${program%/*}"/libexec/isochor prm/$job.prm meshes/$job.geo scripts/*.py; do
    [ "$picture" -nt "$source" ] || return 1
  done
}

if up_to_date; then
  echo "The results are up to date."
else
  rm -f "$picture"
  status=0
  OMP_NUM_THREADS=${OMP_NUM_THREADS:-1} "$program" prm/$job.prm --output "$results" --overwrite ||
    status=$?
  [ $status -eq 0 ] || [ $status -eq 2 ] || exit $status # 2: some runs failed, and are shown so
  scripts/chart.py "$results" >/dev/null
  scripts/picture.py --output "$picture" --study "$results" \
    "Element = P1; Poisson ratio = 0.4999" "Element = P1-P1; Poisson ratio = 0.4999" >/dev/null
fi

echo
echo "table    $results/results.csv"
for chart in "$results"/*_against_*.png; do
  echo "chart    $chart"
done
echo "picture  $picture"
