#!/usr/bin/env bash
# The same input gives the same bytes whatever compiler and optimisation built the tool.
#   determinism.sh SCRATCH_FOLDER
# Builds the tools with g++ and clang++, Debug and Release (about a minute and 500 MB each), meshes
# inputs of each family and an edited one, statically and with the engine, records the examples of
# the engine after edits, and compares files.
set -euo pipefail
source_folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
mkdir -p "$1"
scratch=$(cd "$1" && pwd)
jobs=${JOBS:-$(nproc)}
kinds=(uniform gaussian clusters grid line-circle spiral)
space_kinds=(uniform gaussian clusters grid line-circle spiral sphere spread)
space_points=200
line_kinds=(segments lengths polylines trees corridors zigzag fan bundle)
points=400
lines=60

# A hundred edits of points 1..n near the middle of the first ones: added, moved, removed.
write_edits() {
  awk -v n=$points 'BEGIN {
    srand(7)
    for (i = 1; i <= 40; ++i) printf "+point %d %.17g %.17g\n", n + i, 0.2 + 0.6 * rand(), 0.2 + 0.6 * rand()
    print "begin"
    for (i = 1; i <= 20; ++i) printf "move %d %.17g %.17g\n", n + i, 0.2 + 0.6 * rand(), 0.2 + 0.6 * rand()
    print "commit"
    for (i = 1; i <= 40; ++i) printf "-point %d\n", 2 * i
  }'
}

# Two triangles that lean on each other and a segment come; one triangle goes.
write_complex() {
  printf '%s\n' begin '+point 9001 0.31 0.32 0.33' '+point 9002 0.71 0.33 0.37' \
    '+point 9003 0.49 0.72 0.41' '+point 9004 0.52 0.38 0.74' '+point 9005 0.9 0.9 0.1' \
    '+point 9006 0.8 0.95 0.9' commit '+polygon 1 9001 9002 9003' '+polygon 2 9001 9002 9004' \
    '+segment 3 9005 9006' '-polygon 1'
}

# Texts of traces name modifiables by where they lie, and with SAC_CHECKS they take more memory: all
# builds are without.
build_tool() {  # COMPILER CONFIGURATION FOLDER
  cmake -S "$source_folder" -B "$3" -DCMAKE_CXX_COMPILER="$1" -DCMAKE_BUILD_TYPE="$2" \
    -DBUILD_TESTING=OFF -DSAC_CHECKS=OFF >"$3.log" 2>&1 || { cat "$3.log"; return 1; }
  cmake --build "$3" -j "$jobs" --target mesher_tool traces_tool >"$3.log" 2>&1 || { cat "$3.log"; return 1; }
}

example_names() {  # TRACES_TOOL
  "$1" example '?' -o none 2>&1 | sed -n 's/.*there are \(.*\); see.*/\1/p' | tr -d ,
}

write_files() {  # TOOLS FOLDER
  local kind tool=$1/mesher example
  rm -rf "$2"
  mkdir -p "$2"
  cd "$2"
  write_edits >edits.txt
  for kind in "${kinds[@]}"; do
    "$tool" gen "$kind" --n $points --seed 3 -o "$kind.node"
    "$tool" mesh "$kind.node" --algorithm gap-balls --quiet -o "$kind.out.node" -o "$kind.vtu" -o "$kind.svg" \
      -o "$kind.vtk" -o "$kind.msh" -o "$kind.mesh" -o "$kind.out.obj"
    "$tool" mesh "$kind.node" --quiet --static -o "$kind.static.node"
    "$tool" mesh "$kind.node" --algorithm gap-balls --quiet --rule voronoi-aspect -o "$kind.aspect.node"
    "$tool" mesh "$kind.node" --quiet --algorithm svr -o "$kind.svr.node"
    "$tool" mesh "$kind.node" --quiet --algorithm refine -o "$kind.refine.node"
    cmp "$kind.out.node" "$kind.static.node"
    cmp "$kind.out.ele" "$kind.static.ele"
  done
  for kind in "${space_kinds[@]}"; do
    "$tool" gen "$kind" --n $space_points --seed 3 --dimension 3 -o "$kind.space.node"
    "$tool" mesh "$kind.space.node" --algorithm gap-balls --quiet -o "$kind.space.out.node" -o "$kind.space.vtu" \
      -o "$kind.space.svg" -o "$kind.space.stl"
    "$tool" mesh "$kind.space.node" --quiet --static -o "$kind.space.static.node"
    "$tool" mesh "$kind.space.node" --quiet --algorithm svr -o "$kind.space.svr.node"
    "$tool" mesh "$kind.space.node" --quiet --algorithm refine -o "$kind.space.refine.node"
    cmp "$kind.space.out.node" "$kind.space.static.node"
    cmp "$kind.space.out.ele" "$kind.space.static.ele"
  done
  for kind in "${line_kinds[@]}"; do
    "$tool" gen "$kind" --n $lines --seed 3 -o "$kind.poly"
    "$tool" mesh "$kind.poly" --algorithm gap-balls --quiet -o "$kind.lines.node" -o "$kind.lines.vtu"
    "$tool" mesh "$kind.poly" --quiet --algorithm svr -o "$kind.lines.svr.node"
    "$tool" mesh "$kind.poly" --quiet --algorithm refine -o "$kind.lines.refine.node"
    "$tool" mesh "$kind.poly" --quiet --static -o "$kind.lines.static.node"
    cmp "$kind.lines.ele" "$kind.lines.static.ele"
  done
  "$tool" edit uniform.node --script edits.txt --quiet -o edited.node
  write_complex >complex.txt
  "$tool" edit uniform.space.node --script complex.txt --quiet -o complex.node -o complex.vtu
  "$tool" edit uniform.space.node --script complex.txt --quiet --static -o complex.static.node
  cmp complex.node complex.static.node
  cmp complex.ele complex.static.ele
  "$tool" mesh "$source_folder/tests/data/places.node" --algorithm gap-balls --quiet -o places.node
  "$tool" trace uniform.node --script edits.txt --quiet --edges -o edited.trace
  for example in $(example_names "$1/traces"); do
    "$1/traces" example "$example" --n 200 --edits 50 --edges -o "$example.trace" >"$example.txt"
  done
  cd "$scratch"
}

first=""
for compiler in g++ clang++; do
  for configuration in Release Debug; do
    name=$compiler-$configuration
    echo "== $name"
    build_tool "$compiler" "$configuration" "$scratch/build-$name"
    write_files "$scratch/build-$name/bin" "$scratch/files-$name"
    if [[ -z $first ]]; then
      first=$name
    else
      diff -rq "$scratch/files-$first" "$scratch/files-$name"
    fi
  done
done
echo "$(find "$scratch/files-$first" -type f | wc -l) files, the same bytes from every build"
