#!/bin/bash
# Installs the Debian 12 packages that Isochor is built, run and tested with: only those missing.
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache git
  libdeal.ii-dev libgmsh-dev libmumps-dev libmetis-dev libsuitesparse-dev libcli11-dev
  libopenblas-dev libopenblas0-pthread # Debian's default BLAS is the slow reference one
  openmpi-bin libopenmpi-dev
  numdiff                              # compares test results
  python3 python3-numpy python3-matplotlib python3-vtk9 python3-markdown
  xvfb                                 # Debian's VTK draws through an X server only
  chromium                             # checks that reports are shown as they should be
)

if ! command -v dpkg-query apt-get >/dev/null; then
  echo "error: this is no Debian system; install by hand what these packages hold: ${packages[*]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "All packages are installed."
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "error: packages are missing, and installing them needs root or sudo. As root, run:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
  [ -t 0 ] || as_root+=(-n) # nobody there to type a password
fi

echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends "${missing[@]}" </dev/null
