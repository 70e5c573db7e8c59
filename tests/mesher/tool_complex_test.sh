#!/usr/bin/env bash
# Segments and polygons in space from files: `mesher mesh`, `edit`, `trace` and `check` of them, and
# what an independent judge says of the families.
#
#   tool_complex_test.sh MESHER_TOOL [CGAL_CHECK3D]
set -u
tool=$(realpath "$1")
judge=${2:+$(realpath "$2")}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# shellcheck source=../support/tool_checks.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/tool_checks.sh"
cd "$scratch" || exit 1
tool=$(by_gap_balls "$tool" "$scratch")

expect() { expect_of "$tool" "$@"; }
refuse() { refuse_of "$tool" "$@"; }

mkdir out
formats=(node ele face edge vtu vtk msh mesh off obj stl svg)

echo "== complexes: every family is in its mesh, by our check and by the judge"
for kind in cube cube-square skew dumbbell nested l-hole plates wedge pages spike vee leaning \
  tetrahedron pump faults tee shells island; do
  expect 0 '' gen "$kind" -o "$kind.poly"
  expect 0 '' mesh "$kind.poly" --static --quiet -o in.vtu -o in.msh
  expect 0 'polygons    ok' check in.vtu --input "$kind.poly" --rho 2 --ties
  expect 0 'polygons    ok' check in.msh --input "$kind.poly" --rho 2 --ties
  expect 0 '' mesh "$kind.poly" --static --quiet --box -o box.node
  expect 0 'segments    ok' check box.node --input "$kind.poly" --rho 2 --ties
  [[ -z $judge ]] || expect_of "$judge" 0 'ok box.node' box.node box.ele --complex "$kind.poly"
done

echo "== complexes: with the engine and without, and all outputs"
for kind in island tee skew; do
  outputs=()
  for format in node vtu vtk msh mesh off obj stl svg; do outputs+=(-o "a.$format"); done
  expect 0 ' points in space' mesh $kind.poly "${outputs[@]}" --stats a.json
  expect 0 '' mesh $kind.poly "${outputs[@]/a./b.}" --static --quiet
  for format in "${formats[@]}"; do same a.$format b.$format; done
done
for field in above_rho regions holes seed_faults points; do has a.json "^ *\"$field\": [0-9]"; done
has a.node '^[0-9]+ 3 2 1$'
expect 0 '' mesh tee.poly --quiet -o c.node # the mesh is the same with other outputs
expect 0 '' mesh tee.poly --static --quiet -o d.node
same c.face d.face
expect 0 'tee.poly: ' mesh tee.poly
expect 0 ' in the box' mesh tee.poly
expect 0 ' polygons' mesh tee.poly --dimension 3

echo "== complexes: flat tetrahedra are taken out, of what edits leave too"
echo '+point 1000 0 0 0' >point.txt
echo '-point 1000' >>point.txt
for options in "--quiet" "--quiet --static"; do
  # shellcheck disable=SC2086
  expect 0 '' mesh shells.poly --no-flat $options -o swapped.node
  expect 0 ' nearly' check swapped.node --input shells.poly --rho 2 --near
  expect 1 'delaunay: ' check swapped.node --input shells.poly --rho 2
  # shellcheck disable=SC2086
  expect 0 '' edit shells.poly --script point.txt --no-flat $options -o edited.node
  same swapped.ele edited.ele
  same swapped.face edited.face
done
expect 0 '' gen uniform --n 20 -o plane.node
refuse 2 'error[bad_option]: --no-flat is for space' mesh plane.node --no-flat -o x.node

echo "== complexes: markers, holes and regions"
cat >two.poly <<'END'
16 3 0 1
1 0 0 0 5
2 1 0 0 0
3 1 1 0 0
4 0 1 0 0
5 0 0 1 0
6 1 0 1 0
7 1 1 1 0
8 0 1 1 0
11 .25 .25 .25 0
12 .75 .25 .25 0
13 .75 .75 .25 0
14 .25 .75 .25 0
15 .25 .25 .75 0
16 .75 .25 .75 0
17 .75 .75 .75 0
18 .25 .75 .75 0
12 1
1 0 21
4 1 2 3 4
1 0 22
4 5 6 7 8
1 0 23
4 1 2 6 5
1 0 24
4 2 3 7 6
1 0 25
4 3 4 8 7
1 0 26
4 4 1 5 8
1 0 31
4 11 12 13 14
1 0 31
4 15 16 17 18
1 0 31
4 11 12 16 15
1 0 31
4 12 13 17 16
1 0 31
4 13 14 18 17
1 0 31
4 14 11 15 18
0
2
1 .1 .1 .1 2.5
2 .5 .5 .5 7
END
sed 's/^0$/1\n1 .5 .5 .5/; s/^2$/1/; /^2 .5 .5 .5 7/d' two.poly >hollow.poly
expect 0 'regions               2, holes 0' mesh two.poly -o two.vtu -o two.msh -o two.node
expect 0 'regions     ok      2 regions' check two.vtu --input two.poly --rho 2
expect 0 'regions     ok      2 regions' check two.node --input two.poly --rho 2
has two.msh '^3 1 "region_2.5"$'
has two.msh '^2 31 "marker_31"$'
has two.node '^1 0 0 0 2 1 5$'
for marker in 21 22 23 24 25 26 31; do has two.face " $marker [0-9]+$"; done
expect 0 'regions               1, holes 1' mesh hollow.poly -o hollow.vtu -o hollow.stl -o hollow.mesh \
  -o hollow.msh
expect 0 'regions     ok' check hollow.vtu --input hollow.poly --rho 2
expect 0 'attributes of regions are not compared: .mesh counts those of INPUT' check hollow.mesh \
  --input hollow.poly --rho 2
expect 0 'regions     ok' check hollow.msh --input hollow.poly --rho 2
expect 1 'error[bad_quality]: regions: tetrahedron ' check two.vtu --input hollow.poly
sed 's/^1 .1 .1 .1 2.5/1 .5 .5 .25 2.5/' two.poly >seeds.poly
expect 0 'seeds.poly:45: warning: the seed of region 1 at (0.5, 0.5, 0.25) is on polygon 7' \
  mesh seeds.poly
expect 0 '' mesh two.poly --box --quiet -o all.vtu
expect 0 'regions     ok      3 regions' check all.vtu --input two.poly --rho 2

echo "== complexes: faces of surfaces are polygons if that is asked for"
expect 0 '' mesh hollow.poly --quiet -o hollow.off -o hollow.obj
expect 0 ' points in space, 12 polygons' mesh hollow.off --surface -o s.vtu
expect 0 '12 polygons are unions of' check s.vtu --input hollow.off --surface --rho 2
expect 0 ' points in space, ' mesh hollow.off --surface --no-merge -o s.vtu
expect 0 'polygons    ok' check s.vtu --input hollow.off --surface --rho 2
expect 0 ' polygons' mesh hollow.off --merge -o m.vtu
expect 0 '12 polygons are unions of' check m.vtu --input hollow.off --merge --rho 2
expect 0 '--surface meshes its faces, too' mesh hollow.stl
expect 0 '' mesh two.poly --quiet -o faces.vtu -o faces.vtk
for format in vtu vtk; do
  expect 0 'cells other than faces are not used' mesh faces.$format --merge -o again.vtu
  expect 0 'polygons    ok' check again.vtu --input faces.$format --merge --rho 2
done
expect 0 '' mesh hollow.stl --merge --quiet -o n.node
expect 0 '' mesh hollow.off --merge --quiet -o o.node
same n.ele o.ele
expect 0 '' mesh hollow.obj --merge --quiet --static -o n.node
same n.ele o.ele
refuse 2 'two.node: error[bad_option]: --surface is for .off, .obj, .ply, .stl, .vtu' mesh two.node \
  --surface -o out/x.vtu
grep '^v ' hollow.obj >points.obj
for option in --surface --merge; do
  refuse 2 'points.obj: error[bad_option]: --surface: the file has 47 points and no faces' mesh \
    points.obj $option --repair -o out/x.vtu
done
refuse 2 'error[bad_option]: --surface and --merge are for space' mesh hollow.off --surface --dim 2 \
  -o out/x.vtu
printf '3 2\n1 0 0\n2 1 0\n3 0 1\n' >flat.node
printf '1 3\n1 1 2 3\n' >flat.ele
expect 2 'error[bad_option]: --surface is for meshes of tetrahedra' check flat.node --surface
expect 2 'error[bad_option]: --merge is for meshes of tetrahedra' check flat.node --merge

echo "== complexes: edits go on from a file, and keep the markers of what stays"
cat >edits.txt <<'END'
+point 90 .5 .5 .9
+segment 3 90 7
move 90 .5 .6 .9
-polygon 8
begin
+polygon 40 15 16 17 18
-segment 3
commit
END
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit two.poly --script edits.txt $engine -o "after$engine.node" \
    -o "after$engine.vtu" -o "after$engine.svg" --stats "after$engine.jsonl"
done
for format in node ele face edge vtu svg; do same after.$format after--static.$format; done
has after.face ' 26 6$'
has after.face ' 0 40$'
expect 0 '' trace two.poly --script edits.txt -o after.trace
printf '+point 90 .5 .5 .1\n+point 91 .6 .5 .6\n+segment 3 90 91\n' >bad.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  refuse 1 'bad.txt:3:1: error[segment_through_polygon]: segment 3 goes through polygon 7' \
    edit two.poly --script bad.txt $engine -o out/x.node
done

echo "== complexes: holes and regions follow edits"
printf -- '-region 2\n+hole 1 .5 .5 .5\n' >hollow.txt
expect 0 '' mesh hollow.poly --quiet -o hollow.1.node -o hollow.1.vtu
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit two.poly --script hollow.txt $engine -o hollow.1.node -o edited.vtu \
    --stats edited.jsonl
  same edited.vtu hollow.1.vtu
done
has edited.jsonl '"kept":.*"added":0,"removed":[1-9]'
cat >seeds.txt <<'END'
begin
+region 4 .9 .9 .1 9
-region 1
commit
-polygon 12
begin
-region 4
+hole 3 .5 .5 .5
commit
+polygon 50 14 11 15 18
END
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit two.poly --script seeds.txt $engine -o "seeds$engine.node" \
    -o "seeds$engine.vtu" -o "seeds$engine.svg" --stats "seeds$engine.jsonl"
  grep -o '"kept":{"added.*' "seeds$engine.jsonl" >"kept$engine"
done
for format in node ele face vtu svg; do same seeds.$format seeds--static.$format; done
same kept kept--static
has kept '"removed":[1-9]'
printf '+hole 9 5 5 5\n' >far.txt
expect 0 'far.txt:1: warning: the seed of hole 9' edit two.poly --script far.txt
printf '+point 90 .5 .6 .9\n+region 1 .5 .5 .5 4\n' >twice.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  refuse 3 'twice.txt:2:1: error[repeated_id]' edit two.poly --script twice.txt $engine -o out/x.vtu
done

echo "== complexes: by svr and refine they are in their meshes too"
for kind in nested tee pages spike island; do
  expect 0 '' gen $kind -o byother.poly
  for algorithm in svr refine; do
    expect 0 ' in the box' mesh byother.poly --algorithm $algorithm -o kept.node \
      -o kept.vtu --stats figures.json
    expect 0 'polygons    ok' check kept.node --input byother.poly --rho 2 --ties
    expect 0 '' mesh byother.poly --algorithm $algorithm --box --quiet -o other.node
    expect 0 'quality     ok' check other.node --input byother.poly --rho 2
    [[ -z $judge ]] || expect_of "$judge" 0 'ok other.node' other.node other.ele \
      --complex byother.poly
  done
done
refuse 2 'svr of segments and polygons needs a rho of 2 or more' mesh byother.poly \
  --algorithm svr --rho 1.5 -o out/x.node

echo "== complexes: what is wrong is said with line, ids and place"
# bad CODE TEXT SED: of two.poly, changed
bad() {
  sed "$3" two.poly >bad.poly
  for engine in '' --static; do
    # shellcheck disable=SC2086
    refuse "$1" "$2" mesh bad.poly $engine -o out/x.vtu
  done
}
bad 1 'bad.poly:19:1: error[not_flat]: polygon 1 is not flat' 's/^3 1 1 0 0/3 1 1 .1 0/'
bad 3 'bad.poly:20:3: error[unknown_id]' 's/^4 1 2 3 4/4 9 2 3 4/'
bad 1 ' (polygon ' 's/^18 .25 .75 .75/18 .25 .75 1.75/;s/^17 .75 .75 .75/17 .75 .75 1.75/'
bad 3 'bad.poly:18:' 's/^12 1$/x 1/'
refuse 2 'error[cannot_read]' mesh nothing.poly -o out/x.vtu
refuse 2 'two.poly: error[bad_option]: --max-area is for the plane' mesh two.poly --max-area 1 \
  -o out/x.vtu
refuse 2 'is an input' mesh hollow.off --surface -o out/x.svg -o hollow.off
expect 3 'error[bad_dimension]' mesh two.poly --dim 2

echo "== complexes: check says what is missing"
expect 0 '' mesh two.poly --quiet --box -o good.node
for part in node ele edge; do cp good.$part cut.$part; done
grep -m1 -n ' [0-9]* 8$' good.face | cut -d: -f1 >line
sed "$(cat line)d; 1s/.*/$(($(wc -l <good.face) - 2)) 1/" good.face >cut.face
expect 1 'error[bad_quality]: polygons: polygon ' check cut.node --input two.poly
sed 's/ 8$/ 9/' good.face >cut.face
expect 1 'polygon 8: the edge from ' check cut.node --input two.poly

echo "== complexes: below rho = 2 the guard says where it gave in, and check excuses that alone"
expect 0 ' tetrahedra stay poor beside it, up to ' mesh pages.poly --rho 1.31 --box -o guard.node \
  --stats guard.json
grep -q '"gave_in"' guard.json || fail 'no "gave_in" in --stats'
expect 0 ' left poor beside features' check guard.node --input pages.poly --rho 1.31
expect 1 'error[bad_quality]: quality: ' check guard.node --input pages.poly --rho 1.2
printf '+point 900 .5 .5 .9\n-point 900\n+point 901 .1 .2 .2\n' >guard.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 ' tetrahedra stay poor beside it, up to ' edit pages.poly --rho 1.31 --script guard.txt \
    $engine --stats "guard$engine.jsonl"
  tail -n +2 "guard$engine.jsonl" | sed -n 's/.*\("gave_in":.*\),"kept":.*/\1/p' >"gave_in$engine"
done
same gave_in gave_in--static
[[ -s gave_in ]] || fail 'no "gave_in" of updates in --stats'

echo "== complexes: check compares markers, where both have them"
expect 0 ' faces have one' \
  check good.node --input two.poly
for format in vtu vtk msh mesh; do
  expect 0 '' mesh two.poly --quiet -o marked.$format
  expect 0 'markers     ok' check marked.$format --input two.poly
done
for part in node ele edge face; do cp good.$part cut.$part; done
sed 's/ 31 8$/ 30 8/' good.face >cut.face
expect 1 ' has the marker 30, but is on polygon 8 (line' check cut.node \
  --input two.poly
cp good.face cut.face
sed -E 's/^([0-9]+ 0 0 0 .*) 5$/\1 6/' good.node >cut.node
expect 1 ' has the marker 6, but is point 1 (line 2), which has 5' check cut.node \
  --input two.poly
cp good.node cut.node
sed -E '2s/^([0-9]+ [0-9]+ [0-9]+) [0-9]+/\1 99/' good.edge >cut.edge
expect 1 ' has the marker 99, but is on polygon' check cut.node \
  --input two.poly
sed 's/ 31$/ -31/' two.poly >negative.poly
expect 0 '' mesh negative.poly --quiet -o marked.mesh
expect 0 'markers are not compared: .mesh counts those of INPUT' check marked.mesh \
  --input negative.poly

report_checks
