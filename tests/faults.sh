#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Lets every call by which a verb writes fail with ENOSPC, EIO, EACCES, EINTR or a short write, or kills the verb there; with
# "disk" runs it on disks that are full after a share of its bytes, 30 sizes for each output:
# exit code 4 and one line, or success and the right bytes; the old output whole, nothing half.
#
#   tests/faults.sh [VERB|all] [STEP] [disk]     every STEPth failure or size (1: all)
set -euo pipefail
exec "${INSONIFY_FAULTS:-$(dirname "$0")/../build/dev/bin/fault_sweep}" "${3:-faults}" "${1:-all}" "${2:-1}"
