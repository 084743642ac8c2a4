# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Debian packages by group, the reason for each, and their installation. Sourced by feltgate.

# Group | package | what for.
mapfile -t PACKAGES < <(grep -v '^#' "$ROOT/scripts/packages.txt")

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
