# Sourced by the tests of the judges, CHECK: works in a new folder, which goes at the end.
set -euo pipefail
check=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failures=0

# expect CODE PATTERN ARGUMENTS...: the exit code, and a line of the output.
expect() {
  local code=$1 pattern=$2 output actual=0
  shift 2
  output=$("$check" "$@" 2>&1) || actual=$?
  if [[ $actual != "$code" ]] || ! grep -q -- "$pattern" <<<"$output"; then
    echo "${check##*/} $*: exit $actual, expected $code and '$pattern'; it said:"
    echo "$output"
    failures=$((failures + 1))
  fi
}

# Ends the test.
finish() {
  ((failures == 0)) && echo "all as expected"
}
