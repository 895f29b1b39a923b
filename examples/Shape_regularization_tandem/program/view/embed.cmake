# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# cmake -DTHREE=FILE -DCONTROLS=FILE -DOUTPUT=FILE -P embed.cmake: writes the page of --view as a C++ source. Without
# THREE the page is empty.

file(WRITE "${OUTPUT}" "#include \"view/view_page.h\"\n\n")
# append_file(before file after): to the source, as raw strings.
function(append_file before file after)
  file(READ "${file}" content)
  file(APPEND "${OUTPUT}" "\nR\"tandem(${before})tandem\"\nR\"tandem(")
  file(APPEND "${OUTPUT}" "${content}")
  file(APPEND "${OUTPUT}" ")tandem\"\nR\"tandem(${after})tandem\"")
endfunction()

file(APPEND "${OUTPUT}" "const char* const program::page_before_model = \"\"")
if(THREE)
  append_file("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Tandem</title>\n<style>\n"
              "${CMAKE_CURRENT_LIST_DIR}/page.css" "</style>\n</head>\n<body>\n")
  append_file("" "${CMAKE_CURRENT_LIST_DIR}/page.html" "<script>\n/* three.js, MIT license */\n")
  append_file("" "${THREE}" "\n</script>\n<script>\n")
  append_file("" "${CONTROLS}" "\n</script>\n")
endif()
file(APPEND "${OUTPUT}" ";\nconst char* const program::page_after_model = \"\"")
if(THREE)
  append_file("<script>\n" "${CMAKE_CURRENT_LIST_DIR}/page.js" "</script>\n</body>\n</html>\n")
endif()
file(APPEND "${OUTPUT}" ";\n")
