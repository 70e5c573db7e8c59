#!/usr/bin/env bash
# The built tool end to end: what it writes, what it says, how it exits, what it leaves behind.
#
#   tool_test.sh TOOL DATA_FOLDER [SCRATCH_FOLDER]
set -u
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
tool=$(realpath "$1")
data=$(realpath "$2")
scratch=${3:-$(mktemp -d)}
mkdir -p "$scratch"
scratch=$(mktemp -d "$scratch/tool_test.XXXXXX")
trap 'rm -rf "$scratch"' EXIT
# shellcheck source=../support/tool_checks.sh
source "$here/../support/tool_checks.sh"
cd "$scratch" || exit 1
chosen=$tool  # with its own choice of algorithms
tool=$(by_gap_balls "$tool" "$scratch")

expect() { expect_of "$tool" "$@"; }
refuse() { refuse_of "$tool" "$@"; }

mkdir out

echo "== gen"
for kind in uniform gaussian clusters grid line-circle spiral; do
  expect 0 '' gen "$kind" --n 200 --seed 3 -o "$kind.node"
  has "$kind.node" '^200 2 0 0$'
done
expect 0 '' gen uniform --n 200 --seed 3 -o again.node
same uniform.node again.node
expect 0 '' gen spiral --n 20 --dim 3 -o space.node
has space.node '^20 3 0 0$'
refuse 2 'error[bad_option]' gen circle --n 5 -o out/x.node
refuse 2 'error[bad_option]' gen uniform --n -5 -o out/x.node
refuse 2 'error[bad_option]' gen uniform --n 5 --dim 4 -o out/x.node
refuse 2 'out/x.xyz: error[unknown_format]' gen uniform --n 5 -o out/x.xyz
for kind in segments lengths polylines trees corridors zigzag fan bundle; do
  expect 0 '' gen "$kind" --n 60 --seed 3 -o "$kind.poly"
  expect 0 '' gen "$kind" --n 60 --seed 3 -o "$kind.obj"
  has "$kind.poly" '^[0-9]+ 2 0 0$'
  has "$kind.obj" '^l 1 2'
done
expect 0 '' gen fan --n 2 --angle 0.01 -o wedge.poly
has wedge.poly '^2 0$'
refuse 2 'out/x.node: error[unknown_format]' gen trees --n 5 -o out/x.node
refuse 2 '--angle' gen trees --n 5 --angle 5 -o out/x.poly
refuse 2 '--angle' gen uniform --n 5 --angle 5 -o out/x.node
refuse 2 '--angle' gen fan --n 5 --angle 100 -o out/x.poly
refuse 2 '--angle' gen fan --n 5 --angle 0 -o out/x.poly
refuse 2 '--dimension' gen fan --n 5 --dim 3 -o out/x.poly

echo "== help"
for command in '' gen mesh edit check; do
  # shellcheck disable=SC2086
  expect 0 'Examples:' $command --help
done
for command in mesh edit trace; do
  expect 0 "Usage: mesher $command [OPTIONS] INPUT"$'\n' $command --help
done
expect 0 'mesher 0.' --version
refuse 2 'error[bad_option]'
refuse 2 'error[bad_option]' paint
refuse 2 'error[bad_option]' mesh
refuse 2 'error[bad_option]' mesh uniform.node --colour red

echo "== --min-angle stands for --rho"
expect 0 '' mesh uniform.node --min-angle 28 --quiet -o angle.node
expect 0 'quality     ok' check angle.node --input uniform.node --rho 1.06503
expect 0 '' mesh uniform.node --min-angle 30e-1 --quiet -o angle.node
refuse 2 '--min-angle 29.7: must be above 0.29 and at most 29.6' mesh uniform.node --min-angle 29.7 \
  -o out/x.node
refuse 2 '--min-angle 0: must be' mesh uniform.node --min-angle 0 -o out/x.node
refuse 2 '--min-angle' mesh uniform.node --min-angle 20 --rho 2 -o out/x.node

echo "== mesh and check"
for kind in uniform gaussian clusters grid line-circle spiral; do
  expect 0 'vertices' mesh "$kind.node" -o "$kind.mesh.node" -o "$kind.off" -o "$kind.vtu" \
    -o "$kind.vtk" -o "$kind.msh" -o "$kind.mesh" -o "$kind.mesh.obj" -o "$kind.svg" \
    --stats "$kind.json"
  for format in mesh.node mesh.ele off vtu vtk msh mesh mesh.obj; do
    expect 0 'delaunay' check "$kind.$format" --input "$kind.node" --rho 1.4142
  done
  expect 0 '' mesh "$kind.node" --static --quiet -o "$kind.static.node" -o "$kind.static.vtu"
  same "$kind.mesh.node" "$kind.static.node"
  same "$kind.mesh.ele" "$kind.static.ele"
  same "$kind.vtu" "$kind.static.vtu"
done
for field in vertices simplices min_angle_deg max_radius_edge quadtree steiner triangulate total \
  calls edges trace_bytes peak_rss_bytes; do
  has uniform.json "^ *\"$field\": [0-9]"
done
[[ -z $("$tool" mesh uniform.node --quiet 2>&1) ]] || fail "--quiet is not quiet"
expect 0 '' mesh uniform.node --rho 2 --rule voronoi-aspect -o paper.node
expect 0 'quality' check paper.node --input uniform.node --rho 2
printf '0 2 0 0\n' >empty.node
expect 0 '' mesh empty.node -o empty.mesh.node --stats empty.json
expect 0 'quality' check empty.mesh.node --rho 1.4142
has empty.json '"min_angle_deg": 2[1-9]'

"$tool" mesh uniform.node -o piped.node --stats - >piped.json 2>said.txt || fail "--stats -"
[[ ! -e - && ! -s said.txt ]] || fail "--stats - writes more than standard output"
same uniform.mesh.node piped.node
python3 -m json.tool piped.json >/dev/null || fail "--stats -: $(head -c 300 piped.json)"
"$tool" mesh uniform.node -o out/x.vtu --stats - >/dev/full 2>said.txt
has said.txt 'error\[cannot_write\]: standard output'
[[ -z $(ls -A out) ]] || fail "--stats - to a full disk leaves: $(ls -A out)"

echo "== names, versions of .msh, second order"
printf '%s\n' '4 2 0 0' '1 0 0' '2 4 0' '3 4 4' '4 0 4' '4 1' '1 1 2 1' '2 2 3 7' '3 3 4 1' '4 4 1 8' 0 1 \
  '1 1 1 3' >named.poly
expect 0 'named.poly: note: --name-marker 9=x is not used: the mesh has nothing of that number' mesh \
  named.poly --name-marker 7=inlet --name-marker 9=x --name-region 3=rock -o named.msh -o named.inp \
  -o named.su2 -o named.vtu
for line in '4.1 0 8' '1 7 "inlet"' '1 8 "marker_8"' '2 3 "rock"'; do has named.msh "^$line$"; done
has named.inp '^\*SURFACE, NAME=inlet, TYPE=ELEMENT$'
has named.su2 '^MARKER_TAG= inlet$'
expect 0 'markers     ok' check named.msh --input named.poly
expect 0 '' mesh named.poly --quiet --order 2 --msh-version 2.2 -o second.msh -o second.inp \
  -o second.vtu -o second.node -o second.svg
has second.msh '^2.2 0 8$'
has second.inp '^\*ELEMENT, TYPE=CPS6, ELSET=region_3$'
for format in msh vtu node; do
  expect 0 'of second order are not used' check "second.$format" --input named.poly --rho 1.4142
done
printf '+point 9 2 2\n' >named.txt
expect 0 '' edit named.poly --script named.txt --quiet --name-marker 7=inlet -o edited.msh
has edited.msh '^1 7 "inlet"$'
refuse 2 'out/x.su2: error[bad_option]: .su2 has no meshes of second order' mesh named.poly --order 2 \
  -o out/x.su2
refuse 2 '--order' mesh named.poly --order 3 -o out/x.msh
refuse 2 '--msh-version' mesh named.poly --msh-version 3 -o out/x.msh
refuse 2 "the name 'a b' has a blank" mesh named.poly --name-marker '7=a b' -o out/x.msh
refuse 2 "the name 'a' is given to two groups" mesh named.poly --name-marker 7=a --name-region 3=a \
  -o out/x.msh
refuse 2 "--name-marker 'inlet': expected NUMBER=NAME" mesh named.poly --name-marker inlet -o out/x.msh
refuse 2 "--name-marker 'x': not a whole number" mesh named.poly --name-marker x=7 -o out/x.msh
refuse 2 '--name-line is for space' mesh named.poly --name-line 7=x -o out/x.msh
[[ -z $(ls -A out) ]] || fail "bad names leave: $(ls -A out)"

echo "== formats and order of input give the same bytes"
tail -n +2 uniform.node | sed 's/^[0-9]* //' >uniform.xyz
(echo 'name,Y,X' && awk '{ print "p," $2 "," $1 }' uniform.xyz) >uniform.csv
{ head -1 uniform.node && tail -n +2 uniform.node | tac; } | sed 's/$/\r/' >backward.node
for input in uniform.xyz uniform.csv backward.node; do
  expect 0 '200 points' mesh "$input" -o other.node
  same uniform.mesh.node other.node
  same uniform.mesh.ele other.ele
done

echo "== bad options and outputs"
refuse 2 'none.node: error[cannot_read]' mesh none.node -o out/x.vtu
refuse 2 'uniform.dae: error[unknown_format]' mesh uniform.dae -o out/x.vtu
refuse 2 'none.poly: error[cannot_read]' mesh none.poly -o out/x.vtu
refuse 2 'out/x.stl: error[unknown_format]' mesh uniform.node -o out/x.off -o out/x.stl
refuse 2 'error[cannot_write]' mesh uniform.node -o out/x.vtu -o none/x.vtu
refuse 2 'error[cannot_write]' mesh uniform.node -o out/x.vtu --stats none/x.json
refuse 2 'out/x.vtu: error[bad_option]' mesh uniform.node -o out/x.vtu -o out/x.vtu
refuse 2 './uniform.node: error[bad_option]' mesh uniform.node -o out/x.vtu -o ./uniform.node
refuse 2 '--rho' mesh uniform.node --rho 1 -o out/x.vtu
refuse 2 '--rho' mesh uniform.node --rho nan -o out/x.vtu
refuse 2 'error[bad_option]: --rho 101: must be above 1.01 and at most 100' mesh uniform.node \
  --rho 101 -o out/x.vtu
refuse 2 '--rho' mesh uniform.node --rho 2x -o out/x.vtu
refuse 2 'error[bad_option]' mesh uniform.node --rule best -o out/x.vtu
refuse 2 '--domain' mesh uniform.node --domain 0 0 1 inf -o out/x.vtu
refuse 2 '--domain' mesh uniform.node --domain 0 0 1 0 -o out/x.vtu
refuse 2 '--domain' mesh uniform.node --domain 0 0 1 1e40 -o out/x.vtu
refuse 2 'error[bad_option]' mesh uniform.node --domain 0 0 1 -o out/x.vtu
refuse 2 'At least 4' mesh uniform.node --domain 0 0 1 -o out/x.vtu
expect 0 '' mesh uniform.node --domain -.5 -1e0 +2 2 -o wide.node
expect 0 '' mesh --domain -.5 -1e0 +2 2 uniform.node -o wide_first.node
same wide.node wide_first.node
echo '-point 1' >remove_1.txt
printf '2 2 0 0\n1 1e20 0\n2 1.0000000000001e20 .5\n' >far.node
printf '3 2 0 0\n1 1e20 0\n2 1.0000000000001e20 .5\n3 1e20 1\n2 0\n1 1 2\n2 2 3\n0\n' >far.poly
printf '2 3 0 0\n1 1e20 0 0\n2 1.0000000000001e20 .5 1\n' >far.3d.node
for far in far.node far.poly far.3d.node; do
  too_far="$far: error[bad_option]: the domain is too far from the origin for its size"
  for engine in '' --static; do
    # shellcheck disable=SC2086
    refuse 2 "$too_far" mesh "$far" $engine -o out/x.vtu
    # shellcheck disable=SC2086
    refuse 2 "$too_far" edit "$far" --script remove_1.txt $engine -o out/x.vtu
  done
  refuse 2 "$too_far" trace "$far" -o out/x.trace
  [[ $far == far.3d.node ]] || refuse 2 "$too_far" mesh "$far" --repair -o out/x.vtu
done
for seed in -1 1.5 18446744073709551616 ''; do
  refuse 2 '--seed' gen uniform --n 5 --seed "$seed" -o out/x.node
done

echo "== bad points: FILE:LINE:COL: error[code]"
points() { printf '%b' "$1" >bad.node; }
points '2 2 0 0\n1 0 0\n2 0.5\n'
refuse 3 'bad.node:3:6: error[truncated]' mesh bad.node -o out/x.vtu
points '1 2 0 0\n1 0 0\n2 0.5 1\n'
refuse 3 'bad.node:3:1: error[wrong_count]' mesh bad.node -o out/x.vtu
points '1 2 0 0\n1 0 nan\n'
refuse 3 'bad.node:2:5: error[not_finite]' mesh bad.node -o out/x.vtu
points '1 2 0 0\n1 0 1e31\n'
refuse 3 'bad.node:2:5: error[magnitude]' mesh bad.node -o out/x.vtu
points '2 2 0 0\n7 0 1\n7 1 0\n'
refuse 3 'bad.node:3:1: error[repeated_id]' mesh bad.node -o out/x.vtu
points '2 2 0 0\n7 0 1\n8 0 1\n'
refuse 1 'bad.node:3:1: error[duplicate_point]: point 8 lies on point 7' mesh bad.node -o out/x.vtu
refuse 3 'space.node:1:4: error[bad_dimension]' mesh space.node --dimension 2 -o out/x.vtu
points '2 2 0 0\n7 0 1\n8 3 1\n'
refuse 1 'bad.node:3:1: error[outside_domain]: point 8' mesh bad.node --domain 0 0 1 1 -o out/x.vtu
refuse 1 '--domain' mesh bad.node --domain 0 0 1 1 --static -o out/x.vtu

echo "== edit"
cat >edits.txt <<'END'
# every kind of edit
+point 1000 0.5 0.5000001
-point 3
move 4 0.25 0.75
begin
+point 1001 0.125 0.875
-point 1000
move 5 .9 .1
commit
END
awk 'NR == 1 { print "200 2 0 0"; next }
  $1 == 3 { next }
  $1 == 4 { print "4 0.25 0.75"; next }
  $1 == 5 { print "5 .9 .1"; next }
  { print }
  END { print "1001 0.125 0.875" }' uniform.node >edited.node
domain=(--domain 0 0 1 1)
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit uniform.node "${domain[@]}" --script edits.txt $engine -o after.node \
    --stats "after$engine.jsonl"
  # shellcheck disable=SC2086
  expect 0 '' mesh edited.node "${domain[@]}" $engine -o fresh.node
  same after.node fresh.node
  same after.ele fresh.ele
  expect 0 '' check after.node --input edited.node --rho 1.4142
  [[ $(wc -l <"after$engine.jsonl") == 5 ]] || fail "after$engine.jsonl has not 5 lines"
  has "after$engine.jsonl" '^\{"vertices":[0-9]+,"simplices":[0-9]+,"min_angle_deg":'
  has "after$engine.jsonl" '^\{"edit":"-point 3","seconds":[0-9.e-]+,"calls":\{"executed":[0-9]+,"reused":[0-9]+,"created":[0-9]+,"discarded":[0-9]+\},"vertices":\{"added":[0-9]+,"removed":[1-9][0-9]*\},"simplices":\{"added":[0-9]+,"removed":[0-9]+\},"kept":\{"added":[0-9]+,"removed":[0-9]+\}\}$'
  has "after$engine.jsonl" '^\{"edit":"\+point 1001 0\.125 0\.875; -point 1000; move 5 \.9 \.1"'
done
"$tool" edit uniform.node "${domain[@]}" --script edits.txt --stats - >piped.jsonl || fail "--stats -"
[[ $(wc -l <piped.jsonl) == 5 ]] || fail "--stats - of edit: $(head -c 300 piped.jsonl)"
cat >swap.txt <<'END'
begin
move 4 0.25 0.75
move 5 .9 .1
commit
begin
move 4 .9 .1
+point 2000 0.25 0.75
move 5 0.25 0.5
commit
begin
move 4 0.25 0.75
-point 2000
move 5 0.9 0.1
commit
-point 3
+point 1001 0.125 0.875
END
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit uniform.node "${domain[@]}" --script swap.txt $engine -o swapped.node
  same after.node swapped.node
  same after.ele swapped.ele
done
counts() { sed 's/.*"vertices":{/{/' "$1" | tail -n +2; }
counts after.jsonl >engine.counts
counts after--static.jsonl >static.counts
same engine.counts static.counts
: >nothing.txt
expect 0 '' edit uniform.node --script nothing.txt -o after.node

echo "== lines by scripts"
printf '%s\n' '7 2' '1 0.1 0.1' '2 0.9 0.15' '3 0.5 0.9' '4 0.3 0.4' '5 0.7 0.3' '6 0.2 0.8' \
  '7 0.8 0.8' >corners.node
printf '%s\n' '+segment 1 1 3' '+polyline 2 3 2 1' '+segment 3 4 5' '-segment 3' >lines.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit corners.node --script lines.txt $engine -o "lines$engine.vtu" -o lines.svg
done
same lines.vtu lines--static.vtu
expect 0 'lines       ok      ' check lines.vtu --input corners.node --rho 1.4142
has lines.vtu 'Name="line"'
printf '%s\n' '+segment 1 1 3' '+segment 2 6 5' >crossing.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  refuse 1 'crossing.txt:2:1: error[crossing_segments]' edit corners.node --script crossing.txt \
    $engine -o out/x.vtu
done
expect 1 '(segment 1: crossing.txt:1)' edit corners.node --script crossing.txt -o out/x.vtu
same after.node uniform.mesh.node

echo "== bad edits: FILE:LINE:COL: error[code], nothing written"
# bad_edit CODE TEXT SCRIPT: after a good line
bad_edit() {
  printf '+point 1000 .5 .4999\n%b\n' "$3" >bad.txt
  for engine in '' --static; do
    # shellcheck disable=SC2086
    refuse "$1" "bad.txt:$2" edit uniform.node --script bad.txt $engine -o out/x.node \
      --stats out/x.jsonl
  done
}
bad_edit 3 '2:1: error[bad_edit]' '+polygon 1 2'
bad_edit 3 '2:10: error[bad_edit]' '-point 5 6'
bad_edit 3 '2:13: error[bad_number]' '+point 1 .5 z'
bad_edit 3 '2:10: error[not_finite]' '+point 1 nan .5'
bad_edit 3 '2:8: error[magnitude]' 'move 1 1e-40 .5'
bad_edit 3 '2:1: error[unknown_id]' '-point 999'
bad_edit 3 '2:1: error[unknown_id]' 'move 999 .1 .1'
bad_edit 3 '2:1: error[repeated_id]' '+point 1000 .1 .1'
bad_edit 1 '2:1: error[duplicate_point]' '+point 1002 .5 .4999'
bad_edit 1 '3:2: error[duplicate_point]' 'begin\n move 7 .5 .4999\ncommit'
bad_edit 1 '3:2: error[duplicate_point]' 'begin\n move 7 .5 .4999\n+point 9999 .5 .25\ncommit'
bad_edit 1 '2:1: error[outside_domain]' '+point 1002 7 7'
bad_edit 3 '2:1: error[unbalanced_commit]' 'commit'
bad_edit 3 '2:1: error[unbalanced_commit]' 'begin'
printf '+point 1002 7 7\n' >bad.txt
refuse 1 '--domain' edit uniform.node --script bad.txt -o out/x.node
refuse 2 'none.txt: error[cannot_read]' edit uniform.node --script none.txt -o out/x.node
refuse 2 'error[bad_option]' edit uniform.node -o out/x.node
refuse 2 'edits.off: error[bad_option]' edit uniform.node --script edits.off -o edits.off

bad_edit 3 '2:1: error[unknown_id]' '-hole 5'
bad_edit 3 '2:1: error[unknown_id]' '-region 5'
bad_edit 3 '3:1: error[repeated_id]' '+hole 5 .5 .5\n+hole 5 .5 .5'
bad_edit 3 '2:11: error[bad_edit]' '+hole 5 .5'
bad_edit 3 '2:15: error[bad_edit]' '+hole 5 .5 .5 1'
bad_edit 3 '2:16: error[bad_edit]' '+region 5 .5 .5'
bad_edit 3 '2:21: error[bad_edit]' '+region 5 .5 .5 1 2 3'
bad_edit 3 '2:17: error[bad_number]' '+region 5 .5 .5 x'
bad_edit 3 '2:17: error[not_finite]' '+region 5 .5 .5 inf'
bad_edit 3 '2:1: error[unknown_id]' '-segment 5'
bad_edit 3 '3:1: error[repeated_id]' '+segment 5 1 2\n+polyline 5 3 4'
bad_edit 1 '2:1: error[zero_length]' '+segment 5 1 1'
bad_edit 3 '2:1: error[unknown_id]' '+segment 5 1 999'
bad_edit 1 '3:1: error[point_in_use]' '+segment 5 1 2\n-point 2'
bad_edit 1 '3:1: error[repeated_segment]' '+segment 5 1 2\n+polyline 6 2 1'

# shellcheck source=tool_domain_test.sh
source "$here/tool_domain_test.sh"
# shellcheck source=tool_repair_test.sh
source "$here/tool_repair_test.sh"

echo "== check speaks"
sed '2s/ [0-9]* \([0-9]*\)$/ \1 \1/' uniform.mesh.ele >bent.ele
cp uniform.mesh.node bent.node
refuse 3 'bent.ele:2:' check bent.node
cp uniform.mesh.node holed.node
awk 'NR == 1 { print $1 - 1, 3, 0; next } NR != 9' uniform.mesh.ele >holed.ele
refuse 1 'error[bad_quality]' check holed.node
refuse 1 'input' check uniform.mesh.node --input spiral.node
refuse 1 'quality' check uniform.mesh.node --rho 1.02
refuse 2 'error[unknown_format]' check uniform.svg
refuse 1 'area' check uniform.msh --max-area 1e-9
refuse 2 '--max-area' check uniform.msh --max-area 0
refuse 2 'error[bad_option]' check uniform.msh --boundary round
cat >crossing.poly <<'END'
2 2 0 0
1 0.1 0.1
2 0.9 0.8
1 0
1 1 2
0
END
refuse 1 'error[bad_quality]: segments: line 1' check uniform.vtu --input crossing.poly
cat >square.poly <<'END'
4 2 0 0
0 0 0
1 1 0
2 1 1
3 0 1
4 0
0 0 1
1 1 2
2 2 3
3 3 0
0
1
0 0.5 0.25 7
END
printf '4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n' >square.1.node
printf '2 3 1\n0 0 1 2 7\n1 0 2 3 7\n' >square.1.ele
expect 0 'segments    ok      4 segments' check square.1.node --input square.poly
expect 0 'note        square.poly:13: a region with one value' check square.1.node \
  --input square.poly
printf '2 3 1\n0 0 1 2 8\n1 0 2 3 8\n' >square.1.ele
refuse 1 'regions' check square.1.node --input square.poly
printf '1 3 1\n0 0 1 2 7\n' >square.1.ele
refuse 1 'vertex 4 at (0, 1) is in no triangle' check square.1.node --input square.poly

echo "== failing disk and interrupts leave nothing behind"
cp uniform.mesh.node out/kept.node
before=$(ls -lA --full-time out)
(
  ulimit -f 8
  "$tool" mesh uniform.node -o out/kept.node -o out/x.vtu --stats out/x.json >said.txt 2>&1
  echo $? >>said.txt
)
has said.txt 'error\[cannot_write\]: .*too large'
has said.txt '^2$'
[[ $(ls -lA --full-time out) == "$before" ]] || fail "a failing disk left: $(ls -A out)"
expect 0 '' gen uniform --n 300000 -o large.node
for signal in INT TERM; do
  timeout --preserve-status -s "$signal" 1 \
    "$tool" mesh large.node -o out/kept.node -o out/x.vtu >said.txt 2>&1
  echo $? >>said.txt
  has said.txt 'error\[cancelled\]'
  has said.txt '^5$'
  [[ $(ls -lA --full-time out) == "$before" ]] || fail "SIG$signal left: $(ls -A out)"
done

for i in $(seq 100000); do echo "move $((i % 200 + 1)) 0.5 0.$((100000 + i))"; done >long.txt
for engine in '' --static; do
  # shellcheck disable=SC2086
  timeout --preserve-status -s INT 1 \
    "$tool" edit uniform.node "${domain[@]}" --script long.txt $engine -o out/x.vtu >said.txt 2>&1
  echo $? >>said.txt
  has said.txt '^error\[cancelled\]'
  has said.txt '^5$'
  [[ $(ls -lA --full-time out) == "$before" ]] || fail "SIGINT in updates left: $(ls -A out)"
done

echo "== long runs say how far they are, to people"
# on_terminal COMMAND...: for 8 seconds
on_terminal() {
  timeout -s INT 8 script -qefc "$(printf '%q ' "$@")" /dev/null </dev/null
}
if command -v script >/dev/null; then
  # It takes more than the two seconds after which they are told.
  expect 0 '' gen uniform --n 1000000 -o larger.node
  on_terminal "$tool" mesh larger.node --algorithm gap-balls --rho 1.02 >said.txt 2>&1
  has said.txt '[1-3] of 3\): [0-9]'
  on_terminal "$tool" mesh larger.node --algorithm gap-balls --rho 1.02 --quiet >said.txt 2>&1
  if grep -q 'of 3)' said.txt; then fail "--quiet shows progress"; fi
  on_terminal "$tool" mesh uniform.node >said.txt 2>&1
  if grep -q 'of 3)' said.txt; then fail "a short run shows progress"; fi
fi
timeout -s INT 3.5 "$tool" mesh large.node --rho 1.1 >said.txt 2>&1
if grep -q 'of 3)' said.txt; then fail "progress in a file"; fi

# shellcheck source=tool_space_test.sh
source "$here/tool_space_test.sh"
# shellcheck source=tool_space_repair_test.sh
source "$here/tool_space_repair_test.sh"
# shellcheck source=tool_svr_test.sh
source "$here/tool_svr_test.sh"
# shellcheck source=tool_threads_test.sh
source "$here/tool_threads_test.sh"
# shellcheck source=tool_out_of_core_test.sh
source "$here/tool_out_of_core_test.sh"

echo "== the cities of the world"
expect 0 '7343 points' mesh "$data/places.node" -o cities.node
expect 0 'input       ok' check cities.node --input "$data/places.node" --rho 1.4142

report_checks
