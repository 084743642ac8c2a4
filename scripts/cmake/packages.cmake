# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: 2026 the feltgate authors
#
# Lists all missing Debian packages together, with the command that installs them. The table is
# scripts/packages.txt.
set(packages_file "${FELTGATE_ROOT}/scripts/packages.txt")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${packages_file}")

# feltgate_check_packages(GROUP...): stops where one of these groups is missing; does nothing where there
# is no dpkg.
function(feltgate_check_packages)
  find_program(FELTGATE_DPKG_QUERY dpkg-query)
  mark_as_advanced(FELTGATE_DPKG_QUERY)
  if(NOT FELTGATE_DPKG_QUERY)
    return()
  endif()
  list(JOIN ARGN "|" groups)
  file(STRINGS "${packages_file}" rows REGEX "^(${groups})\\|")
  list(TRANSFORM rows REPLACE "^[a-z]+\\|([^|]+)\\|.*" "\\1" OUTPUT_VARIABLE names)
  list(REMOVE_DUPLICATES names)
  execute_process(COMMAND "${FELTGATE_DPKG_QUERY}" -W -f "\${Package} \${db:Status-Abbrev}\n" ${names}
    OUTPUT_VARIABLE known ERROR_QUIET)
  set(missing "")
  set(why "")
  foreach(name IN LISTS names)
    string(REPLACE "+" "\\+" pattern "${name}")
    if(NOT "\n${known}" MATCHES "\n${pattern} .i")
      list(APPEND missing ${name})
      foreach(row IN LISTS rows)
        if(row MATCHES "^[a-z]+\\|${pattern}\\|(.*)")
          string(APPEND why "  ${name}: ${CMAKE_MATCH_1}\n")
          break()
        endif()
      endforeach()
    endif()
  endforeach()
  if(missing)
    list(JOIN missing " " line)
    message(FATAL_ERROR "These Debian packages are missing:\n${why}Install them:\n"
      "  sudo apt-get install --no-install-recommends ${line}\n"
      "or, where they come from elsewhere, configure with -DFELTGATE_PACKAGES=OFF.")
  endif()
endfunction()
