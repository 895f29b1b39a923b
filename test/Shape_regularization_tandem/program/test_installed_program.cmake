# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The component `program` that is installed: the program, the completion of its options, and its page of the manual
# where help2man is found. Needs bash for the completion.

include("${CMAKE_CURRENT_LIST_DIR}/support.cmake")

execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${WORK_DIR}/usr" --component program
                RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
expect_equal("cmake --install" "${status}" 0)
set(PROGRAM "${WORK_DIR}/usr/bin/detect_planes")
expect(0 "^detect_planes \\(Tandem\\) [0-9]+\\.[0-9]+\\.[0-9]+\n$" --version)

# complete(previous word found): what bash offers for the word after the previous one.
function(complete previous word found)
  execute_process(
    COMMAND bash -c ". \"$1\"; _detect_planes \"$2\" \"$3\" \"$4\"; echo \${COMPREPLY[*]}" bash
            "${WORK_DIR}/usr/share/bash-completion/completions/detect_planes" "${PROGRAM}" "${word}" "${previous}"
    OUTPUT_VARIABLE out ERROR_VARIABLE err OUTPUT_STRIP_TRAILING_WHITESPACE)
  expect_equal("completion of '${word}' after '${previous}'" "${out}${err}" "${found}")
endfunction()
find_program(BASH bash)
if(BASH)
  complete("cloud.ply" "--ang" "--angle-tolerance")
  complete("--backend" "s" "sequential")
  complete("detect_planes" "cloud" "")
  complete("--output-directory" "${WORK_DIR}/us" "${WORK_DIR}/usr")
endif()

if(HELP2MAN)
  file(READ "${WORK_DIR}/usr/share/man/man1/detect_planes.1" page)
  if(NOT page MATCHES "maximum.-distance")
    complain("the page of the manual has no options")
  endif()
endif()
finish()
