#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# gives_up.sh HPVI SCENE.prm: where the quadratic program does not converge, the run ends with exit
# status 2 and one line, keeps its finished steps, and passes nothing off as a result.
set -uo pipefail
program=$1 scene=$2
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT
fail() { echo "$1"; cat "$directory/errors"; exit 1; }

"$program" --output "$directory/out" --set "Solver/QP solver=mprgp" \
  --set "Solver/QP warm start=false" --set "Solver/QP maximum multiplications=20" "$scene" \
  >"$directory/rows" 2>"$directory/errors"
[ $? -eq 2 ] || fail "exit status is not 2"
[ "$(wc -l <"$directory/errors")" -eq 1 ] || fail "not exactly one line on stderr"
grep -q "has not converged after 2[0-9] products" "$directory/errors" || fail "the line does not say why"
grep -q '"status": "failed"' "$directory/out/summary.json" || fail "summary.json does not say failed"
finished=$(($(wc -l <"$directory/out/convergence.csv") - 1))
[ "$finished" -ge 1 ] || fail "the finished steps are gone"
[ ! -e "$directory/out/contact-0$((finished + 1)).csv" ] || fail "the failed step left a file"
! grep -q "results in" "$directory/rows" || fail "stdout claims results"
