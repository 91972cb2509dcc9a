# Installation, and the exported package: find_package(Stockwork) from another tree gives the
# target Stockwork::stockwork and the function stockwork_add_plugin(name source...).
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Stockwork)

install(TARGETS stockwork EXPORT StockworkTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET stockwork_program)
  install(TARGETS stockwork_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/stockwork DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/prm DESTINATION ${CMAKE_INSTALL_DATADIR}/stockwork OPTIONAL)

# The study tool lies beside the decks, with what it takes from the other scripts, and is run by a link.
set(scripts_dir ${CMAKE_INSTALL_DATADIR}/stockwork/contrib)
install(PROGRAMS ${CMAKE_SOURCE_DIR}/contrib/stockwork-study DESTINATION ${scripts_dir})
install(FILES ${CMAKE_SOURCE_DIR}/contrib/arguments.py ${CMAKE_SOURCE_DIR}/contrib/results.py
  ${CMAKE_SOURCE_DIR}/contrib/measures.py ${CMAKE_SOURCE_DIR}/contrib/closure.py
  DESTINATION ${scripts_dir})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/contrib/study ${CMAKE_SOURCE_DIR}/contrib/plot
  DESTINATION ${scripts_dir} FILES_MATCHING PATTERN "*.py")
file(RELATIVE_PATH bin_to_scripts ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_PREFIX}/${scripts_dir})
install(CODE "
  set(bin \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_BINDIR}\")
  file(MAKE_DIRECTORY \"\${bin}\")
  file(CREATE_LINK ${bin_to_scripts}/stockwork-study \"\${bin}/stockwork-study\" SYMBOLIC)")

install(EXPORT StockworkTargets NAMESPACE Stockwork:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/StockworkConfig.cmake.in
  ${CMAKE_BINARY_DIR}/StockworkConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/StockworkConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/StockworkConfig.cmake
  ${CMAKE_BINARY_DIR}/StockworkConfigVersion.cmake DESTINATION ${package_dir})
