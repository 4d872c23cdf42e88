#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages that insonify needs and this machine lacks, on Debian 12 and 13 and what is made of them; says which
# and why. On other systems it only says what to install, by the names of Debian. Run by apps/demo.sh and tests/run.sh. With --python also what Python's module needs, with --tests that and what the tests need, with --tidy what
# tests/tidy.sh needs, with --packages what tests/packages.sh and docs/make_site.sh need. Uses sudo when not root.
set -euo pipefail

declare -A why=(
  [build-essential]="compiler" [cmake]="build system" [ninja-build]="build system" [pkg-config]="finds FFTW and EGL"
  [ca-certificates]="certificates" [libpcl-dev]="point clouds, normals (PCL)" [libvtk9-dev]="pictures, mesh readers (VTK)"
  [libflann-dev]="KD-trees (FLANN)" [liblz4-dev]="FLANN's headers ask for it, compressed MCAP" [libzstd-dev]="compressed MCAP" [libssl-dev]="SHA-256 (OpenSSL)" [libeigen3-dev]="linear algebra (Eigen)"
  [libboost-dev]="sorting, allocation (Boost's headers)"
  [libfftw3-dev]="Fourier transforms (FFTW)" [libhdf5-dev]="ping cubes (HDF5)" [librandom123-dev]="counter-based random numbers"
  [libtomlplusplus-dev]="sonar and run files (TOML)" [nlohmann-json3-dev]="manifests (JSON)" [libfmt-dev]="text formatting"
  [libcli11-dev]="command line" [libegl-dev]="off-screen pictures" [libegl-mesa0]="off-screen pictures"
  [libgl1-mesa-dri]="off-screen pictures in software" [libglew-dev]="VTK's headers ask for it" [fonts-dejavu-core]="letters in pictures"
  [libx11-dev]="the viewer's window" [libassimp-dev]="meshes of robots and CAD (Assimp)" [liblaszip-dev]="clouds of LAZ (LASzip)" [libembree-dev]="rays from surface to surface (Embree)" [libgdal-dev]="rasters as scenes, map projections (GDAL; libvtk9-dev needs it too)"
)
if [[ "${1:-}" == --python || "${1:-}" == --tests || "${1:-}" == --packages ]]; then
  why+=([pybind11-dev]="Python's module" [python3-dev]="Python's module" [python3-numpy]="Python's module")
fi
if [[ "${1:-}" == --tests ]]; then
  why+=([libgtest-dev]="tests" [libgmock-dev]="tests" [clang-format]="test of the code format"
    [libbenchmark-dev]="benchmarks" [xvfb]="a display for the tests of the viewer"
    [parallel]="shards of a survey" [slurm-wlm]="shards of a survey as a job array" [munge]="Slurm's keys"
    [python3-pytest]="tests of Python's module" [mypy]="types of Python's module" [python3-h5py]="cubes as Python reads them" [python3-laspy]="LAS and LAZ as Python reads them" [python3-laszip]="LAZ as Python reads it" [gdal-bin]="grids as GDAL reads them" [pcl-tools]="clouds as PCL reads them")
fi
if [[ "${1:-}" == --tidy ]]; then why+=([clang-tidy]="tests/tidy.sh"); fi
if [[ "${1:-}" == --packages ]]; then
  why+=([doxygen]="the site" [dpkg-dev]="dependencies of packages" [file]="dependencies of packages" [debootstrap]="a bare Debian to try packages in")
fi

if ! command -v apt-get >/dev/null; then
  echo "insonify: this system has no apt-get; if the build lacks anything, install these (names of Debian):"
  for package in "${!why[@]}"; do printf '  %-24s %s\n' "$package" "${why[$package]}"; done | sort
  exit 0
fi
# Not in every suite: Debian 12 has no LASzip and no laspy; the format that tests check is that of clang-format 14, of Debian 12.
not_everywhere=(liblaszip-dev python3-laspy python3-laszip) absent=(clang-format)
if [[ -r /etc/os-release ]] && grep -q '^VERSION_CODENAME=bookworm' /etc/os-release; then absent=("${not_everywhere[@]}"); fi
for package in "${absent[@]}"; do unset "why[$package]"; done
missing=()
installed=$'\n'$(dpkg-query -W -f='${Package} ${Status}\n' "${!why[@]}" 2>/dev/null || true)
for package in "${!why[@]}"; do
  [[ $installed == *$'\n'"$package install ok installed"* ]] || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo >/dev/null || { echo "insonify: need root or sudo to install: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -qq
for package in "${not_everywhere[@]}"; do
  if [[ " ${missing[*]} " != *" $package "* ]] || apt-cache show "$package" >/dev/null 2>&1; then continue; fi
  echo "insonify: this system has no $package (${why[$package]}); going on without it"
  unset "why[$package]"
done
mapfile -t missing < <(for package in "${missing[@]}"; do if [[ -n ${why[$package]:-} ]]; then echo "$package"; fi; done | sort)
[[ ${#missing[@]} -gt 0 ]] || exit 0
echo "insonify: installing ${#missing[@]} missing Debian packages:"
for package in "${missing[@]}"; do printf '  %-24s %s\n' "$package" "${why[$package]}"; done
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
