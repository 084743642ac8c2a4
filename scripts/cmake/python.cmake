# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# The Python package feltgate: the extension module, its Python files, and the scenes, plants and
# designs that it reads, as component `python` of the installation. It is built alone for
# pip, and in a build with tests for these tests. pyproject.toml, docs/python.md
include_guard(GLOBAL)

find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 QUIET CONFIG)
if(NOT pybind11_FOUND)
  message(FATAL_ERROR "pybind11 is missing; run: apt-get install pybind11-dev")
endif()

# lever in shorter words, for docs/fixed_against_float.ipynb; too coarse for a design for use.
set(narrow "${PROJECT_BINARY_DIR}/designs/narrow.toml")
file(READ "${FELTGATE_ROOT}/rtl/designs/lever.toml" text)
foreach(format "velocity = [1, 10, 14]" "torque = [1, 4, 12]" "current = [1, 5, 12]"
    "voltage = [1, 5, 11]" "observer_fraction = 24")
  string(REGEX MATCH "^[a-z_]+ = " key "${format}")
  string(REGEX REPLACE "\n${key}[^\n#]*" "\n${format} " text "${text}")
endforeach()
string(REGEX REPLACE "\ndescription = [^\n]*" "\ndescription = \"lever in shorter words\"" text "${text}")
file(CONFIGURE OUTPUT "${narrow}" CONTENT "${text}" @ONLY)

install(FILES "${narrow}" DESTINATION feltgate/data/rtl/designs COMPONENT python EXCLUDE_FROM_ALL)

file(GLOB sources CONFIGURE_DEPENDS "${FELTGATE_ROOT}/model/apps/python/*.cpp")
set(host "${FELTGATE_ROOT}/model/apps/python/host_binding.cpp")
list(REMOVE_ITEM sources "${host}")
# Loops over ticks are in the libraries; what binds them is optimised as far as that compiles fast.
pybind11_add_module(feltgate_python MODULE NO_EXTRAS ${sources})
set_target_properties(feltgate_python PROPERTIES OUTPUT_NAME _core)
feltgate_unity(feltgate_python)
target_compile_options(feltgate_python PRIVATE ${FELTGATE_WARNINGS} -O1)
target_compile_definitions(feltgate_python PRIVATE FELTGATE_VERSION="${PROJECT_VERSION}")
target_link_libraries(feltgate_python PRIVATE feltgate_registry feltgate_loop fmt::fmt)

# The host's side of the link with the compiler of laws, loaded when it is used.
pybind11_add_module(feltgate_python_host MODULE NO_EXTRAS "${host}")
set_target_properties(feltgate_python_host PROPERTIES OUTPUT_NAME _host)
target_compile_options(feltgate_python_host PRIVATE ${FELTGATE_WARNINGS} -O1)
target_link_libraries(feltgate_python_host PRIVATE feltgate_hostlink feltgate_traces fmt::fmt)

if(FELTGATE_PYTHON)
  # pip compiles once and on two cores: what reads files and laws is not in a loop, and headers are
  # read once for several sources.
  find_library(FELTGATE_TOML_LIBRARY tomlplusplus)
  if(FELTGATE_TOML_LIBRARY)
    target_compile_definitions(feltgate_config PUBLIC TOML_HEADER_ONLY=0 TOML_SHARED_LIB=1)
    target_link_libraries(feltgate_config PUBLIC "${FELTGATE_TOML_LIBRARY}")
  endif()
  foreach(library bounds config design files law plant_files traces units)
    target_compile_options(feltgate_${library} PRIVATE -O0)
  endforeach()
  foreach(library law design)
    target_precompile_headers(feltgate_${library} PRIVATE
      <algorithm> <cmath> <map> <optional> <sstream> <string> <vector> <fmt/format.h>)
  endforeach()
endif()

install(TARGETS feltgate_python feltgate_python_host LIBRARY DESTINATION feltgate COMPONENT python EXCLUDE_FROM_ALL)
install(DIRECTORY "${FELTGATE_ROOT}/model/apps/python/feltgate" DESTINATION . COMPONENT python EXCLUDE_FROM_ALL
  FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
# The folders keep their places, so that FELTGATE_ROOT may name a repository instead.
foreach(folder vectors/plants vectors/scenes vectors/traces rtl/designs rtl/laws)
  install(DIRECTORY "${FELTGATE_ROOT}/${folder}/" DESTINATION "feltgate/data/${folder}"
    COMPONENT python EXCLUDE_FROM_ALL)
endforeach()
install(FILES "${FELTGATE_ROOT}/rtl/registers.toml" DESTINATION feltgate/data/rtl COMPONENT python
  EXCLUDE_FROM_ALL)
