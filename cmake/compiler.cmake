# Compiler settings shared by every target. deal.II's own flags carry -g, which doubles the
# time and memory of each translation unit; a Release build does without. Debug is -O0 there: with
# -Og a unit compiles no slower, for it comes to less code, and its tests run faster.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# Debian's deal.II unrolls all loops, which costs compile time and gains nothing measurable.
string(REPLACE "-funroll-all-loops" "" DEAL_II_CXX_FLAGS_RELEASE "${DEAL_II_CXX_FLAGS_RELEASE}")
string(REPLACE "-funroll-loops" "" DEAL_II_CXX_FLAGS_RELEASE "${DEAL_II_CXX_FLAGS_RELEASE}")

# Debian 13's deal.II was linked with mold and hands that flag on, but not the linker.
if(DEAL_II_LINKER_FLAGS MATCHES "-fuse-ld=([a-z]+)")
  set(flag ${CMAKE_MATCH_0})
  find_program(STOCKWORK_LINKER NAMES ld.${CMAKE_MATCH_1} ${CMAKE_MATCH_1})
  if(NOT STOCKWORK_LINKER)
    string(REPLACE "${flag}" "" DEAL_II_LINKER_FLAGS "${DEAL_II_LINKER_FLAGS}")
    if(TARGET dealii::dealii)
      get_target_property(options dealii::dealii INTERFACE_LINK_OPTIONS)
      list(REMOVE_ITEM options ${flag})
      set_target_properties(dealii::dealii PROPERTIES INTERFACE_LINK_OPTIONS "${options}")
    endif()
  endif()
endif()

add_library(stockwork_options INTERFACE)
target_compile_options(stockwork_options INTERFACE $<$<CONFIG:Release>:-g0> $<$<CONFIG:Debug>:-Og;-g1>)
if(STOCKWORK_NATIVE)
  target_compile_options(stockwork_options INTERFACE $<$<CONFIG:Release>:-O3 -march=native>)
endif()
# Programs of tests spend their time in the library: -O1 compiles them in two thirds of the time.
target_compile_options(stockwork_options INTERFACE
  $<$<AND:$<CONFIG:Release>,$<BOOL:$<TARGET_PROPERTY:STOCKWORK_CALLS_ONLY>>>:-O1>)
if(STOCKWORK_UNITY)
  # Files compiled together are included, and the compiler takes what is included for a header, in
  # which an unnamed namespace would be a mistake.
  target_compile_options(stockwork_options INTERFACE -Wno-subobject-linkage)
endif()

find_program(STOCKWORK_CCACHE ccache)
if(STOCKWORK_CCACHE AND NOT STOCKWORK_PCH)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${STOCKWORK_CCACHE})
endif()

# The library's precompiled headers for a program: that takes the same compiler flags, down to the
# kind of position-independent code.
function(stockwork_reuse_headers target)
  if(STOCKWORK_PCH)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE -fPIC)
    target_precompile_headers(${target} REUSE_FROM stockwork)
  endif()
endfunction()

# An installed program finds its library beside it, and deal.II where it was found.
file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
set(CMAKE_INSTALL_RPATH "$ORIGIN/${bin_to_lib}")
set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
