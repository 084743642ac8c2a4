# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Debian packages by group, why each is needed, and how they get installed. Sourced by feltgate.

# Group | package | what for.
PACKAGES=(
  "build|g++|compiles the C++ twin, the plant and the tools"
  "build|cmake|configures the build"
  "build|ninja-build|runs the build"
  "build|pkg-config|finds the libraries below"
  "build|python3|runs the build's small scripts"
  "build|verilator|turns the SystemVerilog core into a C++ simulation"
  "build|libboost-dev|intervals for the proven bounds, 128-bit floats, the grammar of laws (headers)"
  "build|libeigen3-dev|poles of loops: feltgate stability and design (headers)"
  "build|libtomlplusplus-dev|reads designs, plants and scenes (TOML)"
  "build|libarchive-dev|reads sigrok recordings (zip)"
  "build|nlohmann-json3-dev|writes the JSON results"
  "build|libcli11-dev|reads the command line"
  "build|libfmt-dev|formats numbers and messages"
  "build|libsvgpp-dev|reads the outlines of hidden shapes: SVG++ (headers)"
  "build|libpng-dev|reads the images of textures"
  "build|zlib1g-dev|writes FST waveforms"
  "python|python3|writes the page of a table"
  "plots|python3-matplotlib|draws the figures of the report"
  "test|catch2|the unit test framework"
  "test|patch|seeds the defects that the tests must find"
  "test|make|FuseSoC runs simulators with it"
  "test|libsystemc-dev|sc_fixed, the independent oracle of the fixed-point type"
  "test|iverilog|second simulator, with unknown values (X)"
  "test|python3-distributed|a sweep over two dask workers, one of them killed"
  "test|pybind11-dev|binds the twin to Python"
  "test|python3-dev|headers for that"
  "test|python3-pil|makes the images that feltgate texture must refuse"
  "test|python3-numpy|arrays of the Python package"
  "test|python3-venv|a place to pip install it into, and what scripts/requirements.txt pins"
  "test|python3-nbclient|runs the notebook of docs/"
  "test|python3-ipykernel|the same"
  "test|python3-matplotlib|draws the notebook's pictures"
  "test|yosys|checks that the RTL is synthesizable, and writes what z3 proves"
  "test|z3|proves the properties of the blocks"
  "test|gappa|proves the bounds of laws a second time"
  "test|chromium|runs the page with the lever"
  "test|chromium-driver|lets a test drag and type in it"
  "test|python3-selenium|the same"
  "long|g++-aarch64-linux-gnu|the libraries on AArch64"
  "long|qemu-user|runs what it compiles"
  "bench|libsystemc-dev|sc_fixed, one of the engines of the benchmark"
  "synth|python3-venv|holds the pinned Yosys and nextpnr of scripts/requirements.txt"
  "synth|ca-certificates|lets pip fetch them over https"
  "product|yosys|writes the RTL as Verilog-2005"
  "page|emscripten|compiles the twin for a browser"
  "prove|python3-venv|holds the pinned Yosys and z3 of scripts/requirements.txt"
  "prove|ca-certificates|lets pip fetch them over https"
  "prove|patch|seeds the defects that the proofs must find"
  "faults|yosys|names the flip-flops of the core"
  "gappa|gappa|proves the bound of a law a second time"
  "dask|python3-distributed|sends the chunks of a sweep to many machines"
)

# Missing ones among the named packages, one a line.
missing_packages() {
  local name status installed=" " package
  while read -r name status; do
    if [[ $status == ?i* ]]; then installed+="$name "; fi
  done < <(dpkg-query -W -f '${Package} ${db:Status-Abbrev}\n' "$@" 2>/dev/null)
  for package in "$@"; do
    [[ $installed == *" $package "* ]] || printf '%s\n' "$package"
  done
}

# The named packages with their first reason, each once.
list_with_reasons() {
  local entry rest listed=" "
  for entry in "${PACKAGES[@]}"; do
    rest=${entry#*|}
    if [[ " $* " == *" ${rest%%|*} "* && $listed != *" ${rest%%|*} "* ]]; then
      listed+="${rest%%|*} "
      printf '  %-20s %s\n' "${rest%%|*}" "${rest#*|}" >&2
    fi
  done
}

# 0 when the installation may go on without, or after, a question.
may_install() {
  [[ ${ASSUME_YES-} || (${CI-} && ${CI-} != false && ${CI-} != 0) ]] && return
  [[ -t 0 ]] || return 1
  local answer
  read -r -p "Install them now? [Y/n] " answer || return 1
  [[ ! $answer || $answer == [Yy]* ]]
}

install_packages() {
  local shown as_root=() apt install=(install --yes --no-install-recommends "$@")
  shown="apt-get update && apt-get ${install[*]}"
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      die "neither root nor sudo here; run this, then start again:"$'\n'"  su -c '$shown'"
    fi
    shown=${shown//apt-get/sudo apt-get}
    as_root=(sudo)
    [[ -t 0 ]] || as_root+=(-n)
  fi
  may_install || die "nothing installed; run this, then start again:"$'\n'"  $shown"
  say "$shown"
  # Ask for the password here, not behind the progress line.
  if [[ ${as_root[*]} == sudo ]]; then sudo -v || die "sudo refused; the command was: $shown"; fi
  apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
  # Old package lists may still do, so only the installation decides.
  run_logged "package lists" "$STATE/apt-update.log" "${apt[@]}" update || true
  run_logged "installing" "$STATE/apt-install.log" "${apt[@]}" "${install[@]}" ||
    die "the installation failed; the command was: $shown"
}

# need_packages GROUPS: all packages of these groups are there, or the launcher ends with status 2.
# The stamp saves even the look, until dpkg changes anything.
need_packages() {
  local entry rest wanted=() missing stamp=$STATE/packages-${1// /-}
  [[ ${FELTGATE_SKIP_PACKAGES-} == 1 ]] && return
  for entry in "${PACKAGES[@]}"; do
    rest=${entry#*|}
    if [[ " $1 " == *" ${entry%%|*} "* ]]; then wanted+=("${rest%%|*}"); fi
  done
  [[ $stamp -nt /var/lib/dpkg/status && $(<"$stamp") == "${wanted[*]}" ]] && return
  mkdir -p "$STATE"
  if ! command -v dpkg-query >/dev/null; then
    say "this is no Debian; these packages, or what your system calls them, are needed:"
    list_with_reasons "${wanted[@]}"
    die "when they are there, start again with FELTGATE_SKIP_PACKAGES=1"
  fi
  mapfile -t missing < <(missing_packages "${wanted[@]}")
  if ((${#missing[@]})); then
    say "these Debian packages are missing:"
    list_with_reasons "${missing[@]}"
    install_packages "${missing[@]}"
    mapfile -t missing < <(missing_packages "${wanted[@]}")
    ((${#missing[@]} == 0)) || die "still missing after the installation: ${missing[*]}"
  fi
  printf '%s\n' "${wanted[*]}" >"$stamp"
}
