#!/usr/bin/env bash
# sanitized.sh MESHER: the tool, built with sanitizers, on small inputs of every kind.
set -euo pipefail
mesher=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for kind in uniform grid line-circle; do
  for dimension in 2 3; do
    "$mesher" gen "$kind" --n 150 --dimension "$dimension" -o "$work/$kind$dimension.node"
  done
done
for kind in segments polylines fan; do "$mesher" gen "$kind" --n 30 -o "$work/$kind.poly"; done
for kind in cube-square nested plates wedge; do "$mesher" gen "$kind" -o "$work/$kind.poly"; done

for input in "$work"/*.node "$work"/*.poly; do
  name=$(basename "$input")
  for algorithm in refine svr gap-balls; do
    "$mesher" mesh "$input" --algorithm "$algorithm" --quiet -o "$work/$name.vtu" -o "$work/$name.svg"
  done
  "$mesher" check "$work/$name.vtu" --input "$input" >/dev/null
done
printf '+point 9001 0.31 0.47\nmove 9001 0.33 0.46\n-point 9001\n' >"$work/edits2.txt"
printf '+point 9001 0.31 0.47 0.4\nmove 9001 0.33 0.46 0.41\n-point 9001\n' >"$work/edits3.txt"
"$mesher" edit "$work/uniform2.node" --script "$work/edits2.txt" --quiet -o "$work/edited.node"
"$mesher" edit "$work/segments.poly" --script "$work/edits2.txt" --quiet -o "$work/edited.msh"
"$mesher" edit "$work/nested.poly" --script "$work/edits3.txt" --quiet -o "$work/edited.mesh"
echo "sanitized: all is well"
