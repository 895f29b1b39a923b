# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The component `python` of BUILD_DIR is installed below WORK_DIR, and PYTHON imports it from there.

file(REMOVE_RECURSE "${WORK_DIR}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --component python --prefix "${WORK_DIR}"
                RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the installation failed: ${text}")
endif()
set(check "import tandem, sys; assert tandem.__file__.startswith(sys.argv[1]), tandem.__file__; \
assert len(tandem.detect_planes([[x, y, 0] for x in range(20) for y in range(20)])) == 1")
execute_process(COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${WORK_DIR}/${PYTHON_DIR}" PYTHONDONTWRITEBYTECODE=1
                        "${PYTHON}" -c "${check}" "${WORK_DIR}"
                RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the installed package cannot be used")
endif()
file(GLOB_RECURSE files RELATIVE "${WORK_DIR}" "${WORK_DIR}/*")
list(LENGTH files count)
if(NOT count EQUAL 6)
  message(FATAL_ERROR "installed were ${files}")
endif()
