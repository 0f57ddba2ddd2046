# Run by `cmake --install`: puts the build in ${build} into the wheel's folder for it, ${CMAKE_INSTALL_PREFIX}, and its
# man pages and completions into ${data}, which pip unpacks into the environment, where man and the shells look for them.
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${build}" --prefix "${CMAKE_INSTALL_PREFIX}" --strip
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(MAKE_DIRECTORY "${data}/share")
foreach(folder IN ITEMS man bash-completion fish zsh)
  file(RENAME "${CMAKE_INSTALL_PREFIX}/share/${folder}" "${data}/share/${folder}")
endforeach()
file(REMOVE_RECURSE "${CMAKE_INSTALL_PREFIX}/share/doc")

# The kit for units in SystemC has to be linked with the SystemC that they are compiled with, which no wheel can know.
file(GLOB systemc
  "${CMAKE_INSTALL_PREFIX}/lib*/libstride_systemc*"
  "${CMAKE_INSTALL_PREFIX}/lib*/cmake/stride/*[sS]ystem[cC]*")
file(REMOVE_RECURSE ${systemc} "${CMAKE_INSTALL_PREFIX}/include/stride/systemc")
