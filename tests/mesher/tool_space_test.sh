# shellcheck shell=bash disable=SC2154
# The tool's part in space; tool_test.sh sources it.

rm -rf out
mkdir out

echo "== space: families"
for kind in uniform gaussian clusters grid line-circle spiral sphere spread; do
  expect 0 '' gen "$kind" --n 100 --seed 3 --dimension 3 -o "$kind.3d.node"
  has "$kind.3d.node" '^100 3 0 0$'
done
expect 0 '' gen sphere --n 100 --seed 4 --dim 3 -o other.3d.node
if cmp -s sphere.3d.node other.3d.node; then fail "the seed says nothing to sphere"; fi

echo "== space: mesh, with the engine and without"
for kind in uniform gaussian clusters grid line-circle spiral sphere spread; do
  expect 0 '100 points in space' mesh "$kind.3d.node" -o 3d.node -o 3d.vtu -o 3d.vtk -o 3d.msh \
    -o 3d.mesh -o 3d.off -o 3d.obj -o 3d.stl -o 3d.svg --stats 3d.json
  has 3d.json '"max_radius_edge": (1\.|2\.0$|2,)'
  expect 0 '' mesh "$kind.3d.node" --static --quiet -o 3ds.node -o 3ds.vtu -o 3ds.vtk -o 3ds.msh \
    -o 3ds.mesh -o 3ds.off -o 3ds.obj -o 3ds.stl -o 3ds.svg
  for format in node ele face vtu vtk msh mesh off obj stl svg; do same 3d.$format 3ds.$format; done
done
for field in vertices simplices min_dihedral_deg max_dihedral_deg max_radius_edge slivers points \
  quadtree steiner triangulate total calls edges trace_bytes peak_rss_bytes; do
  has 3d.json "^ *\"$field\": [0-9]"
done
expect 0 'tetrahedra' mesh uniform.3d.node
[[ -z $("$tool" mesh uniform.3d.node --quiet 2>&1) ]] || fail "--quiet is not quiet in space"
expect 0 '' mesh uniform.3d.node --box --quiet -o boxed.node
expect 0 '' mesh uniform.3d.node --quiet -o plain.node
same boxed.node plain.node
printf '0 3 0 0\n' >empty.3d.node
expect 0 '0 points in space' mesh empty.3d.node -o empty.mesh.node -o empty.svg
expect 0 'largest radius-edge' mesh uniform.3d.node --rho 4 --rule voronoi-aspect
"$tool" mesh uniform.3d.node --rho 3 --quiet --stats - >rho3.json
has rho3.json '"max_radius_edge": 2\.'
python3 -m json.tool rho3.json >/dev/null || fail "--stats - in space"

echo "== space: the dimension is that of INPUT"
tail -n +2 uniform.3d.node | sed 's/^[0-9]* //' >uniform.3d.xyz
(echo 'z;name;y;x' && awk '{ print $3 ";p;" $2 ";" $1 }' uniform.3d.xyz) >named.3d.csv
sed 's/ /,/g' uniform.3d.xyz >bare.3d.csv
awk '{ print "v", $0 } END { print "f 1 2 3"; print "l 1 2" }' uniform.3d.xyz >uniform.3d.obj
(echo OFF && echo '100 1 0' && cat uniform.3d.xyz && echo '3 0 1 2') >uniform.3d.off
(printf '%s\n' ply 'format ascii 1.0' 'element vertex 100' 'property double x' \
  'property double y' 'property double z' 'element face 1' \
  'property list uchar int vertex_indices' end_header && cat uniform.3d.xyz &&
  echo '3 0 1 2') >uniform.3d.ply
expect 0 '' mesh uniform.3d.node --quiet -o fresh.node
for input in uniform.3d.xyz named.3d.csv bare.3d.csv uniform.3d.obj uniform.3d.off uniform.3d.ply; do
  expect 0 '100 points in space' mesh "$input" -o other.node
  same fresh.node other.node
  same fresh.ele other.ele
done
expect 0 "uniform.3d.obj:101: note: the statement 'f' is not used" mesh uniform.3d.obj
expect 0 'is not used' mesh uniform.3d.ply
# What is written in space is read as points: the vertices of the mesh are the points now.
expect 0 '' mesh uniform.3d.node --quiet -o round.vtu -o round.vtk -o round.node -o round.off \
  -o round.stl -o round.obj
for format in vtk node; do
  expect 0 "$(head -1 round.node | cut -d' ' -f1) points in space" mesh round.$format -o other.node
  expect 0 '' mesh round.vtu --quiet -o fresh.node
  same fresh.ele other.ele
  # Of the two formats .node has markers, and they are kept.
  [[ $format == node ]] || same fresh.node other.node
done
[[ $(head -1 other.node) == *' 3 2 1' ]] || fail "markers are lost: $(head -1 other.node)"
for format in stl obj; do
  expect 0 'points in space' mesh round.$format -o other.node
  expect 0 '' mesh round.off --quiet -o fresh.node
  same fresh.node other.node
done
# Three columns that are the plane.
printf '0 0 0\n1 0 0\n0 1 -0.0\n' >flat.xyz
expect 0 'flat.xyz: 3 points' mesh flat.xyz -o flat.svg
expect 0 'flat.xyz: 3 points in space' mesh flat.xyz --dimension 3 -o flat.svg
printf 'x,y,z\n0,0,0\n1,0,0\n0,1,0\n' >flat.csv
expect 0 'triangles' mesh flat.csv -o flat.svg
expect 0 'tetrahedra' mesh flat.csv --dim 3 -o flat.svg
expect 0 'triangles' mesh named.3d.csv --dimension 2
refuse 3 'uniform.3d.xyz:1:40: error[bad_dimension]' mesh uniform.3d.xyz --dimension 2 -o out/x.vtu
refuse 3 'uniform.node:1:5: error[bad_dimension]' mesh uniform.node --dimension 3 -o out/x.vtu
refuse 2 'error[unknown_format]: points and lines are read from' mesh uniform.3d.ply --dimension 2
refuse 2 'error[bad_option]' mesh uniform.node --dimension 4 -o out/x.vtu

echo "== space: bad options and outputs"
refuse 2 'error[bad_option]: --max-area is for the plane' mesh uniform.3d.node --max-area 1 \
  -o out/x.vtu
refuse 3 'uniform.node:1:5: error[bad_dimension]' mesh uniform.3d.node --sizes uniform.node \
  -o out/x.vtu
refuse 2 'error[bad_option]: --domain: 4 numbers' mesh uniform.3d.node --domain 0 0 1 1 -o out/x.vtu
refuse 2 'error[bad_option]: --domain: 6 numbers' mesh uniform.node --domain 0 0 0 1 1 1 -o out/x.vtu
refuse 2 'error[bad_option]: --domain: 5 numbers' mesh uniform.node --domain 0 0 0 1 1 -o out/x.vtu
refuse 2 'left and before' mesh uniform.3d.node --domain 0 0 1 1 1 0 -o out/x.vtu
refuse 2 '--domain' mesh uniform.3d.node --domain 0 0 0 1 1 nan -o out/x.vtu
refuse 2 'error[bad_option]: INPUT is required' mesh --domain 0 0 0 1 1 1 -o out/x.vtu
expect 0 '' mesh --domain 0 0 0 1 1 1 uniform.3d.node --quiet -o first.node
expect 0 '' mesh uniform.3d.node --domain 0 0 0 1 1 1 --quiet -o last.node
same first.node last.node
expect 0 '' mesh --domain -.5 -1 2 2 uniform.node --quiet -o first.node
expect 0 '' mesh uniform.node --domain -.5 -1 2 2 --quiet -o last.node
same first.node last.node
refuse 2 'error[unknown_format]' mesh uniform.3d.node -o out/x.poly
refuse 2 'error[cannot_write]' mesh uniform.3d.node -o out/x.vtu -o none/x.stl
refuse 2 'error[bad_option]' mesh uniform.3d.off -o out/x.vtu -o uniform.3d.off
refuse 2 'out/x.node: error[bad_option]' mesh uniform.3d.node -o out/x.node -o out/x.node
refuse 2 '--rho' mesh uniform.3d.node --rho 1 -o out/x.vtu
refuse 4 'uniform.3d.node: error[too_many]' mesh uniform.3d.node --max-vertices 300 -o out/x.vtu
refuse 4 'uniform.3d.node: error[too_many]' mesh uniform.3d.node --max-vertices 300 --static \
  -o out/x.vtu

refuse 2 'error[bad_option]: --max-area is for the plane' trace uniform.3d.node --max-area 1 \
  -o out/x.trace
refuse 3 'uniform.node:1:5: error[bad_dimension]' trace uniform.3d.node --sizes uniform.node \
  -o out/x.trace

echo "== space: bad points: FILE:LINE:COL: error[code]"
points3() { printf '%b' "$1" >bad3.node; }
points3 '2 3 0 0\n1 0 0 0\n2 0.5 1\n'
refuse 3 'bad3.node:3:8: error[truncated]' mesh bad3.node -o out/x.vtu
points3 '1 3 0 0\n1 0 nan 0\n'
refuse 3 'bad3.node:2:5: error[not_finite]' mesh bad3.node -o out/x.vtu
points3 '2 3 0 0\n7 0 1 1\n7 1 0 0\n'
refuse 3 'bad3.node:3:1: error[repeated_id]' mesh bad3.node -o out/x.vtu
points3 '2 3 0 0\n7 0 1 1\n8 0 1 1\n'
refuse 1 'bad3.node:3:1: error[duplicate_point]: point 8 lies on point 7' mesh bad3.node -o out/x.vtu
for engine in '' --static; do
  points3 '2 3 0 0\n7 0 1 .5\n8 0 1 .5000000000000001\n'
  # shellcheck disable=SC2086
  refuse 1 'bad3.node:3:1: error[too_close]' mesh bad3.node $engine --domain 0 0 0 1 1 1 \
    -o out/x.vtu
  points3 '2 3 0 0\n7 0 1 .5\n8 0 1 3\n'
  # shellcheck disable=SC2086
  refuse 1 'bad3.node:3:1: error[outside_domain]: point 8 at (0, 1, 3)' mesh bad3.node $engine \
    --domain 0 0 0 1 1 1 -o out/x.vtu
  refuse 1 'ZMIN' mesh bad3.node --domain 0 0 0 1 1 1 -o out/x.vtu
done
head -c 2000 uniform.3d.ply >bad3.ply
refuse 3 "error[truncated]: the file ends after" mesh bad3.ply -o out/x.vtu
printf 'solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n' >bad3.stl
refuse 3 'bad3.stl:5:13: error[truncated]' mesh bad3.stl -o out/x.vtu

echo "== space: edit"
cat >edits3.txt <<'END'
# every kind of edit
+point 1000 0.5 0.5000001 .25
-point 3
move 4 0.25 0.75 .5
begin
+point 1001 0.125 0.875 1e-3
-point 1000
move 5 .9 .1 +.5
commit
END
awk 'NR == 1 { print "100 3 0 0"; next }
  $1 == 3 { next }
  $1 == 4 { print "4 0.25 0.75 .5"; next }
  $1 == 5 { print "5 .9 .1 .5"; next }
  { print }
  END { print "1001 0.125 0.875 1e-3" }' uniform.3d.node >edited.3d.node
domain3=(--domain 0 0 0 1 1 1)
expect 0 '' mesh edited.3d.node "${domain3[@]}" -o fresh.node -o fresh.vtu
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit uniform.3d.node "${domain3[@]}" --script edits3.txt $engine -o after.node \
    -o after.vtu -o after.svg --stats "after3$engine.jsonl"
  for format in node ele face; do same after.$format fresh.$format; done
  same after.vtu fresh.vtu
  [[ $(wc -l <"after3$engine.jsonl") == 5 ]] || fail "after3$engine.jsonl has not 5 lines"
  has "after3$engine.jsonl" '^\{"edit":"-point 3","seconds":[0-9.e-]+,"calls":\{"executed":[0-9]+,"reused":[0-9]+,"created":[0-9]+,"discarded":[0-9]+\},"vertices":\{"added":[0-9]+,"removed":[1-9][0-9]*\},"simplices":\{"added":[0-9]+,"removed":[0-9]+\},"kept":\{"added":[0-9]+,"removed":[1-9][0-9]*\}\}$'
  has after.svg 'fill="#(ff|f|e|d|c)[0-9a-f]*"'
  cp after.svg "picture$engine.svg"
done
same picture.svg picture--static.svg
counts after3.jsonl >engine.counts
counts after3--static.jsonl >static.counts
same engine.counts static.counts

echo "== space: bad edits: FILE:LINE:COL: error[code], nothing written"
# bad_edit3 CODE TEXT SCRIPT: after a good line
bad_edit3() {
  printf '+point 1000 .5 .4999 .5\n%b\n' "$3" >bad3.txt
  for engine in '' --static; do
    # shellcheck disable=SC2086
    refuse "$1" "bad3.txt:$2" edit uniform.3d.node --script bad3.txt $engine -o out/x.node \
      --stats out/x.jsonl
  done
}
bad_edit3 3 '2:13: error[bad_edit]' '+point 1 1 1'
bad_edit3 3 '2:16: error[bad_edit]' '+point 1 1 1 1 1'
bad_edit3 3 '2:15: error[bad_number]' '+point 1 .5 1 z'
bad_edit3 3 '2:13: error[not_finite]' '+point 1 .5 nan 1'
bad_edit3 3 '2:14: error[magnitude]' 'move 1 .5 .5 1e-40'
bad_edit3 3 '2:1: error[unknown_id]' '-point 999'
bad_edit3 3 '2:1: error[unknown_id]' 'move 999 .1 .1 .1'
bad_edit3 3 '2:1: error[repeated_id]' '+point 1000 .1 .1 .1'
bad_edit3 1 '2:1: error[duplicate_point]' '+point 1002 .5 .4999 .5'
bad_edit3 1 '3:2: error[duplicate_point]' 'begin\n move 7 .5 .4999 .5\ncommit'
bad_edit3 1 '2:1: error[outside_domain]' '+point 1002 .5 .5 7'
bad_edit3 3 '2:1: error[unbalanced_commit]' 'commit'
bad_edit3 3 '2:1: error[unbalanced_commit]' 'begin'
bad_edit3 3 "2:7: error[bad_edit]" 'limit area 1'
bad_edit3 3 '2:12: error[bad_number]' 'limit size 0'
bad_edit3 3 '2:24: error[bad_edit]' 'limit size 1 in 0 0 1 1'
bad_edit3 3 "2:1: error[bad_edit]: no edit is called '+tetrahedron'" '+tetrahedron 1 2 3'
printf '+point 1002 .5 .5 7\n' >bad3.txt
refuse 1 'ZMAX' edit uniform.3d.node --script bad3.txt -o out/x.node

echo "== space: segments and polygons come and go by edits"
cat >corners.node <<'END'
8 3 0 0
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 .5 .5 -1
6 .5 .5 1
7 .2 .2 .5
8 .8 .8 .5
END
printf '%s\n' '+polygon 1 1 2 3 4 along 1 3' '+segment 1 7 8' '+polyline 2 1 5 2' 'begin' '+point 9 .4 .5 0' \
  '-polygon 1' '+polygon 3 1 2 3 4 on 9' '-point 8' '-segment 1' 'commit' 'move 9 .4 .6 0' >features3.txt
expect 0 '' edit corners.node --script features3.txt -o after.node --stats after3.jsonl
expect 0 '' edit corners.node --script features3.txt --static -o after.static.node \
  --stats after3--static.jsonl
for format in node ele face; do same after.$format after.static.$format; done
[[ $(wc -l <after3.jsonl) == 6 ]] || fail 'after3.jsonl has not 6 lines'
counts after3.jsonl >engine.counts
counts after3--static.jsonl >static.counts
same engine.counts static.counts
expect 0 '' mesh corners.node -o alone.node
if cmp -s after.ele alone.ele; then fail "polygons say nothing to the mesh"; fi
printf '%s\n' '+polygon 1 1 2 3 4' '+segment 1 7 8' '-segment 1' '-polygon 1' >gone3.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 '' edit corners.node --script gone3.txt $engine -o after.node
  for format in node ele face; do same after.$format alone.$format; done
done
# bad_features3 CODE TEXT SCRIPT: the whole message after the file's name
bad_features3() {
  printf '%b\n' "$3" >bad3.txt
  for engine in '' --static; do
    # shellcheck disable=SC2086
    refuse "$1" "bad3.txt:$2" edit corners.node --script bad3.txt $engine -o out/x.node
    # shellcheck disable=SC2086
    said=$("$tool" edit corners.node --script bad3.txt $engine 2>&1)
    [[ $said == "bad3.txt:$2" ]] || fail "$said, expected bad3.txt:$2"
  done
}
bad_features3 1 '2:1: error[segment_through_polygon]: segment 2 goes through polygon 1 at (0.5, 0.5, 0) (polygon 1: bad3.txt:1)' \
  '+polygon 1 1 2 3 4\n+segment 2 5 6'
bad_features3 1 '2:1: error[segment_through_polygon]: segment 1 goes through polygon 1 at (0.5, 0.5, 0) (segment 1: bad3.txt:1)' \
  '+segment 1 5 6\n+polygon 1 1 2 3 4'
bad_features3 1 '3:1: error[crossing_segments]: an edge of polygon 4 crosses segment 3 at (0.5, 0.5, 0.5) (segment 3: bad3.txt:1)' \
  '+segment 3 7 8\n+segment 4 1 2\n+polygon 4 5 4 6'
bad_features3 1 '2:1: error[point_in_use]: point 1 cannot go: it is on polygon 3 (polygon 3: bad3.txt:1)' \
  '+polygon 3 1 2 3 4\n-point 1'
bad_features3 1 '2:1: error[point_in_use]: point 7 cannot go: it is an end of segment 1 (segment 1: bad3.txt:1)' \
  '+segment 1 7 8\n-point 7'
bad_features3 1 '1:1: error[zero_length]: segment 1 goes from point 1 to itself (point 1: corners.node:2)' \
  '+segment 1 1 1'
bad_features3 1 '2:1: error[repeated_polygon]: polygon 4 is polygon 3 again; its first corner is at (0, 0, 0) (polygon 3: bad3.txt:1)' \
  '+polygon 3 1 2 3 4\n+polygon 4 3 2 1 4'
bad_features3 1 '1:1: error[not_flat]: polygon 3 is not flat: (0.5, 0.5, -1) is 0.5773502691896258 off its plane' \
  '+polygon 3 1 2 3 5'
bad_features3 3 '1:1: error[unknown_id]: point 99, a corner of polygon 3, is not there' \
  '+polygon 3 1 2 99'
bad_features3 3 '1:1: error[unknown_id]: polygon 3 is not there' '-polygon 3'

echo "== space: interrupts leave nothing behind"
expect 0 '' gen uniform --n 400000 --dimension 3 -o large.3d.node
for engine in '' --static; do
  # shellcheck disable=SC2086
  timeout --preserve-status -s INT 1.5 \
    "$tool" mesh large.3d.node $engine -o out/x.vtu -o out/x.svg >said.txt 2>&1
  echo $? >>said.txt
  has said.txt 'error\[cancelled\]'
  has said.txt '^5$'
  [[ -z $(ls -A out) ]] || fail "SIGINT in space left: $(ls -A out)"
done
if command -v script >/dev/null; then
  on_terminal "$tool" mesh large.3d.node >said.txt 2>&1
  has said.txt '(octree|Steiner points|tetrahedra) \([1-3] of 3\): [0-9]'
fi
