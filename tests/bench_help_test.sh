#!/usr/bin/env bash
# Every benchmark takes --help for a question, not for a file: it is the first that main() looks at,
# and the text, the first comment, tells how the benchmark is called. (They are no part of a test
# build, so their sources are looked at.)
#
#   bench_help_test.sh REPOSITORY
set -u
cd "$1" || exit 1
failed=0
for file in */bench/*.cpp; do
  name=$(basename "$file" .cpp)
  grep -A1 '^int main(int argc, char\*\* argv) {$' "$file" |
    grep -q '^  if (bench::shows_help(argc, argv)) return 0;$' ||
    { echo "$file: main() does not begin with bench::shows_help" >&2; failed=1; }
  head -1 "$file" | grep -q '^// ' ||
    { echo "$file: no comment at the beginning" >&2; failed=1; }
done
exit "$failed"
