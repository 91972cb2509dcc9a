# The tree is the registry: each folder of `root` whose name does not start with an underscore
# and which holds a .cc file is a plug-in. Folder F defines
#   namespace stockwork::F { void register_<what>(<Registry> &); }
# and `output` gets the one function which calls them all, register_all_<all>. Rewritten only when
# the list changes.
function(stockwork_write_plug_in_table root output what all registry)
  file(GLOB plug_in_sources CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*/*.cc)
  set(folders)
  foreach(file ${plug_in_sources})
    get_filename_component(folder ${file} DIRECTORY)
    if(NOT folder MATCHES "^_")
      list(APPEND folders ${folder})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES folders)

  set(declarations "")
  set(calls "")
  foreach(folder ${folders})
    string(APPEND declarations
      "namespace ${folder}\n{\nvoid register_${what}(${registry} &registry);\n}\n")
    string(APPEND calls "  ${folder}::register_${what}(registry);\n")
  endforeach()
  if(NOT folders)
    set(calls "  (void)registry;\n")
  endif()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
// Written by CMake from the folders of the source tree; edits are lost.
namespace stockwork
{
class @registry@;
@declarations@
void register_all_@all@(@registry@ &registry);

void register_all_@all@(@registry@ &registry)
{
@calls@}
} // namespace stockwork
]])
  list(JOIN folders ", " names)
  message(STATUS "Plug-ins, ${all}: ${names}")
endfunction()
