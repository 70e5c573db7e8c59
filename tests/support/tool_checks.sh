#!/usr/bin/env bash
# Checks of command line tools, to be sourced. They count in `checks` and `failures`, and expect a
# folder out/ below the current one that is empty.
checks=0
failures=0

fail() {
  failures=$((failures + 1))
  echo "FAILED: $*" >&2
}

# expect_of TOOL CODE TEXT ARGUMENT...: exit code, and TEXT in what it says (both streams).
expect_of() {
  local tool=$1 code=$2 text=$3 said status
  shift 3
  checks=$((checks + 1))
  said=$("$tool" "$@" 2>&1)
  status=$?
  ((status == code)) || fail "$* exits with $status, expected $code: $said"
  [[ $said == *"$text"* ]] || fail "$*: no '$text' in: $said"
}

# refuse_of TOOL CODE TEXT ARGUMENT...: the same, and the folder out/ stays empty.
refuse_of() {
  expect_of "$@"
  [[ -z $(ls -A out) ]] || fail "${*:4}: left behind: $(ls -A out)"
  rm -rf out
  mkdir out
}

same() {
  checks=$((checks + 1))
  cmp -- "$1" "$2" || fail "$1 and $2 differ"
}

# has FILE PATTERN: a line of the file matches the extended regular expression.
has() {
  checks=$((checks + 1))
  grep -Eq -- "$2" "$1" || fail "$1 has no $2: $(head -c 300 "$1")"
}

# The last line of a test.
report_checks() {
  echo "$checks checks, $failures failures"
  ((failures == 0))
}

# by_gap_balls TOOL FOLDER: a program in FOLDER that is TOOL, but whose `mesh` makes the mesh that
# `edit` keeps unless it is told an algorithm.
by_gap_balls() {
  cat >"$2/mesher" <<END
#!/usr/bin/env bash
words=" \$* "
if [[ \${1:-} == mesh && \$words != *" --algorithm "* && \$words != *" --help "* ]]; then
  shift
  exec "$1" mesh --algorithm gap-balls "\$@"
fi
exec "$1" "\$@"
END
  chmod +x "$2/mesher"
  echo "$2/mesher"
}
