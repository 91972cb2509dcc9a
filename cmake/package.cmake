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

install(EXPORT StockworkTargets NAMESPACE Stockwork:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/StockworkConfig.cmake.in
  ${CMAKE_BINARY_DIR}/StockworkConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/StockworkConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/StockworkConfig.cmake
  ${CMAKE_BINARY_DIR}/StockworkConfigVersion.cmake DESTINATION ${package_dir})
