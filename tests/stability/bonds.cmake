# (h) What counts as within the horizon of a bond, in a rod that drains; time steps leave 0.0015.
set(rod "Resolution=coarse" "Time/Error tolerance=inf" "Time/Initial step=10 s" "Time/End time=100 s" "Output/Fields=false"
  "Fracture/peridynamics/Horizon=2")
set(deck prm/column/rod/peridynamics.prm)
foreach(rule full:0.06 ramp:0.02 exact:0.008) # 0.069, 0.033, 0.012
  string(REPLACE ":" ";" rule ${rule})
  list(GET rule 0 volumes)
  list(GET rule 1 least)
  stockwork_case_test(NAME stability/h/${volumes}/fails DECK ${deck}
    SET ${rod} "Fracture/peridynamics/Bond volumes=${volumes}" EXPECT "errors/displacement/final > ${least}")
endforeach()
stockwork_case_test(NAME stability/h/isotropic DECK ${deck}
  SET ${rod} "Fracture/peridynamics/Bond volumes=isotropic" EXPECT "errors/displacement/final < 0.002")
# At 30 degrees to the mesh, bonds lead a fracture into its lines, whatever the horizon; on a path, and in cells with jumps, they do not.
set(turned "Resolution=coarse" "Time/End time=2 s" "Output/Fields=false")
stockwork_case_test(NAME stability/h/grid_angle/fails DECK prm/kgd/rotated/30/peridynamics.prm
  SET ${turned} "Fracture/peridynamics/Tracking=none" EXPECT "direction < 20")
stockwork_case_test(NAME stability/h/grid_angle/path DECK prm/kgd/rotated/30/peridynamics.prm
  SET ${turned} EXPECT "direction > 27" "direction < 33")
stockwork_case_test(NAME stability/h/grid_angle/jumps DECK prm/kgd/rotated/30/damage.prm
  SET ${turned} EXPECT "direction > 27" "direction < 33" "final/fracture_length > 2.5")
