#!/usr/bin/env bash
# Complexes that are repaired before they are meshed; tool_test.sh sources it.
# shellcheck disable=SC2154

# write_boxes FILE LO HI LO HI: two boxes between these corners on the diagonal, polygons 1 to 12.
write_boxes() {
  local file=$1 base x y z corners
  shift
  {
    echo "16 3 0 0"
    base=0
    for corners in "$1 $2" "$3 $4"; do
      for x in $corners; do
        for y in $corners; do
          for z in $corners; do echo "$((base += 1)) $x $y $z"; done
        done
      done
    done
    echo "12 1"
    for base in 0 8; do
      for corners in '1 2 4 3' '5 6 8 7' '1 2 6 5' '3 4 8 7' '1 3 7 5' '2 4 8 6'; do
        echo "1 0 $((base + 1))"
        printf 4
        for x in $corners; do printf ' %d' $((base + x)); done
        echo
      done
    done
    printf '0\n0\n'
  } >"$file"
}

echo "== space: boxes through each other"
write_boxes through.poly 0 2 1 3
refuse 1 'error[segment_through_polygon]' mesh through.poly -o out/x.vtu
refuse 1 '; --repair mends this' mesh through.poly -o out/x.vtu
refuse 1 '; --repair mends this' mesh through.poly --static -o out/x.vtu
said=$("$tool" trace through.poly -o out/x.trace 2>&1)
[[ $said == *through.poly:*'error['* && $said != *--repair* ]] || fail "trace has no --repair: $said"
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'through.poly:21:1: repair: polygons 2, 4 and 11 cross at (2, 2, 1), point' \
    mesh through.poly --repair $engine -o "through$engine.1.node"
done
same through.1.node through--static.1.node
same through.1.face through--static.1.face
expect 0 'regions               3, holes 0' mesh through.poly --repair -o x.vtu
expect 0 'regions     ok' check through.1.node --rho 2
expect 0 'hull        ok' check through.1.node --rho 2

echo "== space: one box on the other, side by side in part"
write_boxes stacked.poly 0 2 2 3
awk 'NR > 9 && NR < 18 { $2 -= 1.5; $3 -= 1.5 } { print }' stacked.poly >on_top.poly
expect 0 'repair: polygon 11 leaves to polygon 6 what both cover' \
  mesh on_top.poly --repair -o on_top.1.node
expect 0 'regions               2, holes 0' mesh on_top.poly --repair -o x.vtu
expect 0 'regions     ok' check on_top.1.node --rho 2

echo "== space: a house with a bent roof"
cat >house.poly <<'END'
10 3 0 0
1 0 0 0
2 4 0 0
3 4 6 0
4 0 6 0
5 0 0 3
6 4 0 3
7 4 6 3
8 0 6 3
9 2 0 5
10 2 6 5.25
7 1
1 0 10
4 1 2 3 4
1 0 11
5 1 2 6 9 5
1 0 12
5 4 3 7 10 8
1 0 13
4 1 4 8 5
1 0 14
4 2 3 7 6
1 0 15
4 5 8 10 9
1 0 16
4 6 7 10 9
0
0
END
refuse 1 'house.poly:23:1: error[not_flat]: polygon 6 is not flat' mesh house.poly -o out/x.vtu
refuse 1 '; --repair mends this' mesh house.poly -o out/x.vtu
expect 0 'house.poly:23:1: repair: polygon 6 is not flat, by 0.0' mesh house.poly --repair -o x.vtu
expect 0 '2 triangles now, the new one has id 8' mesh house.poly --repair -o house.1.node
has house.1.face '^ *[0-9]+ .* 15( |$)'
expect 0 'regions     ok      1 regions' check house.1.node
printf -- '+point 20 1 1 1\n-polygon 8\n' >edits.txt
expect 0 'repair: polygon 6 is not flat' edit house.poly --repair --script edits.txt -o x.1.node
# Edits are not repaired.
printf -- '+point 20 1.2 3 3\n+point 21 1.2 3 5.5\n+segment 5 20 21\n' >edits.txt
for options in '' --static; do
  # shellcheck disable=SC2086
  said=$("$tool" edit house.poly --repair $options --script edits.txt -o out/x.vtu 2>&1)
  [[ $said == *'error[segment_through_polygon]'* && $said != *'--repair'* ]] || \
    fail "repairs edits: $said"
done

echo "== space: a surface with a facet twice, and a vertex on an edge"
cat >soup.stl <<'END'
solid soup
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 2 0 0
vertex 0 2 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 0 0 2
vertex 2 0 0
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 2 0
vertex 0 0 2
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 2 0 0
vertex 1 1 0
vertex 0 0 2
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 1 1 0
vertex 0 2 0
vertex 0 0 2
endloop
endfacet
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 2 0
vertex 2 0 0
endloop
endfacet
endsolid soup
END
refuse 1 'error[repeated_polygon]' mesh soup.stl --surface -o out/x.vtu
refuse 1 '; --repair mends this' mesh soup.stl --surface -o out/x.vtu
expect 0 'repair: polygon 6 is dropped: nothing is left of it' repair soup.stl --surface -o soup.poly
expect 0 'nothing was to be repaired' repair soup.poly -o again.smesh
expect 0 'surface repairs its faces, too' repair soup.stl
expect 0 '' mesh soup.poly --quiet -o soup.3.node
expect 0 'polygons    ok' check soup.3.node --input soup.poly --rho 2
for merged in '' --merge; do
  # shellcheck disable=SC2086
  expect 0 'repair: polygon 6 is dropped: nothing is left of it' \
    mesh soup.stl --surface $merged --repair -o soup.1.node
  expect 0 'regions     ok      1 regions' check soup.1.node --rho 2
  expect 0 'cover       ok' check soup.1.node --rho 2
  # shellcheck disable=SC2086
  expect 0 'polygons    ok' check soup.1.node --input soup.stl --surface $merged --repair --ties --rho 2
  expect 1 'BROKEN' check soup.1.node --input soup.stl --surface
done
expect 0 '' mesh soup.stl --surface --no-merge --repair --quiet -o soup.2.node
expect 0 'polygons    ok' check soup.2.node --input soup.stl --surface --no-merge --repair
refuse 2 '--repair requires --input' check soup.1.node --repair
expect 0 'soup.stl:4:1: repair: polygon 1 has point 5 (1, 1, 0) on it' \
  mesh soup.stl --surface --repair -o x.vtu
refuse 1 'error[outside_domain]' mesh soup.stl --surface --repair --domain 0 0 0 1 1 1 -o out/x.vtu
expect 0 '' mesh uniform.3d.node --repair --quiet -o x.1.node

echo "== space: a surface that is open"
box='0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n'
sides='4 0 1 2 3\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n'
# shellcheck disable=SC2059
{
  printf "OFF\n8 5 0\n$box$sides" >open.off
  printf "OFF\n8 6 0\n$box${sides}4 4 5 6 7\n" >closed.off
  printf "OFF\n12 7 0\n${box}.2 .2 .5\n.8 .2 .5\n.8 .8 .5\n.2 .8 .5\n${sides}4 4 5 6 7\n4 8 9 10 11\n" >inner.off
  printf "OFF\n11 7 0\n${box}2 2 2\n3 2 2\n2 3 2\n${sides}4 4 5 6 7\n3 8 9 10\n" >loose.off
}
expect 0 'open.off:12: warning: the surface is open: 4 edges have a polygon on one side only, as from (0, 0, 1) to (1, 0, 1); it encloses nothing, and the whole box is kept' \
  mesh open.off --surface -o x.vtu
expect 0 'open: 3 edges have a polygon on one side only, as from (2, 2, 2) to (3, 2, 2); what it does not enclose is left out' \
  mesh loose.off --surface -o x.vtu
echo '+polygon 7 5 6 7 8' >lid.txt
echo '-polygon 6' >no_lid.txt
expect 0 'the surface is open: 4 edges have a polygon on one side only' \
  edit closed.off --surface --script no_lid.txt -o x.vtu
said=$("$tool" edit open.off --surface --script lid.txt -o x.vtu 2>&1)
[[ $said == *written* && $said != *open:* ]] || fail "a lid: $said"
for fine in 'open.off --box' closed.off inner.off; do
  # shellcheck disable=SC2086
  said=$("$tool" mesh $fine --surface -o x.vtu 2>&1)
  [[ $said != *open:* ]] || fail "$fine: $said"
done

echo "== space: a thin hole of a polygon, which another one fills"
cat >thin.poly <<'END'
7 3 0 0
1 0 0 0
2 4 0 0
3 4 4 0
4 0 4 0
5 1 1 0
6 3 1 0
7 2.9 1.2 0
2 0
2 1
4 1 2 3 4
3 5 6 7
1 2.3 1.05 0
1 0
3 5 6 7
0
0
END
expect 0 'nothing was to be repaired' repair thin.poly -o thin.again.poly
has thin.again.poly '^2 1$'
expect 0 '' mesh thin.again.poly --quiet -o thin.1.node
expect 0 'polygons    ok' check thin.1.node --input thin.poly --rho 2

echo "== space: what is closer than a tolerance is made to touch"
cat >lid.poly <<'END'
8 3 0 0
1 0 0 0
2 4 0 0
3 4 4 0
4 0 4 0
5 1 1 .001
6 3 1 .001
7 3 3 -.001
8 1 3 -.001
2 0
1
4 1 2 3 4
1
4 5 6 7 8
0
0
END
expect 0 '; 2 repairs, which move what is there by at most 0' repair lid.poly -o lid.0.poly
expect 0 'repairs, which move what is there by at most 0.001' repair lid.poly \
  --repair-tolerance .01 -o lid.1.poly
expect 0 '' mesh lid.poly --repair --repair-tolerance .01 --quiet -o lid.node
expect 0 'polygons    ok' check lid.node --input lid.poly --repair --repair-tolerance .01 --rho 2
expect 2 'error[bad_option]: --repair-tolerance -1: must be 0 or more' repair lid.poly \
  --repair-tolerance -1
expect 2 'the tolerance of a repair is 1, not from 0 to' repair lid.poly --repair-tolerance 1
expect 2 'repair-tolerance requires --repair' mesh lid.poly --repair-tolerance 1 -o x.vtu
