#!/usr/bin/env bash
# Limits of size in space as a user of the tool meets them: `mesher mesh`, `edit`, `trace` and
# `check` with them.
#
#   tool_space_limits_test.sh MESHER_TOOL TRACES_TOOL
set -u
tool=$(realpath "$1")
traces=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# shellcheck source=../support/tool_checks.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/tool_checks.sh"
cd "$scratch" || exit 1
tool=$(by_gap_balls "$tool" "$scratch")

expect() { expect_of "$tool" "$@"; }
refuse() { refuse_of "$tool" "$@"; }

mkdir out
# A cube with a wall, which parts it in two regions. The second has a limit.
cat >box.poly <<'END'
13 3 0 0
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 .5 0 0
10 .5 1 0
11 .5 1 1
12 .5 0 1
13 .3 .4 .6
7 0
2
6 1 9 2 3 10 4
2 9 10
2
6 5 12 6 7 11 8
2 12 11
2
6 1 9 2 6 12 5
2 9 12
1
4 2 3 7 6
2
6 3 10 4 8 11 7
2 10 11
1
4 4 1 5 8
1
4 9 10 11 12
0
2
1 .1 .1 .1 10 -1
2 .9 .1 .1 20 0.004
END

echo "== limits in space: everywhere, by a size, by a background, in regions"
printf 'x,y,z,h\n0,0,0,0.25\n1,0,0,0.6\n1,1,1,1\n0,1,0,0.6\n0,0,1,0.6\n' >sizes.csv
printf '5 3 1 0\n1 0 0 0 .25\n2 1 0 0 .6\n3 1 1 1 1\n4 0 1 0 .6\n5 0 0 1 .6\n' >sizes.node
n=0
for limit in '--max-volume 0.006' '--max-size 0.4' '--sizes sizes.csv' --region-volumes \
  '--region-volumes --max-volume 0.01 --sizes sizes.csv'; do
  n=$((n + 1))
  for engine in '' --static; do
    # shellcheck disable=SC2086
    expect 0 'regions               2' mesh box.poly $limit $engine -o "limited$n$engine.1.node" \
      -o "limited$n$engine.vtu"
  done
  for format in vtu 1.node 1.ele 1.face 1.edge; do
    same "limited$n.$format" "limited$n--static.$format"
  done
  expect 0 'polygons    ok' check "limited$n.1.node" --input box.poly --rho 2
done
expect 0 'volume      ok' check limited1.1.node --input box.poly --max-volume 0.006
expect 1 'error[bad_quality]: volume' check limited1.1.node --input box.poly --max-volume 0.0006
# A regular tetrahedron of size 0.4 has a volume of 0.00754; of size 1, of 0.1179.
expect 0 'volume      ok' check limited2.1.node --input box.poly --max-volume 0.00755
expect 0 'volume      ok' check limited3.1.node --input box.poly --max-volume 0.1179
expect 0 '' mesh box.poly -o free.1.node -o free.vtu
expect 1 'error[bad_quality]: volume' check free.1.node --input box.poly --max-volume 0.006
expect 0 '' mesh box.poly --sizes sizes.node -o by_node.vtu
same limited3.vtu by_node.vtu
# The limit of region 2 holds in it, and larger tetrahedra are left in region 1; sizes hold, too.
python3 - <<'END' || fail 'volumes by region, or by a background'
def parts(name):
    rows = [l.split() for l in open(name + '.1.node') if not l.startswith('#')][1:]
    at = {r[0]: tuple(map(float, r[1:4])) for r in rows}
    for row in [l.split() for l in open(name + '.1.ele') if not l.startswith('#')][1:]:
        p = [at[v] for v in row[1:5]]
        u, v, w = ([p[i][k] - p[0][k] for k in range(3)] for i in (1, 2, 3))
        volume = abs(u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
                     u[2] * (v[0] * w[1] - v[1] * w[0])) / 6
        yield float(row[5]), volume, [sum(q[k] for q in p) / 4 for k in range(3)]
largest = {}
for region, volume, _ in parts('limited4'):
    largest[region] = max(largest.get(region, 0), volume)
assert largest[20] <= 0.004 < largest[10], largest
# The sizes from the origin to the three samples beside it.
near = [(volume, 0.25 + 0.35 * sum(c)) for _, volume, c in parts('limited3') if sum(c) <= 1]
assert near and all(volume <= 0.1179 * h ** 3 for volume, h in near), near
far = [volume for _, volume, c in parts('limited3') if sum(c) > 2]
assert max(far) > 4 * min(volume for volume, _ in near), (far, near)
END

echo "== limits in space: where they count, and what is said of those that do not"
unused='note: --region-volumes is not used: no region has a largest volume'
# One region, and no limit.
sed -z 's/\n2\n\(1 .1 .1 .1 10 -1\n\).*/\n1\n\1/' box.poly >open.poly
expect 0 "open.poly: $unused" mesh open.poly --region-volumes -o x.vtu
printf '+region 3 .9 .9 .9 5\n' >region.txt
expect 0 "open.poly: $unused" edit open.poly --region-volumes --script region.txt -o x.vtu
printf '+region 3 .9 .9 .9 5 0.02\n' >region.txt
said=$("$tool" edit open.poly --region-volumes --script region.txt -o by_edit.vtu 2>&1)
said+=$("$tool" mesh box.poly --region-volumes -o x.vtu 2>&1)
[[ $said != *"$unused"* ]] || fail "used, and said to be unused: $said"
expect 0 '' edit open.poly --region-volumes --script region.txt --static -o by_edit--static.vtu
same by_edit.vtu by_edit--static.vtu
sed -z 's/\n0\n2\n1 .1 .1 .1 10 -1/\n1\n1 .1 .1 .1\n1/' box.poly >hollow.poly
expect 0 'holes 1' mesh hollow.poly --max-volume 0.006 -o half.1.node --stats half.json
expect 0 '' mesh hollow.poly --max-volume 0.006 --box -o all.vtu --stats all.json
python3 - <<'END' || fail 'the hole is filled, or all of the box is not'
import json
half, everywhere = json.load(open('half.json')), json.load(open('all.json'))
assert half['vertices'] < everywhere['vertices'], (half['vertices'], everywhere['vertices'])
END

echo "== limits in space: edits of features, with limits that stay"
printf '+point 20 .7 .6 .5\nmove 13 .3 .45 .6\n-polygon 7\n' >features.txt
sed -e 's/^13 3 0 0/14 3 0 0/; s/^13 .3 .4 .6/13 .3 .45 .6\n20 .7 .6 .5/; s/^7 0$/6 0/' \
  -e '/^4 9 10 11 12/d' box.poly | sed -z 's/\n1\n0\n2\n/\n0\n2\n/' >moved.poly
for limit in '--max-volume 0.02' '--max-volume 0.02 --box' '--sizes sizes.csv' --region-volumes; do
  # shellcheck disable=SC2086
  expect 0 '' edit box.poly --script features.txt $limit -o edited.vtu
  # shellcheck disable=SC2086
  expect 0 '' mesh moved.poly $limit -o moved.vtu
  same edited.vtu moved.vtu
done

echo "== limits in space: edits of limits"
cat >limits.txt <<'END'
limit volume 0.03
begin
+point 20 .7 .6 .5
limit size 0.35 in .5 0 0 1 1 .5
commit
-polygon 7
limit sizes sizes.csv in 0 0 0 .5 .5 .5
+polygon 9 9 10 11 12
limit none in .75 .75 .75 1 1 1
END
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'updates' edit box.poly --script limits.txt $engine -o "limits$engine.node" \
    -o "limits$engine.vtu"
done
for format in vtu node ele face; do same limits.$format limits--static.$format; done
printf 'limit volume 0.03\nlimit size .3 in 0 0 0 .5 .5 .5\nlimit none\n' >none.txt
expect 0 '' edit box.poly --script none.txt -o none.vtu
same none.vtu free.vtu
printf 'limit volume 0.006\n' >same.txt
expect 0 '' edit box.poly --script same.txt -o same.vtu
same same.vtu limited1.vtu
printf 'limit sizes sizes.csv\n' >same.txt
expect 0 '' edit box.poly --script same.txt -o same.vtu
same same.vtu limited3.vtu

echo "== limits in space: the trace that edits leave is a fresh one"
# A point that is alone is located in another bucket where there is a lattice.
printf '4 3 0 0\n1 0 0 0\n2 1 1 1\n3 .52 .43 .57\n4 .9 .1 .2\n' >lone.node
printf 'limit size .3\nlimit volume 0.01 in 0 0 0 .5 .5 .5\nlimit volume 0.02\n' >same.txt
printf 'limit volume 1e-3\n' >fine.txt
while read -r input volume script; do
  expect 0 ' calls' trace "$input" --max-volume "$volume" -o fresh.trace
  expect 0 ' calls' trace "$input" --script "$script" -o edited.trace
  expect_of "$traces" 0 '' audit edited.trace
  "$traces" distance fresh.trace edited.trace >distance.txt
  has distance.txt '^ +0 .* complete$'
  ! grep -E '^ +[1-9]' distance.txt || fail "$input: a limit of $script is another than an option's"
done <<'END'
box.poly 0.02 same.txt
lone.node 1e-3 fine.txt
END
expect 0 ' calls' trace box.poly --script limits.txt -o edited.trace
expect_of "$traces" 0 '' audit edited.trace

echo "== limits in space: what makes no sense is refused"
for bad in 0 -1 x nan 1e-60; do
  refuse 2 'error[bad_option]' mesh box.poly --max-volume "$bad" -o out/x.vtu
  refuse 2 'error[bad_option]' mesh box.poly --max-volume "$bad" --static -o out/x.vtu
done
refuse 2 'max-size' mesh box.poly --max-size 0 -o out/x.vtu
refuse 2 'excludes' mesh box.poly --max-size 1 --max-volume 1 -o out/x.vtu
refuse 2 'radius-edge' mesh box.poly --max-volume 1 --rule voronoi-aspect -o out/x.vtu
refuse 2 'box.poly: error[bad_option]: --max-area is for the plane' mesh box.poly --max-area 1 \
  -o out/x.vtu
printf '4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n' >plane.node
refuse 2 'plane.node: error[bad_option]: --max-volume is for space' mesh plane.node \
  --max-volume 1 -o out/x.vtu
printf 'x,y,z,h\n0,0,0,0\n' >zero.csv
refuse 3 'zero.csv:2' mesh box.poly --sizes zero.csv -o out/x.vtu
printf 'x,y,h\n0,0,1\n' >flat.csv
refuse 3 'flat.csv:1:1: error[bad_header]: no columns named x,y,z,h' mesh box.poly \
  --sizes flat.csv -o out/x.vtu
printf '0,0,0,1,2\n' >wide.csv
refuse 3 'name the columns in a first line (x,y,z,h)' mesh box.poly --sizes wide.csv -o out/x.vtu
printf '1 2 1 0\n1 0 0 1\n' >flat.node
refuse 3 'flat.node:1:3: error[bad_dimension]' mesh box.poly --sizes flat.node -o out/x.vtu
printf 'x,y,z,h\n0,0,0,1\n0,0,1,1\n0,0,0,2\n' >twice.csv
refuse 1 'twice.csv:4:1: error[duplicate_point]' mesh box.poly --sizes twice.csv -o out/x.vtu
refuse 2 'sizes.csv' mesh box.poly --sizes sizes.csv -o sizes.csv
# bad_edit CODE TEXT LINE
bad_edit() {
  printf '%s\n' "$3" >bad.txt
  for engine in '' --static; do
    # shellcheck disable=SC2086
    refuse "$1" "$2" edit box.poly --script bad.txt $engine -o out/x.vtu
  done
}
bad_edit 2 'none.csv: error[cannot_read]: cannot be read: No such file or directory (named by bad.txt:1)' \
  'limit sizes none.csv'
bad_edit 3 'zero.csv:2:1: error[bad_number]' 'limit sizes zero.csv'
bad_edit 3 '(named by bad.txt:1)' 'limit sizes zero.csv in 0 0 0 1 1 1'
bad_edit 3 'bad.txt:1:7: error[bad_edit]' 'limit area 1'
bad_edit 3 'bad.txt:1:14: error[bad_number]' 'limit volume 0'
bad_edit 3 'bad.txt:1:' 'limit volume 1 in 0 0 1 1'
bad_edit 3 'bad.txt:1:19: error[bad_edit]: the first corner' 'limit volume 1 in 1 0 0 0 1 1'
bad_edit 2 'bad.txt:1' 'limit volume 1e-60'

report_checks
