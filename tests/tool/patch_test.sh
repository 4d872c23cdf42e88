#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the commands of docs/patch-test.md and demands the offsets that the mission of apps/09_patch_test.py states.
#
#   tests/tool/patch_test.sh TOOL
#
# Exits with 77 if python3 has no numpy.
set -euo pipefail
tool=$(realpath "$1")
script=$(realpath "$(dirname "$0")/../../apps/09_patch_test.py")
python=/usr/bin/python3
"$python" -c 'import numpy' 2>/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$python" "$script" make patch
"$tool" survey patch/mission.toml -q -o patch/run
"$tool" export patch/run -q --to gsf -o patch/patch.gsf
"$python" "$script" solve patch/patch.gsf >found.json
cat found.json
"$python" - <<'END'
import json
found = json.load(open("found.json"))
for name, true, most in (("roll_deg", 0.8, 0.02), ("pitch_deg", -1.3, 0.02), ("heading_deg", 1.5, 0.02), ("latency_s", 0.25, 0.005)):
    assert abs(found[name] - true) < most, (name, found[name], true)
END
