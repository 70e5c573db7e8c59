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

echo "== svr: gap-balls is the default, and another mesh"
expect 0 '' mesh svr/uniform.3.node --quiet -o svr/plain.node
expect 0 '' mesh svr/uniform.3.node --algorithm gap-balls --quiet -o svr/named.node
same svr/plain.node svr/named.node
expect 0 '' mesh svr/uniform.3.node --algorithm svr --quiet -o svr/svr.node
if cmp -s svr/plain.node svr/svr.node; then fail "--algorithm says nothing"; fi
expect 0 '' mesh svr/uniform.3.node --algorithm refine --quiet -o svr/refined.node
if cmp -s svr/svr.node svr/refined.node; then fail "refine is svr"; fi

echo "== svr: refusals, and nothing is written"
rm -rf out
mkdir out
refuse 2 'svrr not in {gap-balls,svr,refine}' mesh svr/uniform.3.node --algorithm svrr -o out/x.node
for algorithm in svr refine; do
  refuse 2 "$algorithm takes no lines" mesh "$data/great_lakes.poly" --algorithm $algorithm \
    -o out/x.node
  refuse 2 "$algorithm knows no limits of size" mesh svr/uniform.2.node --algorithm $algorithm \
    --max-area 0.1 -o out/x.node
  refuse 2 "$algorithm needs the rule radius-edge" mesh svr/uniform.2.node --algorithm $algorithm \
    --rule voronoi-aspect -o out/x.node
  refuse 4 'more than 400 vertices are needed' mesh svr/uniform.3.node --algorithm $algorithm \
    --max-vertices 400 -o out/x.node
  printf '3 2 0 0\n1 0 0\n2 1 0\n3 0 0\n' >svr/twice.node
  refuse 1 'svr/twice.node:4:1: error[duplicate_point]: point 3 lies on point 1 of line 2' mesh \
    svr/twice.node --algorithm $algorithm -o out/x.node
done
