# Graphs that are repaired before they are meshed; sourced by tool_test.sh.
# shellcheck shell=bash disable=SC2154

echo "== lines that cross, touch and overlap"
cat >crossing.poly <<'END'
7 2 0 1
1 0 0 0
2 4 4 0
3 0 4 0
4 4 0 0
5 2 2 9
6 4 4 0
7 1 1 0
4 1
1 1 2 5
2 3 4 6
3 7 5 0
4 6 3 0
0
END
refuse 1 '; --repair mends this' mesh crossing.poly -o out/x.vtu
refuse 1 '; --repair mends this' mesh crossing.poly --static -o out/x.vtu
expect 0 'crossing.poly:10:1: repair: line 1 is split at point 5 (2, 2)' repair crossing.poly
expect 0 '6 points, 6 segments; 6 repairs' repair crossing.poly -o fitting.poly -o fitting.obj
expect 0 'nothing was to be repaired' repair fitting.poly -o again.poly
same fitting.poly again.poly
expect 0 '' mesh fitting.poly --quiet -o fitting.1.node
expect 0 '' mesh crossing.poly --repair --quiet -o fitting.2.node
same fitting.1.ele fitting.2.ele
refuse 2 'error[unknown_format]: a repaired file is written to .poly and .obj' \
  repair crossing.poly -o out/x.vtu
refuse 2 'input' repair crossing.poly -o crossing.poly
said=$("$tool" trace crossing.poly -o out/x.trace 2>&1)
[[ $said == *crossing.poly:*'error['* && $said != *--repair* ]] || fail "trace has no --repair: $said"
for engine in '' --static; do
  # shellcheck disable=SC2086
  expect 0 'crossing.poly:7:1: repair: point 6 is point 2 at (4, 4)' \
    mesh crossing.poly --repair $engine -o "crossing$engine.1.node" -o "crossing$engine.vtu"
done
expect 0 'crossing.poly:10:1: repair: line 1 is split at point 5 (2, 2)' \
  mesh crossing.poly --repair -o x.vtu
expect 0 'crossing.poly:12:1: repair: line 3 leaves to line 1 what both cover, from (1, 1) on' \
  mesh crossing.poly --repair -o x.vtu
expect 0 'line 3 is dropped: nothing is left of it' mesh crossing.poly --repair -o x.vtu
same crossing.1.node crossing--static.1.node
same crossing.1.edge crossing--static.1.edge
same crossing.vtu crossing--static.vtu
has crossing.1.edge '^[0-9]+ [0-9]+ [0-9]+ 5 1$'
has crossing.1.edge '^[0-9]+ [0-9]+ [0-9]+ 6 2$'
has crossing.1.edge '^[0-9]+ [0-9]+ [0-9]+ [01] 4$'
expect 0 'lines       ok' check crossing.1.node --rho 1.4142
refuse 1 'error[outside_domain]' mesh crossing.poly --repair --domain 0 0 3 3 -o out/x.vtu
printf -- '-segment 1\n' >edits.txt
expect 0 'repair: line 1 is split' edit crossing.poly --repair --script edits.txt -o x.1.node
printf '4 2 0 0\n1 0 0\n2 1 0\n3 0.5 1e-16\n4 0.5 1\n1 0\n1 1 2\n0\n' >near.poly
refuse 1 'error[too_close]' mesh near.poly -o out/x.vtu
refuse 1 '; --repair may mend this' mesh near.poly -o out/x.vtu
expect 0 'repair: line 1 is split at point 3' mesh near.poly --repair -o x.vtu
# Edits are not repaired, nor is what is repaired a second time.
printf '4 2 0 0\n1 0 0\n2 4 4\n3 0 4\n4 4 0\n1 0\n1 1 2\n0\n' >sound.poly
printf -- '+segment 2 3 4\n' >edits.txt
for options in '' --repair --static; do
  # shellcheck disable=SC2086
  said=$("$tool" edit sound.poly $options --script edits.txt -o out/x.vtu 2>&1)
  [[ $said == *'error[crossing_segments]'* && $said != *--repair* ]] || fail "repairs edits: $said"
done

echo "== small angles are reported"
cat >sharp.poly <<'END'
3 2 0 0
1 0 0
2 8 0
3 8 0.1
2 0
1 1 2
2 1 3
0
END
expect 0 '1 angles under 60 degrees, the smallest 0.7162 at (0, 0), of lines 1 and 2' \
  mesh sharp.poly --box -o x.vtu
expect 0 'all angles of others are at least 20.71' mesh sharp.poly --box -o x.vtu
