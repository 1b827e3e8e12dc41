#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# memory.sh HPVI SCENE.prm: with whatever memory it is granted, the program ends: done, or with exit
# status 2 and one line that says why. Exit status 77 (skipped) where limits cannot be tested: the
# address sanitizer maps more than there is.
set -uo pipefail
program=$1 scene=$2
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT
fail() { echo "$1"; cat "$directory/errors"; exit 1; }

# solve MEGABYTES ENTRY=VALUE...: one step within that address space; leaves $status
solve()
{
  local limit=$1 arguments=()
  shift
  for override in "$@"; do arguments+=(--set "$override"); done
  (ulimit -v "${limit}000" && exec timeout 60 "$program" --output "$directory/out" \
    --set "Adaptivity/Maximum steps=1" --set "Output/VTU=false" "${arguments[@]}" "$scene") \
    >"$directory/rows" 2>"$directory/errors"
  status=$?
}

# gives_up WORD...: the last run ended with one line that holds the words, and left nothing behind
gives_up()
{
  [ "$status" -eq 2 ] || fail "exit status $status instead of 2"
  [ "$(wc -l <"$directory/errors")" -eq 1 ] || fail "not exactly one line on stderr"
  for word in "$@"; do
    grep -qF -- "$word" "$directory/errors" || fail "stderr does not say: $word"
  done
}

(ulimit -v 4000000 && "$program" --version) >"$directory/rows" 2>"$directory/errors" || exit 77

# From where not even the libraries fit (127, the loader's) to where all of it does.
for threads in 1 4; do
  export OPENBLAS_NUM_THREADS=$threads
  gave_up=0
  for limit in $(seq 350 100 1050); do
    solve "$limit"
    case $status in
      0 | 127) ;;
      2) gives_up "of memory"; gave_up=$((gave_up + 1)) ;;
      *) fail "exit status $status within $limit MB" ;;
    esac
  done
  [ "$status" -eq 0 ] || fail "1 GB is not enough"
  [ "$gave_up" -gt 0 ] || fail "no limit was too small for the run"
done

solve 1000 "Geometry/Subdivisions=220, 220" "Adaptivity/Start degree=2"
gives_up "the factorisation of" "unknowns needs" "are left of the address space" "Maximum unknowns"
grep -q '"status": "failed"' "$directory/out/summary.json" || fail "summary.json does not say failed"
[ ! -e "$directory/out/convergence.csv" ] || fail "a step that failed left a row"

# 12000 multipliers: Y and S alone are larger than that.
solve 2000 "Geometry/Subdivisions=6000, 1"
gives_up "the dense algebra of 12000 multipliers needs 4.61 GB" "Geometry/Subdivisions"

# Scenes of a sweep come one after the other there, and leave what they mapped to the next one.
(ulimit -v 1000000 && exec timeout 60 "$program" --output "$directory/swept" --set "Adaptivity/Maximum steps=1" \
  --set "Output/VTU=false" --sweep "Material/Poisson's ratio=0.1, 0.2, 0.3, 0.4" "$scene") >"$directory/rows" 2>"$directory/errors" ||
  fail "1 GB is not enough for a sweep"
grep -q "4 scenes on 1 core, for ulimit" "$directory/rows" || fail "a sweep does not come one after the other"
