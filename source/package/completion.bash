# SPDX-License-Identifier: LGPL-2.1-or-later
# Completes the options of hpvi, and after --set the entries of the scene and their values. The program is asked for
# all of them: what it learns is known here as well.

_hpvi_entries() # "Section/Entry=" of each, one a line; scenes have sections of their own
{
  "$1" --print-parameters ${2:+"$2"} 2>/dev/null | sed -n '
    s/^subsection //; t section
    /^ *set /{ s/^ *set \([^=]*[^ =]\) *=.*/\1/; G; s/\(.*\)\n\(.\{1,\}\)/\2\/\1/; s/\n//; s/$/=/; p }
    /^end/{ s/.*//; h }
    b
    : section
    h'
}

_hpvi_values() # words that an entry accepts, where these are all that it does
{
  "$1" --validate --set "$2=?" "${3:-/dev/null}" 2>&1 >/dev/null |
    sed -n 's/.*: is not accepted here; give //p' | grep -E '^([^ ,]+, )*[^ ,]+( or [^ ,]+)?$' | sed 's/, \| or /\n/g'
}

_hpvi()
{
  local cur prev words cword
  _init_completion -n = || return
  local word scene= candidates
  for word in "${words[@]:1}"; do
    [[ $word == *.prm ]] && scene=$(dequote "$word" 2>/dev/null) && [[ -r $scene ]] || scene=
    [[ $scene ]] && break
  done
  case $prev in
    --import)
      _filedir inp
      return
      ;;
    --output | --resume | --report)
      _filedir -d
      return
      ;;
    --set | --sweep)
      local typed=${cur#[\"\']} quote=
      [[ $typed != "$cur" ]] && quote=${cur:0:1}
      [[ $quote ]] || typed=$(dequote "$cur" 2>/dev/null)
      if [[ $typed == *=* ]]; then
        candidates=$(_hpvi_values "$1" "${typed%%=*}" "$scene" | sed "s|^|${typed%%=*}=|")
      else
        candidates=$(_hpvi_entries "$1" "$scene")
        compopt -o nospace
      fi
      local IFS=$'\n'
      COMPREPLY=()
      for word in $candidates; do
        [[ ${word,,} == "${typed,,}"* ]] || continue
        [[ $quote ]] && COMPREPLY+=("$word") || COMPREPLY+=("$(printf %q "$word")")
      done
      return
      ;;
  esac
  if [[ $cur == -* ]]; then
    COMPREPLY=($(compgen -W "$("$1" --help | sed -n 's/^  \(-[a-z] \[ \)\{0,1\}\(--[a-z-]*\).*/\2/p')" -- "$cur"))
  else
    _filedir prm
  fi
} && complete -F _hpvi hpvi
