# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Configures and builds out of tree with CMake and Ninja; Python venvs. Sourced by
# feltgate. All messages go to stderr, so stdout has only the program's output.

# Copies stdin to a log; shows its newest line on a terminal, or one line every ten seconds. Lines
# that begin with [DONE/ALL] tell how long the rest will take.
show_progress() {
  local label=$1 log=$2 line width=80 start=$SECONDS next=$((SECONDS + 10))
  if [[ -t 2 ]]; then width=$(tput cols 2>/dev/null || echo 80); fi
  while IFS= read -r line; do
    printf '%s\n' "$line" >&3
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] && ((BASH_REMATCH[1] >= 5)); then
      line="about $(((SECONDS - start) * (BASH_REMATCH[2] - BASH_REMATCH[1]) / BASH_REMATCH[1])) s left: $line"
    fi
    if [[ -t 2 ]]; then
      printf '\r\033[K%.*s' $((width - 1)) "feltgate: $label: $line" >&2
    elif ((SECONDS >= next)); then
      next=$((SECONDS + 10))
      say "$label: ${line:0:100}"
    fi
  done 3>"$log"
  if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
}

# run_logged LABEL LOG COMMAND...: its status; a failure prints the last lines and the log's path.
run_logged() {
  local label=$1 log=$2 status=0 start=$SECONDS
  shift 2
  "$@" </dev/null 2>&1 9>&- | show_progress "$label" "$log" || status=${PIPESTATUS[0]}
  if ((status > 128)); then
    say "$label: interrupted"
  elif ((status)); then
    tail -n 40 "$log" >&2
    say "$label: failed with status $status; the whole log: $log"
  elif ((SECONDS - start >= 2)); then
    say "$label: done in $((SECONDS - start)) s"
  fi
  return "$status"
}

# Holds a lock for the rest of the build, so that two starts at once do not build into each other.
lock_build() {
  { mkdir -p "$STATE" && : >>"$STATE/lock" && [[ -w $BUILD ]]; } 2>/dev/null ||
    die "the build folder $BUILD cannot be written, for it is another user's or read-only;" \
      'build in one of your own: FELTGATE_BUILD=~/feltgate-build ./feltgate ...'
  exec 9>"$STATE/lock"
  flock -n 9 && return
  say "another feltgate builds in $BUILD; waiting for it"
  flock 9
}

# configure TESTS: once per build folder, again when tests are wanted, the repository or Python moved,
# warnings become errors or no longer are (.ci/run sets FELTGATE_WERROR, nobody else), or dpkg has changed
# something: a tool that CMake did not find may be there now.
configure() {
  local tests=$1 werror=${FELTGATE_WERROR:-OFF} had_tests='' had_root='' had_python='' had_werror='' fresh=()
  if [[ -f $BUILD/build.ninja && -f $STATE/configured ]]; then
    { read -r had_tests && read -r had_root && read -r had_python && read -r had_werror; } \
      <"$STATE/configured" || true
  fi
  if [[ $had_tests == ON ]]; then tests=ON; fi
  [[ $had_tests == "$tests" && $had_root == "$ROOT" && $had_python == "$FELTGATE_PYTHON" &&
    $had_werror == "$werror" && ! /var/lib/dpkg/status -nt $STATE/configured ]] && return
  if [[ $had_root && $had_root != "$ROOT" ]]; then fresh=(--fresh); fi
  run_logged "configuring" "$STATE/configure.log" cmake "${fresh[@]}" -S "$ROOT" -B "$BUILD" \
    -G Ninja -DCMAKE_BUILD_TYPE=Release -DFELTGATE_TESTS="$tests" \
    -DFELTGATE_WERROR="$werror" -DFELTGATE_PACKAGES=OFF -DPython3_EXECUTABLE="$FELTGATE_PYTHON" || return
  printf '%s\n' "$tests" "$ROOT" "$FELTGATE_PYTHON" "$werror" >"$STATE/configured"
}

# build TESTS TARGET...: ends the launcher with the build's own status when it fails. The target
# build.ninja alone only configures, again where a CMakeLists.txt has changed.
build() {
  lock_build
  configure "$1" || exit
  if [[ ! -f $BUILD/.ninja_log && $2 != build.ninja ]]; then
    say "building ${*:2} in $BUILD, once; later starts build what changed"
  fi
  NINJA_STATUS='[%f/%t] ' run_logged "building" "$STATE/build.log" \
    ninja -C "$BUILD" "${@:2}" || exit
  exec 9>&-
}

# need_venv GROUP: the packages that scripts/requirements.txt pins for the group, in a venv of their own
# that is remade when the pins change. FELTGATE_VENV is its folder.
need_venv() {
  local group=$1 venv=$BUILD/venv-$1 pins
  pins=$(sed -n "/^# $group: /,/^# [a-z]*: /{/^[^#]/p}" "$ROOT/scripts/requirements.txt")
  if [[ ! -f $venv/requirements.txt || $(<"$venv/requirements.txt") != "$pins" ]]; then
    lock_build
    say "fetching $(sed -n "s/^# $group: //p" "$ROOT/scripts/requirements.txt") from PyPI, once"
    rm -rf "$venv"
    run_logged "Python venv" "$STATE/venv-$group.log" "$FELTGATE_PYTHON" -m venv "$venv" || exit
    printf '%s\n' "$pins" >"$STATE/requirements-$group.txt"
    run_logged "Python packages" "$STATE/pip-$group.log" "$venv/bin/pip" install \
      --disable-pip-version-check -r "$STATE/requirements-$group.txt" || exit
    cp "$STATE/requirements-$group.txt" "$venv/requirements.txt"
    exec 9>&-
  fi
  export FELTGATE_VENV=$venv PATH=$venv/bin:$PATH
}
