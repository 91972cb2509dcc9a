# Target `doc`: Doxygen pages of the installed headers and of the texts in doc/.
find_package(Doxygen REQUIRED)
configure_file(${CMAKE_SOURCE_DIR}/doc/Doxyfile.in ${CMAKE_BINARY_DIR}/Doxyfile @ONLY)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/doc)
add_custom_target(doc COMMAND Doxygen::doxygen ${CMAKE_BINARY_DIR}/Doxyfile
  COMMENT "Documentation: ${CMAKE_BINARY_DIR}/doc/html/index.html" VERBATIM)
