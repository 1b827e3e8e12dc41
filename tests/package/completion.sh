#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# completion.sh PROGRAM SOURCE: what the shell offers after a part of a command. Each row: words, the last of them
# being typed, a bar, and what must be offered; a bang before what must not.
set -uo pipefail
. /usr/share/bash-completion/bash_completion
. "$2/source/package/completion.bash"
compopt() { :; } # there is no line being edited
cd "$2"
failures=0

check() # offers words...
{
  local offers=$1 offer
  shift
  COMP_LINE="$*" COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  COMP_POINT=${#COMP_LINE}
  _hpvi "$program" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
  local IFS='|'
  for offer in $offers; do
    # No pipe: grep -q ends at the first match, and a writer that it leaves behind would count as failed.
    if grep -qxF -- "${offer#!}" < <(printf '%s\n' ${COMPREPLY[@]+"${COMPREPLY[@]}"}); then
      [[ $offer == !* ]] || continue
    else
      [[ $offer == !* ]] && continue
    fi
    printf '%s: wrong about %s; offered: %s\n' "$COMP_LINE" "$offer" "${COMPREPLY[*]-}" >&2
    failures=$((failures + 1))
  done
}

program=$1
check '--set|!--output' hpvi --s
check '--set|--validate|--print-parameters|--help' hpvi --
check 'Solver/Linear=|!Output/VTU=' hpvi --set Sol
check 'Solver/Linear=multigrid|Solver/Linear=amg|!Solver/Linear=or' hpvi --set Solver/Linear=
check 'Material/Young\'"'"'s\ modulus=' hpvi --set material/yo
check 'Boundary\ bottom/Friction\ bound=' hpvi prm/slab.prm --set 'Boundary\ bo'
check 'Boundary bottom/Friction bound=' hpvi prm/slab.prm --set '"Boundary bo'
check 'Adaptivity/Method=hap4|!Adaptivity/Method=hpa3' hpvi prm/slab.prm --set '"Adaptivity/Method='
check '!Material/Density=a' hpvi --set Material/Density=
check 'prm/slab.prm|!prm/meshes/foot.msh' hpvi prm/sl
check 'doc|!README.md' hpvi --output do
exit $((failures > 0))
