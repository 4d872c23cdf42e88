#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Kills (SIGKILL) each verb that writes COUNT times per output, at random times: the old or the new output is whole, and the
# next run leaves nothing else.
#
#   tests/kill_verbs.sh [VERB|all] [COUNT] [SEED]
set -euo pipefail
exec "${INSONIFY_FAULTS:-$(dirname "$0")/../build/dev/bin/fault_sweep}" kills "${1:-all}" "${2:-200}" "${3:-1}"
