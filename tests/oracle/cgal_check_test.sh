#!/usr/bin/env bash
# The judge itself: a good mesh passes, and each way of being bad is named.
#   cgal_check_test.sh CGAL_CHECK
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

# A unit square around its centre, 0-based with comments; two points lie inside the north triangle.
cat >good.node <<'END'
# a comment
7 2 1 1
0 0 0   0 1
1 1 0   0 1
2 1 1   0 1
3 0 1   0 1
4 0.5 0.5  1 0  # the centre
5 0.5 0.75 0 0
6 0.5 1    0 1
END
cat >good.ele <<'END'
7 3 0
1 0 1 4
2 1 2 4
3 3 0 4
4 4 2 5
5 4 5 3
6 5 2 6
7 5 6 3
END
printf '1 2 0 0\n9 5e-1 0.5\n' >inside.node
printf '1 2 0 0\n9 0.5 0.50000000000000011\n' >outside.node

expect 0 '^ok good.node: 7 vertices, 7 triangles' good.node good.ele
expect 0 '^ok' good.node good.ele --input inside.node --rho 2
expect 1 'input: input point 9' good.node good.ele --input outside.node

# Triangle 4 has sides 0.25, sqrt(5)/4, sqrt(2)/2: squared radius-edge ratio 2.5, exactly.
expect 0 '^ok' good.node good.ele --rho 1.5811388300841898
expect 1 'radius-edge: triangle 4' good.node good.ele --rho 1.5811388300841895

sed 's/^1 0 1 4/1 1 0 4/' good.ele >flipped.ele
expect 1 'orientation: triangle 1' good.node flipped.ele
sed 's/^7 /6 /; /^7 5 6 3/d' good.ele >hole.ele
expect 1 'edge: .* has only one side' good.node hole.ele
expect 1 'area' good.node hole.ele
sed 's/^7 3/8 3/; $a 8 0 1 4' good.ele >twice.ele
expect 1 'twice on one side' good.node twice.ele
sed 's/^7 2/8 2/; $a 7 0.5 0.75' good.node >coincident.node
expect 1 'coincident: vertex 7' coincident.node good.ele
expect 1 'unused: vertex 7' coincident.node good.ele

# The edge of the centre and the north-east corner flipped.
sed 's/^2 1 2 4/2 1 2 5/; s/^4 4 2 5/4 1 5 4/' good.ele >flip.ele
expect 1 'delaunay: vertex' good.node flip.ele

# Two rectangles side by side: both diagonals are Delaunay. Their common corner moved east by one
# unit in the last place: one diagonal each.
printf '6 2 0 0\n1 0 0\n2 0.5 0\n3 1 0\n4 1 1\n5 0.5 1\n6 0 1\n' >square.node
sed 's/^5 0.5/5 0.50000000000000011/' square.node >moved.node
printf '4 3 0\n1 1 2 5\n2 1 5 6\n3 2 3 5\n4 3 4 5\n' >square.ele
printf '4 3 0\n1 1 2 6\n2 2 5 6\n3 2 3 5\n4 3 4 5\n' >moved.ele
expect 0 '^ok' square.node square.ele

# All corners of its triangles are on the box: they count, too. Squared radius-edge ratio 1.25.
expect 0 '^ok' square.node square.ele --rho 1.12
expect 1 'radius-edge: triangle 1' square.node square.ele --rho 1.11

expect 0 '^ok' square.node moved.ele
expect 0 '^ok' moved.node moved.ele
expect 1 'delaunay: vertex' moved.node square.ele

# Batch: every line is judged, the first bad one does not end it.
printf 'good.node good.ele --rho 2\n\ngood.node flipped.ele # bad\nsquare.node square.ele\n' >list
expect 1 '^3 meshes judged, 1 failed' --batch list
expect 1 '^ok square.node' --batch list
expect 2 'a batch of no meshes' --batch /dev/null

expect 2 'usage' good.node
expect 2 'cannot open' none.node good.ele
sed 's/0.75/0,75/' good.node >comma.node
expect 2 'comma.node:8: not a number: 0,75' comma.node good.ele
sed '$d' good.ele >short.ele
expect 2 'ends too early' good.node short.ele

finish
