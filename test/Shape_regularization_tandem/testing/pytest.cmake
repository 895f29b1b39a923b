# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Tests by pytest, one for each file.

# Says at once what is missing: the tests fail without it.
function(tandem_find_pytest)
  execute_process(COMMAND "${Python3_EXECUTABLE}" -c "import numpy, pytest" RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
  if(NOT status EQUAL 0)
    message(NOTICE "Tests of the program and of the Python package need python3-pytest and python3-numpy for "
                   "'${Python3_EXECUTABLE}', or another -DPython3_EXECUTABLE.")
  endif()
endfunction()

# tandem_add_pytest(name file environment [python])
function(tandem_add_pytest name file environment)
  set(python "${Python3_EXECUTABLE}")
  if(ARGC GREATER 3)
    set(python "${ARGV3}")
  endif()
  get_filename_component(file "${file}" ABSOLUTE)
  add_test(NAME ${name} COMMAND "${python}" -m pytest -q -p no:cacheprovider "${file}"
                                "--basetemp=${CMAKE_CURRENT_BINARY_DIR}/${name}")
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "PYTHONDONTWRITEBYTECODE=1;${environment}"
                       SKIP_REGULAR_EXPRESSION "\n[0-9]+ skipped in ")
endfunction()
