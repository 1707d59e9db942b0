# Writes the scenes of this folder into one C++ file: cmake -DOUT=scenes.cpp -P embed.cmake
file(GLOB scenes RELATIVE ${CMAKE_CURRENT_LIST_DIR} ${CMAKE_CURRENT_LIST_DIR}/*.obj ${CMAKE_CURRENT_LIST_DIR}/*.mtl)
list(SORT scenes)
set(rows "")
foreach(scene IN LISTS scenes)
  file(READ ${CMAKE_CURRENT_LIST_DIR}/${scene} text)
  string(APPEND rows "      {\"${scene}\", R\"urad(${text})urad\"},\n")
endforeach()
file(WRITE ${OUT} "// Written by host/scenes/embed.cmake from the files of that folder.
#include \"scene/builtin.hpp\"

namespace host {

std::vector<EmbeddedFile> embedded_files() {
  return {
${rows}  };
}

}  // namespace host
")
