#!/usr/bin/env bash
# The tool `traces` end to end, on traces of the tool `mesher`: what it says, how it exits, what it
# leaves behind.
#
#   tool_test.sh TRACES_TOOL MESHER_TOOL
set -u
traces=$(realpath "$1")
mesher=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
# shellcheck source=../support/tool_checks.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/tool_checks.sh"
cd "$scratch" || exit 1

expect() { expect_of "$traces" "$@"; }
refuse() { refuse_of "$traces" "$@"; }

# value NAME [FUNCTION]: a field of distance.json, in all or of a function.
value() {
  local object rest
  object=$(cat distance.json)
  rest=${object#*${2:+\"$2\":\{}}
  [[ $rest =~ \"$1\":([0-9]+) ]] && echo "${BASH_REMATCH[1]}"
}

# holds CONDITION: arithmetic.
holds() {
  checks=$((checks + 1))
  (($1)) || fail "not $1 in: $(cat distance.json)"
}

mkdir out
domain=(--domain 0 0 1 1)

echo "== mesher trace"
"$mesher" gen uniform --n 300 --seed 3 -o points.node >/dev/null || exit 1
cat >edits.txt <<'END'
+point 1000 0.5 0.5000001
-point 3
begin
move 4 0.25 0.75
move 5 .9 .1
commit
END
awk 'NR == 1 { print "300 2 0 0"; next }
  $1 == 3 { next }
  $1 == 4 { print "4 0.25 0.75"; next }
  $1 == 5 { print "5 .9 .1"; next }
  { print }
  END { print "1000 0.5 0.5000001" }' points.node >edited.node
expect_of "$mesher" 0 'before.trace: ' trace points.node "${domain[@]}" -o before.trace
expect_of "$mesher" 0 ' calls' trace points.node "${domain[@]}" --script edits.txt -o after.trace
expect_of "$mesher" 0 '' trace edited.node "${domain[@]}" -o fresh.trace
expect_of "$mesher" 0 '' trace points.node "${domain[@]}" --quiet -o again.trace
same before.trace again.trace
same after.trace fresh.trace
[[ -z $("$mesher" trace points.node --quiet -o out/x.trace 2>&1) ]] || fail "--quiet is not quiet"
rm out/x.trace
for options in '--rho 2' '--rule voronoi-aspect'; do
  # shellcheck disable=SC2086
  expect_of "$mesher" 0 '' trace points.node "${domain[@]}" $options -o other.trace
  "$traces" distance before.trace other.trace --json >distance.json
  holds "$(value distance) > 0 && $(value unnamed_a) == 0 && $(value unnamed_b) == 0"
done
expect_of "$mesher" 0 '' trace points.node "${domain[@]}" --edges -o edges.trace
expect_of "$mesher" 0 'Examples:' trace --help
# Limits of size, given and edited, leave the trace of a run from scratch.
printf 'limit area 0.001\nlimit area 0.002 in 0 0 .5 1\n+point 901 .25 .3\nlimit none\n' >limits.txt
printf 'limit area 0.0015\n-point 901\n' >>limits.txt
expect_of "$mesher" 0 '' trace points.node "${domain[@]}" --max-area 0.0015 -o limited.trace
expect_of "$mesher" 0 '' trace points.node "${domain[@]}" --script limits.txt -o edited.trace
"$traces" distance limited.trace edited.trace --json >distance.json
holds "$(value distance) == 0 && $(value common) > 1000"
"$traces" distance before.trace limited.trace --json >distance.json
holds "$(value distance) > 1000"
expect 0 'fill' show limited.trace
[[ -z $("$traces" audit limited.trace edited.trace 2>&1) ]] || fail "audit of limits is not silent"
refuse_of "$mesher" 2 'error[bad_option]' trace points.node
refuse_of "$mesher" 2 'error[cannot_read]' trace none.node -o out/x.trace
refuse_of "$mesher" 2 'error[cannot_write]' trace points.node -o none/x.trace
refuse_of "$mesher" 2 './points.node: error[bad_option]' trace points.node -o ./points.node
refuse_of "$mesher" 2 'edits.txt: error[bad_option]' trace points.node --script edits.txt \
  -o edits.txt
refuse_of "$mesher" 1 '--domain' trace points.node --domain 0 0 .5 .5 -o out/x.trace
printf -- '-point 999\n' >bad.txt
refuse_of "$mesher" 3 'bad.txt:1:1: error[unknown_id]' trace points.node --script bad.txt \
  -o out/x.trace

echo "== example"
for example in array-map list-map list-filter list-reverse list-sum list-minimum quicksort \
  mergesort quicksort-by-elements mergesort-by-elements quickhull diameter distance expression-tree tree-contraction breadth-first-search \
  connected-components spell-check string-hash spreadsheet; do
  expect 0 'ex4.trace: ' example $example --n 40 --edits 4 -o ex4.trace
  expect 0 'the last edit: ' example $example --n 40 --edits 5 -o ex5.trace
  [[ -z $("$traces" audit ex4.trace ex5.trace 2>&1) ]] || fail "audit of $example is not silent"
  "$traces" distance ex4.trace ex5.trace --json >distance.json
  holds "$(value unnamed_a) == 0 && $(value common) > 0"
done
expect 0 ' calls' example quicksort --edges --n 40 -o out/none.trace
expect 0 '  weighs ' show out/none.trace
expect 0 ' calls' example quicksort --edges --n 0 -o out/none.trace
expect 0 'all ' stability --example quicksort --n 40 --edits 5
rm out/none.trace
refuse 2 'there are array-map, ' example bubblesort -o out/x.trace
refuse 2 'there are array-map, ' stability --example bubblesort
refuse 2 'error[bad_option]' example quicksort
refuse 3 'none/x.trace' example quicksort -o none/x.trace

echo "== help and usage"
expect 0 'Examples:' --help
for command in show distance audit render; do
  expect 0 'A trace file' "$command" --help
  refuse 2 'error[bad_option]' "$command"
done
refuse 2 'error[bad_option]'
refuse 2 'error[bad_option]' paint before.trace
refuse 2 'error[bad_option]' show before.trace --limit -1
refuse 2 'error[bad_option]' distance before.trace

echo "== show"
expect 0 '0 refine()' show before.trace --limit 1
expect 0 '1 drain(segments)' show before.trace --limit 2
expect 0 'complete((' show before.trace
[[ $("$traces" show before.trace --limit 7 | wc -l) == 7 ]] || fail "--limit 7 is not 7 lines"

expect 0 '  nearest (' show edges.trace
expect 0 '  neighbours (' show edges.trace
expect 0 '  crowded to level ' show edges.trace --limit 10
! "$traces" show before.trace | grep -q '^ ' || fail "edges that were not asked for"

echo "== distance"
"$traces" distance before.trace after.trace --json >distance.json
holds "$(value distance) == $(value calls_a) + $(value calls_b) - 2 * $(value common)"
holds "0 < $(value distance) && 4 * $(value distance) < $(value calls_a)"
holds "$(value unnamed_a) == 0 && $(value unnamed_b) == 0"
for field in distance common calls_a calls_b; do  # all first, then functions, which add up to it
  sum=$(grep -o "\"$field\":[0-9]*" distance.json | cut -d: -f2 | paste -sd+)
  holds "2 * $(value $field) == $sum"
done
holds "$(value distance locate) >= 6"  # 1 more, 1 less, 2 moved; others are crowded otherwise
for pair in 'after.trace fresh.trace' 'before.trace edges.trace'; do
  # shellcheck disable=SC2086
  "$traces" distance $pair --json >distance.json
  holds "$(value distance) == 0 && $(value common) == $(value calls_a) && $(value common) > 1000"
done
expect 0 ' locate' distance before.trace after.trace
expect 0 'calls_b   distance          a          b   heaviest   function' \
  distance before.trace after.trace
# Not recorded by `mesher trace`: each call weighs 1.
"$traces" distance before.trace after.trace --json >distance.json
holds "$(value weight_distance) == $(value distance) && $(value heaviest) == 1"
"$traces" distance ex4.trace ex5.trace --json >distance.json
holds "$(value weight_distance) > 0 && $(value weight_a) > 0 && $(value weight_b) > 0"

echo "== audit"
expect 0 '' audit before.trace
expect 0 '' audit before.trace after.trace
[[ -z $("$traces" audit before.trace after.trace 2>&1) ]] || fail "audit is not silent"

echo "== render"
expect 0 '' render before.trace -o before.svg
expect 0 '' render before.trace after.trace -o both.svg --width 800 --rows 5
grep -q '>refine()<' before.svg || fail "before.svg does not name the calls"
grep -q 'Only in after.trace' both.svg || fail "both.svg does not show the blame region"
refuse 2 'error[bad_option]' render before.trace
refuse 2 'error[bad_option]' render before.trace -o before.trace
refuse 2 'error[bad_option]' render before.trace -o out/x.svg --width 10
refuse 3 'error[cannot_write]' render before.trace -o none/x.svg

echo "== stability"
expect 0 'ratio' stability --n 50 --edits 5
expect 0 'ratio' stability --n 50 --n 60 --edits 5 --kind grid --rule voronoi-aspect --trust
"$traces" stability --n 50 --edits 6 --json >rows.jsonl
[[ $(wc -l <rows.jsonl) == 6 ]] || fail "rows.jsonl has not 6 lines"
checks=$((checks + 1))
row='^\{"n":[0-9]+,"m":[0-9]+,"lg_L_s":[0-9.]+,"lg_L_d":[0-9.]+,"distance":[0-9]+,'
row+='"executed":[0-9]+,"created":[0-9]+,"discarded":[0-9]+,"work":[0-9]+,"ratio":[0-9.]+,'
row+='"weight_distance":[0-9]+,"weight_work":[0-9]+,"weight_ratio":[0-9.]+,"heaviest":[0-9]+,'
row+='"drift":0\}$'
[[ $(grep -Ec -- "$row" rows.jsonl) == 6 ]] || fail "rows.jsonl: $(head -1 rows.jsonl)"
for row in $(cat rows.jsonl); do  # a mesh's searches are weighed, and none is heavy in an update
  checks=$((checks + 2))
  [[ $row =~ \"distance\":([0-9]+).*\"weight_distance\":([0-9]+) ]]
  ((BASH_REMATCH[2] > 5 * BASH_REMATCH[1])) || fail "hardly any weights: $row"
  [[ $row =~ \"heaviest\":([0-9]+) ]]
  ((BASH_REMATCH[1] < 2000)) || fail "a heavy call: $row"
done
# Edits at every scale, beyond 2^-32 of the domain too.
"$traces" stability --n 20 --edits 60 --trust --json >deep.jsonl
checks=$((checks + 1))
grep -Eq '"lg_L_d":(3[3-9]|4[0-9])' deep.jsonl || fail "no edit is nearer than 2^-33 to a point"
# In space.
"$traces" stability --dimension 3 --n 30 --edits 4 --json >space.jsonl
checks=$((checks + 1))
grep -q '"drift":[^0]' space.jsonl && fail "space.jsonl drifts"
[[ $(wc -l <space.jsonl) == 4 ]] || fail "space.jsonl has not 4 lines"
refuse 2 'error[bad_option]' stability --dimension 4
refuse 2 'error[bad_option]' stability --n 1
refuse 2 'error[bad_option]' stability --kind circle
refuse 2 'error[bad_option]' stability --rho 1
refuse 2 'error[bad_option]' stability --edits -1

echo "== bad files"
refuse 3 'none.trace:byte 0: error[io]' show none.trace
refuse 3 'points.node:byte 1: error[not_a_trace]' audit points.node
head -c 1000 before.trace >cut.trace
for command in 'show cut.trace' 'distance before.trace cut.trace' 'audit cut.trace' \
  'render before.trace cut.trace -o out/x.svg'; do
  # shellcheck disable=SC2086
  refuse 3 'cut.trace:byte 1000: error[truncated]' $command
done
{ head -c 500 before.trace && printf 'x' && tail -c +502 before.trace; } >bent.trace
refuse 3 'bent.trace:byte ' distance before.trace bent.trace
{ printf '\x89traces\n\x7f' && tail -c +10 before.trace; } >future.trace
refuse 3 'error[version]: version 127' show future.trace

report_checks
