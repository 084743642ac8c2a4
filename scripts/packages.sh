# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Debian packages by group, the reason for each, and their installation. Sourced by feltgate.

# Group | package | what for.
mapfile -t PACKAGES < <(grep -v '^#' "$ROOT/scripts/packages.txt")

INSTALL=(install --yes --no-install-recommends)
# What the build does not need: pictures, and what tests run.
LATER='plots test'

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

# ask_to_install PACKAGE...: the command is shown, and the launcher ends where it may not be called. APT is
# how apt-get is called afterwards.
ask_to_install() {
  local shown as_root=()
  shown="apt-get update && apt-get ${INSTALL[*]} $*"
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
  APT=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
  # Old package lists may still do, so only the installation decides.
  run_logged "package lists" "$STATE/apt-update.log" "${APT[@]}" update || true
}

# install_packages LABEL LOG PACKAGE...: all of them are there, or the launcher ends with status 2.
install_packages() {
  local label=$1 log=$STATE/$2 missing
  shift 2
  run_logged "$label" "$log" "${APT[@]}" "${INSTALL[@]}" "$@" ||
    die "the installation failed; the command was: ${APT[*]} ${INSTALL[*]} $*"
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]} == 0)) || die "still missing after the installation: ${missing[*]}"
}

# need_packages GROUPS: all packages of these groups are there, or the launcher ends with status 2. Those
# that only groups of LATER name are installed while the launcher builds; await_packages waits for them.
# The stamp saves even the look, until dpkg changes anything.
need_packages() {
  local entry group package _ wanted=() now=() missing first=() stamp=$STATE/packages-${1// /-}
  [[ ${FELTGATE_SKIP_PACKAGES-} == 1 ]] && return
  for entry in "${PACKAGES[@]}"; do
    IFS='|' read -r group package _ <<<"$entry"
    [[ " $1 " == *" $group "* ]] || continue
    wanted+=("$package")
    [[ " $LATER " == *" $group "* ]] || now+=("$package")
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
    ask_to_install "${missing[@]}"
    for package in "${missing[@]}"; do
      if [[ " ${now[*]} " == *" $package "* ]]; then first+=("$package"); fi
    done
    if ((${#first[@]} && ${#first[@]} < ${#missing[@]})); then
      install_packages installing apt-install.log "${first[@]}"
      mapfile -t missing < <(missing_packages "${missing[@]}")
      say "the other packages are installed while it builds"
      (install_packages "installing beside" apt-beside.log "${missing[@]}") 2>"$STATE/apt-beside.txt" &
      PACKAGES_BESIDE=$!
      # A launcher that ends early (a build that fails, an option that is refused) leaves no apt behind it.
      trap await_beside EXIT
    else
      install_packages installing apt-install.log "${missing[@]}"
    fi
  fi
  PACKAGES_STAMP=$stamp
  PACKAGES_WANTED=${wanted[*]}
  [[ ${PACKAGES_BESIDE-} ]] || await_packages
}

# Waits for what is installed beside the build, if anything is; a failure is told. 1 where it failed.
await_beside() {
  local beside=${PACKAGES_BESIDE-}
  PACKAGES_BESIDE=''
  [[ $beside ]] || return 0
  if kill -0 "$beside" 2>/dev/null; then say "waiting for the other packages"; fi
  if ! wait "$beside"; then
    cat "$STATE/apt-beside.txt" >&2
    return 1
  fi
}

# All packages that need_packages asked for are there, or the launcher ends with status 2.
await_packages() {
  await_beside || exit 2
  if [[ ${PACKAGES_STAMP-} ]]; then printf '%s\n' "$PACKAGES_WANTED" >"$PACKAGES_STAMP"; fi
}
