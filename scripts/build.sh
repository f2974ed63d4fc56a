#!/bin/bash
# build.sh release|debug TARGET [CMAKE_OPTION...]: configures and builds in build/release or
# build/debug.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

case ${1-} in
  release) type=Release ;;
  debug) type=Debug ;;
  *)
    echo "usage: build.sh release|debug TARGET [CMAKE_OPTION...]" >&2
    exit 1
    ;;
esac
folder=build/$1
target=${2-all}

# The compiler needs up to 2 GB for a file full of deal.II templates.
memory=$(awk '/^MemTotal:/ { print $2 }' /proc/meminfo) # kB
if limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null) && [[ $limit =~ ^[0-9]+$ ]]; then
  memory=$((limit / 1024 < memory ? limit / 1024 : memory))
fi
jobs=$(((memory + 1048576) / 2097152))
[ "$jobs" -le "$(nproc)" ] || jobs=$(nproc)
[ "$jobs" -ge 1 ] || jobs=1

cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=$type "${@:3}"
cmake --build "$folder" --target "$target" -j "$jobs"
