# carom_embed_page(NAMESPACE FILE): the page FILE of this folder as the header
# "<folder>/page_text.h" with NAMESPACE::kPagePieces: string literals short enough for every compiler.
# Scripts that the page takes from beside it become a part of it.
function(carom_embed_page namespace file)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} page)
  cmake_path(GET file PARENT_PATH page_folder)
  string(REGEX MATCHALL "<script src=\"[a-z_]+[.]js\"></script>" tags "${page}")
  foreach(tag IN LISTS tags)
    string(REGEX REPLACE "<script src=\"(.+)\"></script>" "${page_folder}/\\1" script_file "${tag}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${script_file})
    file(READ ${script_file} script)
    string(REPLACE "${tag}" "<script>\n${script}</script>" page "${page}")
  endforeach()
  string(LENGTH "${page}" page_length)
  set(piece_length 12000)
  set(pieces "")
  foreach(begin RANGE 0 ${page_length} ${piece_length})
    string(SUBSTRING "${page}" ${begin} ${piece_length} piece)
    string(APPEND pieces "    R\"carom_page(${piece})carom_page\",\n")
  endforeach()
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(header ${PROJECT_BINARY_DIR}/generated/${folder}/page_text.h)
  file(WRITE ${header}.new "// Written by CMake from ${folder}/${file}.
#pragma once

namespace ${namespace} {

inline constexpr const char* kPagePieces[] = {
${pieces}};

}  // namespace ${namespace}
")
  file(COPY_FILE ${header}.new ${header} ONLY_IF_DIFFERENT)
endfunction()
