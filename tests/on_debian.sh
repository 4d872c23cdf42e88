#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What a user finds on a bare system: makes one by debootstrap, clones the last commit into it, and runs the two commands of
# the README word for word, then those of docs/python.md, in a tree that was configured without Python's packages. Needs root
# and a mirror; an hour on two cores. To be run before a release; logs are in build/on_debian/SUITE.
#
#   tests/on_debian.sh SUITE [COMMAND...]    bookworm, trixie or noble; COMMANDs, e.g. tests/packages.sh, replace those of the pages
#
# noble needs the keys of Ubuntu (the package ubuntu-keyring, or INSONIFY_DEBOOTSTRAP=--keyring=FILE). INSONIFY_MIRROR is the archive, if not that of Debian or Ubuntu.
# INSONIFY_KEEP=1 keeps the system, which a later run then uses.
set -euo pipefail
cd "$(dirname "$0")/.."
suite=${1:-}
case $suite in
  bookworm | trixie) mirror=${INSONIFY_MIRROR:-http://deb.debian.org/debian} components=main ;;
  noble) mirror=${INSONIFY_MIRROR:-http://archive.ubuntu.com/ubuntu} components=main,universe ;;
  *) sed -n '7s/^# *//p' "$0" >&2 && exit 2 ;;
esac
[[ $(id -u) -eq 0 ]] && command -v debootstrap >/dev/null || { echo "$0: needs root and debootstrap" >&2; exit 2; }
shift
commands=("$@")
if [[ $# -eq 0 ]]; then
  mapfile -t commands < <(sed -n '/^## Start/,/^## /s/^\(\.\/[a-z]*\/[a-z.]*\) .*/\1/p' README.md
    sed -n '/^## Installing/,/^## /p' docs/python.md | sed -n '/^```$/,/^```$/s/^\([a-zA-Z].*\)$/\1/p')
fi
printf 'on %s:\n' "$suite"
printf '  %s\n' "${commands[@]}"

work=$PWD/build/on_debian/$suite root=$PWD/build/on_debian/$suite/root
clean() {
  for mounted in dev/shm dev/pts dev proc; do if mountpoint -q "$root/$mounted"; then umount "$root/$mounted"; fi; done
  [[ -n ${INSONIFY_KEEP:-} ]] || rm -rf --one-file-system "$root"
}
trap clean EXIT
mkdir -p "$work"
if [[ ! -e $root/usr/bin/git ]]; then
  scripts=/usr/share/debootstrap/scripts script=()
  [[ -e $scripts/$suite ]] || script=("$scripts/gutsy")  # of all newer suites of Ubuntu
  # shellcheck disable=SC2086
  debootstrap ${INSONIFY_DEBOOTSTRAP:-} --variant=minbase --include=git,ca-certificates --components="$components" "$suite" "$root" "$mirror" \
    "${script[@]}" >"$work/debootstrap.log" 2>&1 || { tail -n 3 "$work/debootstrap.log" >&2; exit 1; }
fi
mount -t proc proc "$root/proc"
mount --bind /dev "$root/dev"
mount -t tmpfs shm "$root/dev/shm"
mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"
rm -rf "$root/insonify"
git clone -q . "$root/insonify"

failed=0
for command in "${commands[@]}"; do
  log=$work/$(tr -cs 'a-zA-Z0-9.\n' '-' <<<"${command:0:60}").log
  started=$SECONDS code=0
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 bash -c "cd /insonify && $command" >"$log" 2>&1 || code=$?
  echo "$command: $([[ $code == 0 ]] && echo passed || echo "exit code $code"), $((SECONDS - started)) s; $log"
  [[ $code == 0 ]] || { failed=1; tail -n 20 "$log"; }
done
exit $failed
