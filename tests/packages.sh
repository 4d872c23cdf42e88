#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the packages for the Debian that it runs on (tests/on_debian.sh SUITE tests/packages.sh: for another one) and tries them
# on a bare one: apt installs them in a chroot that debootstrap makes, the tool simulates and draws a ping there, and the program of docs/api.md is built against the library without PCL, VTK and HDF5.
# Without root, debootstrap or a mirror the packages are unpacked into a folder and used from there. Not part of
# tests/run.sh, whose test `consume` installs the same files without packages.
#
#   tests/packages.sh            builds what is missing (release preset), then all of it: some minutes
#   tests/packages.sh --unpack   never makes a chroot
set -euo pipefail
cd "$(dirname "$0")/.."
suite=$(. /etc/os-release && echo "$VERSION_CODENAME")
mirror=${INSONIFY_MIRROR:-http://deb.debian.org/debian}

apps/install_packages.sh --packages
docs/make_site.sh build/site >/dev/null
cmake --preset release >build-configure.log 2>&1 || { cat build-configure.log; exit 1; }
rm -f build-configure.log
cmake --build --preset release
rm -rf build/release/packages
(cd build/release && cpack -G DEB >cpack.log 2>&1) || { cat build/release/cpack.log; exit 1; }
packages=(build/release/packages/*.deb)
printf '%s\n' "${packages[@]}"
[[ ${#packages[@]} -eq 4 ]]

work=$(mktemp -d)
clean() { if mountpoint -q "$work/root/proc"; then umount "$work/root/proc"; fi; rm -rf "$work"; }
trap clean EXIT

# What the packages must do, in a root of their own or below a prefix: tool, data, pictures, library.
cat >"$work/try.sh" <<'END'
set -euo pipefail
prefix=${1:-}
PATH=$prefix/usr/bin:$PATH
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
insonify --version --verbose
[[ $(insonify sonars | wc -l) -gt 40 ]]
insonify make-scene harbour -o harbour.ply --points 50000
insonify ping harbour.ply --sonar p900-45 --pose=0,0,-3,0,10,0 --range 1:20 -o ping
[[ -s ping/cube.h5 && -s ping/returns.ply && $(head -c 4 ping/fan.png | tail -c 3) == PNG ]]
insonify image ping --view ascan --beam 100 -o beam.png
insonify view ping --screenshot view.png >/dev/null
[[ -s beam.png && -s view.png ]]
for file in applications/insonify-view.desktop doc/insonify/copyright doc/insonify-doc/README.md doc/insonify-doc/html/index.html \
  man/man1/insonify-ping.1 bash-completion/completions/insonify; do
  [[ -s $prefix/usr/share/$file ]] || { echo "no /usr/share/$file" >&2; exit 1; }
done
PYTHONPATH=$prefix/usr/lib/python3/dist-packages /usr/bin/python3 - <<'PYTHON'
import insonify as iy
assert "libvtk" not in open("/proc/self/maps").read() and "libpcl" not in open("/proc/self/maps").read()
ping = iy.PingSimulator(iy.sonar("p900-45", min_range=1, max_range=20)).ping(iy.load_scene("harbour.ply"), (0, 0, -3), pitch=10)
ping.save("from-python")
PYTHON
cmp ping/cube.h5 from-python/cube.h5
block() { awk -v fence="\`\`\`$1" '$0 == fence { inside = 1; next } inside && /^\`\`\`/ { exit } inside' "$prefix/usr/share/doc/insonify-doc/docs/api.md"; }
mkdir my_ping
block cmake >my_ping/CMakeLists.txt
block cpp >my_ping/my_ping.cpp
cmake -S my_ping -B build -DCMAKE_PREFIX_PATH="$prefix/usr" >/dev/null
cmake --build build >/dev/null
build/my_ping
END

if [[ ${1:-} != --unpack && $(id -u) -eq 0 ]] && command -v debootstrap >/dev/null &&
  debootstrap --variant=minbase "$suite" "$work/root" "$mirror" >"$work/debootstrap.log" 2>&1; then
  mount -t proc proc "$work/root/proc"
  echo 'Dpkg::Use-Pty "0";' >"$work/root/etc/apt/apt.conf.d/quiet"
  cp "${packages[@]}" "$work/try.sh" "$work/root/tmp/"
  inside() { chroot "$work/root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive "$@"; }
  inside sh -c 'apt-get update -qq && apt-get install -y -qq --no-install-recommends /tmp/*.deb cmake g++ make >/dev/null'
  for absent in libpcl-dev libvtk9-dev libhdf5-dev; do
    if inside dpkg -s $absent >/dev/null 2>&1; then echo "the packages pull $absent in" >&2; exit 1; fi
  done
  inside bash /tmp/try.sh
  inside apt-get purge -y -qq insonify libinsonify-dev insonify-doc python3-insonify >/dev/null
  if left=$(inside find /usr -name '*insonify*' | grep .); then echo "left after purge: $left" >&2; exit 1; fi
  echo "installed, used and removed in a bare Debian ($suite)"
else
  for package in "${packages[@]}"; do dpkg-deb -x "$package" "$work/root"; done
  bash "$work/try.sh" "$work/root"
  echo "unpacked and used; no chroot: $(tail -n 1 "$work/debootstrap.log" 2>/dev/null || echo 'not asked for, not root, or no debootstrap')"
fi
