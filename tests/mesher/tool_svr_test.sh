# shellcheck shell=bash disable=SC2154
# The tool's part on refinements of points; tool_test.sh sources it.

rm -rf svr
mkdir svr

echo "== svr, refine: meshes that the judge accepts, the same from points in any order"
for dimension in 2 3; do
  for kind in uniform grid line-circle spread; do
    points=svr/$kind.$dimension.node
    expect 0 '' gen "$kind" --n 300 --seed 3 --dimension "$dimension" -o "$points"
    (head -1 "$points" && tail -n +2 "$points" | grep -v '^#' | tac) >svr/turned.node
    rho=$([[ $dimension == 2 ]] && echo 1.4142 || echo 2)
    for algorithm in svr refine; do
      expect 0 '' mesh "$points" --dim "$dimension" --algorithm $algorithm --quiet \
        -o svr/mesh.node -o svr/mesh.vtu --stats svr/figures.json
      expect 0 'quality' check svr/mesh.node --input "$points" --rho "$rho"
      python3 -m json.tool svr/figures.json >/dev/null || fail "--stats of $algorithm"
      expect 0 '' mesh svr/turned.node --dim "$dimension" --algorithm $algorithm --quiet \
        -o svr/other.vtu
      same svr/mesh.vtu svr/other.vtu
      expect 0 '' mesh "$points" --dim "$dimension" --algorithm $algorithm --static --quiet \
        -o svr/static.vtu
      same svr/mesh.vtu svr/static.vtu
    done
  done
done

echo "== svr: lines in the plane, their holes and regions, in all formats"
printf '8 2 0 1\n1 0 0 5\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 .4 .4 0\n6 .6 .4 0\n7 .6 .5 0\n8 .4 .6 0\n8 1\n1 1 2 7\n2 2 3 0\n3 3 4 0\n4 4 1 0\n5 5 6 0\n6 6 7 0\n7 7 8 0\n8 8 5 0\n1\n1 .5 .45\n1\n1 .1 .1 3\n' >svr/holed.poly
for lines in "$data/great_lakes.poly" svr/holed.poly; do
  for algorithm in svr refine; do
    for extent in '' --box; do
      [[ $lines$extent == svr/holed.poly--box ]] && continue  # holes are kept then
      expect 0 '' mesh "$lines" $extent --algorithm $algorithm --quiet -o svr/lines.1.node \
        -o svr/lines.vtu -o svr/lines.msh -o svr/lines.svg --stats svr/figures.json
      expect 0 'quality' check svr/lines.vtu --input "$lines" --rho 1.4142
      expect 0 'quality' check svr/lines.1.node --input "$lines" --rho 1.4142
      python3 -m json.tool svr/figures.json >/dev/null || fail "--stats of $algorithm"
    done
  done
done

echo "== auto: refine in the plane and for even points, svr else in space, gap-balls for what these do not know; it says which"
# taken ALGORITHM ARGUMENT...: `mesh` takes it, and makes its mesh.
taken() {
  local algorithm=$1
  shift
  expect_of "$chosen" 0 "algorithm             $algorithm" mesh "$@" -o svr/auto.vtu \
    --stats svr/auto.json
  has svr/auto.json "\"algorithm\": \"$algorithm\""
  expect 0 '' mesh "$@" --algorithm "$algorithm" -o svr/named.vtu
  same svr/auto.vtu svr/named.vtu
}
taken refine svr/uniform.2.node
has svr/auto.json '"worst_radius_edge": [0-9.]+,'
taken refine svr/uniform.3.node
taken refine svr/grid.3.node
taken svr svr/line-circle.3.node
has svr/auto.json '"largest_degree": [0-9]+,'
has svr/auto.json '"warped": [0-9]+,'
taken refine "$data/great_lakes.poly"
taken refine svr/uniform.2.node --max-area 0.01
taken gap-balls svr/uniform.2.node --rule voronoi-aspect --rho 2
taken gap-balls svr/uniform.3.node --static
taken gap-balls svr/holed.poly --rho 1.3
taken refine svr/uniform.2.node --rho 1.3
expect 0 '' gen cube --dim 3 -o svr/cube.poly
taken svr svr/cube.poly
taken gap-balls svr/cube.poly --rho 1.8
taken svr svr/cube.poly --max-volume 0.01
taken svr svr/cube.poly --growth 1.3
for algorithm in gap-balls svr refine; do
  expect 0 '' mesh svr/uniform.3.node --algorithm $algorithm --quiet -o svr/$algorithm.node
done
if cmp -s svr/gap-balls.node svr/svr.node; then fail "--algorithm says nothing"; fi
if cmp -s svr/svr.node svr/refine.node; then fail "refine is svr"; fi

echo "== svr: limits of size, everywhere, by a background, in regions, and growth"
for algorithm in svr refine; do
  expect 0 '' mesh "$data/great_lakes.poly" --algorithm $algorithm --max-area 0.01 -o svr/l.1.node
  expect 0 'area        ok' check svr/l.1.node --input "$data/great_lakes.poly" --rho 1.4142 \
    --max-area 0.01
  expect 0 '' mesh svr/cube.poly --algorithm $algorithm --max-volume 0.001 -o svr/c.1.node
  expect 0 'volume      ok' check svr/c.1.node --input svr/cube.poly --rho 2 --max-volume 0.001
  sed 's/^1 .1 .1 3$/1 .1 .1 3 .001/' svr/holed.poly >svr/region.poly
  expect 0 '' mesh svr/region.poly --algorithm $algorithm --region-areas -o svr/r.1.node
  expect 0 'area        ok' check svr/r.1.node --input svr/region.poly --rho 1.4142 --max-area 0.001
  expect 0 '' mesh svr/region.poly --algorithm $algorithm -o svr/r.1.node
  expect 1 'error[bad_quality]: area' check svr/r.1.node --input svr/region.poly --max-area 0.001
  printf 'x,y,h\n0,0,0.02\n1,1,0.2\n' >svr/sizes.csv
  expect 0 '' mesh svr/holed.poly --algorithm $algorithm --sizes svr/sizes.csv -o svr/s.1.node
  expect 0 'quality     ok' check svr/s.1.node --input svr/holed.poly --rho 1.4142
  expect 0 '' mesh svr/cube.poly --algorithm $algorithm --growth 1.2 -o svr/g.1.node
  expect 0 'quality     ok' check svr/g.1.node --input svr/cube.poly --rho 2
done

echo "== svr: refusals, and nothing is written"
rm -rf out
mkdir out
refuse 2 'svrr not in {auto,gap-balls,svr,refine}' mesh svr/uniform.3.node --algorithm svrr -o out/x.node
for algorithm in svr refine; do
  refuse 2 "$algorithm of segments needs a rho of 1.4142 or more" mesh "$data/great_lakes.poly" \
    --algorithm $algorithm --rho 1.4 -o out/x.node
  refuse 4 'more than 6000 vertices are needed; so far' mesh \
    "$data/great_lakes.poly" --algorithm $algorithm --max-vertices 6000 -o out/x.node
  refuse 2 'growth must be 0, for any, or from 1.05 to 100' mesh svr/uniform.2.node \
    --algorithm $algorithm --growth 1.01 -o out/x.node
  refuse 2 'gap-balls, and so a mesh under edits, has no bound of growth' mesh svr/uniform.2.node \
    --algorithm gap-balls --growth 1.3 -o out/x.node
  refuse 2 "$algorithm needs the rule radius-edge" mesh svr/uniform.2.node --algorithm $algorithm \
    --rule voronoi-aspect -o out/x.node
  refuse 4 'more than 400 vertices are needed' mesh svr/uniform.3.node --algorithm $algorithm \
    --max-vertices 400 -o out/x.node
  printf '3 2 0 0\n1 0 0\n2 1 0\n3 0 0\n' >svr/twice.node
  refuse 1 'svr/twice.node:4:1: error[duplicate_point]: point 3 lies on point 1 of line 2' mesh \
    svr/twice.node --algorithm $algorithm -o out/x.node
done

echo "== --no-flat: none above rho comes, and none that is not Delaunay but for rounding"
expect 0 '' mesh "$data/flat_above_rho.poly" --algorithm refine --no-flat --quiet -o svr/flat.vtu
expect 0 'quality     ok' check svr/flat.vtu --input "$data/flat_above_rho.poly" --rho 2 --near
expect 0 '' mesh "$data/flat_not_delaunay.poly" --box --algorithm svr --rho 2.53969 --no-flat \
  --quiet -o svr/flat.vtu
expect 0 'delaunay    ok' check svr/flat.vtu --input "$data/flat_not_delaunay.poly" --boundary box \
  --rho 2.53969 --near

echo "== an INPUT that can be read once alone, and bytes that are no text"
mkfifo svr/pipe.poly
cat "$data/great_lakes.poly" >svr/pipe.poly &
expect 0 'vertices' mesh svr/pipe.poly -o svr/piped.vtu
wait
expect 0 '' mesh "$data/great_lakes.poly" --quiet -o svr/unpiped.vtu
same svr/piped.vtu svr/unpiped.vtu
printf '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\033[31m\001\002 nonsense\n' >svr/bytes.msh
said=$("$tool" check svr/bytes.msh 2>&1)
[[ $said == *'error['* && $said != *$'\033'* && $said != *$'\001'* ]] || fail "raw bytes: $said"
