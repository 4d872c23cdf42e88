#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes git check format, layers and words before each commit. It needs a configured build/dev (tests/run.sh makes it), but
# builds nothing.
set -euo pipefail
cd "$(dirname "$0")/.."
hook=$(git rev-parse --git-path hooks/pre-commit)
mkdir -p "$(dirname "$hook")"
cat >"$hook" <<'HOOK'
#!/usr/bin/env bash
set -euo pipefail
cd "$(git rev-parse --show-toplevel)"
[[ -d build/dev ]] || { echo "pre-commit: no build/dev to check by; run tests/run.sh once" >&2; exit 0; }
unset GIT_DIR GIT_INDEX_FILE
ctest --test-dir build/dev -R '^layers' --output-on-failure >build/dev/pre-commit.log 2>&1 || { cat build/dev/pre-commit.log >&2; exit 1; }
HOOK
chmod +x "$hook"
echo "$hook"
