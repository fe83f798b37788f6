#!/usr/bin/env bash
# docs.sh: writes the reference pages of the public headers to build/docs/html. Fails if a public
# name has no documentation, or if doxygen warns of anything else.
set -euo pipefail
cd "$(dirname "$0")/.."

version=$(sed -n 's/^project(carom VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
rm -rf build/docs
mkdir -p build/docs
sed "s/@VERSION@/$version/" docs/Doxyfile.in >build/docs/Doxyfile
doxygen build/docs/Doxyfile
echo "docs: build/docs/html/index.html"
