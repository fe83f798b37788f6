#!/usr/bin/env bash
# setup.sh build|dev|peers|docs|ci: installs missing packages (Debian 12, Ubuntu 24.04 or later).
# build: what building, testing and benchmarking need. dev: clang, its tools and valgrind as well.
# peers: build, and the libraries Carom is compared with. docs: build, and doxygen. ci: all, and a
# cross compiler for AArch64.
set -euo pipefail

build_packages=(
  cmake ninja-build make g++ pkg-config git ccache python3
  libhwy-dev libtbb-dev libeigen3-dev libzip-dev libcli11-dev nlohmann-json3-dev
  libgtest-dev libgmock-dev libbenchmark-dev librapidcheck-dev libboost-dev
  libqhull-dev libmeshoptimizer-dev libassimp-dev libtinyxml2-dev
)
dev_packages=(clang clang-format clang-tidy libclang-rt-dev valgrind)
peer_packages=(libcgal-dev libbullet-dev libfcl-dev libode-dev libccd-dev libembree-dev)
optional_peer_packages=(libmujoco-dev)  # not every distribution has them
ci_packages=("${dev_packages[@]}" "${peer_packages[@]}" doxygen g++-aarch64-linux-gnu)

optional_packages=()
case "${1:-build}" in
  build) packages=("${build_packages[@]}") ;;
  dev) packages=("${build_packages[@]}" "${dev_packages[@]}") ;;
  ci)
    packages=("${build_packages[@]}" "${ci_packages[@]}")
    optional_packages=("${optional_peer_packages[@]}")
    ;;
  peers)
    packages=("${build_packages[@]}" "${peer_packages[@]}")
    optional_packages=("${optional_peer_packages[@]}")
    ;;
  docs) packages=("${build_packages[@]}" doxygen) ;;
  *) echo "usage: setup.sh build|dev|ci|peers|docs" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null; then
  echo "setup: not a Debian or Ubuntu system; these packages are needed: ${packages[*]}" >&2
  exit 0
fi

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null || true)" = installed ]
}

# Prints the optional packages that are missing and that the distribution has.
missing_options() {
  for package in "${optional_packages[@]}"; do
    is_installed "$package" || ! apt-cache show "$package" >/dev/null 2>&1 || echo "$package"
  done
}

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
mapfile -t options < <(missing_options)
[ $((${#missing[@]} + ${#options[@]})) -gt 0 ] || exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=()
elif command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
  as_root=(sudo)
else
  echo "setup: packages are missing; run as root:" >&2
  echo "  apt-get update && apt-get install -y --no-install-recommends" \
    "${missing[*]} ${options[*]}" >&2
  exit $((${#missing[@]} > 0))
fi

# Everything works without the optional packages: to get none of them is no failure.
needed=${#missing[@]}
"${as_root[@]}" apt-get update -q || [ "$needed" = 0 ]
mapfile -t options < <(missing_options)  # a new system knows of no package before
missing+=("${options[@]}")
echo "setup: installing ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -q -y --no-install-recommends "${missing[@]}" || [ "$needed" = 0 ]
