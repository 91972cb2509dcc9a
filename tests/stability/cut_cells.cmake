# (e) A crack that cuts cells of 0.16 m in halves, or leaves 1e-8 of them on one side. There is no plain method here to fail:
# what is cut off counts by what it holds, and neither iterations nor errors hang on it.
set(deck prm/sneddon/cohesive_xfem.prm)
foreach(cut "halves:0" "sliver:0.0799999984")
  string(REPLACE ":" ";" cut ${cut})
  list(GET cut 0 name)
  list(GET cut 1 y)
  stockwork_case_test(NAME stability/e/${name} DECK ${deck}
    SET "Resolution=coarse" "Linear solver/Type=iterative" "Cracks/Open=-1 m, ${y} m -> 1 m, ${y} m" "Output/Fields=false"
    EXPECT "linear_iterations < 330" "errors/fracture_volume/final < 0.045") # 300, 256; 0.038, 0.040
endforeach()
