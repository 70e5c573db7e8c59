# Lines, holes and regions as a user of the tool meets them; sourced by tool_test.sh.
# shellcheck shell=bash disable=SC2154

echo "== a lake with an island, a wall and two regions"
cat >lake.poly <<'END'
# points: id x y marker
10 2 0 1
1 0 0 5
2 6 0 5
3 8 0 0
4 8 8 0
5 6 8 0
6 0 8 0
7 2 2 0
8 4 2 0
9 4 4 0
10 2 4 0
11 1
1 1 2 3
2 2 3 3
3 3 4 0
4 4 5 0
5 5 6 0
6 6 1 0
7 7 8 0
8 8 9 0
9 9 10 0
10 10 7 0
11 2 5 7
1
1 3 3
2
1 1 1 10 -1
2 7 7 20 0.5
END
formats=(node ele edge poly neigh vtu vtk msh mesh off obj svg)
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'regions               2, holes 1' mesh lake.poly $engine -o "lake$engine.1.node" \
    -o "lake$engine.1.vtu" -o "lake$engine.1.vtk" -o "lake$engine.1.msh" -o "lake$engine.1.mesh" \
    -o "lake$engine.1.off" -o "lake$engine.1.obj" -o "lake$engine.1.svg" --stats "lake$engine.json"
done
for format in "${formats[@]}"; do same "lake.1.$format" "lake--static.1.$format"; done
for format in node vtu vtk msh mesh obj; do
  expect 0 'segments    ok' check "lake.1.$format" --input lake.poly --rho 1.4142
done
for format in node vtu vtk mesh; do
  expect 0 'markers     ok      19 vertices and 20 edges' check "lake.1.$format" --input lake.poly
done
sed 's/ 7 11$/ 8 11/' lake.1.edge >marked.edge
cp lake.1.node marked.node
cp lake.1.ele marked.ele
refuse 1 'has the marker 8, but is on line 11 (line 24), which has 7' check marked.node \
  --input lake.poly
# Values that .mesh counts are not compared there; others are, in other formats.
sed 's/^11 2 5 7/11 2 5 -7/; s/^1 1 1 10 -1/1 1 1 -2.5 -1/' lake.poly >counted.poly
expect 0 '' mesh counted.poly -o counted.mesh -o counted.vtu -o counted.msh
expect 0 'markers are not compared' check counted.mesh --input counted.poly
expect 0 'attributes of regions are not compared' check counted.mesh --input counted.poly
for format in vtu msh; do
  expect 0 'markers     ok' check "counted.$format" --input counted.poly
  refuse 1 'has the marker -7, but is on line 11' check "counted.$format" --input lake.poly
done
has lake.1.ele '^[0-9]+ [0-9]+ [0-9]+ [0-9]+ 10$'
has lake.1.ele '^[0-9]+ [0-9]+ [0-9]+ [0-9]+ 20$'
has lake.1.edge '^[0-9]+ [0-9]+ [0-9]+ 7 11$'
has lake.1.edge '^[0-9]+ [0-9]+ [0-9]+ 1 3$'
has lake.1.node '^[0-9]+ 6 0 2 2 5$'
has lake.1.node '^[0-9]+ 8 8 2 4 1$'
has lake.1.msh '"region_20"'
has lake.1.msh '"marker_7"'
has lake.1.svg '#fde3cf'
python3 - <<'END' || fail "lake.json: $(cat lake.json)"
import json
run = json.load(open('lake.json'))
assert run['above_rho'] == 0 and run['min_angle_deg_within_rho'] == run['min_angle_deg']
assert run['regions'] == 2 and run['holes'] == 1 and run['seed_faults'] == 0
assert run['kept']['points'] == 10 and run['kept']['vertices'] < run['vertices']
assert run['kept']['simplices'] == int(open('lake.1.ele').readline().split()[0])
END
expect 0 'regions               4, holes 1' mesh lake.poly --box -o lake.box.vtu
expect 0 'regions     ok' check lake.box.vtu --input lake.poly --boundary box --rho 1.4142
refuse 1 'holds the seed of hole 1' check lake.box.vtu --input lake.poly --boundary any
[[ -z $("$tool" mesh lake.poly --quiet -o quiet.vtu 2>&1) ]] || fail "--quiet is not quiet"

echo "== an output never takes an input's name"
refuse 2 'lake.poly: error[bad_option]' mesh lake.poly -o lake.node
[[ ! -e lake.node ]] || fail "lake.node is there"
{ echo '0 2 0 0' && tail -n +13 lake.poly; } >beside.poly
sed -n 2,12p lake.poly >beside.node
refuse 2 'beside.node: error[bad_option]' mesh beside.poly -o beside.node
expect 0 'regions               2, holes 1' mesh beside.poly -o beside.1.node
same beside.1.node lake.1.node

echo "== every format with lines gives the same mesh"
cat >ring.poly <<'END'
4 2 0 0
1 0 0
2 1 0
3 1 1
4 0 1
4 0
1 1 2
2 2 3
3 3 4
4 4 1
0
END
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 2\nl 2 3\nl 3 4\nl 4 1\n' >ring.obj
cat >ring.geojson <<'END'
{"type": "MultiLineString", "coordinates":
  [[[0, 0], [1, 0]], [[1, 0], [1, 1]], [[1, 1], [0, 1]], [[0, 1], [0, 0]]]}
END
cp ring.geojson ring.json
expect 0 '4 points, 4 lines' mesh ring.poly -o ring.1.vtu
for input in ring.obj ring.geojson ring.json; do
  expect 0 '4 points, 4 lines' mesh "$input" -o other.vtu
  same ring.1.vtu other.vtu
done
cat >island.geojson <<'END'
{"type": "Feature", "properties": {"attribute": 3}, "geometry": {"type": "Polygon", "coordinates":
  [[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]], [[3, 3], [3, 5], [5, 5], [5, 3], [3, 3]]]}}
END
expect 0 'regions               1, holes 1' mesh island.geojson -o island.1.node
has island.1.ele ' 3$'
expect 0 'regions     ok' check island.1.node --input island.geojson --rho 1.4142


echo "== neighbouring polygons share a border"
cat >countries.geojson <<'END'
{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"attribute": 5}, "geometry": {"type": "Polygon", "coordinates":
  [[[0,0],[8,0],[8,8],[0,8],[0,0]], [[2,2],[2,4],[4,4],[4,2],[2,2]], [[6,6],[6,7],[7,6],[6,6]]]}},
{"type": "Feature", "properties": {"attribute": 6}, "geometry": {"type": "Polygon", "coordinates":
  [[[8,8],[8,0],[12,4],[8,8]]]}},
{"type": "Feature", "properties": {"attribute": 7}, "geometry": {"type": "Polygon", "coordinates":
  [[[2,2],[4,2],[4,4],[2,4],[2,2]]]}}]}
END
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'regions               3, holes 1' mesh countries.geojson $engine -o countries.1.node
  for attribute in 5 6 7; do has countries.1.ele " $attribute\$"; done
done
expect 0 'countries.geojson:5: note: a border that polygons share' mesh countries.geojson -o x.vtu
expect 0 'regions     ok' check countries.1.node --input countries.geojson --rho 1.4142
sed 's/\[8,8\],\[8,0\],\[12,4\],\[8,8\]/[8,6],[8,2],[12,4],[8,6]/' countries.geojson >bays.geojson
refuse 1 '; --repair mends this' mesh bays.geojson -o out/x.vtu
expect 0 'regions               3, holes 1' mesh bays.geojson --repair -o x.vtu

echo "== what encloses nothing is meshed in the box"
sed '/^4 4 1$/d; s/^4 0$/3 0/' ring.poly >open.poly
expect 0 'vertices              ' mesh open.poly -o open.1.vtu
expect 0 '' mesh open.poly --box -o open.box.vtu
same open.1.vtu open.box.vtu
sed 's/^4 2 0 0/5 2 0 0/; s/^4 0 1$/4 0 1\n5 3 3/' ring.poly >stray.poly
expect 0 'points left out       1; --box keeps all' mesh stray.poly -o stray.1.vtu

echo "== seeds without a region are warned of"
sed 's/^1 3 3$/1 5 8/; s/^1 1 1 10 -1/1 7 6 10 -1/' lake.poly >faults.poly
expect 0 'faults.poly:26: warning: the seed of hole 1 at (5, 8) is on segment 5' mesh faults.poly \
  -o faults.1.vtu
expect 0 'faults.poly:29: warning: the seed of region 2 at (7, 7) is in one region with region 1' \
  mesh faults.poly --static -o faults.1.vtu --stats faults.json
has faults.json '"seed_faults": 2'
expect 0 'regions     ok' check faults.1.vtu --input faults.poly --rho 1.4142
sed 's/^1 1 1 10 -1/1 99 99 10 -1/' lake.poly >far.poly
expect 0 'far.poly:28: warning: the seed of region 1 at (99, 99) is outside' mesh far.poly -o far.1.vtu
sed 's/^1 1 1 10 -1/1 1 1 10/' lake.poly >single.poly
expect 0 'single.poly:28: note: a region with one value' mesh single.poly -o single.1.vtu

echo "== bad geometry: both features with their lines"
# bad_lake CODE TEXT SED_SCRIPT
bad_lake() {
  sed "$3" lake.poly >bad.poly
  for engine in '' --static; do
    # shellcheck disable=SC2086
    refuse "$1" "$2" mesh bad.poly $engine -o out/x.vtu --stats out/x.json
  done
}
bad_lake 1 'bad.poly:21:1: error[crossing_segments]: segment 8 crosses segment 11 at (4, 2.6666666666666665) (segment 11: bad.poly:24)' \
  's/^11 2 5 7/11 2 6 7/; s/^3 3 4 0/3 3 5 0/'
bad_lake 1 'bad.poly:24:1: error[repeated_segment]: segment 11 is segment 1 again, from (0, 0) to (6, 0) (segment 1: bad.poly:14)' \
  's/^11 2 5 7/11 1 2 7/'
bad_lake 1 'bad.poly:14:1: error[overlapping_segments]: segment 1 overlaps segment 11 from (0, 0) to (6, 0) (segment 11: bad.poly:24)' \
  's/^11 2 5 7/11 1 3 7/'
bad_lake 1 'bad.poly:24:1: error[zero_length]: segment 11 goes from point 2 to itself (point 2: bad.poly:4)' \
  's/^11 2 5 7/11 2 2 7/'
bad_lake 1 'bad.poly:12:1: error[point_on_segment]: point 10 (8, 4) lies on segment 3 (segment 3: bad.poly:16)' \
  's/^10 2 4 0/10 8 4 0/'
bad_lake 1 'bad.poly:12:1: error[duplicate_point]: point 10 (2, 2) lies on point 7 (point 7: bad.poly:9)' \
  's/^10 2 4 0/10 2 2 0/'
sed 's/\[3, 3\], \[3, 5\], \[5, 5\], \[5, 3\]/[3, 3], [5, 5], [3, 5], [5, 3]/' island.geojson >bad.geojson
refuse 1 'bad.geojson:2:' mesh bad.geojson -o out/x.vtu
expect 1 'error[crossing_segments]: segment 2 crosses itself at (4, 4)' mesh bad.geojson -o out/x.vtu
bad_lake 1 '(point 7: bad.poly:9)' 's/^10 2 4 0/10 2 2.000000000000001 0/'
bad_lake 3 'bad.poly:24:1: error[unknown_id]: segment 11' 's/^11 2 5 7/11 2 99 7/'
refuse 2 'segments need the rule radius-edge' mesh lake.poly --rule voronoi-aspect -o out/x.vtu

echo "== --max-vertices"
refuse 4 'error[too_many]: more than 60 vertices' mesh lake.poly --max-vertices 60 -o out/x.vtu
refuse 4 'lake.poly:14:1: error[too_many]' mesh lake.poly --max-vertices 60 --static -o out/x.vtu
printf '3 2 0 0\n1 0 0\n2 1 0\n3 1 1e-5\n2 0\n1 1 2\n2 1 3\n0\n' >wedge.poly
for engine in '' --static; do
  # shellcheck disable=SC2086
  refuse 4 'more than 50 vertices are needed; so far 8 are on segment 1 and 8 on segment 2 (' mesh \
    wedge.poly --max-vertices 50 $engine -o out/x.vtu
done
refuse 2 '--max-vertices' mesh lake.poly --max-vertices 0 -o out/x.vtu
refuse 2 '--max-vertices' mesh lake.poly --max-vertices -5 -o out/x.vtu
refuse 2 '--max-vertices' mesh lake.poly --max-vertices 1e3 -o out/x.vtu
expect 0 '' mesh lake.poly --max-vertices 67 -o budget.vtu
same budget.vtu lake.1.vtu

echo "== memory"
expect 0 '' gen uniform --n 100000 -o many.node
# little COMMAND...: with memory for the program, and little more; a sanitizer's tables have none.
little() { (ulimit -d 40000 && "$chosen" "$@"); }
if little --version >/dev/null 2>&1; then
  refuse_of little 4 'many.node: error[too_many]: out of memory' mesh many.node -o out/x.vtu
  : >none.txt
  refuse_of little 4 'error[too_many]: out of memory' edit many.node --script none.txt -o out/x.vtu
  expect_of little 0 '' mesh lake.poly -o little.vtu
  same little.vtu lake.1.vtu
fi

echo "== limits of size"
for limit in '--max-area 0.3' '--max-size 0.8'; do
  for engine in '' --static; do
    # shellcheck disable=SC2086
    expect 0 '' mesh lake.poly $limit $engine -o "limited$engine.1.node" -o "limited$engine.vtu"
  done
  same limited.vtu limited--static.vtu
  expect 0 'area        ok' check limited.1.node --input lake.poly --max-area 0.3
done
expect 1 'area' check lake.1.node --input lake.poly --max-area 0.3
printf 'x,y,h\n0,0,0.3\n8,0,0.8\n8,8,2\n0,8,0.8\n' >sizes.csv
printf '4 2 1 0\n1 0 0 0.3\n2 8 0 0.8\n3 8 8 2\n4 0 8 0.8\n' >sizes.node
expect 0 '' mesh lake.poly --sizes sizes.csv -o by_csv.1.node
expect 0 '' mesh lake.poly --sizes sizes.node -o by_node.1.node
same by_csv.1.node by_node.1.node
expect 0 'area        ok' check by_csv.1.node --input lake.poly --max-area 1.74
expect 1 'area' check by_csv.1.node --input lake.poly --max-area 0.2
# Region 2 alone has a limit: it holds in it, and larger triangles are left in region 1.
expect 0 '' mesh lake.poly --region-areas -o by_region.1.node -o by_region.vtu
expect 0 '' mesh lake.poly --region-areas --static -o by_region--static.vtu
same by_region.vtu by_region--static.vtu
python3 - <<'END' || fail 'areas by region'
lines = [l.split() for l in open('by_region.1.node') if not l.startswith('#')][1:]
at = {row[0]: (float(row[1]), float(row[2])) for row in lines}
largest = {}
for row in [l.split() for l in open('by_region.1.ele') if not l.startswith('#')][1:]:
    (ax, ay), (bx, by), (cx, cy) = (at[v] for v in row[1:4])
    area = ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2
    largest[row[4]] = max(largest.get(row[4], 0), area)
assert largest['20'] <= 0.5 < largest['10'], largest
END
# Asked for without any: said, also of an edit, unless that brings one.
unused='note: --region-areas is not used: no region has a largest area'
expect 0 "open.poly: $unused" mesh open.poly --region-areas -o x.vtu
printf '+region 3 1 1 5\n' >region.txt
expect 0 "open.poly: $unused" edit open.poly --region-areas --script region.txt -o x.vtu
printf '+region 3 1 1 5 0.5\n' >region.txt
said=$("$tool" edit open.poly --region-areas --script region.txt -o x.vtu 2>&1)
said+=$("$tool" mesh lake.poly --region-areas -o x.vtu 2>&1)
said+=$("$tool" mesh open.poly --region-areas --quiet -o x.vtu 2>&1)
[[ $said != *"$unused"* ]] || fail "used or --quiet, and said to be unused: $said"
# A bad output is found before any work, that for the limits too: the lines cross.
sed 's/^11 2 5 7/11 2 6 7/; s/^3 3 4 0/3 3 5 0/' lake.poly >crossing.poly
for limit in '' --region-areas; do
  # shellcheck disable=SC2086
  refuse 2 'error[cannot_write]' mesh crossing.poly $limit -o nowhere/x.vtu
done
expect 0 '' mesh lake.poly --region-areas --max-area 0.3 -o inside.1.node --stats inside.json
expect 0 'area        ok' check inside.1.node --input lake.poly --max-area 0.3
expect 0 '' mesh lake.poly --max-area 0.3 --box -o all.vtu --stats all.json
python3 - <<'END' || fail 'the outside is filled'
import json
inside, everywhere = json.load(open('inside.json')), json.load(open('all.json'))
assert inside['vertices'] < everywhere['vertices'], (inside['vertices'], everywhere['vertices'])
END
printf '+point 20 1 6\nmove 9 5 5\n' >limited.txt
sed -e 's/^10 2 0 1/11 2 0 1/; s/^9 4 4 0/9 5 5 0/; s/^10 2 4 0/&\n20 1 6 0/' lake.poly >moved.poly
for limit in '--max-area 0.3' '--max-area 0.3 --box' '--sizes sizes.csv' --region-areas; do
  # shellcheck disable=SC2086
  expect 0 '' edit lake.poly --domain 0 0 8 8 --script limited.txt $limit -o limited_edit.vtu
  # shellcheck disable=SC2086
  expect 0 '' mesh moved.poly --domain 0 0 8 8 $limit -o limited_mesh.vtu
  same limited_edit.vtu limited_mesh.vtu
done
for bad in 0 -1 x nan 1e-40; do
  refuse 2 'error[bad_option]' mesh lake.poly --max-area "$bad" -o out/x.vtu
done
refuse 2 'max-size' mesh lake.poly --max-size 0 -o out/x.vtu
refuse 2 'excludes' mesh lake.poly --max-size 1 --max-area 1 -o out/x.vtu
refuse 2 'radius-edge' mesh lake.poly --max-area 1 --rule voronoi-aspect -o out/x.vtu
printf 'x,y,h\n0,0,0\n' >zero.csv
refuse 3 'zero.csv:2' mesh lake.poly --sizes zero.csv -o out/x.vtu
refuse 2 'sizes.csv' mesh lake.poly --sizes sizes.csv -o sizes.csv
printf '# sizes\nlimit sizes none.csv\n' >sizes.txt
refuse 2 'none.csv: error[cannot_read]: cannot be read: No such file or directory (named by sizes.txt:2)' \
  edit lake.poly --script sizes.txt -o out/x.vtu
printf 'limit sizes zero.csv\n' >sizes.txt
refuse 3 'zero.csv:2:1: error[bad_number]' edit lake.poly --script sizes.txt -o out/x.vtu
refuse 3 '(named by sizes.txt:1)' edit lake.poly --script sizes.txt --static -o out/x.vtu

echo "== edits of lines and seeds"
cat >harbour.txt <<'END'
+point 20 1 6
+point 21 5 6
begin                  # a pier, and what it parts
+segment 30 20 21
move 9 5 5
commit
-segment 11
-region 2
begin
-hole 1
+hole 1 3 2.5
+hole 2 1 1
+region 3 3 3 -2.5 0.25
commit
-hole 2
+polyline 31 3 20 6
move 21 5 6.5
END
cat >harbour.poly <<'END'
12 2 0 1
1 0 0 5
2 6 0 5
3 8 0 0
4 8 8 0
5 6 8 0
6 0 8 0
7 2 2 0
8 4 2 0
9 5 5 0
10 2 4 0
20 1 6 0
21 5 6.5 0
13 1
1 1 2 3
2 2 3 3
3 3 4 0
4 4 5 0
5 5 6 0
6 6 1 0
7 7 8 0
8 8 9 0
9 9 10 0
10 10 7 0
30 20 21 0
31 3 7 0
32 20 6 0
1
1 3 2.5
2
1 1 1 10
3 3 3 -2.5 0.25
END
sed -i 's/^+polyline 31 3 20 6$/+segment 31 3 7\n+segment 32 20 6/' harbour.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit lake.poly --script harbour.txt $engine -o "harbour$engine.1.node" \
    -o "harbour$engine.1.msh" -o "harbour$engine.1.vtu" -o "harbour$engine.1.svg" \
    --stats "harbour$engine.jsonl"
done
expect 0 '' mesh harbour.poly --domain 0 0 8 8 --static -o fresh.1.node -o fresh.1.msh -o fresh.1.vtu
for format in node ele edge poly neigh msh vtu; do
  same "harbour.1.$format" "fresh.1.$format"
  same "harbour--static.1.$format" "fresh.1.$format"
done
same harbour.1.svg harbour--static.1.svg
has harbour.1.svg '#ffb347'
counts harbour.jsonl >engine.counts
counts harbour--static.jsonl >static.counts
same engine.counts static.counts
has harbour.jsonl '"edit":"-hole 2","seconds":[0-9.e-]+,"calls":\{"executed":0,.*"kept":\{"added":[1-9][0-9]*,"removed":0\}\}$'
expect 0 'harbour.txt:13: warning: the seed of region 3 at (3, 3) is in one region with hole 1' \
  edit lake.poly --script harbour.txt -o x.vtu
expect 0 'calls' trace lake.poly --script <(grep -v 'hole\|region' harbour.txt) -o lake.trace
refuse 2 'sizes.csv: error[bad_option]' trace lake.poly --sizes sizes.csv -o sizes.csv
expect 0 'calls' trace lake.poly --script harbour.txt -o lake.trace

echo "== what a bad edit of a lake says"
lake_edit() {
  printf '%b\n' "$3" >bad.txt
  for engine in '' --static; do
    # shellcheck disable=SC2086
    refuse "$1" "$2" edit lake.poly --script bad.txt $engine -o out/x.vtu --stats out/x.jsonl
  done
}
across='+point 30 7 1\n+point 31 5 1\n+segment 40 30 31'
lake_edit 1 'bad.txt:3:1: error[crossing_segments]: segment ' "$across"
lake_edit 1 '(segment 11: lake.poly:24)' "$across"
lake_edit 1 'bad.txt:1:1: error[point_on_segment]: point 30 (6, 5) lies on segment 11 (segment 11: lake.poly:24)' \
  '+point 30 6 5'
lake_edit 1 'bad.txt:1:1: error[point_in_use]: point 2 cannot go' '-point 2'
lake_edit 1 'bad.txt:1:1: error[duplicate_point]' '+point 30 2 2'
lake_edit 3 'bad.txt:1:1: error[repeated_id]' '+hole 1 5 5'
lake_edit 3 'bad.txt:1:1: error[repeated_id]' '+region 2 5 5 0'
lake_edit 3 'bad.txt:3:1: error[unknown_id]' 'begin\n-hole 1\n-hole 1\ncommit'

echo "== small angles, and markers by scripts"
printf '3 2 0 1\n1 0 0 0\n2 8 0 4\n3 8 0.01 0\n1 0\n1 1 2\n0\n' >wedge.poly
printf '+segment 7 1 3 marker 5\n+point 8 2 1 marker 6\n-segment 7\n' >leg.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit wedge.poly --script leg.txt $engine -o "wedge$engine.1.node" \
    --stats "wedge$engine.jsonl"
  has "wedge$engine.jsonl" '"small_angles":\[\{"at":\[0.0,0.0\],"lines":\[1,7\],"degrees":0.071.*,"forced":[1-9]'
  has "wedge$engine.jsonl" '^\{"edit":"-segment 7".*"simplices":\{[^}]*\},"kept":'
  # shellcheck disable=SC2086
  expect 0 '1 angles under 60 degrees' edit wedge.poly --script <(head -n 2 leg.txt) $engine \
    -o "marked$engine.1.node"
  has "marked$engine.1.node" '^[0-9]+ 8 0 2 2 4$'
  has "marked$engine.1.node" '^[0-9]+ 8 0.01 2 3 5$'
  has "marked$engine.1.node" '^[0-9]+ 2 1 2 8 6$'
  has "marked$engine.1.edge" '^[0-9]+ [0-9]+ [0-9]+ 5 7$'
done
counts wedge.jsonl >engine.counts
counts wedge--static.jsonl >static.counts
same engine.counts static.counts
same wedge.1.node wedge--static.1.node
same marked.1.node marked--static.1.node
# Short lengths that an update's own limits ask for are no news of the guard.
printf 'limit area 0.002 in 6.5 5 7.5 6\n' >finer.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'shrunk' edit lake.poly --script finer.txt $engine -o finer.vtu \
    --stats "finer$engine.jsonl"
done
counts finer.jsonl >engine.counts
counts finer--static.jsonl >static.counts
same engine.counts static.counts
expect 0 '' mesh wedge.poly --quiet -o wedge.2.node --stats wedge.json
has wedge.json '"small_angles": 0'
printf '4 2 0 0\n1 0 0\n2 0.8 0.6\n3 0.7439999994 0.5580000008\n4 0.6879999988 0.5160000016\n3 0\n1 1 2\n2 1 3\n3 1 4\n0\n' >fan.poly
refuse 1 'fan.poly:8:1: error[too_close]: segment 2, segment 1' mesh fan.poly -o out/x.vtu
refuse 1 'at angles down to ' mesh fan.poly -o out/x.vtu
said=$("$tool" mesh fan.poly -o out/x.vtu 2>&1)
[[ $said != *--repair* ]] || fail "repairs angles: $said"
refuse 1 'segment 1: fan.poly:7' mesh fan.poly --static -o out/x.vtu

echo "== the Great Lakes"
if [[ -e $data/great_lakes.poly ]]; then
  expect 0 ', 20.7' mesh "$data/great_lakes.poly" -o great_lakes.1.node -o great_lakes.msh
  expect 0 'segments    ok      4535' check great_lakes.1.node --input "$data/great_lakes.poly" \
    --rho 1.4142
  expect 0 'at small angles' check great_lakes.1.node --rho 1.4142
  expect 0 'at small angles' check great_lakes.msh --rho 1.4142
fi

echo "== periodic sides"
cat >cell.poly <<'END'
5 2 0 0
1 0 0
2 1 0
3 1 1
4 0 1
5 .04 .3
4 1
1 1 2 1
2 2 3 2
3 3 4 3
4 4 1 4
0
END
for engine in auto svr gap-balls; do
  expect 0 'periodic sides        agree after' mesh cell.poly --algorithm $engine --periodic 4=2 \
    --periodic 1=3 -o cell.1.node -o cell.1.msh
  expect 0 '' check cell.1.node --input cell.poly --rho 1.4142
  has cell.1.msh '^16 1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1$'
  expect 0 '' mesh cell.poly --algorithm $engine --periodic 4=2 --periodic 1=3 --quiet -o again.msh
  same cell.1.msh again.msh
done
expect 0 '"periodic_rounds": ' mesh cell.poly --periodic 4=2 --stats - -o cell.1.msh
expect 0 '' mesh cell.poly --periodic 4=2 --msh-version 2.2 -o cell.1.msh
has cell.1.msh '^Affine 1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1$'
refuse 2 'point 4, moved as the pair 4=3 says, is no point of a line of marker 3' mesh cell.poly \
  --periodic 4=3 -o out/x.msh
refuse 2 'no line has the marker 9' mesh cell.poly --periodic 4=9 -o out/x.msh
refuse 2 "--periodic '4': expected FROM=TO" mesh cell.poly --periodic 4 -o out/x.msh
refuse 2 "--periodic 'x': not a whole number" mesh cell.poly --periodic x=2 -o out/x.msh
expect 0 '' gen cube -o cell_in_space.poly
refuse 2 '--periodic is for the plane' mesh cell_in_space.poly --periodic 4=2 -o out/x.msh
