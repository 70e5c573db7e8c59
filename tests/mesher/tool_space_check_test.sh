#!/usr/bin/env bash
# `mesher check` of meshes of tetrahedra, and `mesher trace` of points in space with what `traces`
# makes of it: what they say, how they exit, what they leave behind.
#
#   tool_space_check_test.sh MESHER_TOOL TRACES_TOOL SPACE_FILES
set -u
tool=$(realpath "$1")
traces=$(realpath "$2")
space_files=$(realpath "$3")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# shellcheck source=../support/tool_checks.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/tool_checks.sh"
cd "$scratch" || exit 1

expect() { expect_of "$tool" "$@"; }
refuse() { refuse_of "$tool" "$@"; }

mkdir out
"$space_files" write . || exit 1 # meshes of these points
"$tool" gen uniform --dim 3 --n 50 --seed 1 -o points.node >/dev/null || exit 1
"$tool" gen grid --dim 3 --n 27 --seed 1 -o places.node >/dev/null || exit 1

echo "== check"
for format in node ele vtu vtk msh mesh; do
  expect 0 'delaunay    ok      ' check "uniform.$format" --input points.node --rho 2 --ties
  expect 0 'quality     ok      radius-edge at most 1.8' check "grid.$format" --input places.node \
    --rho 2 --ties
  expect 0 ' slivers below 5' check "small.$format" --rho 2 --ties
done
expect 0 'uniform.vtk: ' check uniform.vtk
expect 0 ' tetrahedra' check uniform.vtk
expect 0 'kinds       ok' check uniform.vtk --input points.node
expect 0 'input       ok      50 points are vertices' check uniform.msh --input points.node
expect 1 'uniform.vtu: error[bad_quality]: quality: tetrahedron ' check uniform.vtu --rho 1.2
expect 1 'error[bad_quality]: input: input point 1 at ' check uniform.vtu --input places.node

# One vertex moved, one tetrahedron missing, twice, inside out.
cp uniform.ele moved.ele
awk 'NR == 200 { $2 += 0.02 } { print }' uniform.node >moved.node
expect 1 'error[bad_quality]' check moved.node
for how in missing twice inverted; do cp uniform.node $how.node; done
awk 'NR == 1 { $1 -= 1 } NR == 100 { next } { print }' uniform.ele >missing.ele
expect 1 'error[bad_quality]: hull: the face of vertex ' check missing.node
awk 'NR == 1 { $1 += 1 } { print } NR == 100 { $1 = 100000; print }' uniform.ele >twice.ele
expect 1 'error[bad_quality]: faces: the face of vertex ' check twice.node
awk 'NR == 100 { t = $2; $2 = $3; $3 = t } { print }' uniform.ele >inverted.ele
expect 1 'error[bad_quality]: orientation: tetrahedron 99 with the vertices ' check inverted.node

expect 2 'error[bad_option]: --constrained is for meshes of triangles' check uniform.vtu --constrained
expect 2 'error[bad_option]: --max-area is for meshes of triangles' check uniform.vtu --max-area 1
expect 0 'hull        ok      the box ' check uniform.vtu --boundary lines
printf '3 2\n1 0 0\n2 1 0\n3 0 1\n' >flat.node
printf '1 3\n1 1 2 3\n' >flat.ele
expect 2 'error[bad_option]: --ties is for meshes of tetrahedra' check flat.node --ties
expect 3 'error[bad_dimension]' check uniform.vtu --input flat.node
printf '4 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n' >one.node
printf '1 4\n1 1 2 3 4\n' >one.ele
expect 1 'hull: ' check one.node
expect 0 'a convex body in the box (0, 0, 0) to (1, 1, 1)' check one.node --boundary any
printf '1 4\n1 1 2 3 5\n' >one.ele
expect 3 'one.ele:2:9: error[bad_mesh]' check one.node

echo "== trace"
domain=(--domain 0 0 0 1 1 1)
cat >edits.txt <<'END'
+point 1000 0.5 0.5000001 0.25
-point 3
move 4 0.25 0.75 0.125
END
awk 'NR == 1 { print; next }
  $1 == 3 { next }
  $1 == 4 { print "4 0.25 0.75 0.125"; next }
  { print }
  END { print "1000 0.5 0.5000001 0.25" }' points.node >edited.node
expect 0 'before.trace: ' trace points.node "${domain[@]}" -o before.trace
expect 0 ' calls' trace points.node "${domain[@]}" --script edits.txt -o after.trace
expect 0 '' trace edited.node "${domain[@]}" -o fresh.trace
same after.trace fresh.trace
refuse 1 'error[outside_domain]' trace points.node --domain 0 0 0 1 1 0.5 -o out/x.trace
expect_of "$traces" 0 ' locate' distance before.trace after.trace
expect_of "$traces" 0 'complete(' show before.trace
[[ -z $("$traces" audit before.trace after.trace 2>&1) ]] || fail "audit is not silent"
expect_of "$traces" 0 '' audit before.trace after.trace
expect_of "$traces" 0 '' render before.trace after.trace -o both.svg

report_checks
