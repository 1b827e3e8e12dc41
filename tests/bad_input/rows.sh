# SPDX-License-Identifier: LGPL-2.1-or-later
#
# What tables of bad input have in common, for run.sh, shapes.sh and bodies.sh; space.sh runs the program as they do. Every bad scene must end with exit status 1 and
# exactly one line on stderr that names file, entry, value and remedy, and must write nothing. Each call below is one row:
#
#   invalid WORD... -- ENTRY=VALUE...   the table's own scene, $base, with these entries overridden
#   broken FILE WORD...                 a file that is bad by itself
#   refused WORD... -- ARGUMENT...      any other command line
#
# Every WORD must occur in the line.

# Command line, status and line of each row go to the end of $HPVI_ROWS, where that is a file: tests/freeze.py compares them.
# With the library of tests/fuzz/server.cc rows take a tenth of the time: the program is forked where it has loaded its own.

if [ $# -lt 1 ] || [ $# -gt 3 ] || [ ! -x "$1" ]; then
  echo "usage: $0 HPVI [SERVER [MPIRUN]]" >&2
  exit 2
fi
hpvi=$(realpath "$1")
if [ -n "${2:-}" ]; then
  library=$(realpath "$2")
  coproc server { OMP_NUM_THREADS=1 LD_PRELOAD=$library exec "$hpvi"; }
fi
scenes=$(realpath "$(dirname "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/empty"
cd "$scratch/empty" || exit 2
rows=0
failures=0

complain() { # ROW PROBLEM
  echo "FAILED: $1: $2" >&2
  sed 's/^/  stderr: /' "$scratch/stderr" >&2
  failures=$((failures + 1))
}

# Its status, with what it says in $scratch.
run_hpvi() {
  if [ -z "${library:-}" ]; then
    timeout 60 "$hpvi" "$@" >"$scratch/stdout" 2>"$scratch/stderr"
    return
  fi
  local status
  printf '%s\0' $(($# + 6)) "$PWD" "$scratch/stdout" "$scratch/stderr" 8000 60 hpvi "$@" >&"${server[1]}"
  read -r _ _ <&"${server[0]}" # its process
  read -r _ status _ <&"${server[0]}" || return 126
  return $((status & 127 ? 128 + (status & 127) : status >> 8))
}

# Run hpvi with the arguments; $1 is an array's name that holds the words to look for.
check() {
  local -n expected=$1
  shift
  local status word row="hpvi $*"
  rows=$((rows + 1))
  run_hpvi "$@"
  status=$?
  [ -z "${HPVI_ROWS:-}" ] || { echo "$row -> $status" && cat "$scratch/stderr"; } >>"$HPVI_ROWS"
  [ $status -eq 1 ] || complain "$row" "exit status $status instead of 1"
  [ "$(wc -l <"$scratch/stderr")" -eq 1 ] || complain "$row" "stderr does not hold one line"
  for word in "${expected[@]}"; do
    grep -qF -- "$word" "$scratch/stderr" || complain "$row" "stderr does not say: $word"
  done
  ! grep -q "internal error" "$scratch/stderr" || complain "$row" "an internal error"
  ! LC_ALL=C grep -q '[[:cntrl:]]' "$scratch/stderr" || complain "$row" "control characters on stderr"
  [ ! -s "$scratch/stdout" ] || complain "$row" "something on stdout"
  [ -z "$(ls -A)" ] || complain "$row" "files were written: $(ls -A)"
}

# Its arguments up to "--" are words, what follows is the rest.
words_of() {
  words=()
  while [ "$1" != "--" ]; do
    words+=("$1")
    shift
  done
  rest=("${@:2}")
}

invalid() {
  local words arguments=()
  words_of "$@"
  for override in "${rest[@]}"; do
    arguments+=(--set "$override")
  done
  words+=("$base")
  check words --validate "$scenes/$base" "${arguments[@]}"
}

# Validation and a real run share their checks; the run must not have begun to write.
broken() {
  local words=("$@")
  check words --validate "$scenes/$1"
  check words "$scenes/$1"
}

refused() {
  local words
  words_of "$@"
  check words "${rest[@]}"
}
