# shellcheck shell=bash disable=SC2154
# The tool's part on several threads; tool_test.sh sources it.

rm -rf threads
mkdir threads

echo "== edit --threads: the bytes of one thread, also when lines come"
cat >threads/edits.txt <<'EDITS'
move 3 .5 .25
begin
-point 7
+point 1001 .25 .5
+point 1002 .75 .5
commit
-point 1001
EDITS
cat >threads/lines.txt <<'EDITS'
+point 1001 .25 .5
+segment 1 1001 5
move 9 .125 .5
limit size .2 in .25 .25 .5 .5
EDITS
cat >threads/limits.txt <<'EDITS'
limit size .02 in .25 .25 .75 .5
move 3 .5 .25
limit size .05
EDITS
expect 0 '' gen uniform --n 500 --seed 4 -o threads/points.node
for script in edits lines limits; do
  for threads in '' 1 2 5; do
    expect 0 '' edit threads/points.node --domain 0 0 1 1 --script threads/$script.txt --quiet \
      ${threads:+--threads $threads} -o threads/after$threads.node -o threads/after$threads.vtu \
      --stats threads/figures$threads.json
    same threads/after.node threads/after$threads.node
    same threads/after.ele threads/after$threads.ele
    same threads/after.vtu threads/after$threads.vtu
  done
done
for threads in 1 3; do
  expect 0 '' edit threads/points.node --domain 0 0 1 1 --max-area .0005 --quiet --threads $threads \
    --script threads/lines.txt -o threads/limited$threads.node
done
same threads/limited1.node threads/limited3.node
same threads/limited1.ele threads/limited3.ele
printf 'move 3 .5 .25 .5\n-point 7\n+point 1001 .25 .5 .75\n' >threads/space.txt
expect 0 '' gen uniform --n 60 --seed 4 --dimension 3 -o threads/space.node
for threads in 1 3; do
  expect 0 '' edit threads/space.node --domain 0 0 0 1 1 1 --min-dihedral 10 --quiet \
    --threads $threads --script threads/space.txt -o threads/space$threads.node
done
same threads/space1.node threads/space3.node
same threads/space1.ele threads/space3.ele
expect 2 "above 0" edit threads/points.node --script threads/edits.txt --threads 0
expect 2 "must be at most 256" edit threads/points.node --script threads/edits.txt --threads 257
expect 2 "exclude each other" edit threads/points.node --script threads/edits.txt --threads 2 --static
