# Run by `cmake --install`: puts the build in ${build} into the wheel's folder for it, ${CMAKE_INSTALL_PREFIX}, and its
# man pages and completions into ${data}, which pip unpacks into the environment, where man and the shells look for them.
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${build}" --prefix "${CMAKE_INSTALL_PREFIX}" --strip
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(MAKE_DIRECTORY "${data}/share")
foreach(folder IN ITEMS man bash-completion fish zsh)
  file(RENAME "${CMAKE_INSTALL_PREFIX}/share/${folder}" "${data}/share/${folder}")
endforeach()
file(REMOVE_RECURSE "${CMAKE_INSTALL_PREFIX}/share/doc")

# A wheel has no links. The library keeps the name by which programs need it.
file(GLOB library "${CMAKE_INSTALL_PREFIX}/lib*/libstride.so.*.*")
string(REGEX REPLACE "([.]so[.][0-9]+)[.].*" "\\1" needed "${library}")
cmake_path(GET library FILENAME whole_name)
cmake_path(GET needed FILENAME needed_name)
file(GLOB links "${CMAKE_INSTALL_PREFIX}/lib*/libstride.so*")
list(REMOVE_ITEM links "${library}")
file(REMOVE ${links})
file(RENAME "${library}" "${needed}")
file(REMOVE_RECURSE "${CMAKE_INSTALL_PREFIX}/lib/pkgconfig")  # its -lstride is such a link
file(GLOB exports "${CMAKE_INSTALL_PREFIX}/lib*/cmake/stride/strideTargets-*.cmake")
foreach(export IN LISTS exports)
  file(READ "${export}" text)
  string(REPLACE "${whole_name}" "${needed_name}" text "${text}")
  file(WRITE "${export}" "${text}")
endforeach()

# The kit for units in SystemC has to be linked with the SystemC that they are compiled with, which no wheel can know.
file(GLOB systemc
  "${CMAKE_INSTALL_PREFIX}/lib*/libstride_systemc*"
  "${CMAKE_INSTALL_PREFIX}/lib*/cmake/stride/*[sS]ystem[cC]*")
file(REMOVE_RECURSE ${systemc} "${CMAKE_INSTALL_PREFIX}/include/stride/systemc")
