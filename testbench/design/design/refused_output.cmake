# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# cmake -DGENERATE=program -DROOT=dir -P refused_output.cmake: an output that cannot be written ends
# the generator with 2 and a line that says so.
foreach(output /proc/x /dev/full /dev/null/x)
  execute_process(
    COMMAND "${GENERATE}" "${ROOT}" --design "${ROOT}/rtl/designs/paper.toml" --output ${output}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code STREQUAL "2" OR NOT text MATCHES "^${output}: cannot be written [^\n]*; give a folder[^\n]*\n$")
    message(FATAL_ERROR "${output}: ended with ${code}: ${text}")
  endif()
endforeach()
