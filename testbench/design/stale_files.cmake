# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# cmake -DGENERATE=program -DROOT=repository -DCOPY=folder -P stale_files.cmake: in a copy, the
# check of generated files passes, fails after a change of a design, and a bad design ends with 2.
file(REMOVE_RECURSE "${COPY}")
foreach(folder rtl/designs rtl/generated model/include/feltgate/generated)
  file(COPY "${ROOT}/${folder}/" DESTINATION "${COPY}/${folder}")
endforeach()
file(COPY "${ROOT}/rtl/registers.toml" "${ROOT}/rtl/schedule.toml" DESTINATION "${COPY}/rtl")
file(COPY "${ROOT}/docs/registers.md" DESTINATION "${COPY}/docs")

function(expect code what)
  execute_process(COMMAND "${GENERATE}" "${COPY}" ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL code)
    message(FATAL_ERROR "${what}: exit code ${result} instead of ${code}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

expect(0 "fresh copy" --check)
file(READ "${COPY}/rtl/designs/lever.toml" design)
string(REPLACE "ramp_nm_s = 5.0" "ramp_nm_s = 6.0" changed "${design}")
file(WRITE "${COPY}/rtl/designs/lever.toml" "${changed}")
expect(1 "changed design" --check)
foreach(file feltgate_pkg.sv lever.hpp registers.md)
  if(NOT output MATCHES "${file}: stale; run `feltgate generate`")
    message(FATAL_ERROR "${file} is not named as stale:\n${output}")
  endif()
endforeach()
expect(0 "written anew")
expect(0 "fresh again" --check)
file(APPEND "${COPY}/rtl/designs/lever.toml" "nonsense = 1\n")
expect(2 "bad design" --check)
if(NOT output MATCHES "lever.toml:[0-9]+: .*nonsense")
  message(FATAL_ERROR "no place in the error:\n${output}")
endif()
file(REMOVE_RECURSE "${COPY}")
