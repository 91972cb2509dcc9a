# The tree is the registry: each folder of `root` whose name does not start with an underscore
# and which holds a .cc file is a fracture model. Folder F defines
#   namespace stockwork::F { void register_model(FractureModelRegistry &); }
# and `output` gets the one function which calls them all. Rewritten only when the list changes.
function(stockwork_write_model_table root output)
  file(GLOB model_sources CONFIGURE_DEPENDS RELATIVE ${root} ${root}/*/*.cc)
  set(models)
  foreach(file ${model_sources})
    get_filename_component(model ${file} DIRECTORY)
    if(NOT model MATCHES "^_")
      list(APPEND models ${model})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES models)

  set(declarations "")
  set(calls "")
  foreach(model ${models})
    string(APPEND declarations
      "namespace ${model}\n{\nvoid register_model(FractureModelRegistry &registry);\n}\n")
    string(APPEND calls "  ${model}::register_model(registry);\n")
  endforeach()
  if(NOT models)
    set(calls "  (void)registry;\n")
  endif()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT [[
// Written by CMake from the folders of source/fracture; edits are lost.
namespace stockwork
{
class FractureModelRegistry;
@declarations@
void register_all_fracture_models(FractureModelRegistry &registry);

void register_all_fracture_models(FractureModelRegistry &registry)
{
@calls@}
} // namespace stockwork
]])
  list(JOIN models ", " names)
  message(STATUS "Fracture models: ${names}")
endfunction()
