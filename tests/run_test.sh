#!/usr/bin/env bash
# The script ./run where packages are missing and another apt holds the locks: it waits for that, and
# fails for nothing else than a reason.
#
#   run_test.sh RUN
set -u
run=$(realpath "$1")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
fail() {
  echo "run_test: $*" >&2
  failed=1
}

# A program of that name, with this body, before all others.
mkdir "$scratch/bin"
program() {
  printf '#!/bin/sh\n%s\n' "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}
program dpkg-query 'exit 1'
program sudo '"$@"'
program cmake 'exit 0'
program ctest 'exit 0'
program ninja 'exit 0'

# run_with TIMES MESSAGE [COMMAND]: apt-get fails so often with the message, then succeeds.
run_with() {
  : >"$scratch/calls"
  program apt-get "echo \"\$*\" >>'$scratch/calls'
    if [ \$(wc -l <'$scratch/calls') -le $1 ]; then echo '$2' >&2; exit 100; fi"
  # A copy, so that no build folder is made.
  mkdir -p "$scratch/repo"
  cp "$run" "$scratch/repo/run"
  PATH="$scratch/bin:$PATH" bash "$scratch/repo/run" "${3:-build}" >"$scratch/out" 2>&1
}

run_with 0 '' || fail "does not install: $(cat "$scratch/out")"
grep -q 'DPkg::Lock::Timeout=.* install ' "$scratch/calls" || fail 'apt-get does not wait for dpkg'

run_with 2 'E: Could not get lock /var/lib/apt/lists/lock. It is held by process 7 (apt-get)' ||
  fail "does not wait for another apt: $(cat "$scratch/out")"
[[ $(grep -c ' update$' "$scratch/calls") == 3 ]] || fail 'does not try again'
[[ $(grep -c 'waiting for another apt' "$scratch/out") == 1 ]] || fail 'does not say that it waits'

run_with 9 'E: The repository has no Release file.' && fail 'goes on without packages'
[[ $(wc -l <"$scratch/calls") == 1 ]] || fail 'tries again what cannot succeed'
grep -q 'no Release file' "$scratch/out" || fail 'does not say why apt failed'

# What the tests of `soak` skip without.
run_with 0 '' soak || fail "soak does not install: $(cat "$scratch/out")"
for package in catch2 python3-sphinx doxygen debootstrap libdeal.ii-dev python3-dolfinx freefem++ \
  openfoam; do
  grep ' install ' "$scratch/calls" | grep -qFw -- "$package" || fail "soak does not install $package"
done

exit "$failed"
