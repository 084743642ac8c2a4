# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# ./feltgate test [NAME] [--long]: builds what the tests need and runs CTest. Sourced by feltgate.

# What `test core` means: the chain's blocks and the whole core beside the twin, on recorded and synthetic traces.
CORE_TESTS='^(quad_decoder|velocity_n_lever|lowpass|dob_lever|torque_control_lever|pwm|feltgate_core|replay\.(synthetic|mouse-usb-x|stepper))$'

tests_usage() {
  cat <<TEXT
Usage: ./feltgate test [core | NAME] [--whole | --long] [--list]

  core    decoder, velocity, observer, control, PWM and the whole core: RTL beside the twin in every
          clock, on synthetic and recorded traces; about two minutes with its build

  NAME    only the tests whose name matches this regular expression, such as quad_decoder;
          only what they need is built
  --list  only lists the tests with their labels; builds nothing
  --whole also what a usual run tries a share of: recordings and scenes through the RTL to their end
          on every design, all seeded defects, the defects of the proofs, all mutants;
          more than twice as long
  --long  the whole, the long runs (1e9 lock-step clocks of the core and more), and every random run
          ten times as long, or as many times as FELTGATE_LONG says

The last line is "N passed, N failed", with ", N skipped" where tests could not run here; before it
a run of all tests says how long each group of them took. Exit code: 0 none failed, 1 some did,
2 wrong use. Results for machines: test-results.xml (JUnit) in the build folder.

  ./feltgate test                 all of them: about an hour on two cores, build included
  ./feltgate test scene.wall      what the scene 'wall' is tested with
  ./feltgate test '^uart_tx\.'    must fail inside to pass: the seeded defects of one block
TEXT
}

# What scripts/tests.py says about the tests of the build folder.
tests_say() {
  "$FELTGATE_PYTHON" -B "$ROOT/scripts/tests.py" "$@" --build "$BUILD"
}

run_tests() {
  local groups=$1 argument name='' configuration='' list='' found chosen=() options=() targets=(all) status=0
  local results=$BUILD/test-results.xml
  shift
  for argument in "$@"; do
    case $argument in
      -h | --help)
        tests_usage
        return
        ;;
      --list) list=1 ;;
      --whole)
        export FELTGATE_WHOLE=1
        chosen+=(--whole)
        targets=(all whole)
        configuration=Whole
        ;;
      --long)
        export FELTGATE_WHOLE=1
        targets=(all whole)
        export FELTGATE_LONG=${FELTGATE_LONG:-10}
        chosen+=(--long)
        groups+=" long"
        configuration=Long
        ;;
      -*) die "test: unknown option '$argument'; './feltgate test --help'" ;;
      *)
        [[ ! $name ]] || die "test: one NAME only, got '$name' and '$argument'"
        name=$argument
        [[ $name != core ]] || name=$CORE_TESTS
        chosen+=(--name "$name")
        options+=(-R "$name")
        ;;
    esac
  done
  # Who names tests gets the seeded defects of both halves.
  if [[ $name && ! $configuration ]]; then configuration=Named; fi
  if [[ $configuration ]]; then options+=(-C "$configuration"); fi
  need_packages "$groups"
  look_up_programs
  # What needs no packages of the tests is built while these are installed: the longest of what a
  # build with tests compiles alike. A folder that is configured with tests would be so again.
  if [[ ${PACKAGES_BESIDE-} && ! -f $STATE/configured && ! $list && ! $name ]]; then
    build OFF feltgate_run rtl_paper feltgate_stability feltgate_shape
  fi
  await_packages
  if [[ $list || $name ]]; then
    build ON build.ninja
    found=$(tests_say list "${chosen[@]}") || exit 2
    [[ $found ]] ||
      die "no test matches '$name'; './feltgate test --list' lists them"
  fi
  if [[ $list ]]; then
    printf '%s\n' "$found"
    return
  fi
  if [[ $name ]]; then mapfile -t targets < <(tests_say targets "${chosen[@]}"); fi
  if [[ ${targets[*]} ]]; then build ON "${targets[@]}"; fi
  fetch_for_tests slang slang 'lint\.'
  if [[ ${FELTGATE_WHOLE-} ]]; then
    fetch_for_tests synth "Yosys and nextpnr" '(ulx3s|tang_nano_9k)\.(bitstream|netlist)'
    fetch_for_tests gowin "nextpnr for Gowin" 'tang_nano_9k\.bitstream'
  fi
  fetch_for_tests mutate tree-sitter 'mutate\.twin'
  fetch_for_tests neighbours "FuseSoC and LiteX" 'register_files|neighbours\.|board\.host'
  fetch_for_tests mujoco MuJoCo 'plant\.mujoco'
  fetch_for_tests apytypes APyTypes 'python\.oracle'
  fetch_for_tests fmpy FMPy 'product\.fmu'
  rm -f "$results"
  local built_s
  children_cpu_s built_s
  # One more than there are processors: some tests wait for a browser, a device or a pipe.
  ctest --test-dir "$BUILD" --output-on-failure --no-tests=error -j "$(($(nproc) + 1))" \
    --output-junit "$results" "${options[@]}" || status=$?
  if [[ ! $name && -f $results ]]; then
    tests_say minutes "${chosen[@]}" --results "$results"
    local all_s
    children_cpu_s all_s
    printf '\nCPU minutes: %d of packages and build, %d of tests; %d minutes by the clock\n' \
      $((built_s / 60)) $(((all_s - built_s) / 60)) $((SECONDS / 60))
    if [[ ! $configuration ]]; then
      local week
      week=$(sed -n 's/^FELTGATE_WEEK_NOW:INTERNAL=//p' "$BUILD/CMakeCache.txt")
      printf 'parts of week %s; FELTGATE_WEEK=%s chooses them again, --whole tries all\n' "$week" "$week"
    fi
  fi
  report_tests "$status" "$results" "$name"
}

# children_cpu_s NAME: sets NAME to the CPU seconds of all programs that have ended. No subshell may
# ask: it has children of its own.
children_cpu_s() {
  times >"$STATE/times"
  printf -v "$1" %s "$(awk -F'[ms ]+' 'NR == 2 { print int($1 * 60 + $2 + $3 * 60 + $4) }' "$STATE/times")"
}

# fetch_for_tests VENV WHAT TESTS: the venv of tests whose names match TESTS, where one of them is
# to run. Without a network they are skipped, but not in CI.
fetch_for_tests() {
  [[ ! $name || $found =~ $3 ]] || return 0
  (need_venv "$1") || [[ ${CI-} != true ]] || die "$2 cannot be fetched"
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
    if [[ $name ]]; then die "no test matches '$name'; './feltgate test --list' lists them"; fi
    die "CTest ran nothing and ended with status $status"
  fi
  failed=$((total - passed - skipped))
  printf '%d passed, %d failed' "$passed" "$failed"
  if ((skipped)); then printf ', %d skipped' "$skipped"; fi
  printf '\n'
  ((status == 0 && failed == 0))
}
