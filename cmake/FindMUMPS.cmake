# The parallel MUMPS in double precision (not libdmumps_seq, which brings an MPI of its own).
# Defines the target MUMPS::MUMPS.
find_path(MUMPS_INCLUDE_DIR dmumps_c.h HINTS $ENV{MUMPS_DIR}/include ${MUMPS_DIR}/include)
find_library(MUMPS_LIBRARY dmumps HINTS $ENV{MUMPS_DIR}/lib ${MUMPS_DIR}/lib)
find_library(MUMPS_COMMON_LIBRARY mumps_common HINTS $ENV{MUMPS_DIR}/lib ${MUMPS_DIR}/lib)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MUMPS
  REQUIRED_VARS MUMPS_LIBRARY MUMPS_COMMON_LIBRARY MUMPS_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install libmumps-dev, or set MUMPS_DIR")

if(MUMPS_FOUND AND NOT TARGET MUMPS::MUMPS)
  add_library(MUMPS::MUMPS INTERFACE IMPORTED)
  set_target_properties(MUMPS::MUMPS PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${MUMPS_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${MUMPS_LIBRARY};${MUMPS_COMMON_LIBRARY}")
endif()
mark_as_advanced(MUMPS_INCLUDE_DIR MUMPS_LIBRARY MUMPS_COMMON_LIBRARY)
