# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# ./feltgate test [NAME] [--long]: builds everything and runs CTest. Sourced by feltgate.

tests_usage() {
  cat <<TEXT
Usage: ./feltgate test [NAME] [--long]

  NAME    only the tests whose name matches this regular expression, such as quad_decoder
  --long  also the long runs (1e9 lock-step clocks of the core and more)

The last line is "N passed, N failed", with ", N skipped" where tests could not run here; the exit
status is 0 when none failed. Results for machines: test-results.xml (JUnit) in the build folder.
TEXT
}

run_tests() {
  local groups=$1 argument name='' options=() status=0 results=$BUILD/test-results.xml
  shift
  for argument in "$@"; do
    case $argument in
      -h | --help)
        tests_usage
        return
        ;;
      --long)
        export FELTGATE_LONG=1
        options+=(-C Long)
        ;;
      -*) die "test: unknown option '$argument'; './feltgate test --help'" ;;
      *)
        [[ ! $name ]] || die "test: one NAME only, got '$name' and '$argument'"
        name=$argument
        options+=(-R "$name")
        ;;
    esac
  done
  need_packages "$groups"
  look_up_programs
  build ON all
  rm -f "$results"
  ctest --test-dir "$BUILD" --output-on-failure --no-tests=error -j "$(nproc)" \
    --output-junit "$results" "${options[@]}" || status=$?
  report_tests "$status" "$results" "$name"
}

# Prints the counts as the last line; returns 1 when anything failed. CTest's own totals are of no
# use: they count a test whose program is missing as skipped, here it is a failure.
report_tests() {
  local status=$1 results=$2 name=$3 total=0 passed=0 skipped=0 failed
  if [[ -f $results ]]; then
    total=$(grep -c '<testcase ' "$results" || true)
    passed=$(grep -c '<testcase .*status="run"' "$results" || true)
    skipped=$(grep -cE '<testcase .*status="disabled"|<skipped message="SKIP_' "$results" || true)
  fi
  if ((total == 0)); then
    if [[ $name ]]; then die "no test matches '$name'; 'ctest --test-dir $BUILD -N' lists them"; fi
    die "CTest ran nothing and ended with status $status"
  fi
  failed=$((total - passed - skipped))
  printf '%d passed, %d failed' "$passed" "$failed"
  if ((skipped)); then printf ', %d skipped' "$skipped"; fi
  printf '\n'
  ((status == 0 && failed == 0))
}
