#!/usr/bin/env bash
# The judge in space itself: a good mesh passes, and each way of being bad is named.
#   cgal_check3d_test.sh CGAL_CHECK3D
source "$(dirname "${BASH_SOURCE[0]}")/expect.sh"

# A cube around its centre: two tetrahedra on each side, whose four corners are on a circle. So each
# side has the diagonal that its greatest corner is not on.
cat >good.node <<'END'
9 3 0 0
1 0 0 0
2 1 0 0
3 0 1 0
4 1 1 0
5 0 0 1
6 1 0 1
7 0 1 1
8 1 1 1
9 0.5 0.5 0.5  # the centre
END
cat >good.ele <<'END'
12 4 0
1 9 1 3 2
2 9 2 3 4
3 9 5 6 7
4 9 6 8 7
5 9 1 2 5
6 9 2 6 5
7 9 3 7 4
8 9 4 7 8
9 9 1 5 3
10 9 3 5 7
11 9 2 4 6
12 9 4 8 6
END
expect 0 '^ok good.node: 9 vertices, 12 tetrahedra' good.node good.ele
# Each has the sphere of three corners of a side and the centre: radius 3/4, shortest edge sqrt(3)/2.
expect 0 '^ok' good.node good.ele --rho 0.8660254037844387
expect 1 'radius-edge: tetrahedron' good.node good.ele --rho 0.8660254037844385

sed 's/^1 9 \(.\) \(.\)/1 9 \2 \1/' good.ele >inside_out.ele
expect 1 'orientation: tetrahedron' good.node inside_out.ele
# The other diagonal of the bottom is as good but for ties.
sed 's/^1 9 .*/1 9 1 4 2/; s/^2 9 .*/2 9 1 3 4/' good.ele >tie.ele
expect 1 'delaunay: vertex' good.node tie.ele
sed 's/^12 4 0/11 4 0/; /^12 *9/d' good.ele >hole.ele
expect 1 'face: .* has only one side' good.node hole.ele
expect 1 'volume' good.node hole.ele
sed 's/^12 4 0/13 4 0/' good.ele >twice.ele
tail -1 good.ele >>twice.ele
expect 1 'face: .* twice on one side' good.node twice.ele

# A vertex in one tetrahedron, and in the sphere of the next.
sed 's/^9 3 0 0/10 3 0 0/' good.node >inner.node
echo '10 0.35 0.35 0.2' >>inner.node
sed 's/^12 4 0/15 4 0/; s/^1 9 .*/1 10 1 3 2/' good.ele >inner.ele
printf '13 9 10 3 2\n14 9 1 10 2\n15 9 1 3 10\n' >>inner.ele
expect 1 'delaunay: vertex 10' inner.node inner.ele
cat >two.node <<'END'
10 3 0 0
END
tail -9 good.node >>two.node
echo '10 0.5 0.5 0.5' >>two.node
expect 1 'coincident: vertex' two.node good.ele
expect 1 'unused: vertex 10' two.node good.ele
printf '1 3 0 0\n1 0.5 0.5 0.25\n' >other.node
printf '1 3 0 0\n1 1 1 1\n' >corner.node
expect 1 'input: point 1 is no vertex' good.node good.ele --input other.node
expect 0 '^ok' good.node good.ele --input corner.node

# A complex: the bottom, the diagonal that the mesh has of it declared, and a segment to the centre.
cat >good.poly <<'END'
9 3 0 0
1 0 0 0
2 1 0 0
3 0 1 0
4 1 1 0
5 0 0 1
6 1 0 1
7 0 1 1
8 1 1 1
9 0.5 0.5 0.5
2 0
2 0
4 1 2 4 3
2 2 3
1 0
2 1 9
0
0
END
printf '3 1\n1 1 3 2 5 1\n2 2 3 4 5 1\n3 5 6 7 1\n' >good.face
expect 0 '^ok' good.node good.ele --complex good.poly
sed 's/^2 2 3 4 5 1/2 2 3 4 5/' good.face >holed.face
cp good.node holed.node
expect 1 'polygon: 1 has an edge that is no chain' holed.node good.ele --complex good.poly
sed 's/^2 2 3$/2 1 4/' good.poly >other.poly
expect 1 'polygon: 1 has an edge that is no chain' good.node good.ele --complex other.poly
sed 's/^2 1 9$/2 1 7/' good.poly >other.poly
expect 1 'segment: 2 is no chain of edges' good.node good.ele --complex other.poly
printf '3 1\n1 1 3 2 5 1\n2 2 3 4 5 1\n3 1 2 3 5 1\n' >over.face
cp good.node over.node
expect 1 'polygon: 1 has faces that overlap' over.node good.ele --complex good.poly
printf '3 1\n1 1 3 2 5 1\n2 2 3 4 5 1\n3 1 2 5 5 1\n' >bent.face
cp good.node bent.node
expect 1 'polygon: 1 has a face off its plane' bent.node good.ele --complex good.poly
printf '2 1\n1 1 3 4 5 1\n2 1 2 4 5 1\n' >lost.face
cp good.node lost.node
expect 1 'polygon: 1 has a face of no tetrahedron' lost.node good.ele --complex good.poly
printf '2 1\n1 1 3 2 5 3\n2 2 3 4 5 3\n' >named.face
cp good.node named.node
expect 1 'polygon: 1 has no faces' named.node good.ele --complex good.poly
expect 1 'polygon: 3 is not in the complex' named.node good.ele --complex good.poly
expect 2 'cannot open' good.node good.ele --complex none.poly

expect 2 'usage' good.node
expect 2 'cannot open' none.node good.ele
printf '1 2 0 0\n1 0 0\n' >plane.node
expect 2 'not in space' plane.node good.ele

# Batch: every line is judged, the first bad one does not end it.
printf 'good.node good.ele\n\ngood.node hole.ele # bad\ngood.node good.ele --rho 1\n' >list
expect 1 '^3 meshes judged, 1 failed' --batch list

finish
