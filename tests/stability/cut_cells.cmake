# (e) A crack that cuts cells in halves, or leaves 1e-8 of them on one side. The stiffness as it stands is worse by
# what is cut off, down to a thousandth, which a crossing keeps from a corner; scaled by its diagonal it is not.
add_executable(conditioning conditioning.cc)
deal_ii_setup_target(conditioning)
target_include_directories(conditioning PRIVATE ${CMAKE_SOURCE_DIR}/source ${CMAKE_SOURCE_DIR}/tests)
target_link_libraries(conditioning stockwork)
stockwork_reuse_headers(conditioning)
add_test(NAME stability/e/conditioning COMMAND conditioning ${CMAKE_SOURCE_DIR}/tests/contract/fracture.prm
  --set Fracture/Model=cohesive_xfem --set Discretisation/Elements=Q1-Q1)
# So neither iterations nor errors hang on it. Cells of 0.16 m.
set(deck prm/sneddon/cohesive_xfem.prm)
foreach(cut "halves:0" "sliver:0.0799999984")
  string(REPLACE ":" ";" cut ${cut})
  list(GET cut 0 name)
  list(GET cut 1 y)
  stockwork_case_test(NAME stability/e/${name} DECK ${deck}
    SET "Resolution=coarse" "Linear solver/Type=iterative" "Cracks/Open=-1 m, ${y} m -> 1 m, ${y} m" "Output/Fields=false"
    EXPECT "linear_iterations < 330" "errors/fracture_volume/final < 0.045") # 300, 256; 0.038, 0.040
endforeach()
