#!/usr/bin/env bash
# The installed packages work for a project outside of this one, from a prefix that has moved.
#   consumer_test.sh BUILD_FOLDER CONSUMER_FOLDER CMAKE_GENERATOR CXX_COMPILER [CXX_FLAGS]
set -euo pipefail
build=$1 consumer=$2 generator=$3 compiler=$4 flags=${5:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/first" >"$work/install.log" || {
  cat "$work/install.log"
  exit 1
}
mv "$work/first" "$work/prefix"
cmake -S "$consumer" -B "$work/build" -G "$generator" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release
cmake --build "$work/build"
"$work/build/use_sac"
"$work/build/use_mesher"
