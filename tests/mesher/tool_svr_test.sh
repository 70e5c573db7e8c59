# shellcheck shell=bash disable=SC2154
# The tool's part on sparse Voronoi refinement; tool_test.sh sources it.

rm -rf svr
mkdir svr

echo "== svr: meshes that the judge accepts, the same from points in any order"
for dimension in 2 3; do
  for kind in uniform grid line-circle spread; do
    points=svr/$kind.$dimension.node
    expect 0 '' gen "$kind" --n 300 --seed 3 --dimension "$dimension" -o "$points"
    expect 0 '' mesh "$points" --dim "$dimension" --algorithm svr --quiet -o svr/mesh.node \
      -o svr/mesh.vtu --stats svr/figures.json
    rho=$([[ $dimension == 2 ]] && echo 1.4142 || echo 2)
    expect 0 'quality' check svr/mesh.node --input "$points" --rho "$rho"
    python3 -m json.tool svr/figures.json >/dev/null || fail "--stats of svr"
    (head -1 "$points" && tail -n +2 "$points" | grep -v '^#' | tac) >svr/turned.node
    expect 0 '' mesh svr/turned.node --dim "$dimension" --algorithm svr --quiet -o svr/other.vtu
    same svr/mesh.vtu svr/other.vtu
    expect 0 '' mesh "$points" --dim "$dimension" --algorithm svr --static --quiet -o svr/static.vtu
    same svr/mesh.vtu svr/static.vtu
  done
done

echo "== svr: gap-balls is the default, and another mesh"
expect 0 '' mesh svr/uniform.3.node --quiet -o svr/plain.node
expect 0 '' mesh svr/uniform.3.node --algorithm gap-balls --quiet -o svr/named.node
same svr/plain.node svr/named.node
expect 0 '' mesh svr/uniform.3.node --algorithm svr --quiet -o svr/svr.node
if cmp -s svr/plain.node svr/svr.node; then fail "--algorithm says nothing"; fi

echo "== svr: refusals, and nothing is written"
rm -rf out
mkdir out
refuse 2 'svrr not in {gap-balls,svr}' mesh svr/uniform.3.node --algorithm svrr -o out/x.node
refuse 2 'svr takes no lines' mesh "$data/great_lakes.poly" --algorithm svr -o out/x.node
refuse 2 'svr knows no limits of size' mesh svr/uniform.2.node --algorithm svr --max-area 0.1 \
  -o out/x.node
refuse 2 'svr needs the rule radius-edge' mesh svr/uniform.2.node --algorithm svr \
  --rule voronoi-aspect -o out/x.node
refuse 4 'more than 400 vertices are needed' mesh svr/uniform.3.node --algorithm svr \
  --max-vertices 400 -o out/x.node
printf '3 2 0 0\n1 0 0\n2 1 0\n3 0 0\n' >svr/twice.node
refuse 1 'svr/twice.node:4:1: error[duplicate_point]: point 3 lies on point 1 of line 2' mesh \
  svr/twice.node --algorithm svr -o out/x.node
