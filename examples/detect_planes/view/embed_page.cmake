# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Writes the C++ source OUTPUT with the page of the view: page.html of this folder with its styles and scripts, and with
# three.js (THREE) and its controls (CONTROLS). Without these, the source has no page.

cmake_minimum_required(VERSION 3.16)

set(piece_size 8000) # bytes; some compilers take no literal beyond 16 K

# A table of raw literals. The text is ASCII: a piece may end anywhere.
function(add_pieces name text)
  string(LENGTH "${text}" length)
  set(pieces "")
  set(first 0)
  while(first LESS length)
    string(SUBSTRING "${text}" ${first} ${piece_size} piece)
    string(APPEND pieces "  R\"embedded(${piece})embedded\",\n")
    math(EXPR first "${first} + ${piece_size}")
  endwhile()
  file(APPEND "${OUTPUT}.new" "extern const char* const ${name}[] = {\n${pieces}  nullptr};\n")
endfunction()

# insert(mark file): in place of the mark.
macro(insert mark file)
  file(READ "${file}" content)
  string(REPLACE "${mark}" "${content}" page "${page}")
endmacro()

set(before "")
set(after "")
if(THREE AND CONTROLS)
  file(READ "${CMAKE_CURRENT_LIST_DIR}/page.html" page)
  foreach(part IN ITEMS page.css points.js layers.js shapes.js shaders.js viewer.js cloud.js visibility.js panel.js
                        clip.js list.js measure.js save.js address.js controls.js page.js)
    insert("@${part}@" "${CMAKE_CURRENT_LIST_DIR}/${part}")
  endforeach()
  insert("@controls@" "${CONTROLS}")
  insert("@three@" "${THREE}")
  string(FIND "${page}" "@data@" mark)
  string(SUBSTRING "${page}" 0 ${mark} before)
  math(EXPR mark "${mark} + 6")
  string(SUBSTRING "${page}" ${mark} -1 after)
endif()

file(WRITE "${OUTPUT}.new" "// Made by embed_page.cmake.\n\nnamespace program {\n\n")
add_pieces(page_before_data "${before}")
add_pieces(page_after_data "${after}")
file(APPEND "${OUTPUT}.new" "\n} // namespace program\n")
file(RENAME "${OUTPUT}.new" "${OUTPUT}")
