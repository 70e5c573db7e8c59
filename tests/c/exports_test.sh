#!/usr/bin/env bash
# The library exports what its header declares, and nothing else.
#   exports_test.sh NM LIBRARY HEADER
set -euo pipefail
exported=$("$1" -D --defined-only "$2" | awk '$2 == "T" {print $3}' | sed 's/@.*//' | sort)
declared=$(grep -o 'LM_API [^;(]*(' "$3" | grep -o 'lm_[a-z_]*(' | tr -d '(' | sort -u)
diff <(echo "$declared") <(echo "$exported")
others=$("$1" -D --defined-only "$2" | awk '$2 != "T" && $3 !~ /^LIVEMESH_/ {print $3}')
[[ -z $others ]] || { echo "also exported: $others" >&2; exit 1; }
