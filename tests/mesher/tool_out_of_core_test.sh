# shellcheck shell=bash disable=SC2154
# The tool's part on points out of core; tool_test.sh sources it.

rm -rf core
mkdir core

echo "== mesh --out-of-core: the bytes of one run, in the plane and in space"
expect 0 '' gen uniform --n 3000 --seed 4 -o core/plane.node
expect 0 '' gen uniform --n 400 --seed 4 --dim 3 -o core/space.node
for name in plane space; do
  expect 0 '' mesh core/$name.node --algorithm gap-balls --quiet -o core/one.node -o core/one.vtu
  for tiles in 1 5; do
    expect 0 " $((tiles + 1)), of which 0 were in the folder" mesh core/$name.node \
      --out-of-core core/tiles --tiles $tiles --threads $((tiles % 2 + 1)) -o core/many.node \
      -o core/many.vtu --stats core/figures.json
    for kind in node ele vtu; do same core/one.$kind core/many.$kind; done
    has core/figures.json "\"tiles\": $((tiles + 1))"
    if [[ -e core/tiles ]]; then fail "the folder stays"; fi
  done
done

echo "== mesh --out-of-core: killed at any moment, it goes on; nothing is written before the end"
expect 0 '' gen uniform --n 60000 --seed 6 -o core/large.node
expect 0 '' mesh core/large.node --algorithm gap-balls --quiet -o core/one.vtu
killed_after() {
  (timeout -s KILL "$1" "$tool" mesh core/large.node --out-of-core core/tiles --tiles 8 --quiet \
    "${@:2}"; true) 2>/dev/null
}
found=0
for wait in .05 .1 .2 .3 .4 .5; do
  rm -rf core/tiles core/many.vtu
  killed_after "$wait" -o core/many.vtu
  if [[ -d core/tiles ]]; then
    if [[ -e core/many.vtu ]]; then fail "a killed run wrote a mesh"; fi
    if compgen -G 'core/tiles/view_*' >/dev/null; then found=$((found + 1)); fi
  fi
  expect 0 '' mesh core/large.node --out-of-core core/tiles --tiles 8 --quiet -o core/many.vtu
  same core/one.vtu core/many.vtu
done
if [[ $found -eq 0 ]]; then fail "no run was killed between two tiles"; fi

echo "== mesh --out-of-core: what it does not do"
expect 2 "requires --out-of-core" mesh core/plane.node --tiles 3
expect 2 "requires --out-of-core" mesh core/plane.node --threads 3
expect 2 "above 0" mesh core/plane.node --out-of-core core/tiles --tiles 0
expect 2 "must be at most 256" mesh core/plane.node --out-of-core core/tiles --threads 257
expect 2 "the algorithm is gap-balls" mesh core/plane.node --out-of-core core/tiles --algorithm svr
expect 2 "no limits of size" mesh core/plane.node --out-of-core core/tiles --max-area .1
printf '3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n1 0\n1 1 2\n0\n' >core/line.poly
expect 3 "points alone" mesh core/line.poly --out-of-core core/tiles
: >core/file
expect 2 "cannot_write" mesh core/plane.node --out-of-core core/file
killed_after .15
if [[ -e core/tiles/job ]]; then
  expect 2 "tiles of another input" mesh core/plane.node --out-of-core core/tiles
fi
rm -rf core
