#!/bin/bash
# Installs what is missing, builds Debug and Release with warnings as errors, and tests both. All tests
# run in Debug, with deal.II's assertions; Release repeats those that run the whole program (compiling
# the programs that test single rooms twice would take longer than everything else). Exit code 0
# if all pass.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh
scripts/build.sh debug all -DISOCHOR_TESTS=ON -DISOCHOR_WERROR=ON
scripts/build.sh release all -DISOCHOR_TESTS=ON -DISOCHOR_UNIT_TESTS=OFF -DISOCHOR_WERROR=ON

status=0
for build in debug release; do
  printf '\n=== tests, %s\n' $build
  ctest --test-dir build/$build --output-on-failure --no-tests=error -j "$(nproc)" || status=1
done
if [ $status -ne 0 ]; then
  echo "Some tests failed; the figures are above and in build/*/Testing/Temporary/LastTest.log"
fi
exit $status
