#!/usr/bin/env bash
# check_package.sh static|shared: links the libraries of the release tree that way, and checks what
# they install. Both ways use the same objects. Leaves the tree as it is by default: static.
set -euo pipefail
cd "$(dirname "$0")/.."
linkage=$1
case $linkage in
  static) shared=OFF ;;
  shared) shared=ON ;;
  *) echo "usage: check_package.sh static|shared" >&2; exit 2 ;;
esac

trap 'cmake --preset release -DBUILD_SHARED_LIBS=OFF >/dev/null' EXIT
cmake --preset release -DBUILD_SHARED_LIBS=$shared >/dev/null
scripts/build.sh release carom carom_reference carom_hulls carom_ladders
scripts/check_install.sh build/release g++ "$linkage"
