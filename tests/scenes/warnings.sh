#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# warnings.sh HPVI SCENE.prm: what asks for care is said once each, on standard output and in
# summary.json, in the same words.
set -euo pipefail
program=$1 scene=$2
directory=$(mktemp -d)
trap 'rm -rf "$directory"' EXIT

"$program" --output "$directory" --set "Adaptivity/Maximum steps=2" "$scene" >"$directory/log"
python3 - "$directory" <<'END'
import json, pathlib, sys
home = pathlib.Path(sys.argv[1])
said = [line[len("warning: "):] for line in (home / "log").read_text().splitlines()
        if line.startswith("warning: ")]
kept = json.loads((home / "summary.json").read_text())["warnings"]
if said != kept:
    sys.exit(f"said {said}, kept {kept}")
for words in ("bilateral contact pulls", "stick and slip meet"):
    if sum(words in line for line in said) != 1:
        sys.exit(f"not exactly one warning says '{words}': {said}")
END
