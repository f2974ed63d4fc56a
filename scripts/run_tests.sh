#!/bin/bash
# Installs what is missing, builds Debug and Release with warnings as errors, runs all tests in
# both. Exit code 0 if all pass.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh
for build in debug release; do
  scripts/build.sh $build all -DISOCHOR_TESTS=ON -DISOCHOR_WERROR=ON
done

status=0
for build in debug release; do
  printf '\n=== tests, %s\n' $build
  ctest --test-dir build/$build --output-on-failure --no-tests=error -j "$(nproc)" || status=1
done
if [ $status -ne 0 ]; then
  echo "Some tests failed; the figures are above and in build/*/Testing/Temporary/LastTest.log"
fi
exit $status
