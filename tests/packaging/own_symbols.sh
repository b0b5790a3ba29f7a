#!/usr/bin/env bash
# own_symbols.sh PROGRAM...: of Eigen, which libgmsh has compiled with other flags, programs export nothing that would
# take the place of libgmsh's own.
set -euo pipefail
wrong=0
for program in "$@"; do
  nm -D "$program" > /dev/null  # fails if that is no program
  if exported=$(nm -DC --defined-only "$program" | grep 'Eigen::'); then
    echo "$program exports"
    echo "$exported" | cut -c1-200
    wrong=1
  fi
done
exit $wrong
